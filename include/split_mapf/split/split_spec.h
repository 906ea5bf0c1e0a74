#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace split_mapf {

/// How to cut an instance, in the paper's notation: none | auto | [space][time], with
/// space = Ns | RxCs and time = Kt | t(r1,...,rK); or a registered splitter by its name.
struct SplitSpec {
  enum class Kind { kNone, kSplit, kNamed };
  /// Rows and columns of regions.
  struct Space {
    std::uint32_t rows = 1;
    std::uint32_t columns = 1;
  };

  Kind kind = Kind::kNone;
  std::optional<Space> space;
  /// Shares of the time, each > 0, summing to 1; empty: no time split.
  std::vector<double> time_ratios;
};

/// Parses a specification. @throws SplitSpecError that quotes the offending part and shows the
/// grammar.
SplitSpec parseSplitSpec(const std::string& text);

}  // namespace split_mapf
