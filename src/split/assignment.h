#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/graph.h"

namespace split_mapf {

/// A vertex that a robot could take, and at what cost.
struct Candidate {
  Vertex vertex = kNoVertex;
  std::uint32_t cost = 0;
};

/// Gives robots vertices of their own at the least total cost, as many robots as possible first.
/// Ties go to the earlier candidate. @return one vertex a robot; kNoVertex for a robot that is left
/// without. Groups of robots that share no candidate are solved apart.
/// Cost: a group of r robots with c candidates in all takes O(r * c log c) at worst, far less where
/// there is room.
std::vector<Vertex> assignAtLeastCost(const std::vector<std::vector<Candidate>>& candidates);

}  // namespace split_mapf
