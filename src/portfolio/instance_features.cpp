#include "split_mapf/portfolio/instance_features.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <boost/pending/disjoint_sets.hpp>

#include "portfolio/direct_way.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kNobody = 0xffffffffU;

/// Lets all robots walk at once, step by step, and notes who conflicts with whom.
class SharedWalk {
 public:
  SharedWalk(std::uint32_t cells, const std::vector<Path>& paths)
      : paths_(paths), order_(paths.size()), owner_(cells, kNobody) {
    // Longest first: those that still walk come before those that are at home.
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&paths](std::uint32_t a, std::uint32_t b) {
      return paths[a].size() > paths[b].size();
    });
    for (std::uint32_t robot = 0; robot < paths.size(); ++robot) {
      owner_[paths[robot].back()] = robot;
    }
    for (Crowds& crowds : crowds_) {
      crowds.last.resize(cells);
      crowds.before.resize(paths.size());
    }
  }

  /// The pairs of robots that conflict, each once.
  std::vector<std::uint64_t> findConflicts(const Deadline& deadline) {
    std::size_t walking = order_.size();
    for (std::uint32_t step = 0;; ++step) {
      deadline.require();
      while (walking > 0 && step >= paths_[order_[walking - 1]].size()) --walking;
      if (walking == 0) break;
      for (std::size_t i = 0; i < walking; ++i) move(order_[i], step);
    }
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    return std::move(pairs_);
  }

 private:
  /// Who is in each cell at a step: a chain of robots, read only if its step is the one meant.
  struct Crowds {
    struct Last {
      std::uint32_t step = 0xffffffffU;
      std::uint32_t robot = kNobody;
    };
    std::vector<Last> last;
    std::vector<std::uint32_t> before;  ///< who came into the robot's cell before it, or kNobody

    std::uint32_t lastAt(Vertex v, std::uint32_t step) const {
      return last[v].step == step ? last[v].robot : kNobody;
    }
  };

  void move(std::uint32_t robot, std::uint32_t step) {
    const Vertex to = paths_[robot][step];
    const Vertex from = step > 0 ? paths_[robot][step - 1] : kNoVertex;
    Crowds& now = crowds_[step % 2];
    const std::uint32_t last = now.lastAt(to, step);
    for (std::uint32_t other = last; other != kNobody; other = now.before[other]) {
      // Those that walk together are known from the step where they met.
      if (step == 0 || paths_[other][step - 1] != from) note(robot, other);
    }
    now.before[robot] = last;
    now.last[to] = {step, robot};
    const std::uint32_t owner = owner_[to];
    if (owner != kNobody && paths_[owner].size() <= step) note(robot, owner);
    if (step == 0) return;
    const Crowds& past = crowds_[(step - 1) % 2];
    for (std::uint32_t other = past.lastAt(to, step - 1); other != kNobody;
         other = past.before[other]) {
      if (step < paths_[other].size() && paths_[other][step] == from) note(robot, other);
    }
  }

  void note(std::uint32_t a, std::uint32_t b) {
    pairs_.push_back(std::uint64_t{std::min(a, b)} << 32U | std::max(a, b));
  }

  const std::vector<Path>& paths_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> owner_;  ///< whose goal a cell is
  std::array<Crowds, 2> crowds_;      ///< of even and of odd steps
  std::vector<std::uint64_t> pairs_;
};

std::uint32_t largestGroup(std::uint32_t robots, const std::vector<std::uint64_t>& pairs) {
  std::vector<std::uint32_t> rank(robots, 0);
  std::vector<std::uint32_t> parent(robots);
  boost::disjoint_sets<std::uint32_t*, std::uint32_t*> groups(rank.data(), parent.data());
  for (std::uint32_t robot = 0; robot < robots; ++robot) groups.make_set(robot);
  for (const std::uint64_t pair : pairs) {
    groups.union_set(static_cast<std::uint32_t>(pair >> 32U), static_cast<std::uint32_t>(pair));
  }
  std::vector<std::uint32_t> size(robots, 0);
  for (std::uint32_t robot = 0; robot < robots; ++robot) ++size[groups.find_set(robot)];
  return *std::max_element(size.begin(), size.end());
}

