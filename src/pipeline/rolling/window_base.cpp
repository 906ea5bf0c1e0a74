#include "pipeline/rolling/window_base.h"

#include <algorithm>
#include <stdexcept>

namespace split_mapf::rolling {

void WindowBase::make(const std::vector<WindowStart>& starts,
                      const std::vector<std::uint32_t>& order, FleetWindow& window) {
  stop_until_ = 0;
  if (makeSteps(starts, order, window)) return;
  // What is bound leaves somebody no place: then everybody stops, as everybody may.
  for (const WindowStart& start : starts) {
    const auto last = static_cast<std::uint32_t>(start.prefix->size()) - 1;
    stop_until_ = std::max(stop_until_, last);
  }
  if (!makeSteps(starts, order, window)) {
    throw std::logic_error("no step of the fleet was found where everybody may stop");
  }
}

void WindowBase::renew(const std::vector<std::uint32_t>& order, FleetWindow& window) {
  other_.steps = window.steps;
  other_.itineraries = window.itineraries;
  other_.tracks.resize(window.tracks.size());
  const Path nothing;
  std::vector<Path> bound(window.robots());
  std::vector<WindowStart> starts;
  for (std::uint32_t robot = 0; robot < window.robots(); ++robot) {
    const auto begin = window.tracks[robot].at.begin();
    bound[robot].assign(begin, begin + window.itineraries[robot].free_from + 1);
    starts.push_back({&bound[robot], &nothing});
  }
  stop_until_ = 0;
  if (!makeSteps(starts, order, other_)) return;
  if (other_.cost() < window.cost()) window.tracks.swap(other_.tracks);
}

bool WindowBase::makeSteps(const std::vector<WindowStart>& starts,
                           const std::vector<std::uint32_t>& order, FleetWindow& window) {
  const std::uint32_t robots = window.robots();
  table_.clear();
  wishes_.resize(robots);
  reached_.assign(robots, 0);
  on_known_.assign(robots, true);
  for (std::uint32_t robot = 0; robot < robots; ++robot) {
    const Vertex at = starts[robot].prefix->front();
    window.tracks[robot].at[0] = at;
    window.tracks[robot].slot.fill(kWait);
    reached_[robot] = window.itineraries[robot].reachedAt(at, 0);
    const Path& known = *starts[robot].known;
    on_known_[robot] = !known.empty() && known.front() == at;
  }
  const std::uint32_t kept = keepKnownAtOnce(starts, window);
  for (std::uint32_t t = kept; t < window.steps; ++t) {
    for (std::uint32_t robot = 0; robot < robots; ++robot) wish(starts, robot, t, window);
    if (keepKnown(t, window)) continue;
    if (!maker_.make(wishes_, order, table_, moves_)) return false;
    for (std::uint32_t robot = 0; robot < robots; ++robot) {
      on_known_[robot] = on_known_[robot] && moves_[robot] == wishes_[robot].wanted;
      advance(robot, t, moves_[robot], window);
    }
  }
  return true;
}

std::uint32_t WindowBase::keepKnownAtOnce(const std::vector<WindowStart>& starts,
                                          FleetWindow& window) {
  if (stop_until_ > 0) return 0;
  std::size_t steps = window.steps;
  for (const WindowStart& start : starts) {
    if (start.known->size() < start.prefix->size()) return 0;
    steps = std::min(steps, start.known->size() - 1);
  }
  const auto last = static_cast<std::uint32_t>(steps);
  std::uint32_t robot = 0;
  while (robot < window.robots() && keepWay(starts[robot], robot, last, window)) ++robot;
  if (robot < window.robots()) {
    for (std::uint32_t before = 0; before < robot; ++before) {
      table_.flip(window.tracks[before], 0, last);
    }
    return 0;
  }
  for (robot = 0; robot < window.robots(); ++robot) {
    const Itinerary& own = window.itineraries[robot];
    for (std::uint32_t t = 1; t <= last && !own.isIdle(reached_[robot]); ++t) {
      reached_[robot] = own.reachedAt(window.tracks[robot].at[t], reached_[robot]);
    }
  }
  return last;
}

bool WindowBase::keepWay(const WindowStart& start, std::uint32_t robot, std::uint32_t last,
                         FleetWindow& window) {
  const Path& known = *start.known;
  if (!std::equal(start.prefix->begin(), start.prefix->end(), known.begin())) return false;
  const auto free = static_cast<std::uint32_t>(start.prefix->size()) - 1;
  const bool stays = window.itineraries[robot].free_from >= window.steps;
  Track& track = window.tracks[robot];
  for (std::uint32_t t = 0; t < last; ++t) {
    const Vertex at = known[t];
    const Slot slot = graph_.slotOf(at, known[t + 1]);
    if (slot == MoveGraph::kNoSlot || (stays && t >= free && slot != kWait)) return false;
    // Who is bound goes where it has to, walls or not.
    const bool open = slot == kWait || t < free || (table_[at].open >> slot & 1U) != 0;
    if (!open || isTaken(at, slot, t)) return false;
    track.at[t + 1] = known[t + 1];
    track.slot[t] = slot;
  }
  table_.flip(track, 0, last);
  return true;
}

bool WindowBase::isTaken(Vertex at, Slot slot, std::uint32_t t) const {
  if (slot == kWait) return (table_[at].taken >> (t + 1) & 1U) != 0;
  const MoveGraph::Node& node = graph_[at];
  const WindowTable::Row& row = table_[node.next[slot]];
  return ((row.taken >> (t + 1) | row.leaving[node.back[slot]] >> t) & 1U) != 0;
}

void WindowBase::wish(const std::vector<WindowStart>& starts, std::uint32_t robot, std::uint32_t t,
                      const FleetWindow& window) {
  const Path& prefix = *starts[robot].prefix;
  const Path& known = *starts[robot].known;
  const Itinerary& itinerary = window.itineraries[robot];
  StepWish& wish = wishes_[robot];
  wish.at = window.tracks[robot].at[t];
  const bool is_idle = itinerary.isIdle(reached_[robot]);
  wish.slope = is_idle ? nullptr : itinerary.slopes[reached_[robot]];
  wish.wanted = MoveGraph::kNoSlot;
  const auto free = static_cast<std::uint32_t>(prefix.size()) - 1;
  wish.bound = t < free || t < stop_until_ || itinerary.free_from >= window.steps;
  if (wish.bound) {
    wish.wanted = t < free ? graph_.slotOf(wish.at, prefix[t + 1]) : kWait;
    on_known_[robot] = on_known_[robot] && t + 1 < known.size() &&
                       (wish.wanted == kWait ? wish.at : prefix[t + 1]) == known[t + 1];
    return;
  }
  wish.straight = straightOn(window.tracks[robot], t);
  if (!on_known_[robot] || t + 1 >= known.size()) {
    on_known_[robot] = false;
    return;
  }
  const Slot slot = graph_.slotOf(wish.at, known[t + 1]);
  const bool open = slot == kWait || (slot < kSlots && (table_[wish.at].open >> slot & 1U) != 0);
  if (open) wish.wanted = slot;
  on_known_[robot] = open;
}

/// The slot by which the track goes on at step t as it came.
Slot WindowBase::straightOn(const Track& track, std::uint32_t t) const {
  while (t > 0 && track.slot[t - 1] == kWait) --t;
  if (t == 0) return kWait;
  return graph_[track.at[t]].straight[graph_[track.at[t - 1]].back[track.slot[t - 1]]];
}

bool WindowBase::keepKnown(std::uint32_t t, FleetWindow& window) {
  for (const StepWish& wish : wishes_) {
    if (wish.wanted == MoveGraph::kNoSlot) return false;
  }
  for (std::uint32_t robot = 0; robot < window.robots(); ++robot) {
    Track& track = window.tracks[robot];
    const Slot slot = wishes_[robot].wanted;
    const Vertex to = slot == kWait ? track.at[t] : graph_[track.at[t]].next[slot];
    const bool free = !isTaken(track.at[t], slot, t);
    track.slot[t] = slot;
    track.at[t + 1] = to;
    if (free) {
      table_.flip(track, t, t + 1);
      continue;
    }
    for (std::uint32_t before = 0; before < robot; ++before) {
      table_.flip(window.tracks[before], t, t + 1);
    }
    return false;
  }
  for (std::uint32_t robot = 0; robot < window.robots(); ++robot) {
    reached_[robot] =
        window.itineraries[robot].reachedAt(window.tracks[robot].at[t + 1], reached_[robot]);
  }
  return true;
}

void WindowBase::advance(std::uint32_t robot, std::uint32_t t, Slot slot, FleetWindow& window) {
  Track& track = window.tracks[robot];
  track.slot[t] = slot;
  track.at[t + 1] = slot == kWait ? track.at[t] : graph_[track.at[t]].next[slot];
  reached_[robot] = window.itineraries[robot].reachedAt(track.at[t + 1], reached_[robot]);
}

}  // namespace split_mapf::rolling
