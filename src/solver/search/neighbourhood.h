#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/search/adaptive_choice.h"
#include "solver/search/path_table.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// Chooses the robots that are planned anew together, in one of several ways and sizes; ways and
/// sizes that gained more for their effort are chosen more often.
/// Source: Li et al., IJCAI 2021 (delayed robots and random walks; adaptive weights after Ropke and
/// Pisinger 2006). Ours: the robots in the way of a delayed one's arrival, the crowd around a cell,
/// sizes chosen like ways, gains counted by effort.
class NeighbourhoodPicker {
 public:
  NeighbourhoodPicker(const Instance& instance, std::uint64_t seed);

  /// Fills `robots` with at least one robot, each once. @param table holds the paths of the plan.
  void pick(const Plan& plan, const PathTable& table, std::vector<std::uint32_t>& robots);
  /// What came of the last pick: steps gained and states expanded.
  void reward(std::uint64_t gain, std::uint64_t expansions);

 private:
  enum Way { kInTheWay, kAroundArrival, kCrowd, kRandom, kWays };
  static constexpr std::array<std::uint32_t, 5> kSizes = {1, 2, 4, 8, 16};

  std::uint32_t drawDelayed(const Plan& plan);
  void add(std::uint32_t robot, std::vector<std::uint32_t>& robots);
  void addOccupants(const PathTable& table, Vertex v, std::uint32_t from, std::uint32_t to,
                    std::size_t size, std::vector<std::uint32_t>& robots);
  void walkInTheWay(const Plan& plan, const PathTable& table, std::uint32_t robot, std::size_t size,
                    std::vector<std::uint32_t>& robots);
  void takeAroundArrival(const Plan& plan, const PathTable& table, std::uint32_t robot,
                         std::size_t size, std::vector<std::uint32_t>& robots);
  void takeCrowd(const Plan& plan, const PathTable& table, std::uint32_t robot, std::size_t size,
                 std::vector<std::uint32_t>& robots);

  const Instance& instance_;
  RandomEngine engine_;
  AdaptiveChoice<kWays> ways_;
  AdaptiveChoice<kSizes.size()> sizes_;
  std::vector<std::uint32_t> marks_;  // by robot: number of the last pick that took it
  std::uint32_t pick_number_ = 0;
};

}  // namespace split_mapf
