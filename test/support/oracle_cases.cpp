#include "support/oracle_cases.h"

#include "support/oracle.h"
#include "support/small_instances.h"

namespace split_mapf::test {
namespace {

constexpr std::uint64_t kCases = 400;

}  // namespace

const std::vector<OracleCase>& oracleCases() {
  static const std::vector<OracleCase> cases = [] {
    std::vector<OracleCase> list;
    for (std::uint64_t seed = 0; seed < kCases; ++seed) {
      const Instance instance = smallInstance(seed);
      list.push_back({seed, instance, optimalCost(instance, Objective::kMakespan),
                      optimalCost(instance, Objective::kSumOfCosts)});
    }
    return list;
  }();
  return cases;
}

}  // namespace split_mapf::test
