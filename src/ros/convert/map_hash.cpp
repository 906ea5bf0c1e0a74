#include "ros/convert/map_hash.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

namespace split_mapf {
namespace {

class Fnv {
 public:
  void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3ULL; }
  /// By its bits, but the two zeros are one.
  void add(double number) {
    number += 0.0;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    add(bits);
  }
  std::uint64_t hash() const {
    // The upper half has seen all bits, the lower one less.
    return hash_ ^ (hash_ >> 32U);
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

/// Eight cells or what is left, the first one lowest on every machine.
std::uint64_t wordAt(const std::vector<std::int8_t>& cells, std::size_t first) {
  std::uint64_t word = 0;
  const std::size_t count = std::min<std::size_t>(8, cells.size() - first);
  for (std::size_t i = 0; i < count; ++i) {
    word |= std::uint64_t{static_cast<std::uint8_t>(cells[first + i])} << (8 * i);
  }
  return word;
}

}  // namespace

std::string hashOf(const nav_msgs::OccupancyGrid& map, const Deadline& deadline) {
  Fnv fnv;
  const geometry_msgs::Pose& origin = map.info.origin;
  fnv.add(std::uint64_t{map.info.width});
  fnv.add(std::uint64_t{map.info.height});
  for (const double number :
       {double{map.info.resolution}, origin.position.x, origin.position.y, origin.position.z,
        origin.orientation.x, origin.orientation.y, origin.orientation.z, origin.orientation.w}) {
    fnv.add(number);
  }
  SparsePoll poll(deadline);
  for (std::size_t first = 0; first < map.data.size(); first += 8) {
    poll();
    fnv.add(wordAt(map.data, first));
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(fnv.hash()));
  return text;
}

}  // namespace split_mapf
