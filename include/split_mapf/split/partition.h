#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/layout.h"

namespace split_mapf {

/// A block of a buffer zone [cells].
struct BufferSize {
  std::uint32_t across = 4;  ///< across the border, both sides of it together
  std::uint32_t along = 2;   ///< along the border
};

/// Two interleaved partitions of a graph into connected regions. Phases take them in turn; the
/// cells that differ are the buffer zones, through which robots get from one region to another.
struct Partition {
  std::string kind;  ///< "rectangles" or "dynamic"
  std::array<Ownership, 2> ownerships;
};

/// The paper's scheme: rows x columns rectangles as equal as possible; along each border a strip of
/// alternating blocks whose owner is one neighbour in even and the other in odd phases. What
/// obstacles cut off from its rectangle goes to the neighbour that it touches most, so every region
/// is connected.
/// Source: Guo, Han and Yu 2021, section IV. Deviation: no cell is left over where the sides do not
/// divide evenly. @throws SplitSpecError when there are more rows or columns than the grid has.
/// Cost: O(V + E).
Partition partitionRectangles(const Grid& grid, std::uint32_t rows, std::uint32_t columns,
                              BufferSize buffer);

/// The same for any map: about `regions` balanced regions that grow from centres far apart, prefer
/// narrow places as borders and never end inside a corridor. Along each border blocks change their
/// owner in turn; they are deeper the more robots' shortest paths cross the border.
/// Source: our own; the paper leaves it as future work. Cost: O(regions * V log V).
Partition partitionDynamic(const Instance& instance, std::uint32_t regions, BufferSize buffer);

/// Whether rectangles suit the grid: nearly open, with rectangles of more than a few blocks' width.
bool suitsRectangles(const Grid& grid, std::uint32_t rows, std::uint32_t columns,
                     BufferSize buffer);

}  // namespace split_mapf
