#include "portfolio/cost_model.h"

#include <array>
#include <cmath>

#include <yaml-cpp/yaml.h>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

constexpr std::size_t kTerms = 7;

/// As scripts/fit_cost_model takes them.
std::array<double, kTerms> termsOf(const InstanceFeatures& features) {
  return {1.0,
          std::log(features.robots),
          std::log(features.cells),
          std::log(1.0 + features.makespan_bound),
          std::log(1.0 + static_cast<double>(features.conflicting)),
          std::log(features.largest_group),
          features.head_on};
}

std::vector<double> weightsOf(const YAML::Node& method, const char* name) {
  auto weights = method[name].as<std::vector<double>>();
  if (weights.size() == kTerms) return weights;
  throw InputError("cost model: " + std::string(name) + " has " + std::to_string(weights.size()) +
                   " weights; " + std::to_string(kTerms) + " are expected");
}

double predict(const std::vector<double>& weights, const std::array<double, kTerms>& terms) {
  double logarithm = 0;
  for (std::size_t i = 0; i < kTerms; ++i) logarithm += weights[i] * terms[i];
  return std::exp(logarithm);
}

}  // namespace

CostModel::CostModel(const std::string& yaml) {
  try {
    for (const YAML::Node& node : YAML::Load(yaml)["methods"]) {
      Method method;
      method.solver = node["solver"].as<std::string>();
      method.objective = parseObjective(node["objective"].as<std::string>());
      method.log_seconds = weightsOf(node, "log_seconds");
      method.log_excess = weightsOf(node, "log_excess");
      methods_.push_back(std::move(method));
    }
  } catch (const YAML::Exception& e) {
    throw InputError(std::string("cost model: ") + e.what());
  }
  if (methods_.empty()) throw InputError("cost model: it has no methods");
}

const CostModel& CostModel::shipped() {
  static const CostModel model(shipped_cost_model);
  return model;
}

std::vector<MethodEstimate> CostModel::estimate(const InstanceFeatures& features,
                                                Objective objective) const {
  const std::array<double, kTerms> terms = termsOf(features);
  std::vector<MethodEstimate> estimates;
  for (const Method& method : methods_) {
    if (method.objective != objective) continue;
    estimates.push_back(
        {method.solver, predict(method.log_seconds, terms), predict(method.log_excess, terms)});
  }
  return estimates;
}

}  // namespace split_mapf
