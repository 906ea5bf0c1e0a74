#include "split_mapf/pipeline/rolling.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "parallel/thread_budget.h"
#include "parallel/thread_team.h"
#include "pipeline/rolling/admission.h"
#include "pipeline/rolling/escorts.h"
#include "pipeline/rolling/improver.h"
#include "pipeline/rolling/progress.h"
#include "pipeline/rolling/rolling_question.h"
#include "pipeline/rolling/slopes.h"
#include "pipeline/rolling/window_base.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/fleet_check.h"

namespace split_mapf {
namespace {

using namespace rolling;

// Windows without a gain after which a robot is led on. An escort closes cells to all others, so
// where more than two cells in five are taken, and everybody stands for long, it comes later: but
// for robots that have been after their goal for so many windows.
constexpr std::uint32_t kPatience = 3;
constexpr std::uint32_t kCrowdedPatience = 10;
constexpr std::uint32_t kOldWindows = 20;
// Where a crowd flows, what is known is better than anything made anew.
constexpr std::uint32_t kSlowWindows = 2;
// Who gains nothing counts for more: once more every so many steps.
constexpr std::uint32_t kWeightEvery = 5;
constexpr std::uint32_t kMostWeight = 50;

// Windows by how full a map is [thousandths], measured; between these they fall evenly.
struct WindowAt {
  std::size_t fullness;
  std::uint32_t steps;
};
constexpr std::array<WindowAt, 4> kWindows = {{{200, 26}, {240, 20}, {300, 20}, {400, 13}}};

static_assert(RollingOptions::kMostWindow == kMostSteps);

RollingOptions checked(const RollingOptions& options) {
  if (options.window < 1 || options.window > RollingOptions::kMostWindow) {
    throw OptionError("a window of " + std::to_string(options.window) +
                      " steps was asked for; 1 to " + std::to_string(RollingOptions::kMostWindow) +
                      " are expected");
  }
  if (options.threads < 1) throw OptionError("0 threads were given; at least 1 is expected");
  return options;
}

/// Whether a robot is bound to steps, and all in one cell, as one that is delayed.
bool mayOnlyStand(const Path& prefix) {
  return prefix.size() > 1 && std::equal(prefix.begin() + 1, prefix.end(), prefix.begin());
}

}  // namespace

class Rolling::Run {
 public:
  Run(std::shared_ptr<const Grid> grid, const RollingOptions& options)
      : options_(checked(options)),
        grid_(std::move(grid)),
        graph_(*grid_),
        closed_(graph_.size(), false),
        budget_(std::min(options.threads, Improver::kBatch) - 1),
        team_(LentThreads(Improver::kBatch, budget_)),
        slopes_(graph_, options.cache_bytes),
        base_(graph_, closed_, options.seed),
        improver_(graph_, closed_, options.window, team_, options.seed),
        barred_(closed_),
        checker_(grid_) {
    window_.steps = options.window;
  }

  void begin(const RollingQuestion& question, std::uint32_t steps) {
    requireSound(question, *grid_, graph_, options_.window);
    now_ += steps;
    expansions_ = 0;
    closeVertices(question);
    escorts_.goOn(question, steps, closed_);
    is_crowded_ = 5 * question.robots.size() > std::size_t{2} * graph_.size();
    patience_ = is_crowded_ ? kCrowdedPatience : kPatience;
    orderRobots(question);
    readItineraries(question);
    admit(question);
    if (!stuck_.empty()) asked_ = question;
    barEscorts();
    bindRobots(question);
    window_.tracks.resize(question.robots.size());
    base_.make(starts_, order_, window_);
    improver_knows_ = false;
  }

  std::uint64_t improve(std::uint64_t expansions, const Deadline& deadline) {
    // All that a valid window does not need waits until one is there.
    if (!improver_knows_) {
      if (!stuck_.empty()) addEscorts();
      if (is_crowded_ && is_slow_) base_.renew(order_, window_);
      improver_.begin(window_);
    }
    improver_knows_ = true;
    // Held, as a small cache would throw them away before they are of use.
    slopes_.findAll(wanted_, team_, held_);
    wanted_.clear();
    const std::uint64_t done = improver_.improve(expansions, deadline);
    expansions_ += done;
    return done;
  }

  RollingAnswer answer() {
    RollingAnswer answer;
    answer.cut_off = cut_off_;
    answer.expansions = expansions_;
    answer.paths.reserve(window_.robots());
    for (std::uint32_t robot = 0; robot < window_.robots(); ++robot) {
      const Track& track = window_.tracks[robot];
      answer.paths.emplace_back(track.at.begin(), track.at.begin() + window_.steps + 1);
      std::uint32_t reached = 0;
      answer.cost += window_.itineraries[robot].lossOf(track, window_.steps, reached);
      answer.reached.push_back(reached);
    }
    answer.cost /= kStepCost;
    answer.escorts = escorts_.size();
    answer.resting = resting_;
    const std::optional<std::string> wrong = checker_.violation(answer.paths);
    if (wrong) throw std::logic_error("a window is not valid: " + *wrong);
    return answer;
  }

