#include "solver/search/timeline.h"

#include <algorithm>

namespace split_mapf {

void TimelineBuilder::build(Vertex v, std::uint32_t robot, const PathTable* others, OthersAre mode,
                            const RobotConstraints* constraints, std::vector<Segment>& out) {
  const std::size_t first = out.size();
  intervals_.clear();
  if (mode != OthersAre::kIgnored) {
    for (const Stay& stay : others->at(v)) {
      if (stay.robot != robot) intervals_.push_back({stay.begin, stay.end});
    }
  }
  if (intervals_.empty()) {
    out.push_back({0, kForever, 0, 0});
  } else if (mode == OthersAre::kObstacles) {
    appendFree(out);
  } else {
    appendCounted(out);
  }
  if (constraints != nullptr) cutBans(v, *constraints, first, out);
}

void TimelineBuilder::appendFree(std::vector<Segment>& out) {
  std::uint32_t from = 0;
  for (const Interval& taken : intervals_) {
    if (from < taken.begin) out.push_back({from, taken.begin, 0, 0});
    from = std::max(from, taken.end);
  }
  if (from < kForever) out.push_back({from, kForever, 0, 0});
}

void TimelineBuilder::appendCounted(std::vector<Segment>& out) {
  cuts_.clear();
  cuts_.push_back(0);
  cuts_.push_back(kForever);
  for (const Interval& taken : intervals_) {
    cuts_.push_back(taken.begin);
    cuts_.push_back(taken.end);
  }
  std::sort(cuts_.begin(), cuts_.end());
  cuts_.erase(std::unique(cuts_.begin(), cuts_.end()), cuts_.end());
  std::size_t alive = 0;  // intervals before this one have ended
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    Segment segment{cuts_[i], cuts_[i + 1], 0, 0};
    while (alive < intervals_.size() && intervals_[alive].end <= segment.begin) ++alive;
    for (std::size_t k = alive; k < intervals_.size() && intervals_[k].begin < segment.end; ++k) {
      if (intervals_[k].end <= segment.begin) continue;
      ++segment.present;
      if (intervals_[k].begin == segment.begin) ++segment.entering;
    }
    out.push_back(segment);
  }
}

void TimelineBuilder::cutBans(Vertex v, const RobotConstraints& constraints, std::size_t first,
                              std::vector<Segment>& out) {
  for (const RobotConstraints::VertexBan& ban : constraints.vertex_bans) {
    if (ban.vertex != v) continue;
    for (std::size_t i = first; i < out.size(); ++i) {
      const Segment whole = out[i];
      if (whole.end <= ban.begin || ban.end <= whole.begin) continue;
      const Segment head{whole.begin, std::max(whole.begin, ban.begin), whole.present,
                         whole.entering};
      const Segment tail{std::min(whole.end, ban.end), whole.end, whole.present, 0};
      const auto at = static_cast<std::ptrdiff_t>(i);
      if (head.begin < head.end && tail.begin < tail.end) {
        out[i] = head;
        out.insert(out.begin() + at + 1, tail);
        ++i;
      } else if (head.begin < head.end) {
        out[i] = head;
      } else if (tail.begin < tail.end) {
        out[i] = tail;
      } else {
        out.erase(out.begin() + at);
        --i;
      }
    }
  }
}

}  // namespace split_mapf
