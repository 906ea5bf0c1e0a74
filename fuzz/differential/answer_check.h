#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "differential/drawn_case.h"
#include "split_mapf/core/plan_report.h"

namespace split_mapf::fuzz {

/// What is wrong with the paths, by rules that are written down here once more and share nothing
/// with the validator: from start to goal by single steps over free cells, nobody where another
/// is, no two change places. Empty: nothing.
std::string faultOf(const Instance& instance, const Plan& plan);

constexpr double kLimitSec = 0.1;  ///< of each request

/// Whether a faster machine may give another answer: some stages give up by shares of the limit.
/// @pre runtime_sec is what has passed of the limit.
bool isUpToTheClock(const PlanReport& report);

/// How two answers to one request ended, stage by stage and piece by piece, and the first step in
/// which their plans differ; empty where they are the same.
std::string differenceOf(const PlanReport& one, const PlanReport& other);

/// What is known of an instance: by the oracle, or, where it is too large for one, by the answers
/// so far, which must not contradict each other.
class KnownInstance {
 public:
  explicit KnownInstance(DrawnInstance drawn);
  const Instance& instance() const { return drawn_.instance; }

  /// What is wrong with the answer; empty: nothing. Learns from it.
  std::string faultOf(const PlanRequest& request, const PlanReport& report);

 private:
  struct Costs {
    double least = 0;                      ///< no plan costs less
    std::optional<std::uint64_t> reached;  ///< the cost of some plan
  };

  std::string faultOfTermination(const PlanRequest& request, const PlanReport& report);
  std::string faultOfCosts(const PlanRequest& request, const PlanReport& report);

  DrawnInstance drawn_;
  bool is_solvable_ = false;
  bool is_unsolvable_ = false;
  std::array<Costs, kObjectives.size()> costs_;
};

}  // namespace split_mapf::fuzz
