#include "solver/search/path_table.h"

#include <algorithm>

namespace split_mapf {

void PathTable::insert(std::uint32_t robot, const Path& path) {
  forEachStay(path, [&](Vertex v, std::uint32_t begin, std::uint32_t end, Vertex next) {
    std::vector<Stay>& stays = stays_[v];
    auto place = stays.end();
    while (place != stays.begin() && begin < (place - 1)->begin) --place;
    stays.insert(place, {begin, end, robot, next});
  });
}

void PathTable::remove(std::uint32_t robot, const Path& path) {
  forEachStay(path, [&](Vertex v, std::uint32_t begin, std::uint32_t, Vertex) {
    std::vector<Stay>& stays = stays_[v];
    const auto place = std::find_if(stays.begin(), stays.end(), [&](const Stay& s) {
      return s.begin == begin && s.robot == robot;
    });
    stays.erase(place);
  });
}

void PathTable::clear() {
  for (std::vector<Stay>& stays : stays_) stays.clear();
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

}  // namespace split_mapf
