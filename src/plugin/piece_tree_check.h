#pragma once

#include <string>

#include "split_mapf/core/instance.h"
#include "split_mapf/split/piece_tree.h"

namespace split_mapf {

/// What makes a tree useless for solving and stitching, as a sentence; empty: nothing does. Whether
/// the stitched plan is valid is for the validator. Cost: O(robots and vertices of all pieces).
std::string findTreeFault(const PieceTree& tree, const Instance& whole);

/// Whether a plan of one of them is one of the other. @pre neither has a fault.
bool isSamePiece(const Piece& one, const Piece& other);

}  // namespace split_mapf
