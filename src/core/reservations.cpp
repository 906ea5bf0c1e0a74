#include "split_mapf/core/reservations.h"

#include <algorithm>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

void requirePath(const Grid& grid, const Path& path, std::size_t number) {
  const std::string name = "reserved path " + std::to_string(number);
  if (path.empty()) throw InputError(name + " is empty; a vertex a step is expected");
  for (const Vertex v : path) {
    if (v < grid.size()) continue;
    throw InputError(name + " leads to vertex " + std::to_string(v) + ", but the grid has " +
                     counted(grid.size(), "vertex", "vertices"));
  }
}

std::string cellText(const Grid& grid, Vertex v) {
  const Cell cell = grid.cellOf(v);
  return "(" + std::to_string(cell.x) + ", " + std::to_string(cell.y) + ")";
}

/// An instance whose robots take the paths.
Instance instanceOf(const std::shared_ptr<const Grid>& grid, const std::vector<Path>& paths) {
  std::vector<Vertex> starts;
  std::vector<Vertex> goals;
  for (const Path& path : paths) {
    starts.push_back(path.front());
    goals.push_back(path.back());
  }
  return Instance::fromVertices(grid, starts, goals, DistanceExtent::kOnDemand);
}

}  // namespace

Reservations::Reservations(const std::shared_ptr<const Grid>& grid, std::vector<Path> paths)
    : paths_(std::move(paths)) {
  if (paths_.empty()) return;
  for (std::size_t i = 0; i < paths_.size(); ++i) requirePath(*grid, paths_[i], i);
  Plan plan{std::move(paths_)};
  trimToArrival(plan);
  const std::string robots = "reserved paths, counted as robots: ";
  try {
    const std::vector<Violation> violations = validate(instanceOf(grid, plan.paths), plan);
    if (!violations.empty()) throw InputError(violations.front().message);
  } catch (const InputError& error) {
    throw InputError(robots + error.what());
  }
  paths_ = std::move(plan.paths);
}

std::uint32_t Reservations::lastStep() const {
  std::size_t last = 0;
  for (const Path& path : paths_) last = std::max(last, path.size() - 1);
  return static_cast<std::uint32_t>(last);
}

Reservations Reservations::from(std::uint32_t step) const {
  Reservations later;
  for (const Path& path : paths_) {
    const std::size_t begin = std::min<std::size_t>(step, path.size() - 1);
    later.paths_.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(begin), path.end());
  }
  return later;
}

std::string Reservations::findBlocked(const Instance& instance) const {
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
      const bool at_start = paths_[i].front() == instance.start(robot);
      if (!at_start && paths_[i].back() != instance.goal(robot)) continue;
      const Vertex v = at_start ? instance.start(robot) : instance.goal(robot);
      return "reserved path " + std::to_string(i) +
             (at_start ? " begins at the start " : " ends at the goal ") +
             cellText(instance.grid(), v) + " of robot " + std::to_string(robot);
    }
  }
  return "";
}

std::string findViolation(const Instance& instance, const Plan& plan,
                          const Reservations& reserved) {
  const std::vector<Violation> alone = validate(instance, plan);
  if (!alone.empty()) return alone.front().message;
  if (reserved.empty()) return "";
  std::string blocked = reserved.findBlocked(instance);
  if (!blocked.empty()) return blocked;
  Plan all = plan;
  all.paths.insert(all.paths.end(), reserved.paths().begin(), reserved.paths().end());
  const std::vector<Violation> together =
      validate(instanceOf(instance.sharedGrid(), all.paths), all);
  return together.empty() ? "" : together.front().message;
}

}  // namespace split_mapf
