#include "split_mapf/pipeline/rest_replanner.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "pipeline/kept_schedule.h"
#include "search/departures.h"
#include "search/ejection_chain.h"
#include "search/neighbourhood_search.h"
#include "search/replan_singly.h"
#include "search/reservation_table.h"
#include "search/ring_breaking.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/validate.h"

namespace split_mapf {
namespace {

// Of what is left of the budget, for robots one at a time: the greatest gains come first.
constexpr std::uint64_t kSinglyOneIn = 3;
// What is done with each visit beside the searches (orders, checks, forecasts) takes as long as so
// many states; to take rings out so many more.
constexpr std::uint64_t kStatesAVisit = 2;
constexpr std::uint64_t kStatesAVisitOfRings = 2;
// So many visits that come to the table of paths, or go, take as long as a state.
constexpr std::uint64_t kChangesAState = 2;
// Visits cost no more than one in so many of the budget: of long plans something must be left to
// search.
constexpr std::uint64_t kVisitsOneIn = 2;
constexpr std::uint64_t kVisitsOfRingsOneIn = 4;
// A map is one of lanes when of its vertices more than one in so many have no third way.
constexpr std::uint32_t kLanesOneIn = 3;
constexpr std::uint32_t kPasses = 8;
// A schedule that more than one in so many robots have left is none.
constexpr std::size_t kUnplacedOneIn = 4;
// To find places for those costs at most one in so many states of what is left.
constexpr std::uint64_t kRepairOneIn = 3;
constexpr std::uint32_t kRepairSlack = 16;  // [steps]
constexpr std::uint32_t kRepairReach = 16;
constexpr std::size_t kRepairSearches = 200;  // for those who make room
constexpr double kStatesAPoll = 1024;

bool isOfLanes(const Graph& graph) {
  std::uint32_t lanes = 0;
  for (Vertex v = 0; v < graph.size(); ++v) lanes += graph.neighbours(v).size() <= 2 ? 1 : 0;
  return lanes > graph.size() / kLanesOneIn;
}

/// One call of RestReplanner::replan().
class RestRun {
 public:
  RestRun(const Instance& whole, bool is_of_lanes, const MotionTimes& times,
          const ReplanQuestion& question, const std::vector<std::uint64_t>& expected,
          const KeptSchedule& schedule, const Deadline& deadline)
      : whole_(whole),
        is_of_lanes_(is_of_lanes),
        times_(times),
        question_(question),
        expected_(expected),
        schedule_(schedule),
        graph_(*question.graph),
        deadline_(deadline),
        now_(forecastOf(graph_)),
        cut_(promised()),
        departures_(departuresBehindCut()),
        arrivals_(arrivalsOf(graph_, now_)) {
    answer_.cost_before = sumOfArrivals(graph_.precedence(), now_);
  }

  ReplanAnswer run(std::uint64_t expansions, std::uint64_t seed) {
    answer_.cost_after = answer_.cost_before;
    answer_.rings = ringsAhead();
    budget_ = expansions;
    const Precedence order = restBehind(graph_, cut_);
    visits_ = order.size();
    spent_ += std::min(costOfVisits(order.size()), budget_ / kVisitsOneIn);
    const bool has_rings = breaksRings() && !findRings(order).empty();
    Plan rest = soonest(order, has_rings);
    const Instance instance = instanceOf(rest);
    if (has_rings) rest = takeOutRings(instance, std::move(rest));
    Plan in_order = rest;
    std::optional<ReservationTable> table = keepToSchedule(instance, rest);
    if (!table) table.emplace(instance.graph().size(), rest, headway_);
    rest = improve(instance, std::move(rest), std::move(*table), seed);
    requireValid(instance, rest);
    answer_.expansions = work_.expansions;
    answer_.states = spent();
    judge(concatenate(graph_, cut_, rest));
    planned_.plan = std::move(answer_.execution ? rest : in_order);
    planned_.begin = beginOfRest();
    planned_.headway = headway_;
    return std::move(answer_);
  }

  /// What the execution to go on with has robots do.
  KeptSchedule& planned() { return planned_; }

  /// By robot, of the execution to go on with [ticks from now].
  const std::vector<std::uint32_t>& arrivals() const { return arrivals_; }

 private:
  /// Where a headway does not keep them away.
  bool avoidsRings() const { return breaksRings() && headway_ == 0; }

  bool breaksRings() const { return question_.avoid_rings && graph_.release() > 0; }

