#include "pipeline/rolling/leader_search.h"

#include <algorithm>
#include <utility>

namespace split_mapf::rolling {

LeaderSearch::LeaderSearch(const LeaderQuestion& question) : question_(question) {
  const MoveGraph& graph = *question.graph;
  std::vector<Number> number(graph.size(), kNone);
  for (Vertex v = 0; v < graph.size(); ++v) {
    if (!(*question.inside)[v]) continue;
    number[v] = static_cast<Number>(vertices_.size());
    vertices_.push_back(v);
  }
  State state;
  for (const Vertex v : vertices_) {
    std::array<Number, kSlots>& next = next_.emplace_back();
    for (Slot slot = 0; slot < kSlots; ++slot) {
      const Vertex u = graph[v].next[slot];
      next[slot] = u == v ? kNone : number[u];
    }
    state.occupied.push_back((*question.occupied)[v]);
  }
  state.leader = number[question.leader];
  state.left = question.left;
  add(std::move(state));
}

std::optional<std::vector<LeaderMove>> LeaderSearch::find() {
  while (!open_.empty() && visits_ < question_.visits) {
    const std::uint32_t index = std::get<2>(open_.top());
    open_.pop();
    if (states_[index].left <= question_.aim) return movesTo(index);
    expand(index);
  }
  return std::nullopt;
}

void LeaderSearch::expand(std::uint32_t index) {
  const Number at = states_[index].leader;
  const std::vector<Part>& parts = partsWithout(at);
  std::array<bool, kSlots> has_room{};
  for (Number v = 0; v < vertices_.size(); ++v) {
    if (parts[v] != kNoPart && !states_[index].occupied[v]) has_room[parts[v]] = true;
  }
  visits_ += vertices_.size();
  for (Slot slot = 0; slot < kSlots; ++slot) {
    const Number to = next_[at][slot];
    if (to == kNone || !has_room[parts[to]]) continue;
    arrive(states_[index], index, slot, kNoPart);
    const std::vector<Part>& ahead = partsWithout(to);
    std::array<bool, kSlots> is_done{};
    is_done[ahead[at]] = true;
    for (const Number u : next_[to]) {
      if (u == kNone || is_done[ahead[u]]) continue;
      is_done[ahead[u]] = true;
      makeRoom(index, slot, ahead[u]);
    }
  }
}

/// As arrive(), with more vertices free in a part that lies behind `to`: as many as there are, and
/// each power of two below.
void LeaderSearch::makeRoom(std::uint32_t index, Slot slot, Part part) {
  State state = states_[index];
  const Number to = next_[state.leader][slot];
  state.moves.clear();
  std::uint32_t made = 0;
  std::uint32_t used = 0;
  while (visits_ < question_.visits && makeRoomOnce(state, to, part)) {
    ++made;
    if ((made & (made - 1)) != 0) continue;
    arrive(state, index, slot, part);
    used = made;
  }
  if (used < made) arrive(std::move(state), index, slot, part);
}

/// Lets one robot out of a part, to a free vertex outside. @return whether there is one.
bool LeaderSearch::makeRoomOnce(State& state, Number to, Part part) {
  const std::vector<Part>& ahead = partsWithout(to);
  const auto outside = [&](Number v) { return v != state.leader && ahead[v] != part; };
  std::vector<Number> way = wayTo(to, outside, [&](Number v) { return !state.occupied[v]; });
  if (way.empty()) return false;
  std::reverse(way.begin(), way.end());
  const std::vector<Number> inner = wayTo(
      to, [&](Number v) { return ahead[v] == part; },
      [&](Number v) { return ahead[v] == part && state.occupied[v]; });
  if (inner.empty()) return false;
  way.insert(way.end(), inner.begin() + 1, inner.end());
  state.cost += shift(way, state);
  return true;
}

/// Moves the leader on by a slot, once the nearest free vertex has been brought there; one of the
/// part that is kept only if there is no other one.
void LeaderSearch::arrive(State state, std::uint32_t parent, Slot slot, Part kept) {
  const Number at = state.leader;
  const Number to = next_[at][slot];
  if (kept == kNoPart) state.moves.clear();
  const auto is_free = [&](Number v) { return !state.occupied[v]; };
  std::vector<Number> way;
  if (kept != kNoPart) {
    const std::vector<Part>& ahead = partsWithout(to);
    way = wayTo(
        to, [&](Number v) { return v != at && ahead[v] != kept; }, is_free);
  }
  if (way.empty())
    way = wayTo(
        to, [&](Number v) { return v != at; }, is_free);
  if (way.empty()) return;
  std::reverse(way.begin(), way.end());
  shift(way, state);
  const std::uint32_t bits = (*question_.slope)[vertices_[at]];
  if ((bits >> slot & 1U) != 0) {
    --state.left;
  } else if ((bits >> slot & 16U) == 0) {
    ++state.left;
  }
  state.moves.push_back({vertices_[at], vertices_[to]});
  state.occupied[at] = false;
  state.occupied[to] = true;
  state.leader = to;
  state.parent = parent;
  ++state.cost;
  add(std::move(state));
}

void LeaderSearch::add(State state) {
  const std::vector<Part>& parts = partsWithout(state.leader);
  std::vector<std::uint32_t> key(kSlots + std::size_t{1}, 0);
  key[kSlots] = state.leader;
  for (Number v = 0; v < vertices_.size(); ++v) {
    if (parts[v] != kNoPart && !state.occupied[v]) ++key[parts[v]];
  }
  visits_ += vertices_.size();
  if (!known_.insert(std::move(key)).second) return;
  open_.emplace(state.cost + state.left, state.left, static_cast<std::uint32_t>(states_.size()));
  states_.push_back(std::move(state));
}

std::vector<LeaderMove> LeaderSearch::movesTo(std::uint32_t index) const {
  std::vector<std::uint32_t> states;
  for (std::uint32_t i = index; i != kNone; i = states_[i].parent) states.push_back(i);
  std::vector<LeaderMove> moves;
  for (auto state = states.rbegin(); state != states.rend(); ++state) {
    moves.insert(moves.end(), states_[*state].moves.begin(), states_[*state].moves.end());
  }
  return moves;
}

/// Numbers of connected parts of what is left without a vertex, in the order of its slots.
const std::vector<LeaderSearch::Part>& LeaderSearch::partsWithout(Number number) {
  std::vector<Part>& parts = parts_[number];
  if (!parts.empty()) return parts;
  parts.assign(vertices_.size(), kNoPart);
  Part count = 0;
  std::vector<Number> queue;
  for (const Number first : next_[number]) {
    if (first == kNone || parts[first] != kNoPart) continue;
    queue.assign(1, first);
    parts[first] = count;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      for (const Number u : next_[queue[head]]) {
        if (u == kNone || u == number || parts[u] != kNoPart) continue;
        parts[u] = count;
        queue.push_back(u);
      }
    }
    ++count;
  }
  visits_ += vertices_.size();
  return parts;
}

