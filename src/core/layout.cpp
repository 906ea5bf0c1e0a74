#include "split_mapf/core/layout.h"

#include <algorithm>

namespace split_mapf {

std::vector<Vertex> bufferVertices(const Layout& layout) {
  std::vector<Vertex> buffer;
  if (layout.ownerships.size() < 2) return buffer;
  const Ownership& odd = layout.ownerships[0];
  const Ownership& even = layout.ownerships[1];
  for (Vertex v = 0; v < odd.size(); ++v) {
    if (odd[v] != even[v]) buffer.push_back(v);
  }
  return buffer;
}

std::uint32_t regionCount(const Ownership& ownership) {
  std::uint32_t count = 0;
  for (const std::uint32_t region : ownership) {
    if (region != kNoRegion) count = std::max(count, region + 1);
  }
  return count;
}

}  // namespace split_mapf
