#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "split_mapf/core/execution_graph.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/precedence.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kRobots = 1000;
constexpr std::uint32_t kSteps = 400;
constexpr std::uint32_t kGap = 20;
constexpr std::uint32_t kVertices = kRobots * kGap + kSteps + 1;
constexpr double kRelease = 0.7;

/// Robots that follow each other on a long way, so that each vertex is visited by many.
Plan procession() {
  Plan plan;
  for (std::uint32_t robot = 0; robot < kRobots; ++robot) {
    Path& path = plan.paths.emplace_back();
    for (Vertex v = robot * kGap; v <= robot * kGap + kSteps; ++v) path.push_back(v);
  }
  return plan;
}

void build(benchmark::State& state) {
  const Plan plan = procession();
  std::size_t events = 0;
  for ([[maybe_unused]] auto _ : state) {
    const ExecutionGraph graph(Precedence(plan, kVertices), kRelease);
    events = graph.precedence().size();
    benchmark::DoNotOptimize(events);
  }
  state.counters["events"] = static_cast<double>(events);
}
BENCHMARK(build)->Unit(benchmark::kMillisecond);

/// Each event is reported as it ends, the foremost robots first; time is that of all reports.
void release(benchmark::State& state) {
  const Plan plan = procession();
  std::vector<VisitId> freed;
  std::size_t releases = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    ExecutionGraph graph(Precedence(plan, kVertices), kRelease);
    state.ResumeTiming();
    for (std::uint32_t step = 0; step < kSteps; ++step) {
      for (std::uint32_t robot = kRobots; robot-- > 0;) {
        freed.clear();
        graph.report(robot, graph.at(robot) + 1, 1, &freed);
        releases += freed.size();
      }
    }
    if (!graph.isDone(0)) state.SkipWithError("a robot was not released");
  }
  state.counters["releases/s"] =
      benchmark::Counter(static_cast<double>(releases), benchmark::Counter::kIsRate);
  state.SetItemsProcessed(state.iterations() * kRobots * kSteps);
}
BENCHMARK(release)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace split_mapf
