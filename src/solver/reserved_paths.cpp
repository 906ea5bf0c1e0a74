#include "solver/reserved_paths.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "search/safe_interval_search.h"

namespace split_mapf {

ReservedPaths::ReservedPaths(const Instance& instance, const Reservations* reserved,
                             const Deadline& deadline)
    : instance_(instance), reserved_(reserved) {
  if (const auto robot = findCutOffRobot(instance)) refusal_ = cutOffResult(*robot);
  if (refusal_ || reserved == nullptr || reserved->empty()) return;
  table_.emplace(instance.graph().size());
  for (std::uint32_t i = 0; i < reserved->paths().size(); ++i) {
    table_->insert(i, reserved->paths()[i]);
  }
  SafeIntervalSearch search(instance.graph());
  SearchQuery query;
  query.reserved = table();
  for (query.robot = 0; query.robot < instance.robots(); ++query.robot) {
    query.start = instance.start(query.robot);
    const HeldDistances distances = instance.distances(query.robot);
    query.distances = &*distances;
    const SearchAnswer answer = search.search(query, deadline);
    if (answer.interrupted || deadline.expired()) {
      refusal_.emplace().termination = interruptionOf(deadline);
      return;
    }
    if (answer.path.empty()) {
      refusal_.emplace().termination = Termination::kUnsolvable;
      refusal_->message = "robot " + std::to_string(query.robot) +
                          " cannot reach its goal around the reserved paths";
      return;
    }
    soonest_.push_back(static_cast<std::uint32_t>(answer.path.size() - 1));
  }
}

std::uint32_t ReservedPaths::makespanBound() const {
  if (!any()) return makespanLowerBound(instance_);
  return *std::max_element(soonest_.begin(), soonest_.end());
}

std::uint64_t ReservedPaths::lowerBound(Objective objective) const {
  if (!any()) return split_mapf::lowerBound(instance_, objective);
  if (ruleOf(objective).greatest_only) return makespanBound();
  return std::accumulate(soonest_.begin(), soonest_.end(), std::uint64_t{0});
}

}  // namespace split_mapf
