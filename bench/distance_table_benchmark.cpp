#include <benchmark/benchmark.h>

#include "crowd.h"

namespace split_mapf {
namespace {

void wholeTable(benchmark::State& state) {
  const Instance instance = bench::generatedInstance(static_cast<std::uint32_t>(state.range(0)), 1);
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(DistanceTable(instance.graph(), instance.goal(0)));
  }
  state.SetItemsProcessed(state.iterations() * instance.graph().size());
}
BENCHMARK(wholeTable)->Arg(32)->Arg(128)->Arg(256);

void tableOnDemandToTheStart(benchmark::State& state) {
  const Instance instance = bench::generatedInstance(static_cast<std::uint32_t>(state.range(0)), 1);
  while (state.KeepRunning()) {
    const DistanceTable table(instance.graph(), instance.goal(0), DistanceExtent::kOnDemand);
    benchmark::DoNotOptimize(table(instance.start(0)));
  }
}
BENCHMARK(tableOnDemandToTheStart)->Arg(32)->Arg(128)->Arg(256);

/// Half-way to the goal, with what is known of the whole way: as in a time split.
void guidedTableToTheStart(benchmark::State& state) {
  const Instance instance = bench::generatedInstance(static_cast<std::uint32_t>(state.range(0)), 1);
  Vertex half_way = instance.start(0);
  for (const std::uint32_t length = instance.shortestLength(0);
       2 * instance.distances(0)(half_way) > length;) {
    for (const Vertex v : instance.graph().neighbours(half_way)) {
      if (instance.distances(0)(v) < instance.distances(0)(half_way)) half_way = v;
    }
  }
  while (state.KeepRunning()) {
    const DistanceTable table(half_way,
                              {&instance.grid(), instance.start(0), instance.shareDistances(0)});
    benchmark::DoNotOptimize(table(instance.start(0)));
  }
}
BENCHMARK(guidedTableToTheStart)->Arg(32)->Arg(128)->Arg(256);

}  // namespace
}  // namespace split_mapf
