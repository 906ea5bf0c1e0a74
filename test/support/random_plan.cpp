#include "support/random_plan.h"

#include <utility>
#include <vector>

namespace split_mapf::test {

Plan randomValidPlan(const Grid& grid, std::uint32_t robots, std::uint32_t steps,
                     RandomEngine& engine) {
  std::vector<Vertex> cells(grid.size());
  for (Vertex v = 0; v < grid.size(); ++v) cells[v] = v;
  shuffle(cells, engine);
  cells.resize(robots);
  return randomWalkFrom(grid, cells, steps, engine);
}

Plan randomWalkFrom(const Grid& grid, const std::vector<Vertex>& starts, std::uint32_t steps,
                    RandomEngine& engine) {
  const auto robots = static_cast<std::uint32_t>(starts.size());
  Plan plan;
  for (const Vertex v : starts) plan.paths.push_back({v});
  constexpr std::uint32_t kNobody = 0xffffffffU;
  for (std::uint32_t t = 0; t < steps; ++t) {
    // Wishes are withdrawn until none conflicts: what is left may follow and rotate.
    std::vector<Vertex> to(robots);
    for (std::uint32_t i = 0; i < robots; ++i) {
      const VertexRange around = grid.graph().neighbours(plan.paths[i].back());
      const std::uint64_t pick = drawBelow(engine, around.size() + 1);
      to[i] = pick == around.size() ? plan.paths[i].back() : around.begin()[pick];
    }
    for (bool changed = true; changed;) {
      changed = false;
      std::vector<std::uint32_t> claimed(grid.size(), kNobody);
      std::vector<std::uint32_t> at(grid.size(), kNobody);
      for (std::uint32_t i = 0; i < robots; ++i) at[plan.paths[i].back()] = i;
      for (std::uint32_t i = 0; i < robots; ++i) {
        const Vertex from = plan.paths[i].back();
        const std::uint32_t there = at[to[i]];
        const bool swap = there != kNobody && there != i && to[there] == from;
        const bool taken = claimed[to[i]] != kNobody;
        if (to[i] != from && (swap || taken)) {
          to[i] = from;
          changed = true;
        } else if (taken) {
          to[claimed[to[i]]] = plan.paths[claimed[to[i]]].back();
          changed = true;
        }
        claimed[to[i]] = i;
      }
    }
    for (std::uint32_t i = 0; i < robots; ++i) plan.paths[i].push_back(to[i]);
  }
  trimToArrival(plan);
  return plan;
}

Instance instanceOf(std::shared_ptr<const Grid> grid, const Plan& plan) {
  std::vector<Vertex> starts;
  std::vector<Vertex> goals;
  for (const Path& path : plan.paths) {
    starts.push_back(path.front());
    goals.push_back(path.back());
  }
  return Instance::fromVertices(std::move(grid), starts, goals);
}

}  // namespace split_mapf::test
