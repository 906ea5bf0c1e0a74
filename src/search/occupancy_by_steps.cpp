#include "search/occupancy_by_steps.h"

#include <algorithm>

namespace split_mapf {

OccupancyBySteps::OccupancyBySteps(const HeadingGraph& graph, std::uint32_t vertices,
                                   const Plan& plan)
    : graph_(graph), bytes_((vertices + std::size_t{1}) / 2) {
  for (const Path& path : plan.paths) {
    steps_ = std::max(steps_, static_cast<std::uint32_t>(path.size()));
  }
  codes_.resize(bytes_ * steps_);
  for (const Path& path : plan.paths) insert(path, 0, steps_);
}

void OccupancyBySteps::set(Vertex v, std::uint32_t t, std::uint32_t code) {
  std::uint8_t& byte = codes_[t * bytes_ + v / 2];
  const std::uint32_t shift = v % 2 * 4;
  byte = static_cast<std::uint8_t>((byte & ~(15U << shift)) | code << shift);
}

/// Says whether anybody is there beside a step at which nobody is.
void OccupancyBySteps::noteBeside(Vertex v, std::uint32_t t) {
  if (t >= steps_ || at(t).isTaken(v)) return;
  const bool before = t > 0 && at(t - 1).isTaken(v);
  const bool after = t + 1 < steps_ && at(t + 1).isTaken(v);
  set(v, t, (before ? 1 : 0) + (after ? 1 : 0));
}

/// The steps [begin, end) of a path.
void OccupancyBySteps::insert(const Path& path, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t t = begin; t < end; ++t) {
    const Vertex v = positionAt(path, t);
    const Vertex before = positionAt(path, t == 0 ? 0 : t - 1);
    set(v, t, v == before ? kStays : kEntered + graph_.headingOf(before, v));
    if (v == before) continue;
    noteBeside(before, t);
    noteBeside(v, t - 1);
  }
}

void OccupancyBySteps::remove(const Path& path, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t t = begin; t < end; ++t) set(positionAt(path, t), t, 0);
  for (std::uint32_t t = begin; t < end; ++t) {
    const Vertex v = positionAt(path, t);
    const Vertex before = positionAt(path, t == 0 ? 0 : t - 1);
    noteBeside(v, t);
    if (v == before) continue;
    noteBeside(before, t);
    noteBeside(v, t - 1);
  }
}

/// Whether nobody but the robot itself is in the way at step `t`.
bool OccupancyBySteps::isFree(const Path& path, std::uint32_t t, const Path& own) const {
  const Vertex from = positionAt(path, t - 1);
  const Vertex to = positionAt(path, t);
  if (isOthers(to, t, own)) return false;
  const Heading back = graph_.headingOf(to, from);
  return back == kNoHeading || !at(t).isEntered(from, back) || positionAt(own, t) == from;
}

bool OccupancyBySteps::exchange(Path& own, Path& path) {
  // Where they differ.
  auto end = static_cast<std::uint32_t>(own.size() - 1);
  while (end > 0 && positionAt(own, end) == positionAt(path, end)) --end;
  std::uint32_t begin = 1;
  while (begin < end && own[begin] == positionAt(path, begin)) ++begin;
  // The step behind leads to the same vertex, but from elsewhere.
  end = std::min(end + 2, steps_);
  for (std::uint32_t t = begin; t < end; ++t) {
    if (!isFree(path, t, own)) return false;
  }
  remove(own, begin, end);
  own.swap(path);
  insert(own, begin, end);
  return true;
}

}  // namespace split_mapf
