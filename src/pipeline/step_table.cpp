#include "pipeline/step_table.h"

#include "search/crowd.h"

namespace split_mapf {
namespace {

constexpr std::uint64_t kMostMebibytes = 192;
// Of large teams: solvers that keep none keep a table of distances a robot, which takes more.
constexpr std::uint64_t kMostOfTeamMebibytes = 512;
// Of straightening, whatever the threads: one, and no others beside it.
constexpr std::uint64_t kMostToStraightenMebibytes = 512;
// Several of them would be kept.
constexpr std::uint64_t kMostAskedForMebibytes = 2048;

}  // namespace

StepTable::StepTable(const Instance& instance, std::uint32_t steps) {
  const std::uint64_t words = steps / 64 + 1;
  most_mebibytes_ = instance.robots() >= kCrowd ? kMostOfTeamMebibytes : kMostMebibytes;
  mebibytes_ = instance.graph().size() * words * sizeof(std::uint64_t) >> 20U;
}

bool StepTable::isTooLarge() const { return mebibytes_ > most_mebibytes_; }

bool StepTable::isTooLargeForEachThread() const { return mebibytes_ > kMostMebibytes; }

bool StepTable::isTooLargeToStraighten() const {
  return kBitsToStraighten * mebibytes_ > kMostToStraightenMebibytes;
}

std::string StepTable::describeToStraighten() const {
  return "a table of steps to straighten would take " +
         std::to_string(kBitsToStraighten * mebibytes_) + " MiB";
}

bool StepTable::isImpossible() const { return mebibytes_ > kMostAskedForMebibytes; }

std::string StepTable::describe(const std::string& whose) const {
  return "a table of steps" + whose + " would take " + std::to_string(mebibytes_) + " MiB";
}

std::string StepTable::mostOfAuto() const { return std::to_string(most_mebibytes_) + " MiB"; }

std::string StepTable::mostPossible() { return std::to_string(kMostAskedForMebibytes) + " MiB"; }

}  // namespace split_mapf
