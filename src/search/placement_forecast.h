#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace split_mapf {

/// Foresees what a placement will have expanded once nobody waits, from what it took of late to
/// shorten its queue. Depends on what happened only, not on threads or the clock.
class PlacementForecast {
 public:
  /// While a map fills up each robot takes more than the one before, so what is left counts twice.
  /// Says nothing once a quarter of the robots wait: then those that wait are the displaced ones,
  /// and their number goes up and down.
  static PlacementForecast ofCrowd(std::size_t robots) { return {robots / 4, robots / 20, 2}; }
  /// Of the displaced ones, until few are left.
  static PlacementForecast ofJam(std::size_t robots) { return {robots / 20, robots / 10, 1}; }

  /// @param tried  robots searched for since the last call. @param waiting, expansions  by now.
  /// @return whether more than `limit` expansions are foreseen.
  bool exceeds(std::uint64_t limit, std::size_t tried, std::size_t waiting,
               std::uint64_t expansions) {
    tried_ += tried;
    if (tried_ < window_) return false;
    const std::size_t gained = waiting_ > waiting ? waiting_ - waiting : 0;
    const double taken = static_cast<double>(expansions - expansions_);
    const bool is_first = waiting_ == 0;
    tried_ = 0;
    waiting_ = waiting;
    expansions_ = expansions;
    if (is_first || waiting <= few_) return false;
    const double each = taken / std::max(0.5, static_cast<double>(gained));
    return static_cast<double>(expansions) + growth_ * each * static_cast<double>(waiting) >
           static_cast<double>(limit);
  }

 private:
  PlacementForecast(std::size_t few, std::size_t window, double growth)
      : few_(few), window_(std::max<std::size_t>(1, window)), growth_(growth) {}

  std::size_t few_;               // waiting robots for which nothing is foreseen
  std::size_t window_;            // tries between two looks
  double growth_;                 // of what a robot takes, to the end
  std::size_t tried_ = 0;         // since the last look
  std::size_t waiting_ = 0;       // at that look; 0: there was none
  std::uint64_t expansions_ = 0;  // likewise
};

}  // namespace split_mapf
