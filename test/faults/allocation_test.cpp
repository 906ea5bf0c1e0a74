// Memory that is refused once, at the n-th request of a small run, for each n in a long run and
// else for many: the planner answers with a plan or says that memory ran out, and files are whole
// or not there.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>
#include <string>

#include "solver/available/available_solvers.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/generate/generator.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/pipeline/planner.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"

namespace {

constexpr long kNever = std::numeric_limits<long>::max();
// Names that operator new, which has no parameters for them, can reach.
std::atomic<long> g_until_refusal{kNever};  // NOLINT(readability-identifier-naming)

void* allocate(std::size_t bytes) {
  if (g_until_refusal.fetch_sub(1, std::memory_order_relaxed) == 1) return nullptr;
  return std::malloc(bytes == 0 ? 1 : bytes);
}

void* allocateOrThrow(std::size_t bytes) {
  void* memory = allocate(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return allocateOrThrow(bytes); }
void* operator new[](std::size_t bytes) { return allocateOrThrow(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return allocate(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  return allocate(bytes);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t /*bytes*/) noexcept { std::free(memory); }

namespace split_mapf {
namespace {

constexpr double kPatienceSec = 60;
// Far more than any of these runs asks for.
constexpr long kMostRequests = 200000;

/// The next request to refuse: each in a long run; else ever fewer, as most of a run is its middle.
long after(long n) { return test::isLongRun() ? n + 1 : n + 1 + n / 50; }

/// Refuses the n-th request for memory of all threads while it lives.
class RefusedRequest {
 public:
  explicit RefusedRequest(long n) { g_until_refusal.store(n); }
  ~RefusedRequest() { g_until_refusal.store(kNever); }
  bool wasReached() const { return g_until_refusal.load() < 1; }
};

/// Parameters: solver, split.
class RefusedMemory : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(RefusedMemory, EndsWithAPlanOrSaysThatMemoryRanOut) {
  const Instance fresh =
      test::instanceFromAscii({"a..b", "....", "c..."}, {"b..a", "....", "...c"});
  PlanRequest request;
  request.solver = std::get<0>(GetParam());
  request.split = std::get<1>(GetParam());
  Executor executor(2);
  const Planner planner(availableSolvers(), executor);
  int plans = 0;
  long n = 1;
  for (bool reached = true; reached; n = after(n)) {
    ASSERT_LT(n, kMostRequests);
    // Its own distance tables: they are part of the run.
    const Instance instance(fresh.problem());
    PlanReport report;
    {
      const RefusedRequest refused(n);
      report =
          Planner(availableSolvers(), executor).plan(instance, request, Deadline(kPatienceSec));
      reached = refused.wasReached();
    }
    ASSERT_TRUE(report.plan.has_value() || report.termination == Termination::kMemoryLimit)
        << "request " << n << ": " << report.message;
    ASSERT_FALSE(report.message.empty()) << n;
    ASSERT_EQ(report.optimal, !report.certified_by.empty()) << n;
    if (report.plan) {
      ASSERT_TRUE(validate(instance, *report.plan).empty()) << n;
    }
    plans += report.plan ? 1 : 0;
  }
  EXPECT_GT(n, 50) << "a run that asks for so little shows nothing";
  EXPECT_GT(plans, 0);
}

std::string nameOf(const std::tuple<const char*, const char*>& parameters) {
  return std::string(std::get<0>(parameters)) + "_" + std::get<1>(parameters);
}

INSTANTIATE_TEST_SUITE_P(Planner, RefusedMemory,
                         ::testing::Combine(::testing::Values("auto", "ecbs", "lacam",
                                                              "prioritized", "conflict_optimizer",
                                                              "joint"),
                                            ::testing::Values("none", "2t", "1x2s2t")),
                         [](const auto& info) { return nameOf(info.param); });

std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Writes the file once for each request that is refused, and once more. @pre one file in `folder`.
template <class Write>
void expectWholeOrAsBefore(const std::string& folder, const std::string& path, Write write) {
  write();
  const std::string whole = bytesOf(path);
  bool reached = true;
  for (long n = 1; reached; ++n) {
    ASSERT_LT(n, kMostRequests);
    std::ofstream(path) << "before";
    bool written = false;
    {
      const RefusedRequest refused(n);
      try {
        write();
        written = true;
      } catch (const std::bad_alloc&) {
      }
      reached = refused.wasReached();
    }
    const std::string found = bytesOf(path);
    ASSERT_TRUE(found == whole || (!written && found == "before")) << n << ": " << found;
    ASSERT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << n;
  }
}

TEST(RefusedMemory, LeavesFilesWholeOrAsTheyWere) {
  const GeneratedProblem problem = generateProblem(GeneratorOptions());
  Scenario scenario;
  scenario.starts = problem.starts;
  scenario.goals = problem.goals;
  const std::string folder = ::testing::TempDir() + "refused_memory";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string path = folder + "/problem";
  expectWholeOrAsBefore(folder, path, [&] { writeMovingAiMap(path, *problem.grid); });
  expectWholeOrAsBefore(
      folder, path, [&] { writeMovingAiScenario(path, "problem.map", *problem.grid, scenario); });
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace split_mapf
