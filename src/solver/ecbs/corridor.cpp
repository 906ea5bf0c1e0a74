#include "solver/ecbs/corridor.h"

#include <algorithm>

#include "search/stay.h"

namespace split_mapf {
namespace {

/// The first step from `time` on at which the constraints let the robot enter `to` from `from`.
std::uint32_t firstAllowed(Vertex from, Vertex to, std::uint32_t time,
                           const RobotConstraints& constraints) {
  for (bool moved = true; moved;) {
    moved = false;
    for (const RobotConstraints::VertexBan& ban : constraints.vertex_bans) {
      if (ban.vertex != to || time < ban.begin || time >= ban.end) continue;
      if (ban.end == kForever) return kForever;
      time = ban.end;
      moved = true;
    }
    if (constraints.bansMove(from, to, time)) {
      ++time;
      moved = true;
    }
  }
  return time;
}

std::uint32_t difference(std::uint32_t a, std::uint32_t b) { return a < b ? b - a : a - b; }

}  // namespace

CorridorReasoning::CorridorReasoning(const Instance& instance)
    : instance_(instance), graph_(instance.graph()), earliest_(instance.graph().size(), kForever) {}

std::optional<Branches> CorridorReasoning::branchOn(const Conflict& conflict,
                                                    const Traveller& first,
                                                    const Traveller& second) {
  if (conflict.kind == Conflict::Kind::kTarget) return std::nullopt;
  const std::optional<Passage> there = passageOf(first.path, conflict.step);
  if (!there) return std::nullopt;
  const std::optional<Passage> back = passageOf(second.path, conflict.step);
  if (!back || back->entry != there->exit || back->exit != there->entry ||
      back->length != there->length) {
    return std::nullopt;
  }
  // Whoever waits leaves the far end a step after the other has arrived there, at the earliest.
  const std::uint32_t after_first =
      earliestAt(there->exit, kNoVertex, first, there->step) + there->length;
  const std::uint32_t after_second =
      earliestAt(back->exit, kNoVertex, second, back->step) + back->length;
  // They bind only robots that come through the corridor; others come round it at this step.
  const std::uint32_t end_of_first =
      std::min(after_second + 1, earliestAt(there->exit, there->last, first, after_second));
  if (there->step >= end_of_first) return std::nullopt;
  const std::uint32_t end_of_second =
      std::min(after_first + 1, earliestAt(back->exit, back->last, second, after_first));
  if (back->step >= end_of_second) return std::nullopt;
  const auto keeps_out = [](const Traveller& traveller, Vertex exit, std::uint32_t end) {
    return Constraint{Constraint::Kind::kVertexBan, traveller.robot, exit, kNoVertex, 0, end};
  };
  return Branches{keeps_out(first, there->exit, end_of_first),
                  keeps_out(second, back->exit, end_of_second)};
}

std::optional<CorridorReasoning::Passage> CorridorReasoning::passageOf(const Path& path,
                                                                       std::uint32_t step) const {
  // The robots may also meet at an end, one on its way out, the other on its way in.
  const std::uint32_t last = static_cast<std::uint32_t>(path.size()) - 1;
  std::uint32_t inside = std::min(step, last);
  if (!inChain(path[inside]) && inside > 0 && inChain(path[inside - 1])) --inside;
  if (!inChain(path[inside]) && step < last && inChain(path[step + 1])) inside = step + 1;
  if (!inChain(path[inside])) return std::nullopt;
  std::uint32_t from = inside;
  while (from > 0 && inChain(path[from])) --from;
  std::uint32_t to = inside;
  while (to < last && inChain(path[to])) ++to;
  // One that starts inside may leave at either end without having come through.
  if (inChain(path[0]) || inChain(path[from]) || inChain(path[to])) return std::nullopt;
  if (path[from] == path[to]) return std::nullopt;
  Passage passage{path[from], path[to], path[to - 1], 1, to};
  Vertex ahead = passage.exit;
  for (Vertex v = passage.last; v != passage.entry; ++passage.length) {
    const VertexRange two = graph_.neighbours(v);
    const Vertex next = *two.begin() == ahead ? *(two.begin() + 1) : *two.begin();
    ahead = v;
    v = next;
  }
  return passage;
}

std::uint32_t CorridorReasoning::earliestAt(Vertex to, Vertex closed, const Traveller& traveller,
                                            std::uint32_t latest) {
  const HeldDistances distances = instance_.distances(traveller.robot);
  const std::uint32_t there = distances(to);
  const auto later = [](const Open& a, const Open& b) {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.time < b.time;
  };
  const auto reach = [&](Vertex v, std::uint32_t time) {
    if (time >= earliest_[v]) return;
    const std::uint32_t estimate = time + difference(distances(v), there);
    if (estimate > latest) return;
    if (earliest_[v] == kForever) reached_.push_back(v);
    earliest_[v] = time;
    open_.push_back({estimate, time, v});
    std::push_heap(open_.begin(), open_.end(), later);
  };
  open_.clear();
  reach(traveller.path.front(), 0);
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), later);
    const Open at = open_.back();
    open_.pop_back();
    if (at.time > earliest_[at.vertex]) continue;
    if (at.vertex == to) break;
    ++expansions_;
    for (const Vertex next : graph_.neighbours(at.vertex)) {
      if (at.vertex == closed && next == to) continue;
      reach(next, firstAllowed(at.vertex, next, at.time + 1, traveller.constraints));
    }
  }
  const std::uint32_t found = earliest_[to];
  for (const Vertex v : reached_) earliest_[v] = kForever;
  reached_.clear();
  return found;
}

}  // namespace split_mapf