  Cut promised() const {
    Cut cut = cutBefore(graph_, now_, question_.commit);
    for (std::size_t robot = 0; robot < question_.promised.size(); ++robot) {
      cut[robot] = std::max(cut[robot], question_.promised[robot]);
    }
    return breaksRings() ? withoutRings(graph_, std::move(cut)) : cut;
  }

  /// The rest in this order, each visit as soon as it can be. Who follows another is planned a step
  /// behind: a little late, but what searches gain the robots gain, too, and nobody can rotate. In
  /// lanes, where robots queue, these gaps cost more than that.
  Plan soonest(const Precedence& order, bool has_rings) {
    headway_ = breaksRings() && !is_of_lanes_ && !has_rings ? 1 : 0;
    Plan rest = planOf(order, earliestSteps(order, departures_, {}, headway_));
    trimToArrival(rest);
    return rest;
  }

  /// Those that are there when half of what was left is spent stay for the next replan.
  Plan takeOutRings(const Instance& instance, Plan rest) {
    rest = breakRings(instance, std::move(rest), Departures(departures_), deadline_, &work_,
                      left() / 2);
    const Precedence order(rest, whole_.graph().size());
    spent_ += std::min(kStatesAVisitOfRings * order.size(), budget_ / kVisitsOfRingsOneIn);
    return soonest(order, !findRings(order).empty());
  }

  /// On the caller's clock.
  std::uint64_t beginOfRest() const { return question_.asked + question_.commit; }

  /// Has robots go on as they were meant to, if those that cannot find places among them.
  /// @return a table of the plan that `rest` is then.
  std::optional<ReservationTable> keepToSchedule(const Instance& instance, Plan& rest) {
    // Where rings have to be looked for, places that keep to the schedule gained nothing.
    if (avoidsRings() || schedule_.headway < headway_) return std::nullopt;
    const std::uint64_t ticks = beginOfRest() - std::min(beginOfRest(), schedule_.begin);
    if (ticks == 0 || ticks % times_.move != 0) return std::nullopt;
    const std::uint32_t vertices = instance.graph().size();
    ScheduleDraft draft = draftBySchedule(
        schedule_, rest, departures_, static_cast<std::uint32_t>(ticks / times_.move), vertices);
    if (draft.saved == 0 || draft.unplaced.size() > rest.paths.size() / kUnplacedOneIn) {
      return std::nullopt;
    }
    for (const std::uint32_t robot : draft.unplaced) draft.plan.paths[robot].clear();
    ReservationTable table(vertices, draft.plan, headway_);
    spent_ += visits_ / kChangesAState;
    for (const std::uint32_t robot : draft.unplaced) draft.plan.paths[robot] = rest.paths[robot];
    RepairStart start;
    start.spare = draft.saved;
    start.slack = kRepairSlack;
    start.reach = kRepairReach;
    start.searches = kRepairSearches + draft.unplaced.size();
    start.unplaced = std::move(draft.unplaced);
    for (std::uint32_t robot = 0; robot < question_.stands.size(); ++robot) {
      // Still when the rest begins.
      if (question_.stands[robot] > question_.commit) start.standing.push_back(robot);
    }
    EjectionChain chain(instance, kForever - 1, Departures(departures_));
    const bool is_whole = chain.repair(start, draft.plan, table, within(left() / kRepairOneIn));
    work_ += chain.work();
    if (!is_whole) return std::nullopt;
    for (PathChange& change : chain.changes()) {
      draft.plan.paths[change.robot] = std::move(change.path);
    }
    rest = std::move(draft.plan);
    return table;
  }

  Forecast forecastOf(const ExecutionGraph& graph) const {
    const bool turns = times_.turn > 0;
    return forecast(graph, times_,
                    turns ? quarterTurns(whole_.grid(), graph.precedence(), question_.came_from)
                          : std::vector<std::uint8_t>{},
                    question_.stands);
  }

  static std::vector<std::uint32_t> arrivalsOf(const ExecutionGraph& graph,
                                               const Forecast& forecast) {
    std::vector<std::uint32_t> arrivals;
    for (std::uint32_t robot = 0; robot < graph.precedence().robots(); ++robot) {
      arrivals.push_back(forecast.ends[graph.precedence().last(robot)]);
    }
    return arrivals;
  }

