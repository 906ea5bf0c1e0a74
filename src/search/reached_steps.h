#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "search/reservation_table.h"
#include "split_mapf/core/graph.h"

namespace split_mapf {

/// One bit for each step of the vertices that a search meets. Keeps its memory between searches.
class ReachedSteps {
 public:
  static constexpr std::uint64_t kAllSteps = ~std::uint64_t{0};

  explicit ReachedSteps(std::uint32_t vertices) : met_(vertices) {}

  /// Forgets everything; from now on steps 0 .. last count.
  void reset(std::uint32_t last) {
    bits_.clear();
    words_ = last / 64 + 1;
    if (++search_ > 0) return;
    std::fill(met_.begin(), met_.end(), Met());
    search_ = 1;
  }
  bool operator()(Vertex v, std::uint32_t t) const {
    return met_[v].search == search_ && (bits_[met_[v].row + t / 64] >> (t % 64) & 1U) != 0;
  }
  /// The words of `v`; until the next call for a vertex not met yet.
  std::uint64_t* row(Vertex v) {
    Met& met = met_[v];
    if (met.search != search_) meet(met);
    return bits_.data() + met.row;
  }
  /// Marks steps from .. to-1, as far as they count.
  void mark(Vertex v, std::uint32_t from, std::uint32_t to) {
    std::uint64_t* const words = row(v);
    to = std::min(to, 64 * words_);
    for (std::uint32_t t = from; t < to; t = 64 * (t / 64 + 1)) {
      const std::uint32_t past = std::min(to - 64 * (t / 64), 64U);  // the word's first step after
      words[t / 64] |= (kAllSteps << (t % 64)) & (kAllSteps >> (64 - past));
    }
  }
  /// Marks the steps from `from` to the end of the gap, to `to` at the latest; returns the step at
  /// which somebody comes, kForever when nobody does until `to`. @pre nobody is there at `from`.
  std::uint32_t markGap(const ReservationTable& placed, Vertex v, std::uint32_t from,
                        std::uint32_t to) {
    std::uint64_t* const words = row(v);
    std::uint64_t steps = kAllSteps << (from % 64);
    for (std::uint32_t word = from / 64; word <= to / 64; ++word) {
      const std::uint64_t taken = placed.taken(v, word) & steps;
      if (taken != 0) {
        words[word] |= steps & ((taken & (0 - taken)) - 1);
        return 64 * word + lowestBit(taken);
      }
      words[word] |= steps;
      steps = kAllSteps;
    }
    return kForever;
  }

  /// Number of the lowest bit set. @pre bits != 0.
  static std::uint32_t lowestBit(std::uint64_t bits) {
    return static_cast<std::uint32_t>(__builtin_ctzll(bits));
  }

 private:
  struct Met {
    std::uint32_t search = 0;  // number of the search that met the vertex last
    std::uint32_t row = 0;     // where its words begin
  };
  void meet(Met& met) {
    met.search = search_;
    met.row = static_cast<std::uint32_t>(bits_.size());
    bits_.resize(bits_.size() + words_, 0);
  }

  std::vector<Met> met_;
  std::vector<std::uint64_t> bits_;
  std::uint32_t search_ = 0;
  std::uint32_t words_ = 0;  // of a row
};

/// Calls enter(step) for the steps first .. last of a vertex that `choose(word)` gives, one bit a
/// step, in order, until it returns false. @pre every call takes its step out of what is chosen.
/// Always inline: to hand over what the calls refer to costs more than most of the loops.
template <typename Choose, typename Enter>
[[gnu::always_inline]] inline void forEachStep(std::uint32_t first, std::uint32_t last,
                                               Choose choose, Enter enter) {
  std::uint64_t steps = ReachedSteps::kAllSteps << (first % 64);
  for (std::uint32_t word = first / 64; word <= last / 64; ++word) {
    if (word == last / 64) steps &= ReachedSteps::kAllSteps >> (63 - last % 64);
    for (std::uint64_t open = steps & choose(word); open != 0; open = steps & choose(word)) {
      if (!enter(64 * word + ReachedSteps::lowestBit(open))) return;
    }
    steps = ReachedSteps::kAllSteps;
  }
}

/// A robot is at `from` until somebody comes there at step `leave_by`, and may move to `to`.
struct GapMove {
  Vertex from;
  Vertex to;
  std::uint32_t leave_by;
  std::uint32_t soonest;  ///< arrival
  std::uint32_t last;     ///< arrival that is still in time, leave_by at most
};

/// Calls enter(step) with the first step of each gap of `to` that the move leads into at no one's
/// expense and that is not reached yet. @pre enter() marks the gap.
template <typename Enter>
[[gnu::always_inline]] inline void forEachNewGap(const ReservationTable& placed,
                                                 ReachedSteps& reached, const GapMove& move,
                                                 Enter enter) {
  const std::uint64_t* const words = reached.row(move.to);
  forEachStep(
      move.soonest, move.last,
      [&](std::uint32_t word) { return ~placed.taken(move.to, word) & ~words[word]; },
      [&](std::uint32_t first) {
        // Only at the last step somebody may come towards it.
        if (first == move.leave_by && placed.oncoming(move.from, move.to, first) != nullptr) {
          return false;
        }
        enter(first);
        return true;
      });
}

}  // namespace split_mapf
