#include "support/oracle_cases.h"

#include "support/long_run.h"
#include "support/oracle.h"
#include "support/small_instances.h"

namespace split_mapf::test {
namespace {

constexpr std::uint64_t kCases = 400;
constexpr std::uint64_t kLongRunCases = 4000;

}  // namespace

const std::vector<OracleCase>& oracleCases() {
  static const std::vector<OracleCase> cases = [] {
    std::vector<OracleCase> list;
    const std::uint64_t count = draws(kCases, kLongRunCases);
    for (std::uint64_t seed = 0; seed < count; ++seed) {
      const Instance instance = smallInstance(seed);
      list.push_back({seed, instance, optimalCost(instance, Objective::kMakespan),
                      optimalCost(instance, Objective::kSumOfCosts)});
    }
    return list;
  }();
  return cases;
}

}  // namespace split_mapf::test
