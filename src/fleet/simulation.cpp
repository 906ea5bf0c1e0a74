#include "split_mapf/fleet/simulation.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/standing_times.h"
#include "fleet/ticked_execution.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/execution_graph.h"
#include "split_mapf/core/validate.h"

namespace split_mapf {

ExecutionPolicy parseExecutionPolicy(const std::string& name) {
  if (name == "lockstep") return ExecutionPolicy::kLockstep;
  if (name == "graph") return ExecutionPolicy::kGraph;
  if (name == "replan") return ExecutionPolicy::kReplan;
  throw OptionError("policy '" + name + "' is unknown; lockstep, graph or replan is expected");
}

std::string toString(ExecutionPolicy policy) {
  switch (policy) {
    case ExecutionPolicy::kLockstep:
      return "lockstep";
    case ExecutionPolicy::kGraph:
      return "graph";
    case ExecutionPolicy::kReplan:
      break;
  }
  return "replan";
}

namespace {

// Ticks of a step where releases or turns make parts of it matter.
constexpr std::uint32_t kTicks = 10;
constexpr double kMostTurnSteps = 1000;

}  // namespace

void requireValid(const SimulationOptions& options) {
  requireValid(options.delays);
  if (!(options.release >= 0 && options.release <= 1)) {
    throw OptionError("release " + std::to_string(options.release) +
                      " is out of range: a fraction of a move, 0 to 1, is expected");
  }
  if (!(options.turn_time >= 0 && options.turn_time <= kMostTurnSteps)) {
    throw OptionError("turn time " + std::to_string(options.turn_time) +
                      " is out of range: 0 to 1000 steps are expected");
  }
  if (options.replan_period == 0) {
    throw OptionError("a replan period of 0 steps is none: 1 step or more is expected");
  }
}

namespace {

std::uint32_t ticksOfAStep(const SimulationOptions& options) {
  const bool whole = !options.moves && (options.release <= 0 || options.release >= 1);
  return whole && std::floor(options.turn_time) == options.turn_time ? 1 : kTicks;
}

MotionTimes motionOf(const SimulationOptions& options) {
  MotionTimes times;
  times.move = ticksOfAStep(options);
  times.turn = static_cast<std::uint32_t>(std::ceil(options.turn_time * times.move - 1e-6));
  return times;
}

/// In lockstep.
std::vector<std::uint32_t> stepsOf(const Plan& plan, std::uint32_t vertices,
                                   ExecutionPolicy policy) {
  std::vector<std::uint32_t> steps;
  if (policy != ExecutionPolicy::kLockstep) return steps;
  const Precedence order(plan, vertices);
  for (VisitId v = 0; v < order.size(); ++v) steps.push_back(order[v].step);
  return steps;
}

double threadCpuMs() {
  std::timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// One call of simulate().
class SimulationRun {
 public:
  SimulationRun(const Instance& instance, const Plan& plan, const SimulationOptions& options,
                const Deadline& deadline)
      : instance_(instance),
        options_(options),
        deadline_(deadline),
        times_(motionOf(options)),
        delays_(options.delays, instance.robots()),
        standing_(instance.robots()),
        robots_(instance.grid(),
                ExecutionGraph(Precedence(plan, instance.graph().size()), options.release,
                               options.moves),
                times_, stepsOf(plan, instance.graph().size(), options.policy)) {
    report_.planned_sum_of_costs = sumOfCostsOf(plan);
    report_.planned_makespan = makespanOf(plan);
    report_.ticks_per_step = times_.move;
    report_.executed.paths.resize(instance.robots());
    if (options.policy == ExecutionPolicy::kReplan) {
      replanner_.emplace(instance, times_, options.budget);
    }
    was_delayed_.assign(instance.robots(), false);
    record();
  }

  SimulationReport run() {
    for (step_ = 0; !robots_.isDone() && step_ < options_.step_limit; ++step_) {
      if (deadline_.expired()) break;
      delays_.nextStep();
      observe();
      // Nothing is known at step 0, but rings may be in the plan.
      const bool soon = robots_.graph().release() > 0 && options_.avoid_rings;
      if (replanner_ && (step_ > 0 || soon) && step_ % options_.replan_period == 0) {
        replan();
      }
      for (std::uint32_t tick = 0; tick < times_.move; ++tick) {
        robots_.tick(delays_);
        if (options_.on_tick) tell();
      }
      record();
    }
    conclude();
    return std::move(report_);
  }

 private:
  void observe() {
    for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
      standing_.observe(robot, delays_.isDelayed(robot));
    }
    for (const std::uint32_t robot : robots_.underWay()) {
      const bool delayed = delays_.isDelayed(robot);
      ++robot_steps_;
      if (delayed) ++delayed_steps_;
      if (delayed && !was_delayed_[robot]) open_delays_.push_back({robot, step_, step_});
      was_delayed_[robot] = delayed;
    }
    const auto over = [this](const DelayInterval& delay) { return !was_delayed_[delay.robot]; };
    for (DelayInterval& delay : open_delays_) {
      if (!over(delay)) delay.end = step_ + 1;
      if (over(delay)) report_.delay_intervals.push_back(delay);
    }
    open_delays_.erase(std::remove_if(open_delays_.begin(), open_delays_.end(), over),
                       open_delays_.end());
  }

  void replan() {
    const double begin_ms = threadCpuMs();
    ReplanQuestion question;
    question.graph = &robots_.graph();
    question.stands.resize(instance_.robots());
    for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
      question.stands[robot] = times_.move * standing_.expected(robot);
    }
    question.came_from = robots_.cameFrom();
    question.commit = times_.move;
    question.avoid_rings = options_.avoid_rings;
    question.asked = std::uint64_t{step_} * times_.move;
    ReplanAnswer answer = replanner_->replan(question, deadline_);
    const double took_ms = threadCpuMs() - begin_ms;
    ++report_.replans;
    replan_ms_ += took_ms;
    report_.replan_cpu_ms_max = std::max(report_.replan_cpu_ms_max, took_ms);
    if (!answer.execution) return;
    ++report_.replans_taken;
    robots_.goOnWith(std::move(*answer.execution));
  }

