#include "roadmap/passages.h"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

namespace split_mapf::roadmap {
namespace {

constexpr int kMostPasses = 4;
constexpr std::size_t kMostTargets = 3;
constexpr std::size_t kMostRepairs = 4;
constexpr double kLeastBlob = 0.3;        // squares of the lattice
constexpr std::size_t kMostSquares = 60;  // that a search for a way may look at

}  // namespace

Passages::Passages(const ClearSpace& space, const Pieces& areas, const CellGraph& lattice,
                   const GraphScale& scale, const Deadline& deadline)
    : space_(space),
      scale_(scale),
      draft_(lattice, space.raster().width, space.raster().height, scale.spacing),
      coverage_(space, scale.spacing),
      main_(draft_, coverage_, areas, space.raster().width, deadline),
      search_(space, draft_, main_, scale),
      insertion_(space, draft_, main_, coverage_, scale),
      ways_(space),
      unreached_(space, coverage_),
      wave_(space, coverage_, draft_, scale.spacing),
      lattice_size_(draft_.size()),
      most_cells_(kMostSquares * scale.spacing * scale.spacing) {}

/// In a piece of the free space where the lattice has no vertex at all.
bool Passages::startPiece(Cell at) {
  Obstruction found;
  ObstructionFinder(draft_, Separation(scale_.separation), scale_.longest_edge)
      .addOfVertex(at, found);
  if (!found.vertices.empty() || !found.edges.empty()) return false;
  main_.joinAround(draft_.addVertex(at));
  main_.commit();
  draft_.commit();
  return true;
}

/// Ties parts that a chain severed to the main piece again, where that is a gain.
void Passages::repair(std::vector<std::uint32_t> severed) {
  if (severed.size() > kMostRepairs) severed.resize(kMostRepairs);
  for (const std::uint32_t v : severed) {
    if (!draft_.node(v).alive || draft_.node(v).main) continue;  // came along with another
    const auto way = ways_.toMain(draft_.at(v), draft_, most_cells_);
    if (!way) continue;
    for (const Chain& chain : search_.along(*way, false)) {
      const ChainInsertion::Mark before = insertion_.mark();
      if (!insertion_.insert(chain)) continue;
      if (insertion_.isWorthIt(before)) break;
      insertion_.undoTo(before);
    }
  }
}

bool Passages::layWithRepair(const Chain& chain) {
  const ChainInsertion::Mark before = insertion_.mark();
  if (!insertion_.insert(chain)) return false;
  repair(insertion_.severed());
  const bool stays = insertion_.isWorthIt(before);
  if (stays) {
    main_.visitJoined(before.main, [this](Cell vertex) { wave_.startAround(vertex); });
  } else {
    insertion_.undoTo(before);
  }
  insertion_.commit();
  return stays;
}

bool Passages::layTowards(Cell target) {
  const auto way = ways_.toMain(target, draft_, most_cells_);
  if (!way) return false;
  for (const bool broad : {false, true}) {
    for (const Chain& chain : search_.along(*way, broad)) {
      if (layWithRepair(chain)) return true;
    }
  }
  return false;
}

/// @return whether more is reached now
bool Passages::layInto(const Blob& blob) {
  const std::vector<Cell> targets =
      unreached_.targets(blob, draft_, 2 * scale_.spacing, kMostTargets);
  if (!unreached_.isBordering(blob)) return startPiece(targets.front());
  return std::any_of(targets.begin(), targets.end(),
                     [this](Cell target) { return layTowards(target); });
}

/// Leads chains to the pieces of the lattice that passages part from the main one, as it grows. A
/// vertex near one that could not be joined is left out. @return false when the deadline struck
bool Passages::joinPieces(const Deadline& deadline) {
  wave_.startEverywhere(deadline);
  std::vector<Cell> failed;
  const auto gap = static_cast<std::int32_t>(2 * scale_.spacing);
  while (const auto target = wave_.nextVertex()) {
    if (deadline.expired()) return false;
    const bool known = std::any_of(failed.begin(), failed.end(), [&](Cell other) {
      return std::abs(other.x - target->x) < gap && std::abs(other.y - target->y) < gap;
    });
    if (!known && !layTowards(*target)) failed.push_back(*target);
  }
  return true;
}

/// Leads chains into what is left. @return false when the deadline struck
bool Passages::fillBlobs(const Deadline& deadline) {
  const double square = static_cast<double>(scale_.spacing) * scale_.spacing;
  const auto least = static_cast<std::size_t>(std::max(1.0, kLeastBlob * square));
  for (int pass = 0; pass < kMostPasses; ++pass) {
    bool gained = false;
    for (const Blob& blob : unreached_.blobs(least, scale_.spacing, deadline)) {
      while (unreached_.uncovered(blob) >= std::min(least, std::size_t{scale_.spacing})) {
        if (deadline.expired()) return false;
        if (!layInto(blob)) break;
        gained = true;
      }
    }
    if (!gained) break;
  }
  return true;
}

bool Passages::lay(const Deadline& deadline) {
  if (!joinPieces(deadline) || !fillBlobs(deadline)) return false;
  closeLoops();
  return !deadline.expired();
}

/// Joins chains to what they pass, where nothing is in the way: fewer dead ends.
void Passages::closeLoops() {
  std::vector<std::uint32_t> near;
  for (std::uint32_t v = lattice_size_; v < draft_.size(); ++v) {
    if (!draft_.node(v).alive || !draft_.node(v).main) continue;
    const Cell at = draft_.at(v);
    near.clear();
    draft_.visitBox(boxAround(at, at, scale_.longest_edge), [&](std::uint32_t u) {
      const Cell to = draft_.at(u);
      const double dx = to.x - at.x;
      const double dy = to.y - at.y;
      if (u == v || !draft_.node(u).main || main_.areaOf(to) != main_.areaOf(at) ||
          dx * dx + dy * dy > scale_.longest_edge * scale_.longest_edge ||
          !space_.isClearWay(at, to)) {
        return;
      }
      near.push_back(u);
    });
    std::sort(near.begin(), near.end());
    for (const std::uint32_t u : near) insertion_.link(v, u);
    insertion_.commit();
  }
}

CellGraph Passages::graph() const {
  CellGraph graph;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;  // cell, vertex of the draft
  for (std::uint32_t v = 0; v < draft_.size(); ++v) {
    const Draft::Node& node = draft_.node(v);
    if (!node.alive || (node.degree == 0 && !node.main)) continue;
    order.emplace_back(static_cast<std::uint32_t>(space_.raster().indexOf(node.at)), v);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> names(draft_.size(), kNoVertex);
  for (const auto& [cell, v] : order) {
    names[v] = static_cast<std::uint32_t>(graph.cells.size());
    graph.cells.push_back(cell);
  }
  for (const auto& [cell, v] : order) {
    const Draft::Node& node = draft_.node(v);
    for (std::uint32_t i = 0; i < node.degree; ++i) {
      if (names[v] < names[node.next[i]]) graph.edges.emplace_back(names[v], names[node.next[i]]);
    }
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  return graph;
}

}  // namespace split_mapf::roadmap
