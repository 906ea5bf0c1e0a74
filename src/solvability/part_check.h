#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solvability/bridge_structure.h"
#include "solvability/part_tree.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {

/// What the checks of all parts read, and the tables that they share so as to allocate them once.
struct CheckTables {
  const Graph& graph;
  const BridgeStructure& structure;
  const std::vector<Vertex>& starts;
  const std::vector<Vertex>& goals;
  const Deadline& deadline;
  std::vector<std::uint32_t> rank_of;    ///< vertex -> rank in the tree of its part
  std::vector<std::uint32_t> goal_rank;  ///< robot -> where the normalised goals have it
};

/// Decides one connected component. `robots` are those that start in it; their goals are in it too.
class PartCheck {
 public:
  PartCheck(std::uint32_t part, const std::vector<std::uint32_t>& robots, CheckTables& tables);

  /// Nothing when the part is solvable. Cost: linear in the part. @throws Interrupted.
  std::optional<SolvabilityVerdict> findRefusal();

 private:
  SolvabilityVerdict refuse(RefusalKind kind, std::optional<std::uint32_t> blanks_needed) const;
  std::vector<std::uint32_t> robotsByRank(const std::vector<Vertex>& places) const;
  std::optional<SolvabilityVerdict> compareClasses();
  SolvabilityVerdict refusePath(std::uint32_t rank) const;
  SolvabilityVerdict refuseBridge(std::uint32_t from, std::uint32_t to,
                                  std::uint32_t blanks_needed) const;
  std::optional<SolvabilityVerdict> compareFullLoops() const;
  std::optional<SolvabilityVerdict> compareRing(const std::vector<std::uint32_t>& ranks) const;
  std::optional<SolvabilityVerdict> compareParity(const std::vector<std::uint32_t>& ranks) const;
  bool shareLoop(std::uint32_t rank, std::uint32_t other) const;
  template <typename IsBeyond>
  void addOpposite(std::uint32_t from, std::uint32_t to, IsBeyond is_beyond,
                   SolvabilityVerdict& verdict) const;

  const GraphPart& part_;
  const std::vector<std::uint32_t>& robots_;
  CheckTables& tables_;
  std::uint32_t blanks_;
  PartTree tree_;
  std::vector<std::uint32_t> at_start_;  // rank -> robot; blanks gathered at the lowest ranks
  std::vector<std::uint32_t> at_goal_;
};

}  // namespace split_mapf
