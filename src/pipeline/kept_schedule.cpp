#include "pipeline/kept_schedule.h"

#include <algorithm>

namespace split_mapf {
namespace {

/// One call of draftBySchedule().
class Drafting {
 public:
  Drafting(const KeptSchedule& schedule, const Plan& rest,
           const std::vector<std::uint32_t>& departures, std::uint32_t passed,
           std::uint32_t vertices)
      : schedule_(schedule),
        rest_(rest),
        departures_(departures),
        passed_(passed),
        holds_(vertices) {}

  ScheduleDraft run() {
    draft_.plan = rest_;
    is_placed_.assign(rest_.paths.size(), false);
    const bool is_of_them = schedule_.plan.paths.size() == rest_.paths.size();
    for (std::uint32_t robot = 0; robot < rest_.paths.size(); ++robot) {
      if (!is_of_them || !goesOn(robot)) leaveOut(robot);
    }
    for (std::uint32_t robot = 0; robot < rest_.paths.size(); ++robot) {
      if (is_placed_[robot] && meetsOneWhoStands(robot)) leaveOut(robot);
    }
    countSteps();
    return std::move(draft_);
  }

 private:
  // How far a robot may be before its schedule, which it is where orders let it.
  static constexpr std::uint32_t kMostAhead = 16;

  struct Hold {
    std::uint32_t robot = 0;
    std::uint32_t until = 0;  // step
  };

  /// Until it departs it may be on its way to where it begins; from then on it goes by the
  /// schedule.
  /// @return false if it is not where that has it, then or soon after.
  bool goesOn(std::uint32_t robot) {
    const Path& scheduled = schedule_.plan.paths[robot];
    const Vertex start = rest_.paths[robot].front();
    if (scheduled.back() != rest_.paths[robot].back()) return false;
    const std::uint32_t begin = passed_ + departures_[robot];
    std::uint32_t ahead = 0;
    while (ahead <= kMostAhead && positionAt(scheduled, begin + ahead) != start) ++ahead;
    if (ahead > kMostAhead) return false;
    Path& path = draft_.plan.paths[robot];
    path.assign(departures_[robot] + ahead + std::size_t{1}, start);
    hold(robot, static_cast<std::uint32_t>(path.size()));
    const std::size_t next = begin + std::size_t{ahead} + 1;
    if (next < scheduled.size()) {
      const auto from = scheduled.begin() + static_cast<std::ptrdiff_t>(next);
      path.insert(path.end(), from, scheduled.end());
    }
    while (path.size() > 1 && path[path.size() - 2] == path.back()) path.pop_back();
    is_placed_[robot] = true;
    return true;
  }

  void leaveOut(std::uint32_t robot) {
    is_placed_[robot] = false;
    draft_.plan.paths[robot] = rest_.paths[robot];
    draft_.unplaced.push_back(robot);
    hold(robot, departures_[robot] + 1 + schedule_.headway);
  }

  void hold(std::uint32_t robot, std::uint32_t until) {
    holds_[rest_.paths[robot].front()] = {robot, until};
  }

  bool meetsOneWhoStands(std::uint32_t robot) const {
    const Path& path = draft_.plan.paths[robot];
    const auto is_held = [&](Vertex v, std::size_t t) {
      return holds_[v].robot != robot && t < holds_[v].until;
    };
    if (is_held(path.back(), path.size())) return true;
    for (std::size_t t = 0; t < path.size(); ++t) {
      if (is_held(path[t], t)) return true;
    }
    return false;
  }

  void countSteps() {
    std::uint64_t before = 0;
    std::uint64_t now = 0;
    for (std::uint32_t robot = 0; robot < rest_.paths.size(); ++robot) {
      before += rest_.paths[robot].size();
      now += draft_.plan.paths[robot].size();
    }
    draft_.saved = before - std::min(before, now);
  }

  const KeptSchedule& schedule_;
  const Plan& rest_;
  const std::vector<std::uint32_t>& departures_;
  const std::uint32_t passed_;
  std::vector<Hold> holds_;  // by vertex, of who begins there
  std::vector<bool> is_placed_;
  ScheduleDraft draft_;
};

}  // namespace

ScheduleDraft draftBySchedule(const KeptSchedule& schedule, const Plan& rest,
                              const std::vector<std::uint32_t>& departures, std::uint32_t passed,
                              std::uint32_t vertices) {
  return Drafting(schedule, rest, departures, passed, vertices).run();
}

}  // namespace split_mapf