 private:
  void closeVertices(const RollingQuestion& question) {
    closed_.assign(graph_.size(), false);
    for (const Vertex v : question.blocked) closed_[v] = true;
    for (const RollingRobot& robot : question.robots) {
      if (!robot.may_move) closed_[robot.prefix.back()] = true;
    }
    if (slopes_.close(closed_)) progress_.measureAnew();
  }

  /// Those of first goals, without which there is no window.
  void findSlopes(const RollingQuestion& question) {
    std::vector<Vertex> goals;
    for (const RollingRobot& robot : question.robots) {
      if (!robot.goals.empty() && !slopes_.has(robot.goals.front())) {
        goals.push_back(robot.goals.front());
      }
    }
    if (!goals.empty()) slopes_.findAll(goals, team_, held_);
  }

  void readItineraries(const RollingQuestion& question) {
    held_before_.swap(held_);  // so that what is asked for again is still there
    held_.clear();
    findSlopes(question);
    cut_off_.clear();
    stuck_.clear();
    waiting_ = 0;
    resting_ = 0;
    is_slow_ = false;
    wanted_.clear();
    window_.itineraries.assign(question.robots.size(), Itinerary());
    std::uint32_t going = 0;
    for (const std::uint32_t robot : order_) {
      const RollingRobot& asked = question.robots[robot];
      Itinerary& itinerary = window_.itineraries[robot];
      const std::size_t held = held_.size();
      addGoals(asked, robot, itinerary);
      if (itinerary.count == 0 || !asked.may_move) {
        progress_.forget(asked.id);
      } else if (isHopeless(asked.id) || going++ < admission_.limit()) {
        weighDelay(asked, robot, *held_[held], itinerary);
      } else {
        progress_.rest(asked.id, now_);
        itinerary.count = 0;  // as one that is idle
        ++resting_;
      }
    }
    std::sort(cut_off_.begin(), cut_off_.end());
    held_before_.clear();
  }

  /// Whether nobody could lead a robot that is stuck. One that goes in a crowd takes no other's
  /// place, and is no sign of a jam: perhaps it can never arrive.
  bool isHopeless(std::uint32_t id) const {
    const std::uint32_t stuck = progress_.stuckFor(id, now_);
    return stuck >= kPatience * options_.window && escorts_.hasNone(id, stuck, now_);
  }

  /// Sees to how many of a crowd go from the next window on.
  void admit(const RollingQuestion& question) {
    if (!is_crowded_) return admission_.open();
    const auto robots = static_cast<std::uint32_t>(question.robots.size());
    admission_.note(robots, waiting_, now_, options_.window);
  }

  void weighDelay(const RollingRobot& asked, std::uint32_t robot, const Slope& slope,
                  Itinerary& itinerary) {
    // Not one that moves by what it is bound to, step by step: it may gain nothing all the same.
    const bool is_excused = mayOnlyStand(asked.prefix) && progress_.excuse(asked.id);
    const std::uint32_t stuck = progress_.stuckFor(asked.id, now_);
    itinerary.weight = 1 + std::min(kMostWeight, stuck / kWeightEvery);
    if (is_excused) return;
    is_slow_ = is_slow_ || stuck >= kSlowWindows * options_.window;
    if (stuck < kPatience * options_.window) return;
    waiting_ += isHopeless(asked.id) ? 0 : 1;
    const bool is_old = asked.age >= kOldWindows * options_.window;
    if (!is_old && stuck < patience_ * options_.window) return;
    const bool is_urgent = stuck >= kOldWindows * options_.window;
    stuck_.push_back({robot, stuck, &slope, progress_.best(asked.id), is_urgent});
  }

  /// As many as can be met within the window, and are at hand.
  void addGoals(const RollingRobot& asked, std::uint32_t robot, Itinerary& itinerary) {
    Vertex from = asked.prefix.front();
    std::uint32_t left = window_.steps;
    const auto most =
        static_cast<std::uint32_t>(std::min<std::size_t>(kMostGoals, asked.goals.size()));
    for (const Vertex goal : asked.goals) {
      std::shared_ptr<const Slope> slope =
          itinerary.count == 0 ? slopes_.find(goal) : slopes_.known(goal);
      if (!slope) {
        wanted_.push_back(goal);  // there is time for it once a window is there
        return;
      }
      const bool is_barred = closed_[goal] && from != goal;
      if (is_barred || !slope->reachable(from)) {
        if (itinerary.count == 0) cut_off_.push_back(robot);
        return;
      }
      itinerary.goals[itinerary.count] = goal;
      itinerary.slopes[itinerary.count++] = slope->data();
      if (itinerary.count == 1) {
        left -= std::min(left, progress_.note(graph_, asked.id, from, goal, *slope, now_));
      } else if (itinerary.count < most) {
        left -= slope->distance(graph_, from, left);
      }
      held_.push_back(std::move(slope));
      if (left == 0 || itinerary.count == most) return;
      from = goal;
    }
  }

