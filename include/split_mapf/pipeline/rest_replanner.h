#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/execution_cut.h"
#include "split_mapf/core/execution_forecast.h"
#include "split_mapf/core/execution_graph.h"
#include "split_mapf/core/instance.h"

namespace split_mapf {

struct KeptSchedule;

/// How much a replan may cost. Counted in work, so that runs can be repeated.
struct ReplanBudget {
  /// States of all searches. All that is done counts as so many of them as take as long: a search
  /// that looks at more neighbours and reaches more places for each state, that may evict, paths
  /// that are taken out and put back, and each visit of the rest.
  /// 0: kDefaultExpansions a robot, and kLeastExpansions at least.
  std::uint64_t expansions = 0;
  std::uint64_t seed = 0;
  static constexpr std::uint64_t kDefaultExpansions = 680;
  static constexpr std::uint64_t kLeastExpansions = 680000;
};

/// What a replan may rely on.
struct ReplanQuestion {
  const ExecutionGraph* graph = nullptr;  ///< the execution as it stands
  /// For how long each robot is expected to stand still [ticks]; empty: none does.
  std::vector<std::uint32_t> stands;
  /// From where each robot came to where it is, see quarterTurns(); empty: turns do not matter.
  std::vector<Vertex> came_from;
  std::uint32_t commit = 1;  ///< [ticks] the events that begin before are promised, and stay
  bool avoid_rings = false;  ///< with a release above 0
  /// What is promised whatever the forecast says, downward-closed; empty: nothing.
  Cut promised;
  std::uint64_t asked = 0;  ///< when, on a clock of the caller's [ticks]; see RestReplanner
};

/// What came of a replan.
struct ReplanAnswer {
  std::optional<ExecutionGraph> execution;  ///< to go on with; nothing: go on as before
  std::uint64_t cost_before = 0;            ///< forecast sum of arrivals [ticks from now]
  std::uint64_t cost_after = 0;             ///< the same with what was found
  std::uint32_t rings = 0;                  ///< of the execution to go on with
  std::uint64_t expansions = 0;             ///< of all searches
  std::uint64_t states = 0;                 ///< of the budget, that all that was done took
};

/// Plans the rest of an execution anew while it goes on. What robots are promised stays: the events
/// that the forecast lets begin before `commit` ticks are over make a downward-closed cut. The
/// forecast of the rest, which is a valid plan, is the warm start; robots known to stand stay at
/// their starts for so long. It is improved by replanSingly() and NeighbourhoodSearch within the
/// budget, validated, and put behind the cut. It is taken when its forecast, with releases, turns
/// and stands, is cheaper, so the execution never gets worse by what is known, and at no time is
/// there none. With `avoid_rings` a robot of each ring is planned anew so that it does not close
/// it, where that is possible within half of the budget; what is left is a joint move. Then, but
/// for maps of lanes, searches keep a headway of a step, see ReservationTable.
///
/// Orders that are kept make hundreds late where one robot is. So robots rather go on as the last
/// replan had them, if those that cannot find places among these, see EjectionChain::repair(), at
/// no more than the forecast costs.
///
/// It remembers when robots were expected to arrive: those that will arrive later than that are
/// where something has happened, and most searches begin there. What cannot be brought back is
/// expected to be later by a tick for each tick that has passed.
///
/// Source: ours. Not thread-safe. Cost: the budget, and O(events).
class RestReplanner {
 public:
  /// The instance outlives this object: its goals are those of the robots. Its distances are found
  /// here where they are not yet, so that no replan has to wait for them.
  RestReplanner(const Instance& instance, const MotionTimes& times, const ReplanBudget& budget);
  ~RestReplanner();
  RestReplanner(const RestReplanner&) = delete;
  RestReplanner& operator=(const RestReplanner&) = delete;

  /// @throws std::logic_error when what was found is not valid, which would be a bug.
  ReplanAnswer replan(const ReplanQuestion& question, const Deadline& deadline = {});

 private:
  void expect(const std::vector<std::uint32_t>& arrivals, std::uint64_t asked);

  const Instance& instance_;
  const bool is_of_lanes_;
  MotionTimes times_;
  ReplanBudget budget_;
  std::uint64_t replans_ = 0;
  std::vector<std::uint64_t> expected_;           // arrival by robot [ticks of the caller's clock]
  std::uint64_t asked_ = 0;                       // last
  const std::unique_ptr<KeptSchedule> schedule_;  // what the last replan planned
};

}  // namespace split_mapf
