#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "search/reservation_table.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/solver/conflict_optimizer.h"

namespace split_mapf::test {

/// A valid plan with delays. @pre conflict optimisation finds one.
inline Plan planWithDelays(const Instance& instance) {
  SolverOptions options;
  options.objective = Objective::kSumOfCosts;
  return *ConflictOptimizerSolver(options).solve(instance, Deadline()).plan;
}

/// Both tables know of the same visits, in the same order and to the bit.
inline void expectSame(const ReservationTable& a, const ReservationTable& b,
                       std::uint32_t vertices) {
  const std::uint32_t words = std::max(a.lastChange(), b.lastChange()) / 64 + 2;
  for (Vertex v = 0; v < vertices; ++v) {
    ASSERT_EQ(a.at(v).size(), b.at(v).size()) << "vertex " << v;
    for (std::size_t i = 0; i < a.at(v).size(); ++i) {
      ASSERT_EQ(a.at(v)[i].begin, b.at(v)[i].begin) << "vertex " << v;
      ASSERT_EQ(a.at(v)[i].end, b.at(v)[i].end) << "vertex " << v;
      ASSERT_EQ(a.at(v)[i].robot, b.at(v)[i].robot) << "vertex " << v;
      ASSERT_EQ(a.at(v)[i].next, b.at(v)[i].next) << "vertex " << v;
    }
    for (std::uint32_t word = 0; word < words; ++word) {
      ASSERT_EQ(a.taken(v, word), b.taken(v, word)) << "vertex " << v;
    }
  }
}

}  // namespace split_mapf::test
