#include "solver/lacam/home_passes.h"

#include <algorithm>

namespace split_mapf {

HomePasses::HomePasses(const Instance& instance)
    : owners_(instance.graph().size(), kNobody),
      arrivals_(instance.robots(), 0),
      passes_(instance.graph().size()),
      latest_(instance.graph().size()) {
  for (std::uint32_t i = 0; i < instance.robots(); ++i) owners_[instance.goal(i)] = i;
}

void HomePasses::clear() {
  for (std::vector<Pass>& passes : passes_) passes.clear();
  std::fill(latest_.begin(), latest_.end(), Latest());
}

void HomePasses::insert(Vertex v, std::uint32_t robot, std::uint32_t step) {
  if (owners_[v] == kNobody || owners_[v] == robot) return;
  passes_[v].push_back({robot, step});
  findLatest(v);
}

void HomePasses::remove(Vertex v, std::uint32_t robot) {
  if (owners_[v] == kNobody || owners_[v] == robot) return;
  std::vector<Pass>& passes = passes_[v];
  const auto gone = std::find_if(passes.begin(), passes.end(),
                                 [robot](const Pass& pass) { return pass.robot == robot; });
  *gone = passes.back();
  passes.pop_back();
  findLatest(v);
}

void HomePasses::findLatest(Vertex v) {
  Latest latest;
  for (const Pass& pass : passes_[v]) {
    if (latest.robot == kNobody || pass.step > latest.first) {
      latest.second = latest.first;
      latest.first = pass.step;
      latest.robot = pass.robot;
    } else {
      latest.second = std::max(latest.second, pass.step);
    }
  }
  latest_[v] = latest;
}

}  // namespace split_mapf
