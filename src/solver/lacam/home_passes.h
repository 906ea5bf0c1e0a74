#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/instance.h"

namespace split_mapf {

/// When robots are expected to pass the homes of others. Who is pushed from home comes home once
/// more, so in a sum of costs it loses all the steps since it came home, or since it was pushed
/// last: a later pass of another makes an earlier one free. Not thread-safe while it changes.
class HomePasses {
 public:
  explicit HomePasses(const Instance& instance);

  void clear();
  /// When the robot is expected home for the first time, or since when it is there.
  void setArrival(std::uint32_t robot, std::uint32_t step) { arrivals_[robot] = step; }
  std::uint32_t arrival(std::uint32_t robot) const { return arrivals_[robot]; }
  /// Nothing happens where `v` is nobody's home, or the robot's own. @pre not there already.
  void insert(Vertex v, std::uint32_t robot, std::uint32_t step);
  /// @pre inserted, if `v` is another's home.
  void remove(Vertex v, std::uint32_t robot);

  /// What the owner of `v` loses when the robot passes at `step` [steps]; the robot's own passes do
  /// not count. 0 where it is nobody's home, or its owner has not come yet.
  std::uint32_t lossOf(Vertex v, std::uint32_t robot, std::uint32_t step) const {
    const std::uint32_t owner = owners_[v];
    if (owner == kNobody || owner == robot || step < arrivals_[owner]) return 0;
    return lossAfter(arrivals_[owner], latestBut(v, robot), step);
  }
  /// What the owner, which is there since `since`, loses to whoever pushes it now; the pusher's own
  /// passes count, too.
  std::uint32_t lossNow(Vertex v, std::uint32_t since, std::uint32_t step) const {
    return lossAfter(since, latest_[v].first, step);
  }

 private:
  static constexpr std::uint32_t kNobody = 0xffffffffU;
  static constexpr std::uint32_t kReturn = 2;  // steps: aside and back

  struct Pass {
    std::uint32_t robot;
    std::uint32_t step;
  };
  struct Latest {  // steps, 0 without a pass
    std::uint32_t robot = kNobody;
    std::uint32_t first = 0;
    std::uint32_t second = 0;
  };
  std::uint32_t latestBut(Vertex v, std::uint32_t robot) const {
    return latest_[v].robot == robot ? latest_[v].second : latest_[v].first;
  }
  static std::uint32_t lossAfter(std::uint32_t arrival, std::uint32_t pass, std::uint32_t step) {
    const std::uint32_t home_for_good = arrival > pass ? arrival : pass;
    return step + kReturn > home_for_good ? step + kReturn - home_for_good : 0;
  }
  void findLatest(Vertex v);

  std::vector<std::uint32_t> owners_;      // by vertex
  std::vector<std::uint32_t> arrivals_;    // by robot
  std::vector<std::vector<Pass>> passes_;  // by vertex
  std::vector<Latest> latest_;             // by vertex
};

}  // namespace split_mapf
