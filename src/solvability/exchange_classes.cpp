#include "solvability/exchange_classes.h"

#include <utility>

namespace split_mapf {

ExchangeClasses::ExchangeClasses(const PartTree& tree, const BridgeStructure& structure,
                                 std::uint32_t blanks, const Deadline& deadline)
    : tree_(tree),
      blanks_(blanks),
      class_of_(tree.size(), 0),
      outlooks_(tree.size()),
      barriers_(1) {
  outlooks_[0].place = structure.kindOf(tree.vertices[0]);
  SparsePoll poll(deadline);
  for (std::uint32_t rank = 1; rank < tree.size(); ++rank) {
    poll();
    visit(rank, structure);
  }
}

void ExchangeClasses::visit(std::uint32_t rank, const BridgeStructure& structure) {
  const Vertex v = tree_.vertices[rank];
  const Vertex parent = tree_.vertices[tree_.parent[rank]];
  const Outlook& up = outlooks_[tree_.parent[rank]];
  Outlook& here = outlooks_[rank];
  const PlaceKind kind = structure.kindOf(v);
  if (kind == PlaceKind::kLoop && structure.loopOf(v) == structure.loopOf(parent)) {
    class_of_[rank] = up.inner_class;
    here = up;
    return;
  }
  const std::uint32_t distance = up.distance + 1;
  const std::uint32_t end = tree_.subtree_end[rank];
  const bool has_place = up.place != PlaceKind::kCorridor;
  const auto enter = [&](std::uint32_t first, std::uint32_t above,
                         std::optional<std::uint32_t> needed) {
    if (needed && *needed <= blanks_) return above;
    return addBarrier({above, 0, first, end, rank, distance, needed}, above);
  };
  std::optional<std::uint32_t> needed;
  if (has_place) {
    needed = kind == PlaceKind::kLoop ? blanksToJoin(up.place, kind, distance)
                                      : blanksToCover(up.place, distance);
  }
  class_of_[rank] = enter(rank, up.inner_class, needed);
  here = {up.place, distance, class_of_[rank]};
  if (kind == PlaceKind::kCorridor) return;
  here.place = kind;
  here.distance = 0;
  if (kind == PlaceKind::kLoop) return;
  // The junction itself belongs to what lies above: blanks from there cannot pass its robot.
  here.inner_class = enter(rank + 1, class_of_[rank], blanksToJoin(up.place, kind, distance));
}

std::uint32_t ExchangeClasses::addBarrier(Barrier barrier, std::uint32_t above) {
  barrier.depth = barriers_[above].depth + 1;
  barriers_.push_back(barrier);
  return static_cast<std::uint32_t>(barriers_.size()) - 1;
}

const ExchangeClasses::Barrier& ExchangeClasses::hardestBetween(std::uint32_t a,
                                                                std::uint32_t b) const {
  std::uint32_t low = class_of_[a];
  std::uint32_t other = class_of_[b];
  std::uint32_t hardest = 0;
  while (low != other) {
    if (barriers_[low].depth < barriers_[other].depth) std::swap(low, other);
    // The root's own entry needs nothing, which compares as least.
    if (barriers_[hardest].blanks_needed < barriers_[low].blanks_needed) hardest = low;
    low = barriers_[low].above;
  }
  return barriers_[hardest];
}

}  // namespace split_mapf
