#include <benchmark/benchmark.h>

#include "crowd.h"

namespace split_mapf {
namespace {

/// One search a robot in turn, among the paths of all others.
void searchAmongOthers(benchmark::State& state, OthersAre mode) {
  const Instance instance = bench::generatedInstance(static_cast<std::uint32_t>(state.range(0)),
                                                     static_cast<std::uint32_t>(state.range(1)));
  const bench::Crowd crowd(instance);
  SafeIntervalSearch search(instance.graph());
  std::uint32_t robot = 0;
  std::uint64_t expansions = 0;
  while (state.KeepRunning()) {
    SearchQuery query = crowd.query(instance, robot);
    query.mode = mode;
    expansions += search.search(query, Deadline()).expansions;
    robot = (robot + 1) % instance.robots();
  }
  state.counters["expansions"] =
      benchmark::Counter(static_cast<double>(expansions), benchmark::Counter::kAvgIterations);
  state.counters["expansions/s"] =
      benchmark::Counter(static_cast<double>(expansions), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(searchAmongOthers, ignored, OthersAre::kIgnored)->Args({128, 500});
BENCHMARK_CAPTURE(searchAmongOthers, counted, OthersAre::kCounted)
    ->Args({32, 150})
    ->Args({128, 500});

}  // namespace
}  // namespace split_mapf