  /// In the steps of the rest, as which robots arrive when it is forecast.
  std::vector<std::uint32_t> expectedArrivals(const Plan& rest) const {
    std::vector<std::uint32_t> expected;
    if (expected_.empty()) return expected;
    for (std::uint32_t robot = 0; robot < rest.paths.size(); ++robot) {
      const std::uint64_t now = question_.asked + arrivals_[robot];
      const std::uint64_t late = now - std::min(now, expected_[robot]);
      const std::uint64_t late_steps = (late + times_.move - 1) / times_.move;
      const auto arrival = static_cast<std::uint32_t>(rest.paths[robot].size() - 1);
      expected.push_back(arrival -
                         static_cast<std::uint32_t>(std::min<std::uint64_t>(arrival, late_steps)));
    }
    return expected;
  }

  /// The steps behind the cut at which robots are done with what lies before it, and with standing.
  std::vector<std::uint32_t> departuresBehindCut() const {
    const std::uint32_t robots = graph_.precedence().robots();
    std::vector<std::uint32_t> departures(robots, 0);
    for (std::uint32_t robot = 0; robot < robots; ++robot) {
      std::uint32_t free = now_.ends[cut_[robot]];
      if (cut_[robot] == graph_.at(robot) && !question_.stands.empty()) {
        free = std::max(free, question_.stands[robot]);
      }
      if (free <= question_.commit) continue;
      departures[robot] = (free - question_.commit + times_.move - 1) / times_.move;
    }
    return departures;
  }

  Instance instanceOf(const Plan& rest) const {
    std::vector<Vertex> starts;
    std::vector<Vertex> goals;
    for (const Path& path : rest.paths) {
      starts.push_back(path.front());
      goals.push_back(path.back());
    }
    return Instance::stretchOf(whole_, starts, goals);
  }

  Plan improve(const Instance& instance, Plan rest, ReservationTable table, std::uint64_t seed) {
    const Departures departures(departures_);
    std::vector<std::uint32_t> expected = expectedArrivals(rest);
    ReplanEffort effort;
    effort.passes = kPasses;
    effort.departures = departures;
    effort.headway = headway_;
    effort.avoids_rings = avoidsRings();
    effort.table = &table;
    effort.work = &work_;
    changes_before_ = table.changes();
    const std::uint64_t until = spent() + left() / kSinglyOneIn;
    effort.go_on = [&, until](std::uint64_t, std::uint64_t) {
      chargeChanges(table);
      return spent() < until;
    };
    rest = replanSingly(instance, std::move(rest), effort, withinWhatIsLeft());
    const SearchWork before = work_;
    NeighbourhoodSearch search(instance, std::move(table), std::move(rest), kForever - 1, seed,
                               departures);
    search.expect(std::move(expected));
    const auto makes_no_ring = [&](const std::vector<PathChange>& changes) {
      return !avoidsRings() ||
             std::none_of(changes.begin(), changes.end(), [&](const PathChange& change) {
               return closesRing(search.table(), change.path);
             });
    };
    std::uint64_t delay = sumOfCostsOf(search.plan());
    for (const std::uint32_t step : departures.soonestArrivals(instance)) delay -= step;
    // What a try costs beside its states: robots are looked through for one that is late.
    const std::uint64_t look = 64 + instance.robots() / 16;
    while (delay > 0 && left() > 0 && !deadline_.expired()) {
      delay -= static_cast<std::uint64_t>(search.tryOne(withinWhatIsLeft(), makes_no_ring));
      work_ = before;
      work_ += search.work();
      chargeChanges(search.table());
      spent_ += look;
    }
    return search.plan();
  }

  /// With a table of them.
  static std::uint64_t costOfVisits(std::uint64_t visits) {
    return kStatesAVisit * visits + visits / kChangesAState;
  }

  /// Searches that expand few states still take paths out of the table and put them back.
  void chargeChanges(const ReservationTable& table) {
    spent_on_changes_ = (table.changes() - changes_before_) / kChangesAState;
  }

  /// In states.
  std::uint64_t spent() const { return spent_ + spent_on_changes_ + work_.states(); }

  std::uint64_t left() const { return budget_ - std::min(budget_, spent()); }

  /// Ends a search that has used up what is left, as one of many may take as much as all others.
  Deadline withinWhatIsLeft() const { return within(left()); }

  /// Searches look at the deadline once in kStatesAPoll states.
  Deadline within(std::uint64_t states) const {
    WorkClock of_a_poll;
    of_a_poll.tick();
    const double polls = static_cast<double>(states) / kStatesAPoll;
    return deadline_.countedBy(std::make_shared<WorkClock>()).within(polls * of_a_poll.nowSec());
  }

