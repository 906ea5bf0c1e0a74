#include "search/timeline.h"

#include <algorithm>

namespace split_mapf {

void TimelineBuilder::build(const std::vector<Stay>& stays, std::uint32_t robot, Timeline& out) {
  out.clear();
  intervals_.clear();
  cuts_.clear();
  cuts_.push_back(0);
  bool in_order = true;  // as long as no two visits overlap
  for (const Stay& stay : stays) {
    if (stay.robot == robot) continue;
    in_order = in_order && cuts_.back() <= stay.begin;
    intervals_.push_back({stay.begin, stay.end});
    cuts_.push_back(stay.begin);
    cuts_.push_back(stay.end);
  }
  cuts_.push_back(kForever);
  if (!in_order) std::sort(cuts_.begin(), cuts_.end());
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

void cutBans(Vertex v, const RobotConstraints& constraints, Timeline& timeline) {
  for (const RobotConstraints::VertexBan& ban : constraints.vertex_bans) {
    if (ban.vertex != v) continue;
    for (std::size_t i = 0; i < timeline.size(); ++i) {
      const Segment whole = timeline[i];
      if (whole.end <= ban.begin || ban.end <= whole.begin) continue;
      const Segment head{whole.begin, std::max(whole.begin, ban.begin), whole.present,
                         whole.entering};
      const Segment tail{std::min(whole.end, ban.end), whole.end, whole.present, 0};
      const auto at = static_cast<std::ptrdiff_t>(i);
      if (head.begin < head.end && tail.begin < tail.end) {
        timeline[i] = head;
        timeline.insert(timeline.begin() + at + 1, tail);
        ++i;
      } else if (head.begin < head.end) {
        timeline[i] = head;
      } else if (tail.begin < tail.end) {
        timeline[i] = tail;
      } else {
        timeline.erase(timeline.begin() + at);
        --i;
      }
    }
  }
}

}  // namespace split_mapf
