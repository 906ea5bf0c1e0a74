#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"

namespace split_mapf::test {

/// A random walk of all robots at once that keeps to the rules, followings and rotations included.
/// Paths end at their arrivals. @pre robots <= grid.size().
Plan randomValidPlan(const Grid& grid, std::uint32_t robots, std::uint32_t steps,
                     RandomEngine& engine);

/// The same from given starts, each another vertex.
Plan randomWalkFrom(const Grid& grid, const std::vector<Vertex>& starts, std::uint32_t steps,
                    RandomEngine& engine);

/// The instance that a plan solves.
Instance instanceOf(std::shared_ptr<const Grid> grid, const Plan& plan);

}  // namespace split_mapf::test
