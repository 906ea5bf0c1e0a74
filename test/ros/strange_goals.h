#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <split_mapf/PlanPathsGoal.h>

namespace split_mapf::test {

/// A goal that no client should send, and the seconds that it asks for.
struct StrangeGoal {
  std::string kind;
  PlanPathsGoal goal;
  double limit_sec = 0;
  bool cancelled = false;  ///< to be cancelled right behind its sending
};

/// Draws malformed and monstrous goals of all kinds. The same seed gives the same goals.
class StrangeGoals {
 public:
  /// @param server_limit_sec  the server's own time limit, for goals that name none.
  StrangeGoals(std::uint64_t seed, double server_limit_sec);
  StrangeGoal draw();

 private:
  using Random = std::mt19937_64;

  std::uint64_t below(std::uint64_t n) { return random_() % std::max<std::uint64_t>(n, 1); }
  bool oneIn(std::uint64_t n) { return below(n) == 0; }
  template <typename T>
  T pick(const std::vector<T>& choices) {
    return choices[below(choices.size())];
  }
  double strangeNumber();
  std::string strangeText();
  void makeStrange(geometry_msgs::PoseStamped& pose);

  void spoilText(StrangeGoal& strange);
  void spoilPoses(StrangeGoal& strange);
  void spoilMap(StrangeGoal& strange);
  void spoilOptions(StrangeGoal& strange);
  void spoilSplit(StrangeGoal& strange);
  void spoilStamps(StrangeGoal& strange);
  void crowd(StrangeGoal& strange);
  void enlargeMap(StrangeGoal& strange);
  void repeatText(StrangeGoal& strange);
  void askForPoses(StrangeGoal& strange);
  void drawNoise(StrangeGoal& strange);

  /// One kind, drawn as often as its weight says.
  struct Kind {
    std::string name;
    std::uint64_t weight;
    void (StrangeGoals::*spoil)(StrangeGoal&);
  };
  static const std::vector<Kind>& kinds();

  Random random_;
  const double server_limit_sec_;
};

}  // namespace split_mapf::test
