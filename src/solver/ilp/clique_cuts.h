#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "solver/ilp/conflict_row.h"
#include "solver/ilp/moves.h"

namespace split_mapf::ilp {

/// Finds clique cuts: moves of single robots in one step of which each two exclude each other, as
/// they share a vertex, exchange two, or are the same robot's. At most one of them is made. This
/// holds what vertex and edge rows say of a few robots, and more: a robot's wait and its way out
/// against another's way through, for instance.
class CliqueCuts {
 public:
  /// @pre `space` outlives this object.
  explicit CliqueCuts(const MoveSpace& space) : space_(space) {}

  /// Appends at most `most` violated cuts, the most violated first.
  void find(const std::vector<UsedPath>& used, std::size_t most, std::vector<ConflictRow>& rows);

 private:
  struct Node {
    std::uint32_t robot = 0;
    MoveId move = 0;
    double value = 0;
  };
  struct Clique {
    std::vector<ConflictRow::Term> terms;
    double value = 0;
  };

  void collect(const std::vector<UsedPath>& used);
  void searchStep(const std::vector<Node>& nodes);
  void grow(const std::vector<Node>& nodes, const std::vector<std::uint32_t>& candidates,
            std::vector<std::uint32_t>& chosen, double value, std::vector<std::uint32_t>& best,
            double& best_value);
  bool exclude(const Node& a, const Node& b) const;
  bool collide(MoveId a, MoveId b) const;
  void lift(Clique& clique) const;

  const MoveSpace& space_;
  std::vector<std::vector<Node>> steps_;
  std::vector<Clique> cliques_;
  std::uint32_t tries_ = 0;
};

}  // namespace split_mapf::ilp
