#include "split_mapf/core/compaction.h"

#include <vector>

#include "split_mapf/core/precedence.h"

namespace split_mapf {

Plan compact(const Plan& plan, std::uint32_t vertices, const Deadline& deadline) {
  const Precedence precedence(plan, vertices, deadline);
  const std::vector<std::uint32_t> steps = earliestSteps(precedence, {}, deadline);
  deadline.require();
  return planOf(precedence, steps);
}

Plan compactInTime(Plan plan, std::uint32_t vertices, const Deadline& deadline) {
  try {
    return compact(plan, vertices, deadline);
  } catch (const Interrupted&) {
    return plan;
  }
}

}  // namespace split_mapf
