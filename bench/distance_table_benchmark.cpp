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

}  // namespace
}  // namespace split_mapf
