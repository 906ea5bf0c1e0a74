#pragma once

#include <string>
#include <vector>

#include "split_mapf/core/objective.h"
#include "split_mapf/portfolio/instance_features.h"

namespace split_mapf {

/// What a method is expected to cost on an instance.
struct MethodEstimate {
  std::string solver;
  double seconds = 0;  ///< of one processor, to the first plan
  double excess = 0;   ///< cost over its lower bound, less 1
};

/// Predicts time and quality of methods from the features of an instance: the logarithms of both
/// are linear in the logarithms of the features (the f(n, S, T) that the paper asks for), fitted on
/// runs of `split_mapf bench` by scripts/fit_cost_model). Immutable.
class CostModel {
 public:
  /// @param yaml  as config/cost_model.yaml. @throws InputError for anything else.
  explicit CostModel(const std::string& yaml);
  /// The one that is built in.
  static const CostModel& shipped();
  /// An estimate for each method that is known for the objective, in the model's order.
  std::vector<MethodEstimate> estimate(const InstanceFeatures& features, Objective objective) const;

 private:
  struct Method {
    std::string solver;
    Objective objective = Objective::kMakespan;
    std::vector<double> log_seconds;
    std::vector<double> log_excess;
  };
  std::vector<Method> methods_;
};

/// config/cost_model.yaml as it was when the library was built.
extern const char* const shipped_cost_model;

}  // namespace split_mapf
