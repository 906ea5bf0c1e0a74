#pragma once

#include <cstdint>
#include <string>

#include "split_mapf/core/instance.h"

namespace split_mapf {

/// The distances of all robots at once, which a solver keeps that looks at all robots in each step:
/// whether there is room for them. Depends on the instance alone, and not on how much memory this
/// machine has: else plans would. Immutable.
class AllDistances {
 public:
  AllDistances() = default;
  /// @param steps  of all robots' shortest ways together, or less.
  AllDistances(const Instance& instance, std::uint64_t steps);
  /// Of who also asks beside the ways: they become tables of all.
  static AllDistances everywhere(const Instance& instance);
  /// What is known of them before any way is: a move crosses one row or column. On a planning graph
  /// that is nothing.
  static AllDistances atLeast(const Instance& instance);

  bool areTooLarge() const;
  /// "the distances of all robots, which WHO keeps, would take 9000 MiB, at most 8192 MiB are
  /// possible".
  std::string describe(const std::string& who) const;

 private:
  std::uint64_t mebibytes_ = 0;
};

}  // namespace split_mapf
