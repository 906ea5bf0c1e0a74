#include "split_mapf/core/compaction.h"

#include "split_mapf/core/precedence.h"

namespace split_mapf {

Plan compact(const Plan& plan, std::uint32_t vertices) {
  const Precedence precedence(plan, vertices);
  return planOf(precedence, earliestSteps(precedence));
}

}  // namespace split_mapf
