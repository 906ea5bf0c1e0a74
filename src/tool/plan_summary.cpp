#include "tool/plan_summary.h"

#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>

#include "split_mapf/core/wording.h"

namespace split_mapf::tool {
namespace {

std::string fixed(double number, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << number;
  return text.str();
}

/// "412 steps, 1.020 x the shortest possible 404"
std::string costLine(std::uint64_t cost, std::uint64_t bound) {
  std::string text = std::to_string(cost);
  if (bound == 0) return text;
  const double ratio = static_cast<double>(cost) / static_cast<double>(bound);
  return text + "  (" + fixed(ratio, 3) + " x the lower bound " + std::to_string(bound) + ")";
}

void printLine(std::ostream& out, const std::string& name, const std::string& value) {
  out << std::left << std::setw(14) << name << value << "\n";
}

}  // namespace

void printSummary(std::ostream& out, const PlanReport& report) {
  const std::string robots = counted(report.robots, "robot");
  printLine(
      out, "status",
      toString(report.termination) + ", " + robots + (report.optimal ? ", proved optimal" : ""));
  if (report.plan) {
    printLine(out, "makespan", costLine(report.makespan, report.makespan_lower_bound));
    printLine(out, "sum of costs", costLine(report.sum_of_costs, report.sum_of_costs_lower_bound));
  }
  printLine(out, "runtime",
            fixed(report.runtime_sec, 3) + " s on " + std::to_string(report.threads) +
                (report.threads == 1 ? " thread" : " threads"));
  printLine(out, "how", report.message);
}

}  // namespace split_mapf::tool
