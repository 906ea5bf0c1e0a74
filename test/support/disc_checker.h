#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace split_mapf::test {

/// Discs that move in straight lines at constant speed between two moments: keeps them apart in
/// continuous time. Knows nothing of plans, graphs or grids: positions in, distances out.
class DiscChecker {
 public:
  struct Point {
    double x = 0;
    double y = 0;
  };
  explicit DiscChecker(double radius) : radius_(radius) {}

  /// All discs at the next moment. Between it and the last one each moved straight.
  void next(const std::vector<Point>& centres);
  /// The least distance between two centres so far.
  double leastDistance() const { return least_; }
  bool isClear() const { return least_ >= 2 * radius_ - 1e-6; }
  /// Which two came closest, and when; for messages of failing tests.
  std::string closest() const;

 private:
  double radius_;
  double least_ = 1e300;
  std::size_t first_ = 0;
  std::size_t second_ = 0;
  std::size_t moment_ = 0;
  std::size_t moments_ = 0;
  std::vector<Point> last_;
};

}  // namespace split_mapf::test
