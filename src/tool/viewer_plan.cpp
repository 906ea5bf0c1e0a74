#include "tool/viewer_plan.h"

#include <algorithm>
#include <ostream>
#include <string>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/fleet/simulation.h"
#include "split_mapf/io/cell_paths.h"
#include "tool/simulation_output.h"

namespace split_mapf::tool {
namespace {

/// A plan is an execution in which nobody is late.
SimulationReport onTime(const Plan& plan) {
  SimulationReport report;
  report.executed = plan;
  report.planned_sum_of_costs = sumOfCostsOf(plan);
  report.executed_sum_of_costs = static_cast<double>(report.planned_sum_of_costs);
  report.planned_makespan = makespanOf(plan);
  report.executed_makespan = report.planned_makespan;
  return report;
}

void writeSteps(std::ostream& out, const CellPaths& paths) {
  std::size_t steps = 0;
  for (const std::vector<Cell>& path : paths) steps = std::max(steps, path.size());
  for (std::size_t step = 0; step < steps; ++step) {
    out << step << ':';
    for (const std::vector<Cell>& path : paths) {
      const Cell cell = path[std::min(step, path.size() - 1)];
      out << '(' << cell.x << ',' << cell.y << "),";
    }
    out << '\n';
  }
}

}  // namespace

void declareViewerFormat(CommandLine& line) {
  line.offer("export", "FORMAT",
             "write the plan for another viewer instead: planviz or mapf-visualizer");
}

std::optional<ViewerFormat> readViewerFormat(const CommandLine& line) {
  if (!line.has("export")) return std::nullopt;
  const std::string format = line.text("export");
  if (format != "planviz" && format != "mapf-visualizer") {
    throw OptionError("option --export: format " + quote(format) +
                      " is unknown; planviz or mapf-visualizer is expected");
  }
  if (!line.has("output")) {
    throw OptionError("option --export needs --output FILE: there is nowhere to write to");
  }
  if (line.has("write-better")) {
    throw OptionError("options --export and --write-better do not go together");
  }
  return format == "planviz" ? ViewerFormat::kPlanViz : ViewerFormat::kMapfVisualizer;
}

void writeForViewer(std::ostream& out, ViewerFormat format, const Instance& instance,
                    const Plan& plan) {
  switch (format) {
    case ViewerFormat::kPlanViz:
      writeLeagueJson(out, instance, onTime(plan));
      return;
    case ViewerFormat::kMapfVisualizer:
      writeSteps(out, cellPathsOf(instance.grid(), plan));
      return;
  }
}

}  // namespace split_mapf::tool
