#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "split_mapf/core/distance_table.h"

namespace split_mapf {

/// Distance tables that nobody reads at the moment, of any number of DistanceTables, within a
/// number of bytes: when there is no more room those that were read longest ago are given up. Those
/// that are being read are out of it and count only when they come back. Thread-safe. Cost: a
/// look-up under one lock.
class TablePool {
 public:
  explicit TablePool(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// A number for tables that belong to each other.
  std::uint64_t enlist();
  /// Null: it is not there.
  std::unique_ptr<const DistanceTable> take(std::uint64_t owner, std::uint32_t number);
  /// Of two tables of the same number the one of which more is known stays.
  void put(std::uint64_t owner, std::uint32_t number, std::unique_ptr<const DistanceTable> table);
  std::size_t bytes() const;

 private:
  struct Entry {
    std::uint64_t owner;
    std::uint32_t number;
    std::size_t bytes;
    std::unique_ptr<const DistanceTable> table;
  };
  using Entries = std::list<Entry>;
  struct Key {
    std::uint64_t owner;
    std::uint32_t number;
    bool operator==(const Key& other) const {
      return owner == other.owner && number == other.number;
    }
  };
  struct HashOfKey {
    std::size_t operator()(const Key& key) const {
      return static_cast<std::size_t>(key.owner * 0x9e3779b97f4a7c15ULL + key.number);
    }
  };

  const std::size_t most_bytes_;
  mutable std::mutex mutex_;
  Entries entries_;  // read last first
  std::unordered_map<Key, Entries::iterator, HashOfKey> places_;
  std::size_t bytes_ = 0;
  std::uint64_t owners_ = 0;
};

}  // namespace split_mapf
