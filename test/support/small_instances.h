#pragma once

#include <cstdint>
#include <string>

#include "split_mapf/core/instance.h"
#include "split_mapf/generate/generator.h"

namespace split_mapf::test {

/// A random instance that the oracle can solve: 1 to 4 robots on 3x3 to 5x5 cells, of which up to
/// a third are blocked. It may be unsolvable, robots may be cut off or home already. The same seed
/// gives the same instance.
Instance smallInstance(std::uint64_t seed);

/// The same with 2 to 5 robots on 2x2 to 4x4 cells: more often a knot, sooner solved by the oracle.
Instance crowdedInstance(std::uint64_t seed);

/// Five robots on eleven of 4x4 cells that must all give way: makespan 10, sum of costs 44. Trees
/// of constraints and linear programs do not end on it within a minute.
Instance fiveRobotKnot();

/// What the generator makes: nobody is cut off.
Instance generatedInstance(const GeneratorOptions& options);
/// The same for a random square map.
Instance generatedInstance(std::uint32_t side, double density, std::uint32_t robots,
                           std::uint64_t seed = 0);

/// The instance as text, for messages of failing tests.
std::string describe(const Instance& instance);

}  // namespace split_mapf::test
