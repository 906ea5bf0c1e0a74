#include "support/reserved_oracle.h"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace split_mapf::test {
namespace {

/// Where everybody is after `step` steps; a robot that has arrived for good moves no more.
struct State {
  std::vector<Vertex> at;
  std::vector<bool> arrived;
  std::uint32_t step = 0;  // no later than the last change of a reserved path

  bool operator<(const State& other) const {
    return std::tie(step, at, arrived) < std::tie(other.step, other.at, other.arrived);
  }
};

class Search {
 public:
  Search(const Instance& instance, const Reservations& reserved, Objective objective)
      : instance_(instance), reserved_(reserved), objective_(objective) {}

  std::optional<std::uint64_t> run() {
    State start{instance_.starts(), std::vector<bool>(instance_.robots(), false), 0};
    for (std::uint32_t choice = 0; choice < 1U << instance_.robots(); ++choice) {
      arriveSome(start, choice, 0);
    }
    while (!open_.empty()) {
      const auto [cost, state] = open_.top();
      open_.pop();
      if (cost > best_[state]) continue;
      if (std::all_of(state.arrived.begin(), state.arrived.end(), [](bool a) { return a; })) {
        if (keepsClearForGood(state)) return cost;
        continue;
      }
      moveFrom(state, cost);
    }
    return std::nullopt;
  }

 private:
  using Entry = std::pair<std::uint64_t, State>;
  struct Dearer {
    bool operator()(const Entry& a, const Entry& b) const { return a.first > b.first; }
  };

  static Vertex placeAt(const Path& path, std::uint32_t step) {
    return path[std::min<std::size_t>(step, path.size() - 1)];
  }

  /// Robots of `choice` that are at their goals arrive there for good.
  void arriveSome(State state, std::uint32_t choice, std::uint64_t cost) {
    for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
      if ((choice >> robot & 1U) == 0 || state.arrived[robot]) continue;
      if (state.at[robot] != instance_.goal(robot)) return;
      state.arrived[robot] = true;
    }
    const auto known = best_.find(state);
    if (known != best_.end() && known->second <= cost) return;
    best_[state] = cost;
    open_.push({cost, state});
  }

  bool keepsClearForGood(const State& state) const {
    for (std::uint32_t step = state.step; step <= reserved_.lastStep(); ++step) {
      for (const Path& path : reserved_.paths()) {
        for (const Vertex v : state.at) {
          if (placeAt(path, step) == v) return false;
        }
      }
    }
    return true;
  }

  void moveFrom(const State& state, std::uint64_t cost) {
    const auto open_robots =
        static_cast<std::uint64_t>(std::count(state.arrived.begin(), state.arrived.end(), false));
    const std::uint64_t step_cost = objective_ == Objective::kMakespan ? 1 : open_robots;
    std::vector<Vertex> to(instance_.robots());
    const std::function<void(std::uint32_t)> choose = [&](std::uint32_t robot) {
      if (robot == instance_.robots()) {
        if (!isLegal(state, to)) return;
        State next{to, state.arrived, std::min(state.step + 1, reserved_.lastStep() + 1)};
        for (std::uint32_t choice = 0; choice < 1U << instance_.robots(); ++choice) {
          arriveSome(next, choice, cost + step_cost);
        }
        return;
      }
      to[robot] = state.at[robot];
      choose(robot + 1);
      if (state.arrived[robot]) return;
      for (const Vertex v : instance_.graph().neighbours(state.at[robot])) {
        to[robot] = v;
        choose(robot + 1);
      }
    };
    choose(0);
  }

  bool isLegal(const State& state, const std::vector<Vertex>& to) const {
    for (std::size_t i = 0; i < to.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (to[i] == to[j]) return false;
        if (to[i] == state.at[j] && to[j] == state.at[i]) return false;
      }
      for (const Path& path : reserved_.paths()) {
        const Vertex before = placeAt(path, state.step);
        const Vertex after = placeAt(path, state.step + 1);
        if (to[i] == after) return false;
        if (to[i] == before && after == state.at[i]) return false;
      }
    }
    return true;
  }

  const Instance& instance_;
  const Reservations& reserved_;
  const Objective objective_;
  std::map<State, std::uint64_t> best_;
  std::priority_queue<Entry, std::vector<Entry>, Dearer> open_;
};

}  // namespace

std::optional<std::uint64_t> optimalCostAround(const Instance& instance,
                                               const Reservations& reserved, Objective objective) {
  if (!reserved.findBlocked(instance).empty()) return std::nullopt;
  return Search(instance, reserved, objective).run();
}

}  // namespace split_mapf::test
