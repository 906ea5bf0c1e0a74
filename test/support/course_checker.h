#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace split_mapf::test {

/// Where one disc's centre is at every whole step [m]; between them it goes straight at constant
/// speed, and stays where its list ends.
struct DiscCourse {
  std::vector<double> x;
  std::vector<double> y;
};

/// What discs must not come near, as a picture of squares, and how near they may come to each
/// other.
struct DiscWorld {
  std::uint32_t width = 0;  ///< squares
  std::uint32_t height = 0;
  double side = 0;                    ///< of a square [m]
  std::vector<std::uint8_t> blocked;  ///< row-major
  double wall_gap = 0;                ///< between centre and square [m]
  double disc_gap = 0;                ///< between two centres [m]
};

/// Checks courses in continuous time, by halving spans of time until the speeds rule out a
/// collision within them; a gap that is missed by less than 1e-4 m counts as kept. Shares no line
/// with the package. @return the first thing that is wrong
std::optional<std::string> findDiscCollision(const DiscWorld& world,
                                             const std::vector<DiscCourse>& courses);

}  // namespace split_mapf::test
