#include "pipeline/rolling/escorts.h"

#include <algorithm>
#include <set>
#include <utility>

namespace split_mapf::rolling {
namespace {

constexpr std::size_t kMostSearches = 2;  // for new escorts at a time
// Others stay out of regions: a new one only while these are less than one cell in so many.
constexpr std::size_t kLeastShare = 8;

using IndexById = std::unordered_map<std::uint32_t, const RollingRobot*>;

/// Whether the member does what the path says, as far as it is bound to anything.
bool keepsTo(const RollingRobot& robot, const Path& path) {
  for (std::uint32_t t = 0; t < robot.prefix.size(); ++t) {
    if (robot.prefix[t] != positionAt(path, t)) return false;
  }
  return robot.may_move;
}

/// Whether somebody else is bound to be in the region: one that the fleet was not told of before.
bool isEntered(const Escort& escort, const RollingQuestion& fleet) {
  const std::set<std::uint32_t> members(escort.members.begin(), escort.members.end());
  const std::set<Vertex> region(escort.region.begin(), escort.region.end());
  return std::any_of(fleet.robots.begin(), fleet.robots.end(), [&](const RollingRobot& robot) {
    return members.count(robot.id) == 0 &&
           std::any_of(robot.prefix.begin(), robot.prefix.end(),
                       [&](Vertex v) { return region.count(v) > 0; });
  });
}

bool goesOn(const Escort& escort, const RollingQuestion& fleet, const IndexById& robots,
            const std::vector<bool>& closed) {
  for (std::size_t i = 0; i < escort.members.size(); ++i) {
    const auto robot = robots.find(escort.members[i]);
    if (robot == robots.end() || !keepsTo(*robot->second, escort.paths[i])) return false;
    if (robot->first == escort.leader && robot->second->prefix.front() == escort.target) {
      return false;
    }
  }
  return !isEntered(escort, fleet) && std::none_of(escort.region.begin(), escort.region.end(),
                                                   [&](Vertex v) { return closed[v]; });
}

}  // namespace

void Escorts::goOn(const RollingQuestion& fleet, std::uint32_t steps,
                   const std::vector<bool>& closed) {
  if (escorts_.empty()) return;
  IndexById robots;
  for (const RollingRobot& robot : fleet.robots) robots.emplace(robot.id, &robot);
  for (Escort& escort : escorts_) {
    for (Path& path : escort.paths) {
      const auto over = std::min<std::size_t>(steps, path.size() - 1);
      path.erase(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(over));
    }
  }
  const auto over = std::remove_if(escorts_.begin(), escorts_.end(), [&](const Escort& escort) {
    return !goesOn(escort, fleet, robots, closed);
  });
  escorts_.erase(over, escorts_.end());
}

void Escorts::add(const MoveGraph& graph, const RollingQuestion& fleet,
                  const std::vector<bool>& closed, std::vector<StuckRobot> stuck, std::uint64_t now,
                  std::uint32_t patience) {
  std::stable_sort(stuck.begin(), stuck.end(), [&](const StuckRobot& a, const StuckRobot& b) {
    const std::uint32_t one = fleet.robots[a.index].age;
    const std::uint32_t other = fleet.robots[b.index].age;
    return one != other ? one > other : a.steps > b.steps;
  });
  std::size_t searches = 0;
  std::size_t led = 0;  // cells in regions
  for (const Escort& escort : escorts_) led += escort.region.size();
  if (stuck.empty()) return;
  std::vector<bool> barred = closed;
  bar(barred);
  for (const StuckRobot& robot : stuck) {
    if (searches == kMostSearches || led * kLeastShare > graph.size()) return;
    const std::uint32_t id = fleet.robots[robot.index].id;
    // Who is in a region already, or has just been looked at, waits.
    const bool was_tried = hasNone(id, robot.steps, now) && now < failed_[id] + patience;
    if (was_tried || barred[fleet.robots[robot.index].prefix.back()]) continue;
    EscortQuestion question;
    question.graph = &graph;
    question.fleet = &fleet;
    question.closed = &barred;
    question.leader = robot.index;
    question.slope = robot.slope;
    question.best = robot.best;
    // One at a time: with many short escorts the others lose more than these robots gain.
    question.is_urgent = robot.is_urgent && escorts_.empty();
    ++searches;
    std::optional<Escort> escort = findEscort(question);
    if (escort) {
      led += escort->region.size();
      for (const Vertex v : escort->region) barred[v] = true;
      escorts_.push_back(std::move(*escort));
      failed_.erase(id);
    } else {
      failed_[id] = now;
    }
  }
}

bool Escorts::hasNone(std::uint32_t id, std::uint32_t stuck, std::uint64_t now) const {
  const auto failed = failed_.find(id);
  return failed != failed_.end() && now <= failed->second + stuck;
}

void Escorts::bar(std::vector<bool>& barred) const {
  for (const Escort& escort : escorts_) {
    for (const Vertex v : escort.region) barred[v] = true;
  }
}

}  // namespace split_mapf::rolling
