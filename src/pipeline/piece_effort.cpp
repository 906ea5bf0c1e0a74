#include "pipeline/piece_effort.h"

#include <cstdint>

namespace split_mapf {
namespace {

// Of a solver that places robot after robot.
constexpr double kSecAStep = 3e-6;
// Solvers that prove bounds resolve conflicts one by one. What a piece takes grows with steps times
// robots only roughly: most take a tenth of this and a few many times it. With half of this value
// long pieces of `ilp` stay at home, with twice it half as many short ones more are asked for.
constexpr double kSecAStepAndRobot = 1e-5;

}  // namespace

double expectedEffort(const Instance& piece) {
  double steps = 0;
  for (std::uint32_t i = 0; i < piece.robots(); ++i) {
    const Cell from = piece.grid().cellOf(piece.start(i));
    const Cell to = piece.grid().cellOf(piece.goal(i));
    steps += rowsAndColumns(from, to);
  }
  return steps;
}

double expectedSec(const Instance& piece, const SolverTraits& solver) {
  const double steps = expectedEffort(piece);
  return solver.optimal_at_one ? steps * piece.robots() * kSecAStepAndRobot : steps * kSecAStep;
}

}  // namespace split_mapf
