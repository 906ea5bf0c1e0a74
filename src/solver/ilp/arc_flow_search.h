#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "solver/ilp/conflict_separator.h"
#include "solver/ilp/engine.h"
#include "solver/ilp/glpk_model.h"
#include "solver/ilp/moves.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"

namespace split_mapf::ilp {

/// One arc-flow program with a latest arrival for each robot, and its branch and bound.
class ArcFlowSearch {
 public:
  /// @param latest  by robot, at least its shortest length.
  /// @param cost_limit  plans that cost this or more are of no interest.
  /// @pre the instance outlives this object.
  ArcFlowSearch(const Instance& instance, Objective objective, std::vector<std::uint32_t> latest,
                std::uint64_t cost_limit, const Effort& effort);

  /// What the program needs at the least [bytes].
  static std::uint64_t leastMemoryBytes(const Instance& instance,
                                        const std::vector<std::uint32_t>& latest);

  /// @throws GlpkError.
  SearchEnd run();
  /// The best plan that costs less than the limit; the optimum once exhausted.
  const std::optional<Plan>& plan() const { return plan_; }
  const SearchCounts& counts() const { return counts_; }

 private:
  /// A move of one robot, or its arrival for good: then `moves` are its waits from there on.
  struct Variable {
    std::uint32_t robot = 0;
    bool arrival = false;
    std::vector<MoveId> moves;
  };
  /// A node of the tree: what it fixes beyond the first `depth` fixed variables.
  struct Node {
    std::size_t depth = 0;
    int variable = -1;
    double value = 0;
  };
  enum class Verdict { kPruned, kOpen, kStopped };

  void build();
  void buildRobot(std::uint32_t robot);
  int addVariable(std::uint32_t robot, bool arrival, std::vector<MoveId> moves, double cost,
                  const Coefficients& rows);
  void enter(const Node& node);
  Verdict solveRelaxation();
  bool separate();
  int mostFractional() const;
  void accept();
  bool stopped();

  const Instance& instance_;
  Objective objective_;
  std::vector<std::uint32_t> latest_;
  std::uint64_t cost_limit_;
  Effort effort_;
  MoveSpace space_;
  GlpkModel model_;
  ConflictSeparator separator_;
  std::vector<Variable> variables_;                            // by LP column
  std::unordered_map<MoveId, std::vector<int>> variables_of_;  // by move
  std::vector<int> fixed_;                                     // from the root down
  std::optional<Plan> plan_;
  Simplex method_ = Simplex::kPrimal;
  SearchEnd end_ = SearchEnd::kExhausted;
  SearchCounts counts_;
};

}  // namespace split_mapf::ilp
