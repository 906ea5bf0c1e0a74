#include "split/region_graph.h"

#include <algorithm>
#include <set>

namespace split_mapf {

RegionGraph::RegionGraph(const Partition& partition)
    : partition_(partition),
      first_odd_(regionCount(partition.ownerships[0])),
      overlaps_(first_odd_ + regionCount(partition.ownerships[1])) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (Vertex v = 0; v < partition.ownerships[0].size(); ++v) {
    pairs.emplace(nodeOf(0, partition.ownerships[0][v]), nodeOf(1, partition.ownerships[1][v]));
  }
  for (const auto& [even, odd] : pairs) {
    overlaps_[even].push_back(odd);
    overlaps_[odd].push_back(even);
  }
}

const std::uint32_t* RegionGraph::hopsTo(Vertex goal, std::uint32_t turn) const {
  const auto goals = std::make_pair(nodeOf(0, partition_.ownerships[0][goal]),
                                    nodeOf(1, partition_.ownerships[1][goal]));
  auto known = known_.find(goals);
  if (known == known_.end()) {
    known = known_.emplace(goals, search(goals.first, goals.second)).first;
  }
  return known->second.data() + nodeOf(turn, 0);
}

RegionGraph::Hops RegionGraph::search(std::uint32_t even_goal, std::uint32_t odd_goal) const {
  Hops hops(overlaps_.size(), kFar);
  std::vector<std::uint32_t> queue = {even_goal, odd_goal};
  hops[even_goal] = hops[odd_goal] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const std::uint32_t next : overlaps_[queue[head]]) {
      if (hops[next] != kFar) continue;
      hops[next] = hops[queue[head]] + 1;
      queue.push_back(next);
    }
  }
  return hops;
}

}  // namespace split_mapf
