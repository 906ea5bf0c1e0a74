#include "support/solvability_cases.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace split_mapf::test {
namespace {

std::uint32_t draw(RandomEngine& engine, std::uint32_t least, std::uint32_t most) {
  return least + static_cast<std::uint32_t>(drawBelow(engine, most - least + 1));
}

/// Edges so far; vertices come into being as they are asked for.
class Sketch {
 public:
  std::uint32_t size() const { return size_; }
  Vertex addVertex() { return size_++; }
  void join(Vertex a, Vertex b) { edges_.emplace_back(a, b); }
  /// A way of `length` edges from `from` over new vertices; returns its last vertex.
  Vertex addWay(Vertex from, std::uint32_t length) {
    for (; length > 0; --length) {
      const Vertex next = addVertex();
      join(from, next);
      from = next;
    }
    return from;
  }
  /// A cycle of `length` vertices through `from`.
  void addCycle(Vertex from, std::uint32_t length) { join(addWay(from, length - 1), from); }
  Vertex anyVertex(RandomEngine& engine) const {
    return static_cast<Vertex>(drawBelow(engine, size_));
  }
  /// The graph with its vertices renumbered at random: nothing may depend on their order.
  Graph finish(RandomEngine& engine) {
    std::vector<Vertex> number(size_);
    std::iota(number.begin(), number.end(), 0U);
    shuffle(number, engine);
    for (auto& [a, b] : edges_) {
      a = number[a];
      b = number[b];
    }
    return Graph(size_, edges_);
  }

 private:
  std::uint32_t size_ = 0;
  std::vector<std::pair<Vertex, Vertex>> edges_;
};

void growTree(Sketch& sketch, std::uint32_t size, bool bushy, RandomEngine& engine) {
  if (sketch.size() == 0) sketch.addVertex();
  while (sketch.size() < size) {
    const bool lengthen = !bushy && drawBelow(engine, 3) > 0;
    sketch.addWay(lengthen ? sketch.size() - 1 : sketch.anyVertex(engine), 1);
  }
}

void addEdges(Sketch& sketch, std::uint32_t count, RandomEngine& engine) {
  for (; count > 0; --count) sketch.join(sketch.anyVertex(engine), sketch.anyVertex(engine));
}

void addTheta(Sketch& sketch, RandomEngine& engine) {
  const Vertex a = sketch.addVertex();
  const Vertex b = sketch.addWay(a, draw(engine, 1, 3));
  for (int i = 0; i < 2; ++i) sketch.join(sketch.addWay(a, draw(engine, 1, 2)), b);
}

/// A loop or a junction at the vertex.
void addPlace(Sketch& sketch, Vertex at, RandomEngine& engine) {
  if (drawBelow(engine, 2) == 0) {
    sketch.addCycle(at, draw(engine, 3, 4));
  } else {
    sketch.addWay(at, 1);
    sketch.addWay(at, draw(engine, 1, 2));
  }
}

void addGrid(Sketch& sketch, RandomEngine& engine) {
  const std::uint32_t width = draw(engine, 2, 4);
  const std::uint32_t height = draw(engine, 1, width == 4 ? 2 : 3);
  std::vector<Vertex> vertices(std::size_t{width} * height, kNoVertex);
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    if (drawBelow(engine, 6) == 0) continue;
    vertices[i] = sketch.addVertex();
    const auto join_to = [&](std::uint32_t other) {
      if (vertices[other] != kNoVertex) sketch.join(vertices[i], vertices[other]);
    };
    if (i % width > 0) join_to(i - 1);
    if (i >= width) join_to(i - width);
  }
}

