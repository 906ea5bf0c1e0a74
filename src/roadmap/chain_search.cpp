#include "roadmap/chain_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace split_mapf::roadmap {
namespace {

// Prices, in vertices of the lattice.
constexpr double kPriceOfEdge = 0.25;
constexpr double kPriceOfLoneVertex = 0.05;
constexpr double kPriceOfPlace = 0.05;
constexpr double kPriceOfShortfall = 2;  // a spacing that a chain stays short of its aim
constexpr double kUnreached = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kNone = 0xffffffffU;

}  // namespace

ChainSearch::ChainSearch(const ClearSpace& space, const Draft& draft, const MainPiece& main,
                         const GraphScale& scale)
    : space_(space),
      draft_(draft),
      main_(main),
      scale_(scale),
      separation_(scale.separation),
      finder_(draft, separation_, scale.longest_edge) {}

double ChainSearch::priceOf(const Obstruction& found) const {
  double price = kPriceOfEdge * static_cast<double>(found.edges.size());
  for (const std::uint32_t v : found.vertices) {
    price += draft_.node(v).degree == 0 ? kPriceOfLoneVertex : 1;
  }
  return price;
}

void ChainSearch::addVerticesNear(Cell centre, bool main, std::uint32_t area) {
  const auto begin = static_cast<std::ptrdiff_t>(places_.size());
  draft_.visitBox(boxAround(centre, centre, 2.0 * scale_.spacing), [&](std::uint32_t v) {
    const Draft::Node& node = draft_.node(v);
    if (node.main != main || main_.areaOf(node.at) != area) return;
    places_.push_back({node.at, v, 0, 0});
  });
  // Bins list the newest first: an order that later changes do not disturb.
  std::sort(places_.begin() + begin, places_.end(),
            [](const Place& a, const Place& b) { return a.vertex < b.vertex; });
}

void ChainSearch::addPlace(Cell at, std::size_t steps) {
  found_.clear();
  finder_.addOfVertex(at, found_);
  const double shortfall = static_cast<double>(steps) / scale_.spacing;
  places_.push_back(
      {at, kNoVertex, kPriceOfPlace + priceOf(found_), kPriceOfShortfall * shortfall});
}

/// One place to each side, where it is clear.
void ChainSearch::addPlacesBeside(const std::vector<Cell>& way, std::size_t i) {
  const Cell back = way[i - std::min<std::size_t>(i, 4)];
  const Cell ahead = way[std::min(i + 4, way.size() - 1)];
  const double dx = ahead.x - back.x;
  const double dy = ahead.y - back.y;
  const double length = std::hypot(dx, dy);
  if (length == 0) return;
  const double aside = 1.5 * scale_.candidates / length;
  for (const double side : {-aside, aside}) {
    const Cell at{way[i].x + static_cast<std::int32_t>(std::lround(-dy * side)),
                  way[i].y + static_cast<std::int32_t>(std::lround(dx * side))};
    if (space_.isClear(at) && main_.inOneArea(at, way[i]) && space_.isClearWay(at, way[i])) {
      addPlace(at, i);
    }
  }
}

/// Where a way cuts the corner between a row and a column that it follows: the cell in which these
/// cross. In passages that leave no choice only that one has clear edges along both.
void ChainSearch::addCorner(const std::vector<Cell>& way, std::size_t i) {
  if (i == 0 || i + 1 >= way.size()) return;
  const Cell before = way[i - 1];
  const Cell at = way[i];
  const bool in_row = before.y == at.y;
  if ((!in_row && before.x != at.x) || way[i + 1].x == at.x || way[i + 1].y == at.y) return;
  std::size_t end = i + 1;
  while (end + 1 < way.size() && way[end + 1].x != way[end].x && way[end + 1].y != way[end].y)
    ++end;
  if (end + 1 >= way.size()) return;
  const bool then_in_row = way[end + 1].y == way[end].y;
  if (then_in_row == in_row) return;
  const Cell corner = in_row ? Cell{way[end].x, at.y} : Cell{at.x, way[end].y};
  if (space_.isClear(corner) && main_.inOneArea(corner, at)) addPlace(corner, i);
}

void ChainSearch::addPlaces(const std::vector<Cell>& way, bool broad) {
  const std::uint32_t area = main_.areaOf(way.front());
  places_.clear();
  addVerticesNear(way.front(), false, area);
  first_on_way_ = static_cast<std::uint32_t>(places_.size());
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i % scale_.candidates == 0) {
      addPlace(way[i], i);
      if (broad) addPlacesBeside(way, i);
    }
    addCorner(way, i);
  }
  first_outer_ = static_cast<std::uint32_t>(places_.size());
  addVerticesNear(way.back(), true, area);
}

