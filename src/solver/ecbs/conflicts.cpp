#include "solver/ecbs/conflicts.h"

#include <algorithm>

namespace split_mapf {

void ConflictFinder::find(std::uint32_t robot, const Path& path, const PathTable& table,
                          std::vector<Conflict>& out) {
  const std::size_t first = out.size();
  forEachConflict(table, path, [&](const Stay& stay, const PathVisit& visit, bool swaps) {
    if (stay.robot == robot) return;
    const Vertex v = visit.vertex;
    const std::uint32_t step = std::max(visit.begin, stay.begin);
    Conflict conflict{Conflict::Kind::kVertex, robot, stay.robot, step, v, kNoVertex};
    if (swaps) {
      conflict = {Conflict::Kind::kSwap, robot, stay.robot, visit.begin, visit.before, v};
    } else if (targets_ && stay.end == kForever) {
      conflict.kind = Conflict::Kind::kTarget;
    } else if (targets_ && visit.end == kForever) {
      conflict = {Conflict::Kind::kTarget, stay.robot, robot, step, v, kNoVertex};
    }
    note(conflict, stay.robot, first, out);
  });
  for (std::size_t i = first; i < out.size(); ++i) {
    slot_[out[i].first == robot ? out[i].second : out[i].first] = kNoSlot;
  }
}

void ConflictFinder::attendOnlyTo(const std::vector<std::uint32_t>& robots) {
  std::fill(slot_.begin(), slot_.end(), kIgnored);
  for (const std::uint32_t robot : robots) slot_[robot] = kNoSlot;
}

void ConflictFinder::note(const Conflict& conflict, std::uint32_t other, std::size_t first,
                          std::vector<Conflict>& out) {
  std::uint32_t& slot = slot_[other];
  if (slot == kIgnored) return;
  if (slot == kNoSlot) {
    slot = static_cast<std::uint32_t>(out.size() - first);
    out.push_back(conflict);
  } else if (conflict.step < out[first + slot].step) {
    out[first + slot] = conflict;
  }
}

Branches branchOn(const Conflict& conflict) {
  const std::uint32_t step = conflict.step;
  Constraint first{
      Constraint::Kind::kVertexBan, conflict.first, conflict.vertex, kNoVertex, step, step + 1};
  Constraint second = first;
  second.robot = conflict.second;
  switch (conflict.kind) {
    case Conflict::Kind::kVertex:
      break;
    case Conflict::Kind::kSwap:
      first.kind = second.kind = Constraint::Kind::kMoveBan;
      first.to = conflict.other;
      second.vertex = conflict.other;
      second.to = conflict.vertex;
      break;
    case Conflict::Kind::kTarget:
      first.end = kForever;
      second.kind = Constraint::Kind::kLaterArrival;
      second.begin = step + 1;
      break;
  }
  return {first, second};
}

void apply(const Constraint& constraint, RobotConstraints& constraints) {
  switch (constraint.kind) {
    case Constraint::Kind::kVertexBan:
      constraints.vertex_bans.push_back({constraint.vertex, constraint.begin, constraint.end});
      break;
    case Constraint::Kind::kMoveBan:
      constraints.move_bans.push_back({constraint.vertex, constraint.to, constraint.begin});
      break;
    case Constraint::Kind::kLaterArrival:
      constraints.earliest_arrival = std::max(constraints.earliest_arrival, constraint.begin);
      break;
  }
}

}  // namespace split_mapf