  /// Finds escorts for those that are stuck, and makes the window anew if there are any.
  void addEscorts() {
    const std::uint32_t before = escorts_.size();
    escorts_.add(graph_, asked_, closed_, stuck_, now_, patience_ * options_.window);
    stuck_.clear();
    if (escorts_.size() == before) return;
    barEscorts();
    bindRobots(asked_);
    base_.make(starts_, order_, window_);
  }

  void barEscorts() {
    std::vector<bool> barred = closed_;
    escorts_.bar(barred);
    if (barred == barred_) return;
    barred_.swap(barred);
    base_.close(barred_);
    improver_.close(barred_);
  }

  /// To what the question says, or to an escort.
  void bindRobots(const RollingQuestion& question) {
    std::unordered_map<std::uint32_t, const Path*> escorted;
    for (const Escort& escort : escorts_.all()) {
      for (std::size_t i = 0; i < escort.members.size(); ++i) {
        escorted.emplace(escort.members[i], &escort.paths[i]);
      }
    }
    starts_.clear();
    for (std::uint32_t robot = 0; robot < question.robots.size(); ++robot) {
      const RollingRobot& asked = question.robots[robot];
      const auto escort = escorted.empty() ? escorted.end() : escorted.find(asked.id);
      // They agree as far as both go; what the robot is bound to beyond its escort is kept.
      const bool is_led = escort != escorted.end() && escort->second->size() >= asked.prefix.size();
      const Path* prefix = is_led ? escort->second : &asked.prefix;
      starts_.push_back({prefix, &asked.known});
      const auto free = static_cast<std::uint32_t>(prefix->size()) - 1;
      window_.itineraries[robot].free_from =
          asked.may_move ? std::min(free, window_.steps) : window_.steps;
    }
  }

  void orderRobots(const RollingQuestion& question) {
    order_.resize(question.robots.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      const RollingRobot& one = question.robots[a];
      const RollingRobot& two = question.robots[b];
      if (one.priority != two.priority) return one.priority > two.priority;
      if (one.age != two.age) return one.age > two.age;
      return a < b;
    });
  }

  RollingOptions options_;
  std::shared_ptr<const Grid> grid_;
  MoveGraph graph_;
  std::vector<bool> closed_;  // by vertex
  ThreadBudget budget_;       // beside the caller
  ThreadTeam team_;
  SlopeCache slopes_;
  WindowBase base_;
  Improver improver_;
  FleetWindow window_;
  bool improver_knows_ = false;                     // the window at hand
  std::vector<std::shared_ptr<const Slope>> held_;  // that the itineraries point to
  std::vector<std::shared_ptr<const Slope>> held_before_;
  std::vector<Vertex> wanted_;        // goals whose slopes the next window should have
  std::vector<std::uint32_t> order_;  // the most important robot first
  std::vector<std::uint32_t> cut_off_;
  Progress progress_;
  std::vector<StuckRobot> stuck_;
  RollingQuestion asked_;  // where somebody is stuck
  Escorts escorts_;
  std::vector<bool> barred_;  // by vertex: closed, or the region of an escort
  std::vector<WindowStart> starts_;
  FleetChecker checker_;
  Admission admission_;
  std::uint32_t waiting_ = 0;  // robots that have gained nothing for kPatience, not hopeless
  std::uint32_t resting_ = 0;
  bool is_crowded_ = false;
  bool is_slow_ = false;                // somebody has gained nothing for kSlowWindows
  std::uint32_t patience_ = kPatience;  // [windows]
  std::uint64_t now_ = 0;               // [steps]
  std::uint64_t expansions_ = 0;
};

std::uint32_t windowFor(std::size_t robots, std::size_t vertices) {
  const std::size_t fullness = vertices == 0 ? 0 : 1000 * robots / vertices;
  WindowAt below = kWindows.front();
  for (const WindowAt& above : kWindows) {
    if (fullness <= above.fullness) {
      if (above.steps == below.steps) return above.steps;
      const std::size_t part = (fullness - below.fullness) * (below.steps - above.steps);
      return below.steps - static_cast<std::uint32_t>(part / (above.fullness - below.fullness));
    }
    below = above;
  }
  return below.steps;
}

Rolling::Rolling(std::shared_ptr<const Grid> grid, const RollingOptions& options)
    : run_(std::make_unique<Run>(std::move(grid), options)) {}
Rolling::~Rolling() = default;

void Rolling::begin(const RollingQuestion& question, std::uint32_t steps) {
  run_->begin(question, steps);
}

std::uint64_t Rolling::improve(std::uint64_t expansions, const Deadline& deadline) {
  return run_->improve(expansions, deadline);
}

RollingAnswer Rolling::answer() { return run_->answer(); }

}  // namespace split_mapf
