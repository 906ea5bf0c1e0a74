#include "split_mapf/core/execution_cut.h"

#include <algorithm>
#include <utility>

namespace split_mapf {
namespace {

bool isUnderWay(const ExecutionGraph& graph, std::uint32_t robot) {
  return graph.progress(robot) > 0;
}

/// The moves of a path as visits; its first step is that of the plan's `begin`.
void appendMoves(const Path& path, std::uint32_t robot, std::uint32_t begin,
                 std::vector<Visit>& visits) {
  for (std::uint32_t t = 1; t < path.size(); ++t) {
    if (path[t] == path[t - 1]) continue;
    visits.push_back({path[t], robot, begin + t, kNoVisit, kNoVisit});
  }
}

/// The steps of the visits from where robots are up to the cut, each once: numbered anew, an
/// execution that goes on for ever has no large ones.
std::vector<std::uint32_t> stepsUpTo(const ExecutionGraph& graph, const Cut& cut) {
  const Precedence& order = graph.precedence();
  std::vector<std::uint32_t> steps;
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
    for (VisitId v = graph.at(robot); v <= cut[robot]; ++v) steps.push_back(order[v].step);
  }
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

}  // namespace

bool isDownwardClosed(const ExecutionGraph& graph, const Cut& cut) {
  const Precedence& order = graph.precedence();
  const auto contains = [&](VisitId event) { return event <= cut[order[event].robot]; };
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
    if (cut[robot] < graph.at(robot) + (isUnderWay(graph, robot) ? 1 : 0)) return false;
    for (VisitId event = graph.at(robot) + 1; event <= cut[robot]; ++event) {
      bool has_all = true;
      graph.forEachAwaited(
          event, [&](VisitId awaited, double) { has_all = has_all && contains(awaited); });
      if (!has_all) return false;
      const Ring* const ring = graph.ringOf(event);
      if (ring != nullptr && !std::all_of(ring->begin(), ring->end(), contains)) return false;
    }
  }
  return true;
}

Cut cutBefore(const ExecutionGraph& graph, const Forecast& forecast, std::uint32_t tick) {
  const Precedence& order = graph.precedence();
  Cut cut(order.robots());
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
    VisitId last = graph.at(robot) + (isUnderWay(graph, robot) ? 1 : 0);
    while (last < order.last(robot) && forecast.begins[last + 1] < tick) ++last;
    cut[robot] = last;
  }
  return cut;
}

Cut withoutRings(const ExecutionGraph& graph, Cut cut) {
  const Precedence& order = graph.precedence();
  const auto has_begun = [&](VisitId event) {
    const std::uint32_t robot = order[event].robot;
    return graph.at(robot) >= event || (graph.at(robot) + 1 == event && graph.progress(robot) > 0);
  };
  for (const Ring& ring : graph.rings()) {
    if (has_begun(ring.front())) continue;
    for (const VisitId event : ring) {
      VisitId& last = cut[order[event].robot];
      last = std::min(last, event - 1);
    }
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
      for (VisitId event = graph.at(robot) + 1; event <= cut[robot]; ++event) {
        bool has_all = true;
        graph.forEachAwaited(event, [&](VisitId awaited, double) {
          has_all = has_all && awaited <= cut[order[awaited].robot];
        });
        if (has_all) continue;
        cut[robot] = event - 1;
        changed = true;
      }
    }
  }
  return cut;
}

Precedence restBehind(const ExecutionGraph& graph, const Cut& cut) {
  const Precedence& order = graph.precedence();
  std::vector<Visit> visits;
  visits.reserve(order.size());
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
    for (VisitId v = cut[robot]; v <= order.last(robot); ++v) visits.push_back(order[v]);
  }
  return Precedence::fromVisits(std::move(visits), order.vertices());
}

ExecutionGraph concatenate(const ExecutionGraph& graph, const Cut& cut, const Plan& plan) {
  const Precedence& order = graph.precedence();
  const std::vector<std::uint32_t> steps = stepsUpTo(graph, cut);
  const auto rank = [&](std::uint32_t step) {
    return static_cast<std::uint32_t>(std::lower_bound(steps.begin(), steps.end(), step) -
                                      steps.begin());
  };
  const std::uint32_t begin = steps.empty() ? 0 : rank(steps.back());
  std::vector<Visit> visits;
  visits.reserve(order.size());
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
    for (VisitId v = graph.at(robot); v <= cut[robot]; ++v) {
      visits.push_back({order[v].vertex, robot, rank(order[v].step), kNoVisit, kNoVisit});
    }
    appendMoves(plan.paths[robot], robot, begin, visits);
  }
  for (std::uint32_t robot = order.robots(); robot < plan.paths.size(); ++robot) {
    visits.push_back({plan.paths[robot].front(), robot, 0, kNoVisit, kNoVisit});
    appendMoves(plan.paths[robot], robot, begin, visits);
  }
  Precedence joined = Precedence::fromVisits(std::move(visits), order.vertices());
  ExecutionGraph result(std::move(joined), graph.release(), graph.closeMoves());
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
    if (!isUnderWay(graph, robot)) continue;
    result.resume(robot, graph.progress(robot));
  }
  return result;
}

}  // namespace split_mapf
