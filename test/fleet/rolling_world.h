#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fleet/fleet_world.h"
#include "split_mapf/fleet/fleet_tasks.h"
#include "split_mapf/fleet/rolling_replan.h"

namespace split_mapf::test {

inline FleetOptions rollingOptions() {
  FleetOptions options;
  options.rolling = true;
  options.progress_timeout_sec = 3;
  return options;
}

/// All robots stand.
inline Plan standing(const std::vector<Vertex>& places) {
  Plan plan;
  for (const Vertex place : places) plan.paths.push_back({place});
  return plan;
}

/// A rolling fleet of discs whose tasks come one by one.
class RollingWorld : public FleetWorld {
 public:
  /// @param distance_m  that centres keep on a planning graph.
  RollingWorld(const std::shared_ptr<const Grid>& grid, const std::vector<Vertex>& places,
               const FleetOptions& options, std::uint64_t seed, std::uint32_t max_active = 0,
               double distance_m = 0)
      : FleetWorld(grid, standing(places), options, seed, distance_m), max_active_(max_active) {
    begin();
  }

  std::uint64_t send(const std::string& robot, Vertex goal) {
    const std::uint64_t task = tasks_->add(robot, goal, now_);
    open_.emplace(task, std::make_pair(robot, goal));
    return task;
  }
  void cancel(std::uint64_t task) { tasks_->end(task, TaskEnd::kCancelled); }

  /// @return whether all tasks are over, but those that are not waited for.
  bool runUntilDone(int most) {
    for (int i = 0; i < most && !open_.empty(); ++i) tick();
    return open_.empty();
  }

  void restart() override {
    FleetWorld::restart();
    open_.clear();
    begin();
  }

  std::map<std::uint64_t, EndedTask> ends_;
  std::map<std::uint64_t, std::pair<std::string, Vertex>> open_;
  std::unique_ptr<FleetTasks> tasks_;
  std::unique_ptr<RollingReplanner> replanner_;
  std::vector<std::string> troubles_;

 protected:
  void handOut() override {
    for (EndedTask& ended : tasks_->step(*fleet_, now_)) {
      if (open_.erase(ended.task) == 0) throw std::logic_error("a task ended twice");
      ends_.emplace(ended.task, std::move(ended));
    }
    if (!fleet_->trouble().empty()) troubles_.push_back(fleet_->trouble());
  }
  FleetAnswer answerTo(const FleetQuestion& question) override {
    return replanner_->answer(question, {});
  }

 private:
  void begin() {
    FleetTaskRules rules;
    rules.step_sec = options_.step_sec;
    rules.max_active = max_active_;
    rules.patience_sec = options_.progress_timeout_sec;
    tasks_ = std::make_unique<FleetTasks>(grid_, rules);
    replanner_ = std::make_unique<RollingReplanner>(grid_, RollingOptions());
  }

  std::uint32_t max_active_;
};

}  // namespace split_mapf::test
