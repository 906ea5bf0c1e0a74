#include "search/retiming.h"

#include <algorithm>
#include <limits>

namespace split_mapf {

Path soonestAlong(const ReservationTable& placed, const Path& path, std::uint32_t departure) {
  Path soonest = path;
  std::uint32_t begin = departure;  // of the visit before
  for (std::uint32_t t = 1; t < path.size(); ++t) {
    if (path[t] == path[t - 1]) continue;
    const std::uint32_t since = placed.freeSince(path[t], t);
    begin = std::max(begin + 1, since);
    // Who left the vertex right then must not have come towards it.
    if (begin == since && begin < t && placed.oncoming(path[t - 1], path[t], begin) != nullptr) {
      ++begin;
    }
    std::fill(soonest.begin() + begin, soonest.begin() + t, path[t]);
  }
  while (soonest.size() > 1 && soonest[soonest.size() - 2] == soonest.back()) soonest.pop_back();
  return soonest;
}

/// A visit begins as late as what follows allows, and as long as the robot may stay where it is.
void WaitPlacer::setLatest(const ReservationTable& placed) {
  for (std::size_t k = visits_.size() - 1; k > 0; --k) {
    const Visit& before = visits_[k - 1];
    Visit& visit = visits_[k];
    const std::uint32_t comes = placed.takenAfter(before.vertex, before.soonest, visit.latest);
    visit.latest = std::min(visit.latest, comes);
    const bool swaps =
        visit.latest == comes && placed.oncoming(before.vertex, visit.vertex, comes) != nullptr;
    if (swaps) --visit.latest;
    visits_[k - 1].latest = visit.latest - 1;
  }
  visits_.front().latest = visits_.front().soonest;
}

/// For each step at which the visit may begin the cheapest begin of the one before.
void WaitPlacer::addChoices(const Visit& before, const Visit& visit) {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  std::uint32_t best = before.soonest;
  std::uint32_t t = before.soonest;
  for (std::uint32_t begin = visit.soonest; begin <= visit.latest; ++begin) {
    for (; t < begin && t <= before.latest; ++t) {
      // Compared as if all waited until the last step of all.
      const std::uint64_t cost = choices_[before.choices + t - before.soonest].cost +
                                 before.dearness * (visit.latest - 1 - t);
      if (cost < least) {
        least = cost;
        best = t;
      }
    }
    choices_.push_back({least - before.dearness * (visit.latest - begin), best});
  }
}

void WaitPlacer::choose(const ReservationTable& placed) {
  // Between equals earlier waits are better: whoever came later would find the way free.
  constexpr std::uint64_t kVisit = 1U << 16U;
  choices_.assign(1, {});
  for (std::size_t k = 0; k < visits_.size(); ++k) {
    Visit& visit = visits_[k];
    visit.dearness = kVisit * placed.at(visit.vertex).size() + k;
    if (k == 0) continue;
    visit.choices = choices_.size();
    addChoices(visits_[k - 1], visit);
  }
}

void WaitPlacer::place(const ReservationTable& placed, Path& path, std::uint32_t from) {
  visits_.clear();
  for (std::uint32_t t = from; t < path.size(); ++t) {
    if (t == from || path[t] != path[t - 1]) visits_.push_back({path[t], t, t, 0, 0});
  }
  const bool waits = visits_.size() < path.size() - from;
  if (!waits || visits_.size() < 2) return;
  setLatest(placed);
  choose(placed);
  auto end = static_cast<std::uint32_t>(path.size());
  std::uint32_t begin = visits_.back().latest;
  for (auto visit = visits_.rbegin(); visit != visits_.rend(); ++visit) {
    std::fill(path.begin() + begin, path.begin() + end, visit->vertex);
    end = begin;
    begin = choices_[visit->choices + begin - visit->soonest].before;
  }
}

void placeWaits(std::uint32_t vertices, Plan& plan) {
  ReservationTable table(vertices, plan);
  WaitPlacer waits;
  for (std::uint32_t i = 0; i < plan.paths.size(); ++i) {
    table.remove(i, plan.paths[i]);
    waits.place(table, plan.paths[i]);
    table.insert(i, plan.paths[i]);
  }
}

}  // namespace split_mapf
