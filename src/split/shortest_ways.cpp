#include "split/shortest_ways.h"

#include <utility>

#include "split_mapf/split/time_split.h"

namespace split_mapf {
namespace {

/// Draws turns; where there are two, always the first with the same probability, itself drawn: with
/// equal ones most ways would keep to the middle of all shortest ones.
class Turns {
 public:
  explicit Turns(RandomEngine& engine) : engine_(engine), limit_(engine()) {}

  std::size_t draw(std::size_t choices) {
    if (choices == 1) return 0;
    if (choices > 2) return drawBelow(engine_, choices);
    return engine_() < limit_ ? 0 : 1;
  }

 private:
  RandomEngine& engine_;
  std::uint64_t limit_;
};

Path drawFrom(const Graph& graph, const DistanceTable& distances, Vertex from,
              RandomEngine& engine) {
  const std::uint32_t length = distances(from);
  Turns turns(engine);
  std::vector<Vertex> closer;  // the neighbours that are
  Path way;
  way.reserve(length + std::size_t{1});
  way.push_back(from);
  for (std::uint32_t left = length; left > 0; --left) {
    closer.clear();
    for (const Vertex v : graph.neighbours(way.back())) {
      if (distances(v) < left) closer.push_back(v);
    }
    way.push_back(closer[turns.draw(closer.size())]);
  }
  return way;
}

}  // namespace

Path drawShortestWay(const Instance& instance, std::uint32_t robot, std::uint64_t seed) {
  // Far apart for robots next to each other, whatever the seed.
  RandomEngine engine(seed + 0x9e3779b97f4a7c15ULL * (robot + std::uint64_t{1}));
  const HeldDistances distances = instance.distances(robot);
  return drawFrom(instance.graph(), *distances, instance.start(robot), engine);
}

ShortestWays::ShortestWays(const Graph& graph, std::vector<Path> drawn)
    : graph_(graph), ways_(std::move(drawn)) {}

Vertex ShortestWays::after(std::uint32_t robot, const DistanceTable& distances, Vertex from,
                           std::uint32_t steps, RandomEngine& engine) {
  Path& way = ways_[robot];
  const std::uint32_t left = distances(from);
  if (way.size() <= left || way[way.size() - 1 - left] != from) {
    way = drawFrom(graph_, distances, from, engine);
  }
  return way[way.size() - 1 - left + steps];
}

void ShortestWays::forget() {
  for (Path& way : ways_) way.clear();
}

}  // namespace split_mapf