  void requireValid(const Instance& instance, const Plan& rest) const {
    const std::vector<Violation> violations = validate(instance, rest);
    if (!violations.empty()) {
      throw std::logic_error("a replan is not valid: " + violations.front().message);
    }
    for (std::uint32_t robot = 0; robot < rest.paths.size(); ++robot) {
      for (std::uint32_t t = 0; t <= departures_[robot]; ++t) {
        if (positionAt(rest.paths[robot], t) == rest.paths[robot].front()) continue;
        throw std::logic_error("a replan moves robot " + std::to_string(robot) +
                               " while it stands");
      }
    }
  }

  /// Takes an execution if it is cheaper by what is known. Where rings are to be avoided one that
  /// has fewer is the better one, as a ring may stop robots for good.
  void judge(ExecutionGraph joined) {
    const Forecast ahead = forecastOf(joined);
    const std::uint64_t cost = sumOfArrivals(joined.precedence(), ahead);
    const auto rings = static_cast<std::uint32_t>(joined.rings().size());
    const std::uint32_t rings_before = breaksRings() ? ringsAhead() : 0;
    const std::uint32_t rings_after = breaksRings() ? rings : 0;
    if (rings_after > rings_before) return;
    if (rings_after == rings_before && cost >= answer_.cost_before) return;
    arrivals_ = arrivalsOf(joined, ahead);
    answer_.cost_after = cost;
    answer_.rings = rings;
    answer_.execution.emplace(std::move(joined));
  }

  /// Of the execution as it stands, those that are not over.
  std::uint32_t ringsAhead() const {
    return static_cast<std::uint32_t>(
        std::count_if(graph_.rings().begin(), graph_.rings().end(), [this](const Ring& ring) {
          const std::uint32_t robot = graph_.precedence()[ring.front()].robot;
          return graph_.at(robot) < ring.front();
        }));
  }

  const Instance& whole_;
  const bool is_of_lanes_;
  const MotionTimes& times_;
  const ReplanQuestion& question_;
  const std::vector<std::uint64_t>& expected_;  // empty: nothing is
  const KeptSchedule& schedule_;                // of no robots: there is none yet
  const ExecutionGraph& graph_;
  const Deadline& deadline_;
  ReplanAnswer answer_;
  KeptSchedule planned_;
  Forecast now_;
  Cut cut_;
  std::vector<std::uint32_t> departures_;  // [steps] behind the cut
  std::vector<std::uint32_t> arrivals_;    // [ticks] from now
  std::uint64_t budget_ = 0;               // [states]
  SearchWork work_;                        // of all searches
  std::uint64_t spent_ = 0;                // beside that
  std::uint64_t visits_ = 0;               // of the rest
  std::uint64_t changes_before_ = 0;       // of the table, when it was made
  std::uint64_t spent_on_changes_ = 0;     // since then
  std::uint32_t headway_ = 0;              // [steps] that the plans of the rest keep
};

}  // namespace

RestReplanner::RestReplanner(const Instance& instance, const MotionTimes& times,
                             const ReplanBudget& budget)
    : instance_(instance),
      is_of_lanes_(isOfLanes(instance.graph())),
      times_(times),
      budget_(budget),
      schedule_(std::make_unique<KeptSchedule>()) {
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) instance.distances(robot);
  if (budget_.expansions == 0) {
    budget_.expansions = std::max(ReplanBudget::kLeastExpansions,
                                  ReplanBudget::kDefaultExpansions * instance.robots());
  }
}

RestReplanner::~RestReplanner() = default;

ReplanAnswer RestReplanner::replan(const ReplanQuestion& question, const Deadline& deadline) {
  RestRun run(instance_, is_of_lanes_, times_, question, expected_, *schedule_, deadline);
  ReplanAnswer answer = run.run(budget_.expansions, budget_.seed + replans_++);
  expect(run.arrivals(), question.asked);
  *schedule_ = std::move(run.planned());
  return answer;
}

void RestReplanner::expect(const std::vector<std::uint32_t>& arrivals, std::uint64_t asked) {
  const std::uint64_t passed = asked - std::min(asked, asked_);
  const bool is_first = expected_.empty();
  expected_.resize(arrivals.size(), 0);
  for (std::size_t robot = 0; robot < arrivals.size(); ++robot) {
    const std::uint64_t arrival = asked + arrivals[robot];
    expected_[robot] = is_first ? arrival : std::min(arrival, expected_[robot] + passed);
  }
  asked_ = asked;
}

}  // namespace split_mapf
