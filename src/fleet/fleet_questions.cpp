// What has to be replanned, and what becomes of the answers.

#include <algorithm>
#include <utility>

#include "core/standing_times.h"
#include "split_mapf/core/promises.h"
#include "split_mapf/fleet/fleet_execution.h"

namespace split_mapf {

namespace {

/// Visits beyond their promises up to which robots may go on while the rest is improved.
constexpr std::uint32_t kMeanwhile = 2;
/// Robots shall get on between plans made anew, whatever happens.
constexpr double kBetweenPlansSec = 0.2;
/// The same for windows of a rolling fleet, which are made in hundredths of a second.
constexpr double kBetweenWindowsSec = 0.02;

}  // namespace

std::optional<FleetQuestion> FleetExecution::ask(double now) {
  if (asked_ || restoring_ || all_paused_ || cancelled_) return std::nullopt;
  if (options_.rolling) return askRolling(now);
  if (!options_.plans_anew) return std::nullopt;
  bool goes_on = false;
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    goes_on = goes_on || (takesPart(robot) && !graph_.isDone(robot));
  }
  if (incident_) {
    const bool is_empty = robots_.empty() && joiners_.empty();
    if (now < next_anew_ || is_empty) return std::nullopt;
    return makeQuestion(true, now);
  }
  if (!goes_on || now < next_replan_) return std::nullopt;
  const bool stalled = !anyMayMove();
  const bool rings = rings_ > 0 && !options_.joint_rings && graph_.release() > 0;
  if (!stalled && !rings && !options_.replans) return std::nullopt;
  // What an earlier try could not take out another may, from other places and with another seed.
  const bool anew = stalled && questions_ > 0;
  FleetQuestion question = makeQuestion(anew, now);
  if (anew) ++stalls_;
  return question;
}

/// Once a step, and at once when something is new.
std::optional<FleetQuestion> FleetExecution::askRolling(double now) {
  if (incident_ ? now < next_anew_ : now < next_replan_ || !hasWork()) return std::nullopt;
  if (robots_.empty() && joiners_.empty()) return std::nullopt;
  FleetQuestion question = makeQuestion(true, now);
  next_replan_ = now + options_.step_sec;
  question.closed = closedCells();
  // Those that join make room like all others.
  for (std::size_t i = 0; i < question_joiners_; ++i) {
    question.closed[joiners_[i].at] = asked_blocked_[joiners_[i].at];
  }
  for (const Robot& robot : robots_) {
    question.numbers.push_back(robot.number);
    question.fresh.push_back(robot.fresh);
    question.ages.push_back(
        static_cast<std::uint32_t>(std::max(0.0, now - robot.goal_since) / options_.step_sec));
  }
  question_fresh_ = question.fresh;
  for (Robot& robot : robots_) robot.fresh = false;
  for (std::uint32_t i = 0; i < question_joiners_; ++i) {
    question.numbers.push_back(next_number_ + i);
  }
  question.fresh.resize(question.numbers.size(), true);
  question.ages.resize(question.numbers.size(), 0);
  return question;
}

/// Whether anybody is sent somewhere, or on its way.
bool FleetExecution::hasWork() const {
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (!takesPart(robot)) continue;
    const bool is_sent = robots_[robot].goal != kNoVertex && !robots_[robot].reached;
    if (is_sent || !graph_.isDone(robot)) return true;
  }
  return false;
}

void FleetExecution::setGoal(std::uint32_t robot, Vertex goal, double now) {
  Robot& record = robots_[robot];
  const bool is_there = goal == vertexOf(robot) && !isUnderWay(robot);
  record.reached = is_there;
  record.fault = GoalFault::kNone;
  record.goal_since = now;
  if (record.goal == goal) return;
  record.goal = goal;
  record.fresh = true;
  // Who stands where it is wanted, or is to stand, needs no plan.
  if (is_there || (goal == kNoVertex && graph_.isDone(robot))) return;
  incident_ = true;
}

FleetQuestion FleetExecution::makeQuestion(bool anew, double now) {
  question_at_.clear();
  question_void_.clear();
  std::vector<bool> takes_part;
  std::vector<bool> held_back;
  std::vector<Vertex> goals;
  std::vector<Vertex> came_from;
  std::vector<std::uint32_t> stands;
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    const Robot& record = robots_[robot];
    const VisitId at = graph_.at(robot);
    question_at_.push_back(at);
    question_void_.push_back(record.void_promise);
    takes_part.push_back(takesPart(robot));
    held_back.push_back(record.paused || record.void_promise || !takesPart(robot));
    goals.push_back(record.goal);
    came_from.push_back(graph_.precedence().isFirst(at) ? record.came_from
                                                        : graph_.precedence()[at - 1].vertex);
    stands.push_back(takesPart(robot) ? times_.move * standing_->expected(robot) : 0);
  }
  question_cut_ = promised_;
  if (!anew) {
    PromiseRule rule{options_.release_ahead + kMeanwhile, false, &closed_, &held_back};
    growPromises(graph_, rule, question_cut_);
  }
  question_joiners_ = anew ? joiners_.size() : 0;
  std::vector<Vertex> joiners;
  for (std::size_t i = 0; i < question_joiners_; ++i) {
    joiners.push_back(joiners_[i].at);
    goals.push_back(joiners_[i].goal);
  }
  std::vector<bool> blocked = closedCells();
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    // Who stands on a blocked cell may leave it.
    if (takes_part[robot]) blocked[graph_.precedence()[question_cut_[robot]].vertex] = false;
  }
  for (const Vertex at : joiners) blocked[at] = false;
  asked_ = true;
  asked_anew_ = anew;
  question_version_ = version_;
  question_openings_ = openings_;
  if (anew) incident_ = false;
  ReplanBudget budget = options_.budget;
  budget.seed += questions_++;
  const bool avoid = !options_.joint_rings;
  return {version_,
          anew,
          grid_,
          std::move(blocked),
          graph_,
          question_cut_,
          std::move(takes_part),
          std::move(goals),
          std::move(joiners),
          std::move(came_from),
          std::move(stands),
          times_,
          budget,
          avoid,
          ground_,
          !anyMayMove(),
          stalls_ > 0,
          closedEdges(),
          now,
          options_.step_sec};
}

