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
  timelines_[v].clear();
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

void PathTable::remove(std::uint32_t robot, const Path& path) {
  forEachStay(path, [&](Vertex v, std::uint32_t begin, std::uint32_t, Vertex) {
    stays_[v].erase(find(robot, v, begin));
    timelines_[v].clear();
  });
}

void PathTable::removeTail(std::uint32_t robot, const Path& path, std::uint32_t from) {
  const Vertex at = positionAt(path, from);
  const auto kept = find(robot, at, beginOfStay(path, from));
  const std::uint32_t end = kept->end == kForever ? kForever : kept->end - headway_;
  kept->end = heldUntil(from + 1);
  kept->next = kNoVertex;
  timelines_[at].clear();
  forEachStay(path, end, [&](Vertex v, std::uint32_t begin, std::uint32_t, Vertex) {
    stays_[v].erase(find(robot, v, begin));
    timelines_[v].clear();
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
  timelines_[at].clear();
  forEachStay(path, end, [&](Vertex v, std::uint32_t begin, std::uint32_t stay_end, Vertex next) {
    insert(robot, v, begin, stay_end, next);
  });
}

void PathTable::removeHead(std::uint32_t robot, const Path& path, std::uint32_t from) {
  for (std::uint32_t begin = 0; begin <= from; ++begin) {
    if (begin >= path.size()) break;
    if (begin > 0 && path[begin] == path[begin - 1]) continue;
    stays_[path[begin]].erase(find(robot, path[begin], begin));
    timelines_[path[begin]].clear();
  }
}

const Timeline& PathTable::timeline(Vertex v) const {
  static const Timeline undisturbed = {{0, kForever, 0, 0}};
  if (stays_[v].empty()) return undisturbed;
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