/// The shortest way to an end, from `from` on, through what is inside; empty when there is none.
template <typename Inside, typename End>
std::vector<LeaderSearch::Number> LeaderSearch::wayTo(Number from, const Inside& inside,
                                                      const End& is_end) {
  before_.assign(vertices_.size(), kNone);
  before_[from] = from;
  std::vector<Number> queue(1, from);
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const Number v = queue[head];
    if (is_end(v)) {
      std::vector<Number> way(1, v);
      while (way.back() != from) way.push_back(before_[way.back()]);
      std::reverse(way.begin(), way.end());
      visits_ += head;
      return way;
    }
    for (const Number u : next_[v]) {
      if (u == kNone || before_[u] != kNone || !inside(u)) continue;
      before_[u] = v;
      queue.push_back(u);
    }
  }
  visits_ += queue.size();
  return {};
}

/// Robots on the way each move on to where the one before them was, the first one to the way's
/// begin, which is free. So its end is free. @return steps that this takes.
std::uint32_t LeaderSearch::shift(const std::vector<Number>& way, State& state) const {
  std::size_t free = 0;
  std::uint32_t longest = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (!state.occupied[way[i]]) continue;
    for (std::size_t j = i; j > free; --j) {
      state.moves.push_back({vertices_[way[j]], vertices_[way[j - 1]]});
    }
    longest = std::max(longest, static_cast<std::uint32_t>(i - free));
    free = i;
  }
  state.occupied[way.front()] = true;
  state.occupied[way[free]] = false;
  return longest;
}

}  // namespace split_mapf::rolling
