#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "solver/ilp/moves.h"

namespace split_mapf::ilp {

constexpr std::uint32_t kEverybody = std::numeric_limits<std::uint32_t>::max();

/// "Of these moves at most `upper` are made", over everybody or over the named robots. A move that
/// stands twice counts twice.
struct ConflictRow {
  struct Term {
    MoveId move = 0;
    std::uint32_t robot = kEverybody;
  };
  std::vector<Term> terms;
  double upper = 1;
};

/// A path that the linear program uses, to a degree.
struct UsedPath {
  std::uint32_t robot = 0;
  double value = 0;                            ///< in (0, 1]
  const Path* path = nullptr;                  ///< up to the arrival
  const std::vector<MoveId>* moves = nullptr;  ///< one a step up to the horizon
};

}  // namespace split_mapf::ilp
