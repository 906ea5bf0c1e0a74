#pragma once

#include <cstdint>
#include <vector>

#include "search/explored.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// The constraints under which one configuration gets its successors, in the order in which they
/// are tried: none, then one robot forced to a place, then two, ... breadth first, robots in order
/// of priority. Sets that contradict themselves are left out. When it is empty, every successor has
/// come up. Memory: nothing before the second visit, then 12 bytes a set. Not thread-safe.
class ConstraintQueue {
 public:
  /// Puts the next set into `next`, kNoVertex for robots that are free. @return false when there is
  /// none left. @pre `from` and `order` are those of the configuration, the same in every call.
  bool pop(const Graph& graph, const Configuration& from, const std::vector<std::uint32_t>& order,
           RandomEngine& engine, Configuration& next);
  /// Frees the memory of a queue that is empty.
  void release() { sets_ = {}; }
  std::size_t bytes() const { return sets_.capacity() * sizeof sets_[0]; }

 private:
  static constexpr std::uint32_t kRoot = 0;

  struct Set {  // a set is its parent and one robot more: number `depth` of the order
    std::uint32_t parent;
    std::uint32_t depth;
    Vertex place;
  };
  void branch(std::uint32_t number, const Graph& graph, const Configuration& from,
              const std::vector<std::uint32_t>& order, RandomEngine& engine);
  bool allows(std::uint32_t number, const Configuration& from,
              const std::vector<std::uint32_t>& order, std::uint32_t robot, Vertex place) const;

  std::vector<Set> sets_;       // set n > 0 stands at n - 1; set 0, the root, is empty
  std::uint32_t tried_ = 0;     // sets 0 .. tried_ - 1 have been given out
  std::uint32_t branched_ = 0;  // sets 0 .. branched_ - 1 have their children
};

}  // namespace split_mapf
