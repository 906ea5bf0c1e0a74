#pragma once

#include <string>

#include "split_mapf/split/piece_tree.h"

namespace split_mapf {

/// A piece as bytes, for who solves it in another process or on another machine: its problem (see
/// io/problem_bytes.h), which robots and vertices of the whole it holds, and how much it may take.
/// Distance tables stay behind. @pre the piece has an instance.
std::string toBytes(const Piece& piece);

/// Reads what toBytes() wrote; distances are then found on demand, as of all pieces. Any solver
/// gives the same plan for it as for the piece that was written. @throws InputError naming the byte
/// and what was expected there; InstanceError where the problem is not well-posed.
Piece pieceFromBytes(const std::string& bytes);

}  // namespace split_mapf
