#include "split_mapf/split/decomposition.h"

#include <algorithm>
#include <iterator>

namespace split_mapf {
namespace {

void collectLeaves(const Decomposition& tree, std::vector<const Decomposition*>& leaves) {
  if (tree.kind == Decomposition::Kind::kLeaf) leaves.push_back(&tree);
  for (const Decomposition& child : tree.children) collectLeaves(child, leaves);
}

/// Folds the tree: appends to the paths of the robots below it what they do in it, starting at
/// step `begin`; returns the step at which the last of them has arrived.
class Stitcher {
 public:
  Stitcher(const std::vector<Plan>& leaf_plans, Plan& whole)
      : leaf_plans_(leaf_plans), whole_(whole) {}

  std::uint32_t append(const Decomposition& tree, std::uint32_t begin) {
    switch (tree.kind) {
      case Decomposition::Kind::kLeaf:
        return appendLeaf(tree, begin);
      case Decomposition::Kind::kSequence:
        for (const Decomposition& child : tree.children) begin = append(child, begin);
        return begin;
      case Decomposition::Kind::kParallel:
        break;
    }
    std::uint32_t end = begin;
    for (const Decomposition& child : tree.children) end = std::max(end, append(child, begin));
    return end;
  }

 private:
  std::uint32_t appendLeaf(const Decomposition& leaf, std::uint32_t begin) {
    const Plan& plan = leaf_plans_[next_leaf_++];
    for (std::uint32_t i = 0; i < leaf.robots.size(); ++i) {
      Path& path = whole_.paths[leaf.robots[i]];
      const Path& piece = plan.paths[i];
      const auto whole = [&leaf](Vertex v) { return leaf.map ? (*leaf.map)[v] : v; };
      if (path.empty()) path.push_back(whole(piece.front()));
      path.resize(begin + 1, path.back());
      std::transform(piece.begin() + 1, piece.end(), std::back_inserter(path), whole);
    }
    return begin + makespanOf(plan);
  }

  const std::vector<Plan>& leaf_plans_;
  Plan& whole_;
  std::size_t next_leaf_ = 0;
};

}  // namespace

Decomposition Decomposition::leaf(Instance piece, std::vector<std::uint32_t> robots,
                                  std::uint32_t phase, std::uint32_t region) {
  Decomposition tree;
  tree.instance = std::make_shared<const Instance>(std::move(piece));
  tree.robots = std::move(robots);
  tree.phase = phase;
  tree.region = region;
  return tree;
}

Decomposition Decomposition::sequence(std::vector<Decomposition> children) {
  Decomposition tree;
  tree.kind = Kind::kSequence;
  tree.children = std::move(children);
  return tree;
}

Decomposition Decomposition::parallel(std::vector<Decomposition> children) {
  Decomposition tree;
  tree.kind = Kind::kParallel;
  tree.children = std::move(children);
  return tree;
}

Decomposition embed(Decomposition tree, const std::vector<std::uint32_t>& robots,
                    const std::shared_ptr<const std::vector<Vertex>>& map, std::uint32_t phase,
                    std::uint32_t region) {
  if (tree.kind == Decomposition::Kind::kLeaf) {
    tree.map = map;
    tree.phase = phase;
    tree.region = region;
    for (std::uint32_t& robot : tree.robots) robot = robots[robot];
  }
  for (Decomposition& child : tree.children) {
    child = embed(std::move(child), robots, map, phase, region);
  }
  return tree;
}

std::vector<const Decomposition*> leavesOf(const Decomposition& tree) {
  std::vector<const Decomposition*> leaves;
  collectLeaves(tree, leaves);
  return leaves;
}

Plan stitch(const Decomposition& tree, const std::vector<Plan>& leaf_plans, std::uint32_t robots) {
  Plan whole;
  whole.paths.resize(robots);
  Stitcher(leaf_plans, whole).append(tree, 0);
  trimToArrival(whole);
  return whole;
}

}  // namespace split_mapf