/// Whether there is no way past a vertex between its neighbours: two that have no other in common.
/// The corner of a hall has two neighbours as well, but robots pass it by.
bool isNarrow(const Graph& graph, Vertex v) {
  const VertexRange around = graph.neighbours(v);
  if (around.size() != 2) return false;
  const VertexRange others = graph.neighbours(around.begin()[0]);
  return std::none_of(others.begin(), others.end(), [&](Vertex other) {
    return other != v && graph.adjacent(other, around.begin()[1]);
  });
}

/// Pairs of robots that go different ways along an edge with a narrow end, over all such edges.
std::uint64_t opposedPairs(const Graph& graph, const std::vector<Path>& paths) {
  // Of a narrow vertex: how often robots come from its neighbours, and go there.
  struct Edge {
    std::uint32_t in = 0;
    std::uint32_t out = 0;
  };
  std::vector<std::array<Edge, 2>> edges(graph.size());
  std::vector<char> narrow(graph.size());
  for (Vertex v = 0; v < graph.size(); ++v) narrow[v] = isNarrow(graph, v) ? 1 : 0;
  const auto edge_of = [&](Vertex at, Vertex other) -> Edge& {
    return edges[at][*graph.neighbours(at).begin() == other ? 0 : 1];
  };
  for (const Path& path : paths) {
    for (std::size_t t = 1; t < path.size(); ++t) {
      const Vertex from = path[t - 1];
      const Vertex to = path[t];
      // An edge between two narrow vertices is counted at the lower one.
      if (narrow[from] != 0 && (from < to || narrow[to] == 0)) {
        ++edge_of(from, to).out;
      } else if (narrow[to] != 0) {
        ++edge_of(to, from).in;
      }
    }
  }
  std::uint64_t pairs = 0;
  for (const auto& both : edges) {
    for (const Edge& edge : both) pairs += std::uint64_t{edge.in} * edge.out;
  }
  return pairs;
}

}  // namespace

Path shortestPath(const Instance& instance, std::uint32_t robot) {
  const HeldDistances distances = instance.distances(robot);
  const std::uint32_t length = distances(instance.start(robot));
  if (instance.isBounded()) {
    Path path = directWay(instance.grid(), instance.start(robot), instance.goal(robot), length);
    if (!path.empty()) return path;
  }
  Path path = {instance.start(robot)};
  path.reserve(length + std::size_t{1});
  for (std::uint32_t left = length; left > 0; --left) {
    for (const Vertex v : instance.graph().neighbours(path.back())) {
      if (distances(v) + 1 != left) continue;
      path.push_back(v);
      break;
    }
  }
  return path;
}

InstanceFeatures measureFeatures(const Instance& instance, const std::vector<Path>& paths,
                                 const Deadline& deadline) {
  InstanceFeatures features;
  features.robots = instance.robots();
  features.cells = instance.graph().size();
  features.makespan_bound = makespanLowerBound(instance);
  features.sum_bound = sumOfCostsLowerBound(instance);
  const std::vector<std::uint64_t> pairs =
      SharedWalk(features.cells, paths).findConflicts(deadline);
  features.conflicting = pairs.size();
  features.largest_group = largestGroup(features.robots, pairs);
  const double times = static_cast<double>(features.robots) * features.makespan_bound;
  if (times > 0) {
    features.head_on = static_cast<double>(opposedPairs(instance.graph(), paths)) / times;
  }
  return features;
}

InstanceFeatures measureFeatures(const Instance& instance) {
  std::vector<Path> paths;
  paths.reserve(instance.robots());
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    paths.push_back(shortestPath(instance, robot));
  }
  return measureFeatures(instance, paths);
}

}  // namespace split_mapf
