#include "fleet/task_matching.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "split/assignment.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kFar = 0xffffffffU;
// A task that has waited for so long goes before all that are newer.
constexpr std::uint32_t kMostWaited = 1U << 20U;

/// Distances from one vertex over open ones; it may be closed itself.
class Flood {
 public:
  Flood(const Graph& graph, const std::vector<bool>& closed) : graph_(graph), closed_(closed) {}

  const std::vector<std::uint32_t>& from(Vertex start) {
    distance_.assign(graph_.size(), kFar);
    queue_.assign(1, start);
    distance_[start] = 0;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      const Vertex v = queue_[i];
      // Who stands on a closed vertex may leave it, but nobody passes.
      if (closed_[v] && v != start) continue;
      for (const Vertex next : graph_.neighbours(v)) {
        if (distance_[next] != kFar) continue;
        distance_[next] = distance_[v] + 1;
        queue_.push_back(next);
      }
    }
    return distance_;
  }

 private:
  const Graph& graph_;
  const std::vector<bool>& closed_;
  std::vector<std::uint32_t> distance_;
  std::vector<Vertex> queue_;
};

/// Robots in the order of their distance from one vertex, over open ones.
class Nearest {
 public:
  Nearest(const Graph& graph, const std::vector<bool>& closed, const std::vector<Vertex>& robots)
      : graph_(graph),
        closed_(closed),
        first_at_(graph.size(), kNone),
        behind_(robots.size(), kNone),
        met_(graph.size(), 0),
        queue_(graph.size() + std::size_t{1}) {
    // The last one put in is met first, so that of equally near ones the first comes first.
    for (std::size_t i = robots.size(); i-- > 0;) {
      behind_[i] = std::exchange(first_at_[robots[i]], static_cast<std::uint32_t>(i));
    }
  }

  /// The nearest robots, `most` or a few more, with their distances; fewer where no more can be
  /// reached. Cost: the vertices up to there.
  void from(Vertex start, std::size_t most, std::vector<Candidate>& found) {
    queue_[0] = start;
    met_[start] = ++search_;
    std::size_t tail = 1;
    std::uint32_t distance = 0;
    std::size_t level_end = 1;
    for (std::size_t head = 0; head < tail; ++head) {
      if (head == level_end) {
        ++distance;
        level_end = tail;
      }
      const Vertex v = queue_[head];
      for (std::uint32_t robot = first_at_[v]; robot != kNone; robot = behind_[robot]) {
        found.push_back({robot, distance});
      }
      if (found.size() >= most) return;
      // Who stands on a closed vertex may leave it, but nobody passes.
      if (closed_[v] && v != start) continue;
      // Whether a neighbour is new cannot be predicted, so all are written behind the queue's end.
      for (const Vertex next : graph_.neighbours(v)) {
        queue_[tail] = next;
        tail += met_[next] != search_ ? 1 : 0;
        met_[next] = search_;
      }
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  const Graph& graph_;
  const std::vector<bool>& closed_;
  std::vector<std::uint32_t> first_at_;  // by vertex
  std::vector<std::uint32_t> behind_;    // by robot: the next one on its vertex
  std::vector<std::uint32_t> met_;       // by vertex: the search that did
  std::vector<Vertex> queue_;
  std::uint32_t search_ = 0;
};

void keepCheapest(std::vector<Candidate>& candidates, std::size_t most) {
  if (candidates.size() <= most) return;
  const auto cheaper = [](const Candidate& a, const Candidate& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.vertex < b.vertex;
  };
  const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(candidates.begin(), end, candidates.end(), cheaper);
  candidates.erase(end, candidates.end());
  std::sort(candidates.begin(), candidates.end(), cheaper);
}

std::uint32_t costOf(std::uint32_t distance, const OpenTask& task) {
  return distance + kMostWaited - std::min(task.waited, kMostWaited);
}

/// A row for each task, whose columns are robots. The nearest ones are the cheapest, so the search
/// ends where there are enough of them.
std::vector<std::vector<Candidate>> rowsOfTasks(const Graph& graph, const std::vector<bool>& closed,
                                                const std::vector<OpenTask>& tasks,
                                                const std::vector<Vertex>& robots) {
  Nearest nearest(graph, closed, robots);
  std::vector<std::vector<Candidate>> rows(tasks.size());
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    nearest.from(tasks[task].goal, tasks.size(), rows[task]);
  }
  return rows;
}

std::vector<std::vector<Candidate>> rowsOfRobots(Flood& flood, const std::vector<bool>& closed,
                                                 const std::vector<OpenTask>& tasks,
                                                 const std::vector<Vertex>& robots) {
  std::vector<std::vector<Candidate>> rows(robots.size());
  for (std::size_t robot = 0; robot < robots.size(); ++robot) {
    const std::vector<std::uint32_t>& distance = flood.from(robots[robot]);
    for (std::uint32_t task = 0; task < tasks.size(); ++task) {
      const std::uint32_t way = distance[tasks[task].goal];
      if (way == kFar || closed[tasks[task].goal]) continue;
      rows[robot].push_back({task, costOf(way, tasks[task])});
    }
    keepCheapest(rows[robot], robots.size());
  }
  return rows;
}

}  // namespace

std::vector<std::uint32_t> matchTasks(const Graph& graph, const std::vector<bool>& closed,
                                      const std::vector<OpenTask>& tasks,
                                      const std::vector<Vertex>& robots) {
  std::vector<std::uint32_t> matched(tasks.size(), kNoRobot);
  if (tasks.size() <= robots.size()) {
    const std::vector<Vertex> found = assignAtLeastCost(rowsOfTasks(graph, closed, tasks, robots));
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      if (found[task] != kNoVertex && !closed[tasks[task].goal]) matched[task] = found[task];
    }
    return matched;
  }
  Flood flood(graph, closed);
  const std::vector<Vertex> found = assignAtLeastCost(rowsOfRobots(flood, closed, tasks, robots));
  for (std::uint32_t robot = 0; robot < robots.size(); ++robot) {
    if (found[robot] != kNoVertex) matched[found[robot]] = robot;
  }
  return matched;
}

std::vector<std::uint32_t> openParts(const Graph& graph, const std::vector<bool>& closed) {
  std::vector<std::uint32_t> parts(graph.size(), 0);
  std::vector<Vertex> queue;
  std::uint32_t part = 0;
  for (Vertex start = 0; start < graph.size(); ++start) {
    if (parts[start] != 0 || closed[start]) continue;
    queue.assign(1, start);
    parts[start] = ++part;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const Vertex next : graph.neighbours(queue[i])) {
        if (parts[next] != 0 || closed[next]) continue;
        parts[next] = part;
        queue.push_back(next);
      }
    }
  }
  return parts;
}

}  // namespace split_mapf