/// Whether a vertex can have one edge more once what was found is gone.
bool ChainSearch::hasRoom(std::uint32_t vertex) const {
  if (vertex == kNoVertex || draft_.node(vertex).degree < Draft::kMostEdges) return true;
  return std::any_of(found_.edges.begin(), found_.edges.end(), [vertex](const Draft::Edge& edge) {
    return edge.a == vertex || edge.b == vertex;
  });
}

void ChainSearch::offerLink(std::uint32_t from, std::uint32_t to) {
  const Place& a = places_[from];
  const Place& b = places_[to];
  const double dx = a.at.x - b.at.x;
  const double dy = a.at.y - b.at.y;
  const double square = dx * dx + dy * dy;
  if (square < scale_.shortest_edge * scale_.shortest_edge ||
      square > scale_.longest_edge * scale_.longest_edge || !space_.isClearWay(a.at, b.at)) {
    return;
  }
  found_.clear();
  finder_.addOfEdge(a.at, b.at, a.vertex, b.vertex, found_);
  if (!hasRoom(a.vertex) || !hasRoom(b.vertex)) return;
  arriving_[to].push_back(static_cast<std::uint32_t>(links_.size()));
  links_.push_back({from, to, priceOf(found_) + b.price, kUnreached, kNone});
}

void ChainSearch::relax(std::uint32_t link, bool joins) {
  Link& mine = links_[link];
  const Place& from = places_[mine.from];
  const bool known = from.vertex != kNoVertex;
  mine.before = kNone;
  mine.total = kUnreached;
  if (known) {  // a chain begins at a vertex, it does not pass through one
    if (joins) mine.total = mine.price;
    return;
  }
  if (!joins) mine.total = mine.price + from.start_price + from.price;
  for (const std::uint32_t before : arriving_[mine.from]) {
    const Link& other = links_[before];
    if (other.total + mine.price >= mine.total ||
        !separation_.turnsApart(places_[other.from].at, from.at, places_[mine.to].at)) {
      continue;
    }
    mine.total = other.total + mine.price;
    mine.before = before;
  }
}

void ChainSearch::addLinks(bool broad) {
  links_.clear();
  arriving_.assign(places_.size(), {});
  // Where both ends come along the way, none can be nearer than the steps between them allow.
  const auto most_ahead =
      static_cast<std::uint32_t>((broad ? 9 : 3) * scale_.longest_edge / scale_.candidates);
  for (std::uint32_t from = 0; from < first_outer_; ++from) {
    const bool inner = from < first_on_way_;
    const std::uint32_t begin = inner ? first_on_way_ : from + 1;
    const std::uint32_t end = inner ? first_outer_ : std::min(first_outer_, from + 1 + most_ahead);
    for (std::uint32_t to = begin; to < end; ++to) offerLink(from, to);
    for (std::uint32_t to = first_outer_; to < places_.size(); ++to) offerLink(from, to);
  }
}

Chain ChainSearch::chainTo(std::uint32_t link) const {
  Chain chain;
  chain.outer = places_[links_[link].to].vertex;
  for (; link != kNone; link = links_[link].before) {
    const Place& from = places_[links_[link].from];
    if (from.vertex != kNoVertex) {
      chain.inner = from.vertex;
    } else {
      chain.cells.push_back(from.at);
    }
  }
  std::reverse(chain.cells.begin(), chain.cells.end());
  return chain;
}

/// The last link of the cheapest chain that begins at a vertex of another piece, or at a new one.
std::uint32_t ChainSearch::cheapest(bool joins) {
  std::uint32_t best = kNone;
  for (std::uint32_t i = 0; i < links_.size(); ++i) {
    relax(i, joins);  // links stand in the order of their first place
    if (links_[i].to < first_outer_ || links_[i].total == kUnreached) continue;
    if (best == kNone || links_[i].total < links_[best].total) best = i;
  }
  return best;
}

std::vector<Chain> ChainSearch::along(const std::vector<Cell>& way, bool broad) {
  std::vector<Chain> chains;
  addPlaces(way, broad);
  addLinks(broad);
  for (const bool joins : {true, false}) {
    const std::uint32_t link = cheapest(joins);
    if (link != kNone) chains.push_back(chainTo(link));
  }
  return chains;
}

}  // namespace split_mapf::roadmap
