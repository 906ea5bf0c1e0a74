#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// An instance cut into pieces: a tree whose leaves are instances, whose sequences run one after
/// another and whose parallels run side by side with robots of their own. A value; splitters build
/// it, the pipeline solves the leaves and stitches their plans along the same tree.
struct Decomposition {
  enum class Kind { kLeaf, kSequence, kParallel };

  Kind kind = Kind::kLeaf;
  /// Of a leaf: its instance, and which robot of the whole each of its robots is.
  std::shared_ptr<const Instance> instance;
  std::vector<std::uint32_t> robots;
  /// Of a leaf on a grid of its own: its vertices in the whole graph; null: they are the same.
  std::shared_ptr<const std::vector<Vertex>> map;
  /// Of a leaf: where it lies, for reports.
  std::uint32_t phase = 0;
  std::uint32_t region = 0;
  std::vector<Decomposition> children;

  static Decomposition leaf(Instance piece, std::vector<std::uint32_t> robots,
                            std::uint32_t phase = 0, std::uint32_t region = 0);
  /// @pre every child concerns the same robots, and each begins where the one before it ends.
  static Decomposition sequence(std::vector<Decomposition> children);
  /// @pre no robot is in two children.
  static Decomposition parallel(std::vector<Decomposition> children);
};

/// Makes a tree over a piece one over the whole: its leaves' robots are numbered within the piece
/// and get the numbers `robots` of the whole; `map`, `phase` and `region` are set everywhere.
Decomposition embed(Decomposition tree, const std::vector<std::uint32_t>& robots,
                    const std::shared_ptr<const std::vector<Vertex>>& map, std::uint32_t phase,
                    std::uint32_t region);

/// The leaves from left to right, as stitch() expects their plans.
std::vector<const Decomposition*> leavesOf(const Decomposition& tree);

/// Joins one plan a leaf, in the order of leavesOf(), to a plan of the whole: the children of a
/// sequence follow each other, each beginning when the slowest robot of the one before has
/// arrived. Paths end at their arrival. @pre every robot is in some leaf.
/// Cost: O(robots * makespan).
Plan stitch(const Decomposition& tree, const std::vector<Plan>& leaf_plans, std::uint32_t robots);

}  // namespace split_mapf
