#include "pipeline/auto_choice.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "split_mapf/split/split_spec.h"

namespace split_mapf {
namespace {

// Plans that cost more than so many times the best expected are no choice while others are: at
// once, but refinement would take long to make up for them.
constexpr double kComparable = 1.25;
// Methods that take at most this many times the least are as soon as it: the best plan decides.
// Waiting longer for a better first plan does not pay, as refinement makes a better one meanwhile.
constexpr double kAsSoon = 1.2;
// Of two processors a split keeps so much busy.
constexpr double kParallelShare = 0.8;

// What takes less is not worth a split, whatever the model says of it.
constexpr double kLeastToSplitSec = 0.05;

std::string inSeconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g s", seconds);
  return text;
}

double wallSeconds(const MethodEstimate& method, std::uint32_t threads) {
  const auto pieces = std::max<std::size_t>(1, parseSplitSpec(method.split).time_ratios.size());
  const auto workers = static_cast<double>(std::min<std::size_t>(pieces, threads));
  return method.seconds / (1 + kParallelShare * (workers - 1));
}

double lastResortSec(const std::vector<MethodEstimate>& methods) {
  for (const MethodEstimate& method : methods) {
    if (method.solver == kLastResort && method.split == "none") return method.seconds;
  }
  return 0;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Those that the question leaves open. A split that was asked for says nothing of the solver: the
/// whole instance stands for its pieces.
std::vector<MethodEstimate> candidates(const AutoQuestion& question, const CostModel& model) {
  std::vector<MethodEstimate> result;
  for (MethodEstimate& method : model.estimate(question.features, question.objective)) {
    const bool solver_fits = question.solver == "auto" ? has(question.solvers, method.solver)
                                                       : question.solver == method.solver;
    const bool worth_it = method.split == "none" || method.seconds >= kLeastToSplitSec;
    const bool split_fits = question.split == "auto" ? worth_it : method.split == "none";
    if (!solver_fits || !split_fits) continue;
    method.seconds = wallSeconds(method, question.threads);
    result.push_back(std::move(method));
  }
  return result;
}

}  // namespace

AutoChoice chooseMethod(const AutoQuestion& question, const CostModel& model) {
  std::vector<MethodEstimate> methods = candidates(question, model);
  if (methods.empty()) {
    return {question.solver == "auto" ? question.solvers.front() : question.solver,
            question.split == "auto" ? "none" : question.split, "nothing is known of it", 0};
  }
  const auto best = std::min_element(
      methods.begin(), methods.end(),
      [](const MethodEstimate& a, const MethodEstimate& b) { return a.excess < b.excess; });
  const double most = kComparable * (1 + best->excess) - 1;
  const double last_resort_sec = lastResortSec(methods);
  methods.erase(std::remove_if(methods.begin(), methods.end(),
                               [most](const MethodEstimate& m) { return m.excess > most; }),
                methods.end());
  const auto soonest = std::min_element(
      methods.begin(), methods.end(),
      [](const MethodEstimate& a, const MethodEstimate& b) { return a.seconds < b.seconds; });
  const double soon_sec = kAsSoon * soonest->seconds;
  std::stable_sort(methods.begin(), methods.end(),
                   [soon_sec](const MethodEstimate& a, const MethodEstimate& b) {
                     const bool a_soon = a.seconds <= soon_sec;
                     const bool b_soon = b.seconds <= soon_sec;
                     if (a_soon != b_soon) return a_soon;
                     return a_soon ? a.excess < b.excess : a.seconds < b.seconds;
                   });
  const MethodEstimate& first = methods.front();
  AutoChoice choice{first.solver, question.split == "auto" ? first.split : question.split,
                    inSeconds(first.seconds) + " expected",
                    first.solver == kLastResort ? 0 : last_resort_sec};
  if (methods.size() > 1) {
    choice.reason += ", " + inSeconds(methods[1].seconds) + " by " + methods[1].solver;
    if (methods[1].split != "none") choice.reason += " in " + methods[1].split;
  }
  return choice;
}

}  // namespace split_mapf
