#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "search/bucket_queue.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// When paths cross each vertex, and from where. Memory: four bytes a step of the paths. Not
/// thread-safe.
class Crossings {
 public:
  static constexpr std::uint32_t kFromBits = 2;
  static constexpr std::size_t kDirections = std::size_t{1} << kFromBits;

  explicit Crossings(const Graph& graph);

  void insert(const Path& path);
  /// @pre the path is there, or empty.
  void remove(const Path& path);
  /// How many paths come to `v` at step `t`, by the neighbour that they come from.
  std::array<std::uint32_t, kDirections> arrivals(Vertex v, std::uint32_t t) const;
  /// How many paths come to `v` at step `t`, or ended there before.
  std::uint32_t count(Vertex v, std::uint32_t t) const;

 private:
  static constexpr std::uint32_t kNever = 0xffffffffU;

  std::uint32_t keyOf(Vertex from, Vertex to, std::uint32_t t) const;
  /// Calls `found` with the key of each path that comes to `v` at step `t`.
  template <typename Found>
  void forEachAt(Vertex v, std::uint32_t t, Found found) const;
  template <typename Change>
  void visit(const Path& path, Change change) const;

  const Graph& graph_;
  std::vector<std::vector<std::uint32_t>> visits_;  // by vertex: step and direction, ascending
  std::vector<std::uint32_t> ended_;                // by vertex: step from which a path stays
};

/// Finds a robot's path through space that collides with few of those in a table, which the search
/// only reads. Used by one thread at a time.
class ScatterSearch {
 public:
  /// @pre instance and table outlive this object.
  ScatterSearch(const Instance& instance, const Crossings& table, std::uint32_t margin);

  Path find(std::uint32_t robot);
  /// Of the last path.
  std::uint64_t collisions() const { return collisions_; }
  std::uint64_t expansions() const { return expansions_; }

 private:
  struct State {
    Vertex vertex;
    std::uint32_t time;
    std::uint32_t collisions;
    std::uint32_t parent;
    std::uint32_t next;
  };

  void expand(std::uint32_t index);

  const Instance& instance_;
  const Crossings& table_;
  std::uint32_t margin_;
  const DistanceTable* distances_ = nullptr;
  std::uint32_t shortest_ = 0;
  std::vector<std::uint32_t> closed_;  // by vertex: number of the search that closed it
  std::uint32_t search_number_ = 0;
  BucketQueue<State> queue_;
  std::uint64_t collisions_ = 0;
  std::uint64_t expansions_ = 0;
};

}  // namespace split_mapf
