#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/pipeline/plan_request.h"
#include "tool/command_line.h"

namespace split_mapf::tool {

/// One combination of a sweep.
struct SweepCell {
  std::size_t scenario = 0;  ///< which of Sweep::scenarios
  std::uint32_t agents = 0;
  std::string solver;
  std::string split;
};

/// What `bench` measures: every combination, or a shard of them.
struct Sweep {
  std::vector<std::string> maps;  ///< of the scenarios
  std::vector<std::string> scenarios;
  std::vector<std::uint32_t> agents;
  std::vector<std::string> solvers;
  std::vector<std::string> splits;
  PlanRequest request;  ///< what all cells have in common
  std::uint32_t shard = 1;
  std::uint32_t shards = 1;
};

void declareSweep(CommandLine& line);
/// @throws OptionError.
Sweep readSweep(const CommandLine& line);

/// All cells, those of a scenario behind each other.
std::vector<SweepCell> cellsOf(const Sweep& sweep);
/// Which of `cells` are the shard's, in order. The cells are dealt out in an order that is random
/// and always the same: each shard gets as many, give or take one, of all kinds, and each cell has
/// one.
std::vector<std::size_t> shardOf(const Sweep& sweep, std::size_t cells);

}  // namespace split_mapf::tool
