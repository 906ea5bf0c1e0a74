#include "roadmap/chain_insertion.h"

#include <algorithm>

namespace split_mapf::roadmap {
namespace {

// What a chain has to gain, in shares of the ground that a vertex stands for.
constexpr double kLeastGain = 0.05;
// A place for a robot that goes has to be made up for by ground that is reached.
constexpr double kPriceOfVertex = 0.15;

}  // namespace

ChainInsertion::ChainInsertion(const ClearSpace& space, Draft& draft, MainPiece& main,
                               Coverage& coverage, const GraphScale& scale)
    : space_(space),
      draft_(draft),
      main_(main),
      coverage_(coverage),
      scale_(scale),
      separation_(scale.separation),
      finder_(draft, separation_, scale.longest_edge),
      ground_(std::min(static_cast<double>(scale.spacing) * scale.spacing,
                       static_cast<double>(coverage.covered()) / std::max(1U, main.size()))) {}

/// Whether the vertices of a chain and its edges keep apart from each other.
bool ChainInsertion::keepsApart(const std::vector<Cell>& row) const {
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (std::size_t j = i + 1; j < row.size(); ++j) {
      if (!separation_.standApart(row[i], row[j])) return false;
    }
    for (std::size_t j = 0; j + 1 < row.size(); ++j) {
      if (i != j && i != j + 1 && !separation_.passes(row[i], row[j], row[j + 1])) return false;
    }
    if (i + 1 == row.size()) break;
    if (i + 2 < row.size() && !separation_.turnsApart(row[i], row[i + 1], row[i + 2])) return false;
    for (std::size_t j = i + 2; j + 1 < row.size(); ++j) {
      if (!separation_.edgesApart(row[i], row[i + 1], row[j], row[j + 1])) return false;
    }
  }
  return true;
}

void ChainInsertion::removeEdge(std::uint32_t a, std::uint32_t b) {
  if (!draft_.adjacent(a, b)) return;  // found twice
  draft_.removeEdge(a, b);
  for (const std::uint32_t v : {a, b}) {
    if (draft_.node(v).main) ends_.push_back(v);
  }
}

void ChainInsertion::removeVertex(std::uint32_t v) {
  if (!draft_.node(v).alive) return;  // found twice
  while (draft_.node(v).degree > 0) removeEdge(v, draft_.node(v).next[0]);
  if (draft_.node(v).main) main_.leave(v);
  draft_.removeVertex(v);
}

/// Removes what is in the chain's way. False when that is one of the vertices that it ends at.
bool ChainInsertion::clearTheWay(const Chain& chain, const std::vector<Cell>& row) {
  found_.clear();
  for (const Cell cell : chain.cells) finder_.addOfVertex(cell, found_);
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    const std::uint32_t tail = i == 0 ? chain.inner : kNoVertex;
    const std::uint32_t head = i + 2 == row.size() ? chain.outer : kNoVertex;
    // Where a chain ends at a vertex its own second edge is judged against it by keepsApart().
    finder_.addOfEdge(row[i], row[i + 1], tail, head, found_);
  }
  for (const std::uint32_t v : found_.vertices) {
    if (v == chain.inner || v == chain.outer) return false;
    removeVertex(v);
  }
  for (const Draft::Edge& edge : found_.edges) removeEdge(edge.a, edge.b);
  return true;
}

/// Adds the chain's vertices and edges. False when a vertex that it ends at has no room.
bool ChainInsertion::lay(const Chain& chain) {
  for (const std::uint32_t v : {chain.inner, chain.outer}) {
    if (v != kNoVertex && draft_.node(v).degree >= Draft::kMostEdges) return false;
  }
  row_.clear();
  if (chain.inner != kNoVertex) row_.push_back(chain.inner);
  for (const Cell cell : chain.cells) row_.push_back(draft_.addVertex(cell));
  row_.push_back(chain.outer);
  for (std::size_t i = 0; i + 1 < row_.size(); ++i) draft_.addEdge(row_[i], row_[i + 1]);
  return true;
}

/// Ties what lost an edge to the chain, where nothing is in the way.
void ChainInsertion::mend() {
  std::sort(ends_.begin(), ends_.end());
  ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
  const double longest = scale_.longest_edge * scale_.longest_edge;
  for (const std::uint32_t end : ends_) {
    if (!draft_.node(end).alive) continue;
    for (const std::uint32_t v : row_) {
      const Cell a = draft_.at(end);
      const Cell b = draft_.at(v);
      const double dx = a.x - b.x;
      const double dy = a.y - b.y;
      if (end == v || dx * dx + dy * dy > longest || !main_.inOneArea(a, b) ||
          !space_.isClearWay(a, b)) {
        continue;
      }
      link(end, v);
    }
  }
}

bool ChainInsertion::insert(const Chain& chain) {
  std::vector<Cell> row;
  if (chain.inner != kNoVertex) row.push_back(draft_.at(chain.inner));
  row.insert(row.end(), chain.cells.begin(), chain.cells.end());
  row.push_back(draft_.at(chain.outer));
  if (!keepsApart(row)) return false;
  const Mark before = mark();
  ends_.assign(1, chain.outer);
  if (!clearTheWay(chain, row) || !lay(chain)) {
    undoTo(before);
    return false;
  }
  mend();
  main_.dropSevered(ends_);
  if (!draft_.node(chain.outer).main) {  // the chain hangs on a part that it cut off
    undoTo(before);
    return false;
  }
  main_.joinAround(chain.outer);
  severed_.clear();
  for (const std::uint32_t v : ends_) {
    if (draft_.node(v).alive && !draft_.node(v).main) severed_.push_back(v);
  }
  return true;
}

bool ChainInsertion::link(std::uint32_t a, std::uint32_t b) {
  if (draft_.node(a).degree >= Draft::kMostEdges || draft_.node(b).degree >= Draft::kMostEdges ||
      draft_.adjacent(a, b) || !separation_.standApart(draft_.at(a), draft_.at(b))) {
    return false;
  }
  found_.clear();
  finder_.addOfEdge(draft_.at(a), draft_.at(b), a, b, found_);
  if (!found_.vertices.empty() || !found_.edges.empty()) return false;
  draft_.addEdge(a, b);
  return true;
}

ChainInsertion::Mark ChainInsertion::mark() const {
  return {draft_.mark(), main_.mark(), coverage_.covered(), main_.size()};
}

void ChainInsertion::undoTo(const Mark& mark) {
  main_.undoTo(mark.main);
  draft_.undoTo(mark.draft);
}

void ChainInsertion::commit() {
  main_.commit();
  draft_.commit();
}

double ChainInsertion::gainSince(const Mark& mark) const {
  const double gained =
      static_cast<double>(coverage_.covered()) - static_cast<double>(mark.covered);
  const double lost = std::max(0.0, static_cast<double>(mark.size) - main_.size());
  return gained - kPriceOfVertex * lost * ground_;
}

bool ChainInsertion::isWorthIt(const Mark& mark) const {
  return gainSince(mark) > kLeastGain * ground_;
}

}  // namespace split_mapf::roadmap
