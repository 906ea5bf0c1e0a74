#pragma once

#include "split/balanced_regions.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/core/layout.h"

namespace split_mapf {

/// Moves the border of each two neighbouring regions to the narrowest place nearby: a minimum cut
/// within a band of up to a quarter of each region, by maximum flow. Units stay whole. Of the two
/// cuts that maximum flow gives, the one that balances the regions better is taken.
/// Cost: O(cut * band) a border.
void narrowBorders(const Graph& graph, const Units& units, Ownership& ownership);

}  // namespace split_mapf
