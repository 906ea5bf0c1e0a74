#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "search/packed_rows.h"
#include "split_mapf/core/graph.h"

namespace split_mapf {

/// Where each robot is, by robot.
using Configuration = std::vector<Vertex>;

/// A hash of a configuration that changes by a few operations when a robot moves: the exclusive or
/// of a pseudo-random number for each robot at its vertex (Zobrist 1970).
std::uint64_t placeHash(std::uint32_t robot, Vertex v);
std::uint64_t hashOf(const Configuration& configuration);

/// The configurations that a search has met, numbered from 0, found by hash and compared in full.
/// Memory: 2 or 4 bytes a robot and configuration. Not thread-safe.
class Explored {
 public:
  Explored(std::uint32_t robots, std::uint32_t vertices);

  std::optional<std::uint32_t> find(const Configuration& configuration, std::uint64_t hash) const;
  /// @pre it is not there. @return its number.
  std::uint32_t add(const Configuration& configuration, std::uint64_t hash);
  void read(std::uint32_t number, Configuration& configuration) const {
    rows_.read(number, configuration);
  }
  std::uint32_t size() const { return rows_.size(); }
  std::uint64_t hash(std::uint32_t number) const { return hashes_[number]; }
  std::size_t bytes() const {
    return rows_.bytes() + hashes_.capacity() * sizeof hashes_[0] +
           slots_.size() * sizeof slots_[0];
  }

 private:
  static constexpr std::uint32_t kFree = 0xffffffffU;

  void place(std::uint32_t number);
  void grow();

  PackedRows rows_;
  std::vector<std::uint64_t> hashes_;
  std::vector<std::uint32_t> slots_;  // open addressing; a power of two, at most half full
};

}  // namespace split_mapf
