// Plans random small instances by random solvers, splits and options, and holds every answer to an
// oracle, and to the other answers where the instance is too large for one.
//
// usage: fuzz_differential [RUNS [FIRST]]
//
// RUNS requests (500), eight an instance; instance i is drawn from seed FIRST + i (0). Each request
// has a tenth of a second, and one in four is planned again on the other number of threads, which
// must give the same plan. Prints what went wrong, with the words that plan it again, and exits 1.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>

#include "differential/answer_check.h"
#include "differential/drawn_case.h"
#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/pipeline/planner.h"
#include "support/small_instances.h"

namespace split_mapf::fuzz {
namespace {

constexpr std::uint64_t kRequestsAnInstance = 8;

class Differential {
 public:
  explicit Differential(std::uint64_t runs) : runs_(runs) {}

  /// Whether nothing went wrong.
  bool run(std::uint64_t first) {
    for (std::uint64_t seed = first; done_ < runs_; ++seed) planInstance(seed);
    std::printf(
        "%llu runs, %llu planned twice, %llu wrong:", static_cast<unsigned long long>(done_),
        static_cast<unsigned long long>(twice_), static_cast<unsigned long long>(wrong_));
    for (const auto& [word, times] : outcomes_) {
      std::printf(" %s %llu", word.c_str(), static_cast<unsigned long long>(times));
    }
    std::puts("");
    // Runs that all end without a plan would show nothing.
    return wrong_ == 0 && outcomes_["solved"] * 3 > done_;
  }

 private:
  void planInstance(std::uint64_t seed) {
    KnownInstance known(drawInstance(seed));
    for (std::uint64_t i = 0; i < kRequestsAnInstance && done_ < runs_; ++i) {
      const PlanRequest request = drawRequest(availableSolvers(), seed * kRequestsAnInstance + i);
      ++done_;
      const std::string fault = planOnce(known, request, i % 4 == 0);
      if (fault.empty()) continue;
      ++wrong_;
      std::printf("instance %llu, request %llu: %s\n  %s%s\n",
                  static_cast<unsigned long long>(seed), static_cast<unsigned long long>(i),
                  fault.c_str(), toString(request).c_str(),
                  test::describe(known.instance()).c_str());
      std::fflush(stdout);
    }
  }

  /// What went wrong; empty: nothing.
  std::string planOnce(KnownInstance& known, PlanRequest request, bool again) {
    try {
      const PlanReport report = plan(known.instance(), request);
      ++outcomes_[toString(report.termination)];
      std::string fault = known.faultOf(request, report);
      if (!fault.empty() || !again || request.refine_sec > 0) return fault;
      request.threads = 3 - request.threads;
      const PlanReport other = plan(known.instance(), request);
      fault = known.faultOf(request, other);
      if (!fault.empty()) return "on another number of threads: " + fault;
      if (isUpToTheClock(report) || isUpToTheClock(other)) return "";
      ++twice_;
      const std::string difference = differenceOf(report, other);
      return difference.empty() ? ""
                                : "another number of threads gives another answer:\n" + difference;
    } catch (const OptionError&) {
      ++outcomes_["refused"];
      return "";
    } catch (const std::exception& error) {
      return std::string("throws: ") + error.what();
    }
  }

  PlanReport plan(const Instance& instance, const PlanRequest& request) {
    const Deadline deadline(kLimitSec);
    PlanReport report = Planner(availableSolvers(), executor_).plan(instance, request, deadline);
    // The report's own clock begins later than the limit: a process that waited for a processor in
    // between has less time than the report says.
    report.runtime_sec = kLimitSec - deadline.remainingSec();
    return report;
  }

  std::uint64_t runs_;
  std::uint64_t done_ = 0;
  std::uint64_t twice_ = 0;
  std::uint64_t wrong_ = 0;
  std::map<std::string, std::uint64_t> outcomes_;
  Executor executor_{2};
};

/// @throws std::invalid_argument, std::out_of_range.
std::uint64_t numberOf(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) {
    throw std::invalid_argument(text);
  }
  return std::stoull(text);
}

}  // namespace
}  // namespace split_mapf::fuzz

int main(int argc, char** argv) {
  std::uint64_t runs = 500;
  std::uint64_t first = 0;
  try {
    if (argc > 3) throw std::invalid_argument("too many");
    if (argc > 1) runs = split_mapf::fuzz::numberOf(argv[1]);
    if (argc > 2) first = split_mapf::fuzz::numberOf(argv[2]);
  } catch (const std::logic_error&) {
    std::puts("usage: fuzz_differential [RUNS [FIRST]]");
    return 2;
  }
  return split_mapf::fuzz::Differential(runs).run(first) ? 0 : 1;
}
