#include "roadmap/leg_matching.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace split_mapf::roadmap {
namespace {

// Sums of whole numbers: those of fractions round, and a chain of moves that is shorter by a
// rounding error than itself would go in circles.
using Cost = std::int64_t;
constexpr Cost kFar = std::numeric_limits<Cost>::max() / 4;
constexpr double kParts = 4096;       // of the square of a cell
constexpr double kMostSquare = 1e11;  // that a map allows [cells^2]

Cost costOf(double square) {
  return static_cast<Cost>(std::llround(std::min(square, kMostSquare) * kParts));
}

constexpr std::uint32_t kNobody = 0xffffffffU;

class Matching {
 public:
  explicit Matching(const std::vector<std::vector<LegOption>>& options)
      : options_(options), vertices_(options.size(), kNoVertex) {}

  std::vector<Vertex> run() {
    for (std::uint32_t robot = 0; robot < options_.size(); ++robot) augment(robot);
    return vertices_;
  }

 private:
  struct Reached {
    Cost cost = kFar;
    std::uint32_t by = kNobody;  // the robot that would move here
  };

  Cost costOfLeg(std::uint32_t robot, Vertex vertex) const {
    for (const LegOption& option : options_[robot]) {
      if (option.vertex == vertex) return costOf(option.square);
    }
    return kFar;
  }

  /// The cheapest chain of robots that move on, from `robot` to a vertex nobody has.
  void augment(std::uint32_t robot) {
    reached_.clear();
    std::vector<std::uint32_t> queue = {robot};
    std::vector<Cost> costs(options_.size(), kFar);
    costs[robot] = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t from = queue[i];
      for (const LegOption& option : options_[from]) {
        if (option.banned) continue;
        const Cost cost = costs[from] + costOf(option.square);
        Reached& there = reached_[option.vertex];
        if (cost >= there.cost) continue;
        there = {cost, from};
        const auto holder = holders_.find(option.vertex);
        if (holder == holders_.end() || holder->second == from) continue;
        const Cost moved = cost - costOfLeg(holder->second, option.vertex);
        if (moved >= costs[holder->second]) continue;
        costs[holder->second] = moved;
        queue.push_back(holder->second);
      }
    }
    Vertex end = kNoVertex;
    Cost least = kFar;
    for (const auto& [vertex, there] : reached_) {
      if (holders_.count(vertex) != 0 || there.cost > least) continue;
      if (there.cost == least && vertex > end) continue;
      least = there.cost;
      end = vertex;
    }
    while (end != kNoVertex) {
      const std::uint32_t by = reached_[end].by;
      const Vertex before = vertices_[by];
      vertices_[by] = end;
      holders_[end] = by;
      end = by == robot ? kNoVertex : before;
    }
  }

  const std::vector<std::vector<LegOption>>& options_;
  std::vector<Vertex> vertices_;
  std::unordered_map<Vertex, std::uint32_t> holders_;
  std::unordered_map<Vertex, Reached> reached_;
};

}  // namespace

std::vector<Vertex> matchLegs(const std::vector<std::vector<LegOption>>& options) {
  return Matching(options).run();
}

}  // namespace split_mapf::roadmap