std::string drawFamily(Sketch& sketch, RandomEngine& engine) {
  const std::uint32_t size = draw(engine, 3, 9);
  switch (drawBelow(engine, 11)) {
    case 0:
      growTree(sketch, size, true, engine);
      return "tree";
    case 1:
      growTree(sketch, size, true, engine);
      addEdges(sketch, draw(engine, 1, 4), engine);
      return "any connected";
    case 2:
      growTree(sketch, size, false, engine);
      addEdges(sketch, draw(engine, 0, 2), engine);
      return "long ways";
    case 3:
      sketch.addWay(sketch.addVertex(), size - 1);
      return "path";
    case 4:
      sketch.addCycle(sketch.addVertex(), size);
      return "cycle";
    case 5:
      addTheta(sketch, engine);
      return "theta";
    case 6:
      sketch.addCycle(sketch.addVertex(), 3);
      while (sketch.size() < size) {
        sketch.addCycle(sketch.anyVertex(engine), drawBelow(engine, 4) == 0 ? 5 : 3);
      }
      return "odd cycles";
    case 7: {
      addPlace(sketch, sketch.addVertex(), engine);
      addPlace(sketch, sketch.addWay(0, draw(engine, 1, 5)), engine);
      return "two places";
    }
    case 8:
      sketch.addCycle(sketch.addVertex(), draw(engine, 3, 5));
      sketch.addWay(sketch.anyVertex(engine), draw(engine, 1, 4));
      return "dead end";
    case 9:
      addGrid(sketch, engine);
      return "grid";
    default:
      growTree(sketch, size, true, engine);
      addEdges(sketch, draw(engine, 0, 2), engine);
      growTree(sketch, sketch.size() + 1, true, engine);
      sketch.addCycle(sketch.addVertex(), 3);
      return "disconnected";
  }
}

std::uint64_t countArrangements(std::uint32_t vertices, std::uint32_t robots) {
  std::uint64_t count = 1;
  for (std::uint32_t i = 0; i < robots; ++i) count *= vertices - i;
  return count;
}

/// Random goals, and some that are close to the starts: the hardest to tell apart.
void drawGoals(SolvabilityCase& result, RandomEngine& engine) {
  std::vector<Vertex> order = result.starts;
  for (Vertex v = 0; v < result.graph.size(); ++v) {
    if (std::find(order.begin(), order.end(), v) == order.end()) order.push_back(v);
  }
  for (int i = 0; i < 8; ++i) {
    if (i % 2 == 0) {
      const std::size_t robot = drawBelow(engine, result.starts.size());
      std::swap(order[robot], order[drawBelow(engine, order.size())]);
    } else {
      shuffle(order, engine);
    }
    result.goals.emplace_back(order.begin(),
                              order.begin() + static_cast<std::ptrdiff_t>(result.starts.size()));
  }
}

}  // namespace

SolvabilityCase solvabilityCase(std::uint64_t seed, std::uint64_t most_arrangements) {
  RandomEngine engine(seed);
  while (true) {
    Sketch sketch;
    SolvabilityCase result;
    result.family = drawFamily(sketch, engine);
    const std::uint32_t size = sketch.size();
    if (size < 3 || size > 10) continue;
    const std::uint32_t blanks = draw(engine, 0, std::min(5U, size - 1));
    const std::uint32_t robots =
        drawBelow(engine, 8) == 0 ? draw(engine, 1, std::min(size, 3U)) : size - blanks;
    if (countArrangements(size, robots) > most_arrangements) continue;
    result.graph = sketch.finish(engine);
    result.starts.resize(size);
    std::iota(result.starts.begin(), result.starts.end(), 0U);
    shuffle(result.starts, engine);
    result.starts.resize(robots);
    drawGoals(result, engine);
    return result;
  }
}

Graph graphOfCorridors(std::uint32_t size, RandomEngine& engine) {
  Sketch sketch;
  sketch.addVertex();
  while (sketch.size() < size) {
    const Vertex end = sketch.addWay(sketch.anyVertex(engine), draw(engine, 0, 6));
    addPlace(sketch, end, engine);
  }
  return sketch.finish(engine);
}

std::string describe(const Graph& graph, const std::vector<Vertex>& starts,
                     const std::vector<Vertex>& goals) {
  std::string text = "\n" + std::to_string(graph.size()) + " vertices, edges";
  for (Vertex v = 0; v < graph.size(); ++v) {
    for (const Vertex u : graph.neighbours(v)) {
      if (v < u) text += " " + std::to_string(v) + "-" + std::to_string(u);
    }
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    text += "\nrobot " + std::to_string(i) + ": " + std::to_string(starts[i]) + " -> " +
            std::to_string(goals[i]);
  }
  return text + "\n";
}

}  // namespace split_mapf::test
