#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/lacam/home_passes.h"
#include "solver/lacam/robot_distances.h"
#include "solver/lacam/traffic.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// What a robot's way home costs from each vertex on and beside its guide path, in tenths of a
/// step. Memory: two bytes a vertex near these, by pages. Thread-safe to read.
class PricedWays {
 public:
  static constexpr std::uint16_t kUnknown = 0xffffU;

  std::uint32_t operator()(Vertex v) const {
    return page_of_.empty() ? kUnknown : values_[placeOf(v)];
  }
  void clear();
  /// @param values  by vertex. @param known  the vertices that have one.
  void take(const std::vector<std::uint16_t>& values, const std::vector<Vertex>& known);

 private:
  static constexpr std::uint32_t kPageSize = 32;

  std::size_t placeOf(Vertex v) const {
    return std::size_t{page_of_[v / kPageSize]} * kPageSize + v % kPageSize;
  }

  std::vector<std::uint32_t> page_of_;  // page 0 is unknown
  std::vector<std::uint16_t> values_;
};

/// Finds a robot's cheapest way home where passing a home costs what its owner loses, and crowded
/// cells and oncoming traffic cost a part of a step. From the goal, as an A* towards the robot.
/// Used by one thread at a time.
class PricedSearch {
 public:
  static constexpr std::uint32_t kStep = 10;  ///< the price of a step

  /// @param margin  steps that a way may be longer than the shortest.
  /// @pre all outlive this object; nobody changes them during a search.
  PricedSearch(const Instance& instance, const RobotDistances& distances, const HomePasses& passes,
               const Traffic& traffic, std::uint32_t margin);

  /// @param now  the step at which the robot is at `at`.
  void find(std::uint32_t robot, Vertex at, std::uint32_t now);
  const Path& guide() const { return guide_; }
  /// What the last search has found.
  void copyWaysTo(PricedWays& ways) const { ways.take(values_, known_); }
  std::uint64_t expansions() const { return expansions_; }

 private:
  void reset();
  void push(Vertex v, std::uint32_t value, Vertex towards);
  void expand(Vertex v);
  std::uint32_t estimate(Vertex v) const;
  void trace();

  const Instance& instance_;
  const RobotDistances& distances_;
  const HomePasses& passes_;
  const Traffic& traffic_;
  const std::uint32_t margin_;
  const bool is_grid_;
  std::uint32_t robot_ = 0;
  Vertex at_ = kNoVertex;
  std::uint32_t now_ = 0;
  std::uint32_t shortest_ = 0;
  std::uint32_t base_ = 0;                    // estimate at the goal
  std::vector<std::uint16_t> values_;         // by vertex
  std::vector<Vertex> towards_;               // by vertex
  std::vector<Vertex> known_;                 // vertices with a value
  std::vector<std::vector<Vertex>> buckets_;  // by value and estimate
  std::size_t last_bucket_ = 0;
  Path guide_;
  std::uint64_t expansions_ = 0;
};

}  // namespace split_mapf
