#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "search/departures.h"
#include "search/eviction_search.h"
#include "search/reservation_table.h"
#include "search/retiming.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// A robot's new path.
struct PathChange {
  std::uint32_t robot = 0;
  Path path;
};

/// Where a chain begins and how far it goes.
struct ChainStart {
  std::uint32_t robot = 0;   ///< has to arrive earlier than it does
  Path path;                 ///< its path or one as good; goes into the table for the time
  std::uint32_t event = 0;   ///< a step that it loses
  std::uint32_t reach = 0;   ///< robots change their paths so many steps before they have to
  std::uint32_t loss = 0;    ///< by how much the sum of costs may grow
  std::size_t searches = 1;  ///< paths that may be searched for
  bool hasty = false;        ///< see EvictionQuery
};

/// Robots that have no place in a table, and how far they may go to find one.
struct RepairStart {
  std::vector<std::uint32_t> unplaced;
  std::vector<std::uint32_t> standing;  ///< nobody ejects these
  std::uint64_t spare = 0;              ///< what all may cost more than in the plan
  std::uint32_t slack = 0;   ///< what one may, and where that is not enough kMoreSlack times it
  std::uint32_t reach = 0;   ///< robots change their paths so many steps before they have to
  std::size_t searches = 1;  ///< paths that may be searched for
  static constexpr std::uint32_t kMoreSlack = 16;
};

/// Improves a valid plan for sum of costs by a chain of ejections: a robot takes the earlier path
/// that the fewest others are in the way of, these look for new paths from shortly before they meet
/// it, ejecting others in turn, and so on until everybody has one, within what they all cost
/// before. Whoever was ejected in the chain is the harder to eject again. Deterministic but for the
/// deadline. Keeps its memory between calls; not thread-safe.
/// Source: ejection chains, Glover, Discrete Applied Math. 1996; for robots within a fixed horizon,
/// the CG:SHOP 2021 winners' conflict optimisation (see Placement). Ours: a budget in place of the
/// horizon, and windows, which make a chain a third of the work.
class EjectionChain {
 public:
  /// @param latest_arrival  nobody arrives after it. The instance outlives this object.
  /// @param reserved  paths in the table behind those of the robots, which are never ejected.
  EjectionChain(const Instance& instance, std::uint32_t latest_arrival, Departures departures = {},
                std::size_t reserved = 0);

  /// @return whether everybody found a path: then the new ones are in the table, else the old ones.
  /// @pre the table holds the paths of the plan, which is valid.
  bool run(const ChainStart& start, const Plan& plan, ReservationTable& table,
           const Deadline& deadline);
  /// Finds paths for robots that have none in the table, where others may make room for them.
  /// @return whether everybody found one: then all are in the table; else it is of no use any more.
  /// @pre the table holds the paths of the plan but of these, and nobody is where they begin before
  /// they depart.
  bool repair(const RepairStart& start, const Plan& plan, ReservationTable& table,
              const Deadline& deadline);
  /// Of the last run, which succeeded.
  std::vector<PathChange>& changes() { return changes_; }
  /// By how many steps these are better, less than 0 where a loss was allowed.
  std::int64_t gain() const { return spare_ - loss_; }
  /// Puts the old paths back into the table. @pre the last run succeeded, and the plan is what it
  /// was.
  void undo(const Plan& plan, ReservationTable& table);
  /// Of all runs.
  const SearchWork& work() const { return work_; }

 private:
  /// A robot of the chain: it has a place on its path, or waits for one.
  struct Link {
    std::uint32_t robot = 0;
    Path path;               // while it waits the table has it until `kept`
    std::uint32_t kept = 0;  // while it waits
    bool waits = false;
  };

  bool placeAll(const ChainStart& start, const Deadline& deadline);
  bool placeNext(const ChainStart& start, const Deadline& deadline);
  Path search(const ChainStart& start, const Link& link, std::int64_t more, bool may_eject,
              const Deadline& deadline);
  std::int64_t mostMore(std::uint32_t slack) const;
  void weighMore(std::uint32_t robot);
  bool mayAllBeEjected(std::size_t link, const Path& by) const;
  std::uint32_t firstInTheWay(const Path& by, const Path& path) const;
  void eject(std::uint32_t robot, const Path& by, std::uint32_t reach);
  Link& linkOf(std::uint32_t robot);
  std::int64_t costOf(const Path& path) const { return static_cast<std::int64_t>(path.size() - 1); }
  std::int64_t oldCost(const Link& link) const { return costOf(plan_->paths[link.robot]); }
  void wait(std::size_t link, std::uint32_t kept);
  void finish();

  const Instance& instance_;
  const Departures departures_;
  std::uint32_t latest_arrival_;
  EvictionSearch search_;
  WaitPlacer waits_;
  std::vector<std::uint32_t> weights_;  // by robot, 1 but in a chain; then of the reserved paths
  SearchWork work_;

  const Plan* plan_ = nullptr;  // during a run, as are all of these
  ReservationTable* table_ = nullptr;
  std::vector<Link> links_;
  std::deque<std::size_t> waiting_;
  std::size_t searches_left_ = 0;
  std::int64_t spare_ = 0;  // what those in place cost less than before, and the loss
  std::int64_t loss_ = 0;
  std::uint32_t slack_ = 0;  // of a repair, else 0
  std::vector<PathChange> changes_;
};

}  // namespace split_mapf
