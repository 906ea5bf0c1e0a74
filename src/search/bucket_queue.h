#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "split_mapf/core/plan.h"

namespace split_mapf {

/// The states of a search in an array, and those that are open in buckets of small keys, last in
/// first out. A state has members `vertex`, `time`, `parent` (index of a state, kNoState for the
/// first) and `next`, which belongs to the queue. Keeps its memory between searches.
template <typename State>
class BucketQueue {
 public:
  static constexpr std::uint32_t kNoState = 0xffffffffU;

  /// Room for so many states; address space, not memory.
  void reserve(std::size_t states) { states_.reserve(states); }
  /// Room for keys below `keys`; push() makes more.
  void reserveKeys(std::size_t keys) {
    if (buckets_.size() < keys) buckets_.resize(keys, kNoState);
  }
  void clear() {
    const std::size_t used = std::min(last_ + 1, buckets_.size());
    std::fill(buckets_.begin(), buckets_.begin() + static_cast<std::ptrdiff_t>(used), kNoState);
    states_.clear();
    current_ = last_ = open_ = 0;
  }
  bool empty() const { return open_ == 0; }
  const State& operator[](std::uint32_t index) const { return states_[index]; }
  const std::vector<State>& states() const { return states_; }

  /// Keeps a state that is not open; returns its index.
  std::uint32_t add(const State& state) {
    states_.push_back(state);
    return static_cast<std::uint32_t>(states_.size() - 1);
  }
  void push(const State& state, std::size_t key) { open(add(state), key); }
  /// Opens a state that was added.
  void open(std::uint32_t index, std::size_t key) {
    if (key >= buckets_.size()) buckets_.resize(2 * key + 1, kNoState);
    states_[index].next = buckets_[key];
    buckets_[key] = index;
    current_ = std::min(current_, key);
    last_ = std::max(last_, key);
    ++open_;
  }
  /// @pre not empty.
  std::size_t leastKey() {
    while (buckets_[current_] == kNoState) ++current_;
    return current_;
  }
  /// A state of the least key. @pre not empty.
  std::uint32_t pop() {
    leastKey();
    const std::uint32_t index = buckets_[current_];
    buckets_[current_] = states_[index].next;
    --open_;
    return index;
  }
  /// The path that ends with a state; where no state stands for a step the robot waits.
  Path pathTo(std::uint32_t index) const {
    Path path(states_[index].time + std::size_t{1});
    auto end = path.end();
    for (;; index = states_[index].parent) {
      const State& state = states_[index];
      const auto begin =
          state.parent == kNoState ? path.begin() : path.begin() + std::ptrdiff_t{state.time};
      std::fill(begin, end, state.vertex);
      if (state.parent == kNoState) break;
      end = begin;
    }
    return path;
  }

 private:
  std::vector<State> states_;
  std::vector<std::uint32_t> buckets_;
  std::size_t current_ = 0;
  std::size_t last_ = 0;
  std::size_t open_ = 0;
};

}  // namespace split_mapf
