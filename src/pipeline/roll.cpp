#include "split_mapf/pipeline/roll.h"

#include <algorithm>
#include <ctime>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "pipeline/goal_source.h"
#include "pipeline/late_robots.h"
#include "pipeline/rolling/move_graph.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/fleet_check.h"

namespace split_mapf {
namespace {

// What a step with a limit of time is cut into, and the goals to which distances are found.
constexpr std::uint64_t kBudget = 2000;
constexpr std::size_t kMostWays = 2000;

double cpuSec() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

RollOptions checked(const RollOptions& options) {
  if (options.steps < 1) throw OptionError("0 steps were asked for; at least 1 is expected");
  if (options.warmup >= options.steps) {
    throw OptionError("a warm-up of " + std::to_string(options.warmup) + " steps was asked for; " +
                      "fewer than the " + std::to_string(options.steps) + " steps are expected");
  }
  if (options.known_goals < 1) throw OptionError("0 known goals; at least 1 is expected");
  return options;
}

/// One call of roll().
class RollRun {
 public:
  RollRun(const std::shared_ptr<const Grid>& grid, const RollTask& task, const RollOptions& options)
      : grid_(grid),
        options_(checked(options)),
        planner_(grid, options.rolling),
        checker_(grid),
        source_(*grid, task, options.rolling.seed),
        late_(options.delays, static_cast<std::uint32_t>(task.starts.size()), grid->size()),
        since_(task.starts.size(), 0) {
    report_.reached.resize(task.starts.size());
    for (std::uint32_t robot = 0; robot < task.starts.size(); ++robot) {
      RollingRobot entry;
      entry.id = robot;
      entry.prefix = {task.starts[robot]};
      question_.robots.push_back(std::move(entry));
      report_.paths.push_back({task.starts[robot]});
      refill(robot);
      passGoals(robot, 0);
    }
  }

  RollReport run(const Deadline& deadline) {
    for (std::uint32_t t = 1; t <= options_.steps && !deadline.expired(); ++t) {
      carryOut(planStep(t, deadline), t);
      report_.steps = t;
    }
    finish();
    return std::move(report_);
  }

 private:
  RollingAnswer planStep(std::uint32_t t, const Deadline& deadline) {
    const double begin = cpuSec();
    const auto threads = std::min(options_.rolling.threads, RollingOptions::kMostThreads);
    planner_.begin(question_);
    const double valid_ms = 1e3 * (cpuSec() - begin);
    if (options_.step_sec > 0) {
      // Once always: without the first call nobody who is stuck is led on.
      do {
        if (planner_.improve(kBudget) == 0) break;
      } while (cpuSec() - begin < options_.step_sec * threads && !deadline.expired());
    } else {
      planner_.improve(options_.step_expansions, deadline);
    }
    RollingAnswer answer = planner_.answer();
    const double took_ms = 1e3 * (cpuSec() - begin);
    if (t == 1) {
      report_.first_step_ms = took_ms;
    } else {
      report_.valid_ms_max = std::max(report_.valid_ms_max, valid_ms);
      report_.step_cpu_ms_max = std::max(report_.step_cpu_ms_max, took_ms);
      cpu_ms_ += took_ms;
    }
    report_.expansions += answer.expansions;
    report_.escorts += answer.escorts;
    if (t > options_.warmup) resting_steps_ += answer.resting;
    return answer;
  }

  void carryOut(RollingAnswer answer, std::uint32_t t) {
    before_.clear();
    now_.clear();
    for (const RollingRobot& robot : question_.robots) before_.push_back(robot.prefix.front());
    for (const Path& path : answer.paths) now_.push_back(path.at(1));
    late_.nextStep();
    late_.hold(before_, now_);
    const std::optional<std::string> wrong = checker_.violation(before_, now_);
    if (wrong) throw std::logic_error("step " + std::to_string(t) + " is not valid: " + *wrong);
    for (std::uint32_t robot = 0; robot < question_.robots.size(); ++robot) {
      RollingRobot& entry = question_.robots[robot];
      count(robot, t);
      entry.known = std::move(answer.paths[robot]);
      if (entry.known[1] == now_[robot]) entry.known.erase(entry.known.begin());
      entry.prefix.assign(1 + standing(robot), now_[robot]);
      report_.paths[robot].push_back(now_[robot]);
      passGoals(robot, t);
      entry.age = t - since_[robot];
    }
  }

  /// Steps for which the robot is expected to stand on.
  std::uint32_t standing(std::uint32_t robot) const {
    const std::uint32_t expected = late_.expected(robot);
    return expected == 0 ? 0 : std::min(expected - 1, options_.rolling.window);
  }

  void count(std::uint32_t robot, std::uint32_t t) {
    if (t <= options_.warmup) return;
    delayed_steps_ += late_.isDelayed(robot) ? 1 : 0;
    if (question_.robots[robot].goals.empty()) return;
    ++busy_steps_;
    standing_ += before_[robot] == now_[robot] ? 1 : 0;
  }

  void refill(std::uint32_t robot) {
    std::vector<Vertex>& goals = question_.robots[robot].goals;
    while (goals.size() < options_.known_goals) {
      const Vertex goal = source_.next(robot);
      if (goal == kNoVertex) return;
      goals.push_back(goal);
    }
  }

