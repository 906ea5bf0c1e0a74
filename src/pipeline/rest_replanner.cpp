#include "split_mapf/pipeline/rest_replanner.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "search/departures.h"
#include "search/neighbourhood_search.h"
#include "search/replan_singly.h"
#include "search/ring_breaking.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/validate.h"

namespace split_mapf {
namespace {

// Of the budget, for robots one at a time: the greatest gains come first.
constexpr std::uint64_t kSinglyOneIn = 3;
constexpr std::uint32_t kPasses = 8;
constexpr double kStatesAPoll = 1024;

/// One call of RestReplanner::replan().
class RestRun {
 public:
  RestRun(const Instance& whole, const MotionTimes& times, const ReplanQuestion& question,
          const Deadline& deadline)
      : whole_(whole),
        times_(times),
        question_(question),
        graph_(*question.graph),
        deadline_(deadline),
        now_(forecastOf(graph_)),
        cut_(promised()),
        departures_(departuresBehindCut()) {
    answer_.cost_before = sumOfArrivals(graph_.precedence(), now_);
  }

  ReplanAnswer run(std::uint64_t expansions, std::uint64_t seed) {
    answer_.cost_after = answer_.cost_before;
    answer_.rings = ringsAhead();
    const Precedence order = restBehind(graph_, cut_);
    Plan rest = planOf(order, earliestSteps(order, departures_));
    trimToArrival(rest);
    const Instance instance = instanceOf(rest);
    if (breaksRings()) {
      rest = breakRings(instance, std::move(rest), Departures(departures_), deadline_,
                        &answer_.expansions);
    }
    rest = improve(instance, std::move(rest), expansions, seed);
    rest = compactRest(rest, order.vertices());
    requireValid(instance, rest);
    judge(concatenate(graph_, cut_, rest));
    return std::move(answer_);
  }

 private:
  bool breaksRings() const { return question_.avoid_rings && graph_.release() > 0; }

  Cut promised() const {
    Cut cut = cutBefore(graph_, now_, question_.commit);
    for (std::size_t robot = 0; robot < question_.promised.size(); ++robot) {
      cut[robot] = std::max(cut[robot], question_.promised[robot]);
    }
    return breaksRings() ? withoutRings(graph_, std::move(cut)) : cut;
  }

  Plan compactRest(const Plan& rest, std::uint32_t vertices) const {
    const Precedence order(rest, vertices);
    return planOf(order, earliestSteps(order, departures_));
  }

  Forecast forecastOf(const ExecutionGraph& graph) const {
    const bool turns = times_.turn > 0;
    return forecast(graph, times_,
                    turns ? quarterTurns(whole_.grid(), graph.precedence(), question_.came_from)
                          : std::vector<std::uint8_t>{},
                    question_.stands);
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

  Plan improve(const Instance& instance, Plan rest, std::uint64_t expansions, std::uint64_t seed) {
    const Departures departures(departures_);
    ReplanEffort effort;
    effort.passes = kPasses;
    effort.departures = departures;
    effort.avoids_rings = breaksRings();
    effort.go_on = [&](std::uint64_t more, std::uint64_t) {
      answer_.expansions += more;
      return answer_.expansions < expansions / kSinglyOneIn;
    };
    rest = replanSingly(instance, std::move(rest), effort, deadline_);
    const std::uint64_t before = answer_.expansions;
    NeighbourhoodSearch search(instance, std::move(rest), kForever - 1, seed, departures);
    const auto makes_no_ring = [&](const std::vector<PathChange>& changes) {
      if (!breaksRings()) return true;
      return std::none_of(changes.begin(), changes.end(), [&](const PathChange& change) {
        return closesRing(search.table(), change.path);
      });
    };
    std::uint64_t left = sumOfCostsOf(search.plan());
    for (const std::uint32_t step : departures.soonestArrivals(instance)) left -= step;
    // What a try costs beside its states: robots are looked through for one that is late.
    const std::uint64_t look = 64 + instance.robots() / 8;
    std::uint64_t looks = 0;
    const Deadline capped = withinBudget(expansions);
    while (left > 0 && answer_.expansions + looks < expansions && !deadline_.expired()) {
      left -= static_cast<std::uint64_t>(search.tryOne(capped, makes_no_ring));
      answer_.expansions = before + search.expansions();
      looks += look;
    }
    return search.plan();
  }

  /// Ends a try that has used up what is left, as one of many searches may take as much as all
  /// others: searches look at the deadline once in kStatesAPoll states.
  Deadline withinBudget(std::uint64_t expansions) const {
    const std::uint64_t left = expansions - std::min(expansions, answer_.expansions);
    WorkClock of_a_poll;
    of_a_poll.tick();
    const double polls = static_cast<double>(left) / kStatesAPoll;
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
    const std::uint64_t cost = sumOfArrivals(joined.precedence(), forecastOf(joined));
    const auto rings = static_cast<std::uint32_t>(joined.rings().size());
    const std::uint32_t rings_before = breaksRings() ? ringsAhead() : 0;
    const std::uint32_t rings_after = breaksRings() ? rings : 0;
    if (rings_after > rings_before) return;
    if (rings_after == rings_before && cost >= answer_.cost_before) return;
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
  const MotionTimes& times_;
  const ReplanQuestion& question_;
  const ExecutionGraph& graph_;
  const Deadline& deadline_;
  ReplanAnswer answer_;
  Forecast now_;
  Cut cut_;
  std::vector<std::uint32_t> departures_;  // [steps] behind the cut
};

}  // namespace

RestReplanner::RestReplanner(const Instance& instance, const MotionTimes& times,
                             const ReplanBudget& budget)
    : instance_(instance), times_(times), budget_(budget) {
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) instance.distances(robot);
  if (budget_.expansions == 0) {
    budget_.expansions = std::max(ReplanBudget::kLeastExpansions,
                                  ReplanBudget::kDefaultExpansions * instance.robots());
  }
}

ReplanAnswer RestReplanner::replan(const ReplanQuestion& question, const Deadline& deadline) {
  return RestRun(instance_, times_, question, deadline)
      .run(budget_.expansions, budget_.seed + replans_++);
}

}  // namespace split_mapf