  void tell() {
    places_.resize(instance_.robots());
    for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
      places_[robot] = {robots_.vertexOf(robot), robots_.nextOf(robot), robots_.progress(robot)};
    }
    options_.on_tick(places_);
  }

  void record() {
    for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
      report_.executed.paths[robot].push_back(robots_.heldVertex(robot));
    }
  }

  void conclude() {
    report_.unfinished = robots_.underWay();
    for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
      const double cost = static_cast<double>(robots_.arrival(robot)) / times_.move;
      report_.executed_sum_of_costs += cost;
      report_.executed_makespan = std::max(report_.executed_makespan, cost);
    }
    if (robot_steps_ > 0) {
      report_.delayed_share =
          static_cast<double>(delayed_steps_) / static_cast<double>(robot_steps_);
    }
    if (report_.replans > 0) report_.replan_cpu_ms_mean = replan_ms_ / report_.replans;
    report_.rings = static_cast<std::uint32_t>(robots_.graph().rings().size());
    report_.delay_intervals.insert(report_.delay_intervals.end(), open_delays_.begin(),
                                   open_delays_.end());
    trimToArrival(report_.executed);
    requireNoCollision();
  }

  /// What was executed is judged as any plan is, but for robots that are still under way.
  void requireNoCollision() const {
    for (const Violation& violation : validate(instance_, report_.executed)) {
      const bool under_way =
          std::binary_search(report_.unfinished.begin(), report_.unfinished.end(), violation.robot);
      if (violation.kind == ViolationKind::kWrongGoal && under_way) continue;
      throw std::logic_error("the simulation executed what is not valid: " + violation.message);
    }
  }

  const Instance& instance_;
  const SimulationOptions& options_;
  const Deadline& deadline_;
  MotionTimes times_;
  Delays delays_;
  StandingTimes standing_;
  std::optional<RestReplanner> replanner_;
  TickedExecution robots_;
  SimulationReport report_;
  std::uint32_t step_ = 0;
  std::uint64_t robot_steps_ = 0;  // until they arrived
  std::uint64_t delayed_steps_ = 0;
  double replan_ms_ = 0;
  std::vector<bool> was_delayed_;
  std::vector<DelayInterval> open_delays_;
  std::vector<RobotPlace> places_;
};

}  // namespace

SimulationReport simulate(const Instance& instance, const Plan& plan,
                          const SimulationOptions& options, const Deadline& deadline) {
  requireValid(options);
  const std::vector<Violation> violations = validate(instance, plan);
  if (!violations.empty()) {
    throw InputError("the plan is not valid: " + violations.front().message);
  }
  Plan trimmed = plan;
  trimToArrival(trimmed);
  return SimulationRun(instance, trimmed, options, deadline).run();
}

}  // namespace split_mapf
