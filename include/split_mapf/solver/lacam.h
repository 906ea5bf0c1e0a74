#pragma once

#include <memory>

#include "split_mapf/solver/registry.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

struct LacamSettings;

/// Lazy constraints addition search: depth-first over configurations (where all robots are at one
/// step), each successor made by PIBT; a configuration that is visited again forces one robot more
/// to one place, so in the end every successor comes up. Complete: it finds a plan or proves that
/// there is none, in a search that is finite but may be exponential; instances that
/// solvability/solvability refuses need no search.
/// Source: Okumura, AAAI 2023 and IJCAI 2023 (swaps), AAMAS 2024 (scattered guidance, after Han and
/// Yu, ICRA 2022). Deviations: one configuration a visit instead of ten; guidance trades collisions
/// against detours; the plan follows the shortest way through the configurations seen and is
/// compacted and polished.
/// With the option guide_again a crowd walks by PIBT first, guided again and again by what pushing
/// robots from home costs, and the search goes on from where the walk ends (docs/lacam.md).
/// Robots need no room: where all cells are taken they rotate.
class LacamSolver : public Solver {
 public:
  /// @throws OptionError for an option value out of range.
  explicit LacamSolver(const SolverOptions& options);
  ~LacamSolver() override;
  static SolverInfo info();

 private:
  /// Counts as expansions: the robots that PIBT moves, and the cells that guidance and polish
  /// expand. Memory: 4 to 8 bytes a robot and configuration, at most what the option `memory` says.
  SolveResult run(const SolveRequest& request) const override;

  std::unique_ptr<LacamSettings> settings_;
};

}  // namespace split_mapf
