#include <benchmark/benchmark.h>

#include "crowd.h"
#include "solver/ecbs/conflicts.h"

namespace split_mapf {
namespace {

/// One robot's path taken out and put back.
void exchangePath(benchmark::State& state) {
  const Instance instance =
      bench::generatedInstance(128, static_cast<std::uint32_t>(state.range(0)));
  bench::Crowd crowd(instance);
  std::uint32_t robot = 0;
  while (state.KeepRunning()) {
    crowd.table.remove(robot, crowd.paths[robot]);
    crowd.table.insert(robot, crowd.paths[robot]);
    robot = (robot + 1) % instance.robots();
  }
}
BENCHMARK(exchangePath)->Arg(100)->Arg(500)->Arg(1000);

/// The conflicts of one robot with all others.
void findConflicts(benchmark::State& state) {
  const Instance instance =
      bench::generatedInstance(128, static_cast<std::uint32_t>(state.range(0)));
  const bench::Crowd crowd(instance);
  ConflictFinder finder(instance.robots());
  std::vector<Conflict> conflicts;
  std::uint32_t robot = 0;
  while (state.KeepRunning()) {
    conflicts.clear();
    finder.find(robot, crowd.paths[robot], crowd.table, conflicts);
    benchmark::DoNotOptimize(conflicts.data());
    robot = (robot + 1) % instance.robots();
  }
}
BENCHMARK(findConflicts)->Arg(100)->Arg(500)->Arg(1000);

}  // namespace
}  // namespace split_mapf