  /// Takes off the goals that a robot has come to.
  void passGoals(std::uint32_t robot, std::uint32_t t) {
    RollingRobot& entry = question_.robots[robot];
    while (!entry.goals.empty() && entry.goals.front() == entry.prefix.front()) {
      const Vertex goal = entry.goals.front();
      report_.reached[robot].push_back({t, goal});
      if (t > options_.warmup) {
        service_.push_back(t - since_[robot]);
      }
      report_.longest_wait = std::max(report_.longest_wait, t - since_[robot]);
      since_[robot] = t;
      entry.goals.erase(entry.goals.begin());
      refill(robot);
    }
  }

  void finish() {
    for (std::uint32_t robot = 0; robot < question_.robots.size(); ++robot) {
      if (question_.robots[robot].goals.empty()) continue;
      report_.longest_wait = std::max(report_.longest_wait, report_.steps - since_[robot]);
    }
    if (report_.steps > 1) report_.step_cpu_ms_mean = cpu_ms_ / (report_.steps - 1);
    if (busy_steps_ > 0) {
      report_.waiting = static_cast<double>(standing_) / static_cast<double>(busy_steps_);
    }
    if (report_.steps > options_.warmup) {
      const double all = static_cast<double>(report_.steps - options_.warmup) *
                         static_cast<double>(question_.robots.size());
      report_.delayed = static_cast<double>(delayed_steps_) / all;
      report_.resting = static_cast<double>(resting_steps_) / all;
    }
    countTurns();
    report_.goals_reached = service_.size();
    if (service_.empty()) return;
    const double steps = report_.steps - options_.warmup;
    report_.throughput = static_cast<double>(service_.size()) / steps;
    std::sort(service_.begin(), service_.end());
    const double sum = std::accumulate(service_.begin(), service_.end(), 0.0);
    report_.service_mean = sum / static_cast<double>(service_.size());
    report_.service_median = service_[service_.size() / 2];
    report_.service_p99 = service_[service_.size() * 99 / 100];
    report_.service_max = service_.back();
    report_.free_flow_share = freeFlowShare();
  }

  /// Of some goals: each is a search.
  double freeFlowShare() const {
    std::size_t goals = 0;
    for (const std::vector<ReachedGoal>& reached : report_.reached) goals += reached.size() + 1;
    const std::size_t stride = std::max<std::size_t>(1, (goals + kMostWays - 1) / kMostWays);
    std::int64_t gained = 0;
    std::int64_t taken = 0;
    std::size_t count = 0;
    for (std::size_t robot = 0; robot < report_.paths.size(); ++robot) {
      std::uint32_t begin = 0;
      for (const ReachedGoal& goal : report_.reached[robot]) {
        if (count++ % stride == 0) {
          addGain(report_.paths[robot], goal.goal, begin, goal.step, gained, taken);
        }
        begin = goal.step;
      }
      const std::vector<Vertex>& ahead = question_.robots[robot].goals;
      if (ahead.empty() || count++ % stride != 0) continue;
      addGain(report_.paths[robot], ahead.front(), begin, report_.steps, gained, taken);
    }
    return taken == 0 ? 0 : static_cast<double>(gained) / static_cast<double>(taken);
  }

  /// How much nearer to the goal a part of a path has come, as far as it is counted.
  void addGain(const Path& path, Vertex goal, std::uint32_t begin, std::uint32_t end,
               std::int64_t& gained, std::int64_t& taken) const {
    begin = std::max(begin, options_.warmup);
    if (begin >= end) return;
    const DistanceTable left(grid_->graph(), goal, DistanceExtent::kOnDemand);
    gained += std::int64_t{left(path[begin])} - std::int64_t{left(path[end])};
    taken += end - begin;
  }

  void countTurns() {
    std::uint64_t moves = 0;
    std::uint64_t turns = 0;
    for (const Path& path : report_.paths) {
      Vertex from = kNoVertex;  // where the last move began
      for (std::size_t t = 1; t < path.size(); ++t) {
        if (path[t] == path[t - 1]) continue;
        ++moves;
        const bool is_turn = from != kNoVertex &&
                             !rolling::isStraight(grid_->cellOf(from), grid_->cellOf(path[t - 1]),
                                                  grid_->cellOf(path[t]));
        turns += is_turn ? 1 : 0;
        from = path[t - 1];
      }
    }
    if (moves > 0) report_.turns = static_cast<double>(turns) / static_cast<double>(moves);
  }

  std::shared_ptr<const Grid> grid_;
  RollOptions options_;
  Rolling planner_;
  FleetChecker checker_;
  GoalSource source_;
  LateRobots late_;
  RollingQuestion question_;
  RollReport report_;
  std::vector<std::uint32_t> since_;  // by robot: the step of its last goal
  std::vector<Vertex> before_;
  std::vector<Vertex> now_;
  std::vector<std::uint32_t> service_;
  std::uint64_t busy_steps_ = 0;
  std::uint64_t standing_ = 0;
  std::uint64_t delayed_steps_ = 0;
  std::uint64_t resting_steps_ = 0;
  double cpu_ms_ = 0;
};

}  // namespace

RollReport roll(const std::shared_ptr<const Grid>& grid, const RollTask& task,
                const RollOptions& options, const Deadline& deadline) {
  return RollRun(grid, task, options).run(deadline);
}

}  // namespace split_mapf
