#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// What a rolling planner is told once.
struct RollingOptions {
  std::uint32_t window = 20;  ///< [steps] planned ahead, 1 .. kMostWindow; see windowFor()
  std::uint32_t threads = 1;  ///< at least 1; what is planned does not depend on it
  std::uint64_t seed = 0;     ///< all randomness
  std::size_t cache_bytes = std::size_t{1} << 29U;  ///< of distances by goal; see Rolling
  static constexpr std::uint32_t kMostWindow = 31;
  static constexpr std::uint32_t kMostThreads = 8;  ///< that are used: as many as try at a time
};

/// The window that pays [steps]: where a map is crowded a shorter one, as robots there come to
/// other places than they were planned to anyway, and more ways are tried in the same time.
/// @param vertices  of the map. Cost: O(1). Thread-safe.
std::uint32_t windowFor(std::size_t robots, std::size_t vertices);

/// One robot of a fleet that never stops.
struct RollingRobot {
  std::uint32_t id = 0;  ///< its own from question to question; no two have the same
  /// Where it is at step 0, and the steps that it is bound to already; from the last of them on it
  /// is free. One that becomes free later waits in it. Never empty.
  Path prefix;
  /// What it was going to do from step 0 on: the last answer's path without the steps that are
  /// over. A warm start; empty, or wrong: it is planned anew.
  Path known;
  /// To be visited in this order; empty: idle. Robots may have the same ones. A goal counts as
  /// reached as soon as the robot is there: it is passed, not held.
  std::vector<Vertex> goals;
  std::uint32_t priority = 0;  ///< the greater one goes first
  std::uint32_t age = 0;       ///< [steps] that it has been after its goal; among equal priorities
  bool may_move = true;        ///< false: stays at its prefix's end, and is an obstacle
};

/// A fleet as it stands now.
struct RollingQuestion {
  std::vector<RollingRobot> robots;
  std::vector<Vertex> blocked;  ///< a robot that is there may leave; none comes in
};

/// The next steps of a fleet.
struct RollingAnswer {
  std::vector<Path> paths;             ///< by robot; window + 1 entries each, from step 0
  std::vector<std::uint32_t> reached;  ///< by robot: goals visited in the window
  std::vector<std::uint32_t> cut_off;  ///< robots whose first goal has no way; treated as idle
  std::uint64_t cost = 0;              ///< steps lost against robots alone, over all
  std::uint64_t expansions = 0;        ///< states of all searches, but of escorts
  std::uint32_t escorts = 0;           ///< under way for robots that had gained nothing
  std::uint32_t resting = 0;           ///< robots with goals that rest, as a crowd has jammed
};

/// Plans the next steps of a fleet whose goals come one by one. begin() takes the fleet as it is
/// and has a valid window at once: what was known, extended step by step by priority inheritance;
/// improve() makes it better, as often as there is time for; answer() gives it. Robots are worth
/// the steps that they still have to go at the window's end, over this goal and the next ones.
/// Groups of 2 to 8 of them, a delayed one and those in its way, are planned anew together among
/// the others, by searches over (vertex, step, goals reached). A robot that comes no nearer to its
/// goal for three windows is led on by a search that is complete for it, whoever is around making
/// room; where robots take more than two fifths of the vertices, and it has been after its goal for
/// fewer than twenty windows, only after ten. Steps in which it stands because it is bound to do
/// not count. Where such a crowd jams, only some of the robots go, by priority and age, and beside
/// them those that could not be led; the others rest as if they were idle, until it flows again.
///
/// At any thread count the same questions and numbers of expansions give the same answers; a clock
/// chooses only how often improve() is called. Every answer has passed a check of its own.
/// Every robot may stop at the end of its prefix: a question in which that would be a collision is
/// refused. Distances are kept by goal, a byte a vertex, within `cache_bytes`, or what the robots
/// need now. Not thread-safe. Source: windows after Li et al. (RHCR, AAAI 2021); the rest is ours.
/// Cost: begin() O(robots * window + vertices), and a breadth-first search for each new goal, by
/// all threads; the first improve() the same for goals behind it, and where a robot is stuck at
/// most two searches that visit 100,000 vertices each and one more window, in a crowd two; memory
/// about 250 bytes a vertex, and 109 a thread.
class Rolling {
 public:
  /// @throws OptionError for a window or a number of threads out of range; InputError where a
  /// vertex has more than four neighbours.
  Rolling(std::shared_ptr<const Grid> grid, const RollingOptions& options);
  ~Rolling();
  Rolling(const Rolling&) = delete;
  Rolling& operator=(const Rolling&) = delete;

  /// Takes the fleet as it is. @param steps  that are over since the last question.
  /// @throws InputError naming robot and cell: a prefix that is empty, longer than the window, no
  /// path, or in conflict with another one; two robots with one id; a goal off the graph.
  void begin(const RollingQuestion& question, std::uint32_t steps = 1);
  /// Searches on for so many expansions, or until the deadline. The first call behind begin() looks
  /// for escorts, too, and may make another window for them, or from nothing that was known in a
  /// crowd. None of that is cut by `expansions` or the deadline. @return expansions done; 0 when
  /// nothing is left to improve.
  /// @pre begin() was called.
  std::uint64_t improve(std::uint64_t expansions, const Deadline& deadline = {});
  /// @throws std::logic_error when what was planned is not valid, which would be a bug.
  RollingAnswer answer();

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

}  // namespace split_mapf
