#include "split_mapf/core/execution_forecast.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace split_mapf {
namespace {

// Ways that bend by less than 3 degrees go straight on: vertices lie in the middle of cells.
constexpr double kStraight = 0.05;

}  // namespace

std::uint8_t quarterTurns(const Grid& grid, Vertex from, Vertex at, Vertex to) {
  const Cell a = grid.cellOf(from);
  const Cell b = grid.cellOf(at);
  const Cell c = grid.cellOf(to);
  const double come_x = b.x - a.x;
  const double come_y = b.y - a.y;
  const double go_x = c.x - b.x;
  const double go_y = c.y - b.y;
  const double ahead = come_x * go_x + come_y * go_y;
  const double across = std::abs(come_x * go_y - come_y * go_x);
  if (ahead > 0 && across < kStraight * ahead) return 0;
  return ahead >= 0 ? 1 : 2;
}

std::vector<std::uint8_t> quarterTurns(const Grid& grid, const Precedence& precedence,
                                       const std::vector<Vertex>& came_from) {
  std::vector<std::uint8_t> turns(precedence.size(), 0);
  for (std::uint32_t robot = 0; robot < precedence.robots(); ++robot) {
    Vertex from = came_from.empty() ? kNoVertex : came_from[robot];
    for (VisitId v = precedence.first(robot); v < precedence.last(robot); ++v) {
      const Vertex at = precedence[v].vertex;
      if (from != kNoVertex) turns[v + 1] = quarterTurns(grid, from, at, precedence[v + 1].vertex);
      from = at;
    }
  }
  return turns;
}

namespace {

/// Events in plan order; those of a step that wait for each other from the first of them on.
class ForecastRun {
 public:
  ForecastRun(const ExecutionGraph& graph, const MotionTimes& times,
              const std::vector<std::uint8_t>& turns, const std::vector<std::uint32_t>& stands)
      : graph_(graph),
        order_(graph.precedence()),
        times_(times),
        turns_(turns),
        stands_(stands),
        settled_(order_.size(), kOpen) {
    result_.begins.assign(order_.size(), 0);
    result_.ends.assign(order_.size(), 0);
  }

  Forecast run() {
    for (std::uint32_t robot = 0; robot < order_.robots(); ++robot) settleThePast(robot);
    order_.forEachInPlanOrder([this](VisitId event) {
      if (settled_[event] == kOpen) settleChain(event);
    });
    return std::move(result_);
  }

 private:
  enum Settled : std::uint8_t { kOpen, kSettled, kUnderWay };

  std::uint32_t standOf(std::uint32_t robot) const { return stands_.empty() ? 0 : stands_[robot]; }

  void settleThePast(std::uint32_t robot) {
    const VisitId at = graph_.at(robot);
    for (VisitId v = order_.first(robot); v <= at; ++v) settled_[v] = kSettled;
    if (graph_.isDone(robot) || graph_.progress(robot) <= 0) return;
    const double left = (1 - static_cast<double>(graph_.progress(robot))) * times_.move;
    result_.ends[at + 1] =
        standOf(robot) + static_cast<std::uint32_t>(std::ceil(left - kRounding * times_.move));
    settled_[at + 1] = kUnderWay;
  }

  /// The soonest begin that the robot itself allows.
  std::uint32_t soonestOf(VisitId event) const {
    const std::uint32_t robot = order_[event].robot;
    const std::uint32_t turns = turns_.empty() ? 0 : turns_[event];
    const std::uint32_t stand = event == graph_.at(robot) + 1 ? standOf(robot) : 0;
    return std::max(result_.ends[event - 1], stand) + turns * times_.turn;
  }

  /// The soonest begin that the robot before it allows. @pre that one's event is settled.
  std::uint32_t releaseOf(VisitId event) const {
    std::uint32_t release = 0;
    graph_.forEachAwaited(event, [&](VisitId awaited, double fraction) {
      const std::uint32_t ends = result_.ends[awaited];
      if (ends <= release) return;  // as all of the past, at 0
      // In a convoy the follower keeps behind even one that has begun to leave.
      const bool may_have_left = settled_[awaited] == kUnderWay && graph_.release() > 0;
      if (may_have_left && graph_.hasDone(awaited, fraction)) return;
      // Counted from the end of its move: before, it may start slowly, or stand.
      const auto ticks = static_cast<std::uint32_t>(std::ceil(fraction * times_.move - kRounding));
      const std::uint32_t after = times_.move - ticks;
      release = std::max(release, ends > after ? ends - after : 0);
    });
    return release;
  }

  VisitId leaderOf(VisitId event) const {
    const VisitId awaited = order_.awaits(event);
    if (awaited == kNoVisit || settled_[awaited] != kOpen) return kNoVisit;
    return order_[awaited].step == order_[event].step ? awaited : kNoVisit;
  }

  void settleChain(VisitId event) {
    chain_.clear();
    VisitId leader = event;
    do {
      chain_.push_back(leader);
      leader = leaderOf(leader);
    } while (leader != kNoVisit && leader != event);
    if (leader == event) return settleRing();
    for (auto follower = chain_.rbegin(); follower != chain_.rend(); ++follower) {
      settle(*follower, std::max(soonestOf(*follower), releaseOf(*follower)));
    }
  }

  void settleRing() {
    std::uint32_t begin = 0;
    for (const VisitId event : chain_) {
      begin = std::max(begin, soonestOf(event));
      if (graph_.closeMoves()) begin = std::max(begin, releaseOf(event));
    }
    for (const VisitId event : chain_) settle(event, begin);
  }

  /// What it loses by starting from rest.
  std::uint32_t startOf(VisitId event, std::uint32_t begin) const {
    if (times_.start == 0) return 0;
    const bool rests = begin > result_.ends[event - 1] || order_.isFirst(event - 1);
    return rests ? times_.start : 0;
  }

  void settle(VisitId event, std::uint32_t begin) {
    result_.begins[event] = begin;
    result_.ends[event] = begin + startOf(event, begin) + times_.move;
    settled_[event] = kSettled;
  }

  static constexpr double kRounding = 1e-6;

  const ExecutionGraph& graph_;
  const Precedence& order_;
  const MotionTimes& times_;
  const std::vector<std::uint8_t>& turns_;
  const std::vector<std::uint32_t>& stands_;
  std::vector<Settled> settled_;
  std::vector<VisitId> chain_;
  Forecast result_;
};

}  // namespace

Forecast forecast(const ExecutionGraph& graph, const MotionTimes& times,
                  const std::vector<std::uint8_t>& turns,
                  const std::vector<std::uint32_t>& stands) {
  return ForecastRun(graph, times, turns, stands).run();
}

std::uint64_t sumOfArrivals(const Precedence& precedence, const Forecast& forecast) {
  std::uint64_t sum = 0;
  for (std::uint32_t robot = 0; robot < precedence.robots(); ++robot) {
    sum += forecast.ends[precedence.last(robot)];
  }
  return sum;
}

}  // namespace split_mapf
