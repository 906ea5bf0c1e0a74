#include "pipeline/rolling/window_search.h"

#include <algorithm>

namespace split_mapf::rolling {

WindowSearch::WindowSearch(const MoveGraph& graph, std::uint32_t window)
    : graph_(graph), window_(window), met_(std::size_t{graph.size()} * (kMostGoals + 1)) {
  buckets_.fill(kNone);
}

std::optional<std::uint32_t> WindowSearch::find(const WindowTable& table,
                                                const Itinerary& itinerary, std::uint32_t most,
                                                RandomEngine& engine, Track& track) {
  most_ = std::min(most, kKeys - 1);
  random_ = engine();
  begin(itinerary, track);
  std::optional<std::uint32_t> found;
  for (;;) {
    while (current_ <= last_ && buckets_[current_] == kNone) ++current_;
    if (current_ > last_) break;
    const std::uint32_t index = pop();
    if (states_[index].step == window_) {
      write(index, track);
      found = current_;
      break;
    }
    expand(index, table, itinerary);
  }
  std::fill(buckets_.begin() + current_, buckets_.begin() + last_ + 1, kNone);
  return found;
}

void WindowSearch::begin(const Itinerary& itinerary, const Track& track) {
  if (++search_ == 0) {
    std::fill(met_.begin(), met_.end(), Met());
    search_ = 1;
  }
  states_.clear();
  current_ = last_ = 0;
  const std::uint32_t t = itinerary.free_from;
  std::uint32_t reached = 0;
  for (std::uint32_t i = 0; i <= t; ++i) reached = itinerary.reachedAt(track.at[i], reached);
  const Vertex v = track.at[t];
  meet(v, t, reached);
  // Who comes in straight may go on straight.
  std::uint32_t before = t;
  while (before > 0 && track.slot[before - 1] == kWait) --before;
  State state{};
  state.vertex = v;
  state.parent = kNone;
  state.step = static_cast<std::uint8_t>(t);
  state.reached = static_cast<std::uint8_t>(reached);
  state.came_by = kWait;
  if (before > 0) state.came_by = graph_[track.at[before - 1]].back[track.slot[before - 1]];
  push(0, state);
}

std::uint32_t WindowSearch::pop() {
  const std::uint32_t index = buckets_[current_];
  buckets_[current_] = states_[index].next;
  ++expansions_;
  return index;
}

void WindowSearch::push(std::uint32_t key, const State& state) {
  const auto index = static_cast<std::uint32_t>(states_.size());
  states_.push_back(state);
  states_.back().next = buckets_[key];
  buckets_[key] = index;
  last_ = std::max(last_, key);
}

bool WindowSearch::meet(Vertex v, std::uint32_t step, std::uint32_t reached) {
  Met& met = met_[std::size_t{reached} * graph_.size() + v];
  if (met.search != search_) {
    met.search = search_;
    met.steps = 0;
  }
  const bool is_new = (met.steps >> step & 1U) == 0;
  met.steps |= 1U << step;
  return is_new;
}

void WindowSearch::expand(std::uint32_t index, const WindowTable& table,
                          const Itinerary& itinerary) {
  const std::uint32_t stage = states_[index].stage;
  const std::uint32_t reached = states_[index].reached;
  const Vertex v = states_[index].vertex;
  const std::uint32_t open = table[v].open;
  if (itinerary.isIdle(reached)) {
    if (stage == 0) {
      defer(index, kIdleMoveCost);
      tryWait(index, table);
    } else {
      tryMoves(index, open, table, itinerary);
    }
    return;
  }
  const std::uint32_t bits = itinerary.slopes[reached][v];
  const std::uint32_t step_cost = stepCostAt(states_[index].step);
  if (stage == 0) {
    defer(index, step_cost);
    tryMoves(index, open & bits, table, itinerary);
  } else if (stage == 1) {
    defer(index, step_cost);
    tryWait(index, table);
    tryMoves(index, open & bits >> kSlots, table, itinerary);
  } else {
    tryMoves(index, open & ~(bits | bits >> kSlots), table, itinerary);
  }
}

void WindowSearch::defer(std::uint32_t index, std::uint32_t cost) {
  if (current_ + cost > most_) return;
  State& state = states_[index];
  ++state.stage;
  state.next = buckets_[current_ + cost];
  buckets_[current_ + cost] = index;
  last_ = std::max(last_, current_ + cost);
}

void WindowSearch::tryWait(std::uint32_t index, const WindowTable& table) {
  State state = states_[index];
  if ((table[state.vertex].taken >> (state.step + 1U) & 1U) != 0) return;
  state.parent = index;
  ++state.step;
  state.stage = 0;
  if (meet(state.vertex, state.step, state.reached)) push(current_, state);
}

void WindowSearch::tryMoves(std::uint32_t index, std::uint32_t slots, const WindowTable& table,
                            const Itinerary& itinerary) {
  if (slots == 0) return;
  // What is pushed last is looked at first: the way straight on, and of the others any.
  const Slot came_by = states_[index].came_by;
  const Slot straight = came_by < kSlots ? graph_[states_[index].vertex].straight[came_by] : kWait;
  const std::uint32_t last = slots & 1U << straight;
  slots &= ~last;
  random_ = random_ * 6364136223846793005U + 1442695040888963407U;
  if ((random_ >> 63U) != 0) {
    while (slots != 0) {
      const auto slot = static_cast<Slot>(31 - __builtin_clz(slots));
      slots &= ~(1U << slot);
      tryMove(index, slot, table, itinerary);
    }
  }
  for (; slots != 0; slots &= slots - 1) {
    tryMove(index, static_cast<Slot>(__builtin_ctz(slots)), table, itinerary);
  }
  if (last != 0) tryMove(index, straight, table, itinerary);
}

void WindowSearch::tryMove(std::uint32_t index, Slot slot, const WindowTable& table,
                           const Itinerary& itinerary) {
  const State& from = states_[index];
  const MoveGraph::Node& node = graph_[from.vertex];
  const Vertex to = node.next[slot];
  const WindowTable::Row& row = table[to];
  const std::uint32_t t = from.step;
  if (((row.taken >> (t + 1) | row.leaving[node.back[slot]] >> t) & 1U) != 0) return;
  State state{};
  state.vertex = to;
  state.parent = index;
  state.step = static_cast<std::uint8_t>(t + 1);
  state.reached = static_cast<std::uint8_t>(itinerary.reachedAt(to, from.reached));
  state.came_by = node.back[slot];
  if (meet(to, state.step, state.reached)) push(current_, state);
}

void WindowSearch::write(std::uint32_t index, Track& track) const {
  for (std::uint32_t i = index; states_[i].parent != kNone; i = states_[i].parent) {
    const State& state = states_[i];
    const Vertex before = states_[state.parent].vertex;
    track.at[state.step] = state.vertex;
    track.slot[state.step - std::size_t{1}] = graph_.slotOf(before, state.vertex);
  }
}

}  // namespace split_mapf::rolling
