#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// The part of a huge map that robots are likely to need: the free cells within a few steps of
/// their shortest ways, as a grid of the same sides whose other cells are blocked. What is planned
/// on it is planned on the map, as its moves are moves of the map and cells keep their place; its
/// shortest ways are the map's. That there is no plan on it says nothing of the map.
class WayBand {
 public:
  /// Margins worth trying one after another [steps], before the whole map.
  static constexpr std::array<std::uint32_t, 2> kMargins = {32, 256};

  /// @param ways  of the robots, none of them empty. Cost: O(cells of the map) bits and the cells
  /// of the band. @throws Interrupted.
  WayBand(const Instance& instance, const std::vector<Path>& ways, std::uint32_t margin,
          const Deadline& deadline);

  /// The same robots on the band.
  const Instance& instance() const { return *instance_; }
  /// Whether it leaves out so little of the map that it saves nothing.
  bool isNearlyAll() const;
  /// A vertex of the band on the map.
  Vertex onMap(Vertex v) const;

 private:
  std::shared_ptr<const Grid> map_;
  std::shared_ptr<const Instance> instance_;
};

/// A shortest way for each robot. Empty when a robot has none.
/// Cost: findShortestWay() for each. @throws Interrupted.
std::vector<Path> findShortestWays(const Instance& instance, const Deadline& deadline);

}  // namespace split_mapf
