#include <algorithm>
#include <utility>

#include "core/detour_search.h"
#include "core/guided_search.h"

namespace split_mapf {
DistanceTable::DistanceTable(Vertex goal, DistanceGuide guide) : goal_(goal) {
  startOnDemand(guide.grid->graph());
  if (paysDetours(guide)) {
    startDetours(std::move(guide));
    return;
  }
  guided_ = std::make_unique<GuidedSearch>(std::move(guide));
  guided_->length = guided_->bound(goal);
  guided_->open.push_back(goal);
}

bool DistanceTable::expandGuided(Vertex from, Vertex v) const {
  GuidedSearch& search = *guided_;
  const std::uint32_t next = (wide_.empty() ? narrow_[placeOf(from)] : wide_[from]) + 1U;
  bool met = false;
  for (const Vertex u : graph_->neighbours(from)) {
    if (isKnown(u)) continue;
    // The way over u is at most two steps longer: no need to look up more once it is.
    std::uint32_t length = next + search.byKnown(u);
    if (length < search.length + 2) length = std::max(length, next + search.byCells(u));
    if (length > search.length) {
      search.longer[length - search.length - 1].push_back(u);
      continue;
    }
    settle(u, next);
    ++search.settled;
    search.open.push_back(u);
    met = met || u == v;
  }
  return met;
}

std::size_t DistanceTable::bytesOfGuide() const {
  const GuidedSearch& search = *guided_;
  return sizeof search + sizeof(Vertex) * (search.open.capacity() + search.longer[0].capacity() +
                                           search.longer[1].capacity());
}

bool DistanceTable::isWorthCompleting() const {
  const GuidedSearch& search = *guided_;
  return search.guide.may_complete &&
         search.settled * kShareWorthCompleting > std::size_t{graph_->size()};
}

void DistanceTable::complete() const {
  DistanceTable all(*graph_, goal_);
  narrow_ = std::move(all.narrow_);
  wide_ = std::move(all.wide_);
  std::vector<std::uint32_t>().swap(page_of_);
  guided_.reset();
  detours_.reset();
  graph_ = nullptr;
}

std::uint32_t DistanceTable::searchGuided(Vertex v) const {
  GuidedSearch& search = *guided_;
  for (;;) {
    while (!search.open.empty()) {
      if (isWorthCompleting()) {
        complete();
        return (*this)(v);
      }
      const Vertex from = search.open.back();
      search.open.pop_back();
      if (expandGuided(from, v)) return (*this)(v);
    }
    if (search.longer[0].empty() && search.longer[1].empty()) return kUnreachable;
    ++search.length;
    for (const Vertex u : search.longer[0]) {
      if (isKnown(u)) continue;
      settle(u, search.length - search.bound(u));
      ++search.settled;
      search.open.push_back(u);
    }
    search.longer[0].clear();
    std::swap(search.longer[0], search.longer[1]);
    if (isKnown(v)) return (*this)(v);
  }
}

}  // namespace split_mapf
