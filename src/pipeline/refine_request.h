#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pipeline/step_table.h"
#include "split_mapf/core/plan_report.h"
#include "split_mapf/improve/refine.h"
#include "split_mapf/portfolio/instance_features.h"

namespace split_mapf {

/// Robots whose conflicts hang together up to this number are worth a search for the optimum.
constexpr std::uint32_t kSmallKnot = 20;
/// More robots than that are measured only where `auto` has to choose.
constexpr std::uint32_t kMostToMeasure = 200;

/// Why the plan of the report is not refined, to be added to its message; empty: it can be.
std::string whyNotRefined(const PlanReport& report, const StepTable& table);
/// What refine() is to do for the plan of the report. @param features  where they were measured.
RefineOptions refineOptionsOf(const PlanReport& report, const SolverRegistry& solvers,
                              const std::optional<InstanceFeatures>& features);

}  // namespace split_mapf
