#include <algorithm>
#include <string>

#include "split_mapf/solvability/solvability.h"

#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

// Robots that a sentence names one by one.
constexpr std::size_t kMostNamed = 10;

std::string numberOf(std::uint32_t robot) { return std::to_string(robot); }

/// Writes one verdict. "Cell" stands for a vertex throughout.
class Explanation {
 public:
  Explanation(const SolvabilityVerdict& verdict, const VerdictNames& names)
      : verdict_(verdict), names_(names) {}

  std::string text() const {
    switch (verdict_.refusal) {
      case RefusalKind::kNone:
        break;
      case RefusalKind::kDifferentComponents:
        return cutOff();
      case RefusalKind::kCycleOrder:
        return cycleOrder();
      case RefusalKind::kPathOrder:
        return pathOrder();
      case RefusalKind::kNoBlankBridge:
        return bridge();
      case RefusalKind::kParity:
        return parity();
      case RefusalKind::kClassMismatch:
        return passage();
    }
    return verdict_.answer == Solvability::kSolvable ? "solvable"
                                                     : "not decided before the deadline";
  }

 private:
  std::string robot(std::size_t i) const { return names_.robot(verdict_.robots[i]); }
  std::string cell(std::size_t i) const { return names_.cell(verdict_.vertices[i]); }
  /// "its connected part of the map has 9 cells, 1 of them empty, and 3 empty cells are needed"
  std::string blanks() const {
    std::string text = "this connected part of the map has " + counted(verdict_.cells, "cell") +
                       ", of which " + std::to_string(verdict_.blanks) +
                       (verdict_.blanks == 1 ? " is empty" : " are empty");
    if (!verdict_.blanks_needed) return text + ", and no number of empty cells would help";
    return text + "; " + std::to_string(*verdict_.blanks_needed) + " empty " +
           (*verdict_.blanks_needed == 1 ? "cell is" : "cells are") + " needed for that";
  }

  std::string cutOff() const {
    std::string text = "robot " + robot(0) + " cannot get from its start " + cell(0) +
                       " to its goal " + cell(1) + ": no way of free cells joins them";
    const std::size_t others = verdict_.robots.size() - 1;
    if (others > 0) text += " (" + counted(others, "other robot") + " cut off likewise)";
    return text;
  }

  std::string cycleOrder() const {
    return "robots " + robot(0) + ", " + robot(1) + " and " + robot(2) +
           " start in this order round the ring of " + counted(verdict_.vertices.size(), "cell") +
           " through " + cell(0) + ", their goals have the opposite order, and robots cannot " +
           "overtake on a ring: " + blanks();
  }

  std::string pathOrder() const {
    return "robots " + robot(0) + " and " + robot(1) + " would have to pass each other between " +
           cell(0) + " and " + cell(verdict_.vertices.size() - 1) +
           ", where the map is a single corridor without any place to pass: " + blanks();
  }

  std::string bridge() const {
    std::string text = "robot " + robot(0);
    if (verdict_.robots.size() > 1) text += " and, the other way, robot " + robot(1);
    return text + " must cross the bridge from " + cell(0) + " to " + cell(1) +
           ", the only way between its two sides: " + blanks();
  }

  std::string parity() const {
    std::string list;
    const std::size_t named = std::min(verdict_.robots.size(), kMostNamed);
    for (std::size_t i = 0; i < named; ++i) list += (i > 0 ? ", " : "") + robot(i);
    const std::size_t others = verdict_.robots.size() - named;
    if (others > 0) list += " and " + counted(others, "more robot");
    return "robots " + list +
           " would have to be exchanged by an odd permutation on the full loop of " +
           counted(verdict_.vertices.size(), "cell") + " through " + cell(0) +
           ", all of whose cycles are odd and allow even permutations only: " + blanks();
  }

  std::string passage() const {
    const std::size_t last = verdict_.vertices.size() - 1;
    return "robots " + robot(0) + " and " + robot(1) +
           " would have to pass each other by the passage from " + cell(0) + " to " + cell(last) +
           " (" + counted(last, "step") + "): " + blanks();
  }

  const SolvabilityVerdict& verdict_;
  const VerdictNames& names_;
};

}  // namespace

std::string explain(const SolvabilityVerdict& verdict, const Grid& grid) {
  return explain(verdict, {numberOf, [&grid](Vertex v) { return toString(grid.cellOf(v)); }});
}

std::string explain(const SolvabilityVerdict& verdict) {
  return explain(verdict, {numberOf, [](Vertex v) { return "vertex " + std::to_string(v); }});
}

std::string explain(const SolvabilityVerdict& verdict, const VerdictNames& names) {
  return Explanation(verdict, names).text();
}

}  // namespace split_mapf
