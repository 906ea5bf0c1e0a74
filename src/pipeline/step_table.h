#pragma once

#include <cstdint>
#include <string>

#include "split_mapf/core/instance.h"

namespace split_mapf {

/// A table of a bit a cell and step, of which most searches keep two or more: whether there is room
/// for it. Immutable.
class StepTable {
 public:
  StepTable() = default;
  /// @param steps  a lower bound of the makespan.
  StepTable(const Instance& instance, std::uint32_t steps);

  /// None is made then unless its solver was asked for.
  bool isTooLarge() const;
  /// Improving a plan keeps one or more for each thread: none of these is made then.
  bool isTooLargeForEachThread() const;
  /// Straightening keeps one with kBitsToStraighten a cell and step: a plan is left as it is then.
  bool isTooLargeToStraighten() const;
  /// "a table of steps to straighten would take 600 MiB".
  std::string describeToStraighten() const;
  /// Not even then.
  bool isImpossible() const;
  /// "a table of steps WHOSE would take 300 MiB". @param whose  begins with a blank; or is empty.
  std::string describe(const std::string& whose = "") const;
  /// What isTooLarge() allows, for people: "192 MiB".
  std::string mostOfAuto() const;
  /// What isImpossible() allows, for people: "2048 MiB".
  static std::string mostPossible();

 private:
  static constexpr std::uint64_t kBitsToStraighten = 4;  // see OccupancyBySteps

  std::uint64_t mebibytes_ = 0;
  std::uint64_t most_mebibytes_ = 0;
};

}  // namespace split_mapf
