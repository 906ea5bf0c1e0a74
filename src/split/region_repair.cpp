#include "split/region_repair.h"

#include <algorithm>
#include <map>

namespace split_mapf {
namespace {

constexpr std::uint32_t kUnseen = 0xffffffffU;

/// The region, other than its own, that a part has the most edges to; kNoRegion if there is none.
std::vector<std::uint32_t> closestNeighbours(const Graph& graph, const Ownership& ownership,
                                             const Parts& parts, const std::vector<bool>& is_main) {
  std::vector<std::map<std::uint32_t, std::uint32_t>> edges(parts.size.size());
  for (Vertex v = 0; v < graph.size(); ++v) {
    if (is_main[parts.part_of[v]]) continue;
    for (const Vertex u : graph.neighbours(v)) {
      if (is_main[parts.part_of[u]]) ++edges[parts.part_of[v]][ownership[u]];
    }
  }
  std::vector<std::uint32_t> closest(parts.size.size(), kNoRegion);
  for (std::size_t part = 0; part < edges.size(); ++part) {
    std::uint32_t most = 0;
    for (const auto& [region, count] : edges[part]) {
      if (count <= most) continue;
      most = count;
      closest[part] = region;
    }
  }
  return closest;
}

/// Of each region its greatest part.
std::vector<bool> mainParts(const Parts& parts, std::uint32_t regions) {
  std::vector<std::uint32_t> greatest(regions, kUnseen);
  for (std::uint32_t part = 0; part < parts.size.size(); ++part) {
    if (parts.region[part] == kNoRegion) continue;
    std::uint32_t& main = greatest[parts.region[part]];
    if (main == kUnseen || parts.size[part] > parts.size[main]) main = part;
  }
  std::vector<bool> is_main(parts.size.size(), false);
  for (const std::uint32_t part : greatest) {
    if (part != kUnseen) is_main[part] = true;
  }
  return is_main;
}

}  // namespace

Parts partsOf(const Graph& graph, const Ownership& ownership) {
  Parts parts;
  parts.part_of.assign(graph.size(), kUnseen);
  std::vector<Vertex> queue;
  for (Vertex seed = 0; seed < graph.size(); ++seed) {
    if (parts.part_of[seed] != kUnseen) continue;
    const auto number = static_cast<std::uint32_t>(parts.size.size());
    queue.assign(1, seed);
    parts.part_of[seed] = number;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      for (const Vertex u : graph.neighbours(queue[head])) {
        if (parts.part_of[u] != kUnseen || ownership[u] != ownership[seed]) continue;
        parts.part_of[u] = number;
        queue.push_back(u);
      }
    }
    parts.size.push_back(static_cast<std::uint32_t>(queue.size()));
    parts.region.push_back(ownership[seed]);
  }
  return parts;
}

void connectRegions(const Graph& graph, Ownership& ownership) {
  for (;;) {
    const Parts parts = partsOf(graph, ownership);
    const std::uint32_t regions = regionCount(ownership);
    const std::vector<bool> is_main = mainParts(parts, regions);
    if (std::all_of(is_main.begin(), is_main.end(), [](bool main) { return main; })) return;
    std::vector<std::uint32_t> target = closestNeighbours(graph, ownership, parts, is_main);
    const bool stuck = std::all_of(target.begin(), target.end(),
                                   [](std::uint32_t region) { return region == kNoRegion; });
    std::uint32_t next_region = regions;
    for (std::size_t part = 0; stuck && part < target.size(); ++part) {
      if (!is_main[part]) target[part] = next_region++;
    }
    for (Vertex v = 0; v < graph.size(); ++v) {
      if (target[parts.part_of[v]] != kNoRegion) ownership[v] = target[parts.part_of[v]];
    }
  }
}

}  // namespace split_mapf
