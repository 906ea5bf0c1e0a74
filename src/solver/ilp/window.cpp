#include "solver/ilp/window.h"

#include <unordered_map>

namespace split_mapf::ilp {

Window::Window(const Instance& instance, std::uint32_t robot, std::uint32_t latest_arrival,
               std::uint32_t slots)
    : latest_arrival_(latest_arrival), slots_(slots) {
  const Graph& graph = instance.graph();
  const HeldDistances to_goal = instance.distances(robot);
  std::unordered_map<Vertex, std::uint32_t> place;
  const auto meet = [&](Vertex v, std::uint32_t steps) {
    const std::uint32_t rest = to_goal(v);
    if (rest == DistanceTable::kUnreachable || steps + rest > latest_arrival) return;
    if (!place.emplace(v, size()).second) return;
    vertices_.push_back(v);
    first_.push_back(steps);
    last_.push_back(latest_arrival - rest);
  };
  meet(instance.start(robot), 0);
  for (std::uint32_t i = 0; i < size(); ++i) {
    for (const Vertex next : graph.neighbours(vertices_[i])) meet(next, first_[i] + 1);
  }
  goal_place_ = place.at(instance.goal(robot));
  sources_.assign(std::size_t{size()} * slots, kNowhere);
  for (std::uint32_t i = 0; i < size(); ++i) {
    std::uint32_t* source = sources_.data() + std::size_t{i} * slots;
    source[0] = i;
    for (const Vertex from : graph.neighbours(vertices_[i])) {
      ++source;
      const auto found = place.find(from);
      if (found != place.end()) *source = found->second;
    }
  }
}

}  // namespace split_mapf::ilp
