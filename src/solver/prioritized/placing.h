#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "solver/prioritized/effort.h"
#include "solver/search/eviction_search.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Places robots one after another, each on the earliest path around those placed before. Where
/// there is none the robot takes the path that displaces others of the least weight, and who is
/// displaced is demoted: it comes last, and weighs more. A robot that would displace one that has
/// been demoted often enough is left over. The placed paths never conflict. Not thread-safe.
/// Measured: last is twice as fast as right after the robot that displaced it (warehouse, 1000
/// robots: 13 instead of 28 million expansions), and one search that may displace is cheaper than a
/// second one where the first found nothing (7 million).
class Placing {
 public:
  Placing(const Instance& instance, Effort& effort, std::vector<Path>& paths);

  /// @param demotions  how often a robot may be demoted.  @param horizon  nobody arrives later.
  /// @return who is left over, without a path, in order; incomplete when the effort stopped.
  std::vector<std::uint32_t> run(const std::vector<std::uint32_t>& order, std::uint64_t demotions,
                                 std::uint32_t horizon);

 private:
  bool place(std::uint32_t robot, std::uint64_t demotions, std::uint32_t horizon);
  GapAnswer search(std::uint32_t robot, std::uint32_t horizon, bool demote);
  void demote(std::uint32_t robot);

  const Instance& instance_;
  Effort& effort_;
  ReservationTable table_;
  std::vector<Path>& paths_;
  EvictionSearch search_;
  std::deque<std::uint32_t> queue_;
  std::vector<std::uint32_t> weights_;  // 1 + how often demoted, squared
  std::vector<std::uint32_t> demoted_;  // how often
};

}  // namespace split_mapf
