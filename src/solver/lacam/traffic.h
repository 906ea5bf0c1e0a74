#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// How many guide paths lead over each vertex, by the neighbour that they come from, in each span
/// of steps from now on. Memory: eight bytes a vertex and span, of which there are 96 at most. Not
/// thread-safe while it changes.
class Traffic {
 public:
  /// In a crowd everybody is held up, by so much on average: step k of a path takes until this.
  static std::uint32_t delayed(std::uint32_t steps) { return steps * 6 / 5; }

  /// @pre no vertex has more than four neighbours.
  explicit Traffic(const Instance& instance);

  void clear();
  void insert(const Path& guide) { change(guide, 1); }
  void remove(const Path& guide) { change(guide, -1); }
  /// Paths that come to `v` around so many steps from now.
  std::uint32_t onto(Vertex v, std::uint32_t steps) const;
  /// Paths that come to `to` from `from` around so many steps from now.
  std::uint32_t along(Vertex from, Vertex to, std::uint32_t steps) const {
    return counts_[place(from, to, spanOf(steps))];
  }

 private:
  static constexpr std::size_t kDirections = 4;
  static constexpr std::uint32_t kSpan = 16;  // steps

  void change(const Path& guide, int by);
  std::size_t spanOf(std::uint32_t steps) const {
    const std::size_t span = steps / kSpan;
    return span < spans_ ? span : spans_ - 1;
  }
  std::size_t place(Vertex from, Vertex to, std::size_t span) const;

  const Graph& graph_;
  std::size_t spans_;
  std::vector<std::uint16_t> counts_;  // by span, as searches go, then vertex and direction
};

}  // namespace split_mapf
