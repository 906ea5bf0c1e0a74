#include "roadmap/leg_matching.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace split_mapf::roadmap {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
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
    double cost = kFar;
    std::uint32_t by = kNobody;  // the robot that would move here
  };

  double squareOf(std::uint32_t robot, Vertex vertex) const {
    for (const LegOption& option : options_[robot]) {
      if (option.vertex == vertex) return option.square;
    }
    return kFar;
  }

  /// The cheapest chain of robots that move on, from `robot` to a vertex nobody has.
  void augment(std::uint32_t robot) {
    reached_.clear();
    std::vector<std::uint32_t> queue = {robot};
    std::vector<double> costs(options_.size(), kFar);
    costs[robot] = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t from = queue[i];
      for (const LegOption& option : options_[from]) {
        const double cost = costs[from] + option.square;
        Reached& there = reached_[option.vertex];
        if (option.banned || cost >= there.cost - 1e-12) continue;
        there = {cost, from};
        const auto holder = holders_.find(option.vertex);
        if (holder == holders_.end() || holder->second == from) continue;
        const double moved = cost - squareOf(holder->second, option.vertex);
        if (moved >= costs[holder->second] - 1e-12) continue;
        costs[holder->second] = moved;
        queue.push_back(holder->second);
      }
    }
    Vertex end = kNoVertex;
    double least = kFar;
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
