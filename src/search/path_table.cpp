#include "search/path_table.h"

#include <algorithm>

namespace split_mapf {
namespace {

constexpr std::uint32_t kNobody = 0xffffffffU;

bool beginsBefore(const Stay& stay, std::uint32_t step) { return stay.begin < step; }

}  // namespace

void PathTable::insert(std::uint32_t robot, Vertex v, std::uint32_t begin, std::uint32_t end,
                       Vertex next) {
  std::vector<Stay>& stays = stays_[v];
  auto place = stays.end();
  while (place != stays.begin() && begin < (place - 1)->begin) --place;
  stays.insert(place, {begin, heldUntil(end), robot, next});
  noteChange(v);
}

void PathTable::erase(std::uint32_t robot, Vertex v, std::uint32_t begin) {
  stays_[v].erase(find(robot, v, begin));
  noteChange(v);
}

/// The robot's visit to `v` that begins at `begin`.
std::vector<Stay>::iterator PathTable::find(std::uint32_t robot, Vertex v, std::uint32_t begin) {
  std::vector<Stay>& stays = stays_[v];
  auto place = std::lower_bound(stays.begin(), stays.end(), begin, beginsBefore);
  while (place->robot != robot) ++place;
  return place;
}

void PathTable::insert(std::uint32_t robot, const Path& path) {
  forEachStay(path, [&](Vertex v, std::uint32_t begin, std::uint32_t end, Vertex next) {
    insert(robot, v, begin, end, next);
  });
}

void PathTable::insertAll(const std::vector<Path>& paths) {
  std::vector<std::uint32_t> visits(stays_.size(), 0);
  for (const Path& path : paths) {
    forEachStay(path, [&](Vertex v, std::uint32_t, std::uint32_t, Vertex) { ++visits[v]; });
  }
  for (Vertex v = 0; v < stays_.size(); ++v) {
    // One may come before another goes.
    if (visits[v] > 0) stays_[v].reserve(visits[v] + std::size_t{1});
  }
  for (std::uint32_t robot = 0; robot < paths.size(); ++robot) insert(robot, paths[robot]);
}

void PathTable::remove(std::uint32_t robot, const Path& path) {
  forEachStay(
      path, [&](Vertex v, std::uint32_t begin, std::uint32_t, Vertex) { erase(robot, v, begin); });
}

void PathTable::removeTail(std::uint32_t robot, const Path& path, std::uint32_t from) {
  const Vertex at = positionAt(path, from);
  const auto kept = find(robot, at, beginOfStay(path, from));
  const std::uint32_t end = kept->end == kForever ? kForever : kept->end - headway_;
  kept->end = heldUntil(from + 1);
  kept->next = kNoVertex;
  noteChange(at);
  forEachStay(path, end, [&](Vertex v, std::uint32_t begin, std::uint32_t, Vertex) {
    erase(robot, v, begin);
  });
}

void PathTable::insertTail(std::uint32_t robot, const Path& path, std::uint32_t from) {
  const Vertex at = positionAt(path, from);
  const auto kept = find(robot, at, beginOfStay(path, from));
  const auto size = static_cast<std::uint32_t>(path.size());
  std::uint32_t end = from + 1;
  while (end < size && path[end] == at) ++end;
  kept->end = end < size ? heldUntil(end) : kForever;
  kept->next = end < size ? path[end] : kNoVertex;
  noteChange(at);
  forEachStay(path, end, [&](Vertex v, std::uint32_t begin, std::uint32_t stay_end, Vertex next) {
    insert(robot, v, begin, stay_end, next);
  });
}

void PathTable::removeHead(std::uint32_t robot, const Path& path, std::uint32_t from) {
  for (std::uint32_t begin = 0; begin <= from; ++begin) {
    if (begin >= path.size()) break;
    if (begin > 0 && path[begin] == path[begin - 1]) continue;
    erase(robot, path[begin], begin);
  }
}

const Timeline& PathTable::timeline(Vertex v) const {
  static const Timeline undisturbed = {{0, kForever, 0, 0}};
  if (stays_[v].empty()) return undisturbed;
  if (timelines_.empty()) timelines_.resize(stays_.size());
  if (timelines_[v].empty()) builder_.build(stays_[v], kNobody, timelines_[v]);
  return timelines_[v];
}

std::uint32_t PathTable::countSwaps(std::uint32_t robot, Vertex from, Vertex to,
                                    std::uint32_t t) const {
  std::uint32_t swaps = 0;
  for (const Stay& stay : stays_[to]) {
    if (stay.begin >= t) break;
    if (stay.end == t && stay.next == from && stay.robot != robot) ++swaps;
  }
  return swaps;
}

std::vector<std::uint32_t> robotsInTheWay(const PathTable& placed, const Path& path) {
  std::vector<std::uint32_t> robots;
  forEachConflict(placed, path, [&robots](const Stay& stay, const PathVisit&, bool) {
    robots.push_back(stay.robot);
  });
  std::sort(robots.begin(), robots.end());
  robots.erase(std::unique(robots.begin(), robots.end()), robots.end());
  return robots;
}

}  // namespace split_mapf