bool FleetExecution::isUrgent() const {
  return asked_ && (!isAwaited() || (incident_ && (options_.rolling || !asked_anew_)));
}

void FleetExecution::take(FleetAnswer answer, double now) {
  asked_ = false;
  const bool is_old = answer.version != version_;
  if (is_old) {
    incident_ = incident_ || answer.anew;
    for (Robot& robot : robots_) robot.fresh = robot.fresh || options_.rolling;
    return;
  }
  ground_ = std::move(answer.ground);
  if (options_.rolling) next_anew_ = now + kBetweenWindowsSec;
  if (!options_.rolling) next_replan_ = now + options_.replan_period_sec;
  ++replans_;
  if (answer.anew && !answer.execution) return takeNothing(answer, now);
  rings_ = answer.rings;
  if (answer.anew) takeFaults(answer, now);
  if (!answer.execution) return;
  adopt(std::move(*answer.execution), now);
  for (std::size_t i = 0; i < question_joiners_; ++i) {
    robots_[robots_.size() - question_joiners_ + i].fault =
        answer.faults[answer.faults.size() - question_joiners_ + i];
  }
  closeCells();
  grow(now);
}

/// There is no plan: it is asked for again.
void FleetExecution::takeNothing(const FleetAnswer& answer, double now) {
  trouble_ = answer.message;
  ++failed_;
  incident_ = true;
  next_anew_ = now + (options_.rolling ? options_.step_sec : options_.replan_period_sec);
  for (std::size_t robot = 0; robot < question_fresh_.size(); ++robot) {
    if (question_fresh_[robot]) robots_[robot].fresh = true;
  }
}

/// Of a plan made anew.
void FleetExecution::takeFaults(const FleetAnswer& answer, double now) {
  failed_ = 0;
  trouble_.clear();
  // Where cells have opened since, there may be a way by now.
  const bool is_late = openings_ != question_openings_;
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    // Of a goal that it has no more.
    const bool is_over = robots_[robot].fresh;
    robots_[robot].fault = is_over ? GoalFault::kNone : answer.faults[robot];
    if (question_void_[robot]) robots_[robot].void_promise = false;
    if (is_late && answer.faults[robot] != GoalFault::kNone) incident_ = true;
  }
  if (options_.rolling) return;
  next_anew_ = now + std::min(kBetweenPlansSec, options_.step_sec);
  // Made in haste: to be improved at once.
  if (rings_ == 0) next_replan_ = now;
}

/// Goes on with what was planned behind the cut, from where robots are by now.
void FleetExecution::adopt(ExecutionGraph next, double now) {
  const Precedence& before = graph_.precedence();
  const Precedence& after = next.precedence();
  std::vector<std::uint32_t> sequences(after.size());
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (renumber(robot, next, question_cut_[robot], sequences)) changed_[robot] = true;
    const VisitId at = graph_.at(robot);
    if (!before.isFirst(at)) robots_[robot].came_from = before[at - 1].vertex;
    const VisitId first = after.first(robot);
    next.resumeAt(robot, first + at - question_at_[robot], graph_.progress(robot));
    promised_[robot] = first + promised_[robot] - question_at_[robot];
  }
  welcomeJoiners(question_joiners_, now);
  for (std::uint32_t robot = before.robots(); robot < after.robots(); ++robot) {
    promised_.push_back(after.first(robot));
    for (VisitId v = after.first(robot); v <= after.last(robot); ++v) {
      sequences[v] = robots_[robot].next_sequence++;
    }
  }
  graph_ = std::move(next);
  sequences_ = std::move(sequences);
  ++snapshot_version_;
}

/// Visits keep their numbers as long as they are the same; from the first one on that is not, all
/// have new ones. @return whether there are any.
bool FleetExecution::renumber(std::uint32_t robot, const ExecutionGraph& next, VisitId cut,
                              std::vector<std::uint32_t>& sequences) {
  const Precedence& before = graph_.precedence();
  const Precedence& after = next.precedence();
  VisitId old = question_at_[robot];
  bool same = true;
  for (VisitId v = after.first(robot); v <= after.last(robot); ++v, ++old) {
    const bool kept = old <= cut || !question_void_[robot];
    same = same && kept && old <= before.last(robot) && before[old].vertex == after[v].vertex;
    sequences[v] = same ? sequences_[old] : robots_[robot].next_sequence++;
  }
  return !same || old <= before.last(robot);
}

void FleetExecution::welcomeJoiners(std::size_t count, double now) {
  for (std::size_t i = 0; i < count; ++i) {
    Robot robot;
    robot.id = joiners_[i].id;
    robot.goal = joiners_[i].goal;
    robot.number = next_number_++;
    robot.heard = robot.moved = now;
    robot.planned_sec = now - began_;
    strangers_[joiners_[i].at] = false;
    robots_.push_back(std::move(robot));
    changed_.push_back(true);
  }
  joiners_.erase(joiners_.begin(), joiners_.begin() + static_cast<std::ptrdiff_t>(count));
  if (count > 0) standing_ = std::make_unique<StandingTimes>(robots());
}

}  // namespace split_mapf
