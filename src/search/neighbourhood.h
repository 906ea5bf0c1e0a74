#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "search/adaptive_choice.h"
#include "search/delayed_robots.h"
#include "search/departures.h"
#include "search/path_table.h"
#include "search/stay.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// Robots that are planned anew together, and from when on.
struct Neighbourhood {
  std::vector<std::uint32_t> robots;  ///< each once
  /// Whether other paths of the same cost will do; if not, the first robot, a delayed
  /// one, has to arrive earlier.
  bool sideways = false;
  /// Whether the others stay on their paths where the first robot leaves them free, and the rest
  /// must not use up what it gains; if not, all share what they cost together.
  bool keeps = false;
  /// Who arrives by `event` may change its path from `reach` steps before its arrival on, everybody
  /// else from `reach` steps before `event`.
  std::uint32_t event = 0;
  std::uint32_t reach = 0;

  /// The step up to which a robot keeps its path: one at which it comes to a vertex, or may leave
  /// its start.
  std::uint32_t keptUntil(const Path& path, std::uint32_t departure = 0) const;
};

/// Chooses the robots that are planned anew together, and the part of their paths, in one of
/// several ways, sizes and reaches; those that gained more for their effort are chosen more often.
/// Source: Li et al., IJCAI 2021 (delayed robots and random walks; adaptive weights after Ropke and
/// Pisinger 2006). Ours: the robots in the way of a delayed one's arrival, the crowd around a cell,
/// sizes chosen like ways, gains counted by effort, and windows: what lies before a lost step is
/// mostly as good as it can be, and need not be searched again. Their ends are elastic, as every
/// robot's way leads on to its goal. And the rarer gains get, the more often a neighbourhood leads
/// sideways, across plateaus: that takes longer than to see that a delayed robot stays delayed.
/// And either everybody is planned anew, or, with a fraction of the searches, only who has to be.
class NeighbourhoodPicker {
 public:
  NeighbourhoodPicker(const Instance& instance, std::uint64_t seed, Departures departures = {});

  /// Puts at least one robot into `picked`. @param table  holds the paths of the plan, and of
  /// others, which are never picked, under greater numbers.
  void pick(const Plan& plan, const PathTable& table, Neighbourhood& picked);
  /// What came of the last pick: steps gained and states expanded.
  void reward(std::uint64_t gain, std::uint64_t expansions);

  DelayedRobots& delayed() { return delayed_; }

 private:
  enum Way { kInTheWay, kAroundArrival, kCrowd, kRandom, kWays };
  static constexpr std::array<std::uint32_t, 5> kSizes = {1, 2, 4, 8, 16};
  static constexpr std::array<std::uint32_t, 3> kReaches = {16, 64, kForever};

  void add(std::uint32_t robot, std::vector<std::uint32_t>& robots);
  std::uint32_t keptUntil(const Plan& plan, std::uint32_t robot, const Neighbourhood& picked) const;
  void addOccupants(const PathTable& table, Vertex v, std::uint32_t from, std::uint32_t to,
                    std::size_t size, std::vector<std::uint32_t>& robots);
  void dropWhoStays(const Plan& plan, std::uint32_t first,
                    std::vector<std::uint32_t>& robots) const;
  /// A step of the robot's path at which the neighbourhood may look around.
  std::uint32_t drawStep(const Plan& plan, std::uint32_t robot, const Neighbourhood& picked);
  void walkInTheWay(const Plan& plan, const PathTable& table, std::uint32_t robot, std::size_t size,
                    Neighbourhood& picked);
  void takeAroundArrival(const Plan& plan, const PathTable& table, std::uint32_t robot,
                         std::size_t size, Neighbourhood& picked);
  void takeCrowd(const Plan& plan, const PathTable& table, std::uint32_t robot, std::size_t size,
                 Neighbourhood& picked);

  const Instance& instance_;
  const Departures departures_;
  DelayedRobots delayed_;
  RandomEngine engine_;
  AdaptiveChoice<kWays> ways_;
  AdaptiveChoice<kSizes.size()> sizes_;
  AdaptiveChoice<kReaches.size()> reaches_;
  AdaptiveChoice<2> keeps_;
  std::vector<std::uint32_t> marks_;  // by robot: number of the last pick that took it
  std::uint32_t pick_number_ = 0;
  std::uint64_t in_vain_ = 0;  // searches since the last gain
};

}  // namespace split_mapf
