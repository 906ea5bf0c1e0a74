#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "solver/ilp/conflict_row.h"
#include "solver/ilp/decision.h"
#include "solver/ilp/glpk_model.h"
#include "solver/ilp/penalties.h"
#include "solver/ilp/robot_rules.h"

namespace split_mapf::ilp {

/// The linear program over paths: every robot takes one path, or its artificial column that stands
/// for "none that I know"; conflict rows come when they are needed. What has not mattered for a
/// while is dropped again.
class Master {
 public:
  /// @param artificial_costs  by robot: above the cost of every path that may matter.
  Master(const MoveSpace& space, const std::vector<double>& artificial_costs,
         const Deadline& deadline, std::size_t memory_mb);

  /// False when the path is there already.
  bool addColumn(std::uint32_t robot, const Path& path, double cost);
  void addRow(ConflictRow row);
  /// Allows exactly the columns that cost at most `most_costs[robot]` and obey the rules.
  void allowOnly(const std::vector<RobotRules>& rules, const std::vector<double>& most_costs);

  LpStatus solve();
  /// Tries a decision: what the program would cost under it with the columns it has.
  /// The next solve() begins where this one ended.
  /// @return nothing when interrupted.
  std::optional<double> probe(const Decision& decision, const Instance& instance);
  double objective() const { return model_.objective(); }
  /// What the artificial columns sum up to.
  double artificialUse() const;
  /// The paths in use, robot by robot.
  std::vector<UsedPath> usedPaths() const;
  double robotDual(std::uint32_t robot) const { return model_.dual(static_cast<int>(robot)); }
  /// Turns the duals of the rows into penalties; returns what the Lagrangian bound loses by them.
  double writePenalties(Penalties& penalties) const;
  /// Drops what has not mattered for long. Invalidates usedPaths().
  /// @param hopeless  a column whose reduced cost is above this goes at once.
  void purge(double hopeless);

  std::size_t columns() const { return columns_.size(); }
  std::size_t conflictRows() const { return rows_.size(); }
  std::size_t memoryBytes() const;
  /// GlpkModel::work(): about as many pricing states take as long.
  std::uint64_t work() const { return model_.work(); }

 private:
  struct Column {
    std::uint32_t robot = 0;
    double cost = 0;
    bool allowed = true;
    std::uint32_t idle = 0;  // solves since it mattered
    std::size_t hash = 0;
    Path path;
    std::vector<MoveId> moves;
  };
  struct Row {
    ConflictRow row;
    std::uint32_t idle = 0;
  };
  struct Membership {
    std::uint32_t row = 0;
    std::uint32_t robot = kEverybody;
  };

  std::vector<MoveId> movesOf(const Path& path) const;
  void indexRow(std::uint32_t row);
  int firstColumn() const { return robots_; }
  int firstRow() const { return robots_; }
  void age();
  void purgeRows();
  void purgeColumns(double hopeless);

  const MoveSpace& space_;
  int robots_;
  GlpkModel model_;
  std::vector<Column> columns_;  // LP column = robots_ + place
  std::vector<Row> rows_;        // LP row = robots_ + place
  std::unordered_map<MoveId, std::vector<Membership>> rows_of_;
  std::unordered_set<std::size_t> known_;  // hashes of robot and path
  bool dual_feasible_ = false;             // since the last solve only rows and bounds were changed
};

}  // namespace split_mapf::ilp
