#include "core/close_waits.h"

#include <vector>

namespace split_mapf {
namespace {

/// What the events of one robot wait for: of each other robot only the most that is not known to be
/// done by then.
class NewsOfARobot {
 public:
  explicit NewsOfARobot(std::uint32_t robots) : known_(robots), now_(robots) {}

  /// Of the next robot nothing is known.
  void forget() {
    for (const std::uint32_t robot : heard_of_) known_[robot] = {};
    heard_of_.clear();
  }

  void add(std::uint32_t robot, const CloseWaits::Wait& wait) {
    if (now_[robot].awaited == kNoVisit) touched_.push_back(robot);
    keepMost(now_[robot], wait);
  }

  void append(std::vector<CloseWaits::Wait>& waits) {
    for (const std::uint32_t robot : touched_) {
      if (known_[robot].awaited == kNoVisit) heard_of_.push_back(robot);
      if (keepMost(known_[robot], now_[robot])) waits.push_back(now_[robot]);
      now_[robot] = {};
    }
    touched_.clear();
  }

 private:
  /// @return whether that is more.
  static bool keepMost(CloseWaits::Wait& most, const CloseWaits::Wait& other) {
    const bool more = most.awaited == kNoVisit || most.awaited < other.awaited ||
                      (most.awaited == other.awaited && most.fraction < other.fraction);
    if (more) most = other;
    return more;
  }

  std::vector<CloseWaits::Wait> known_;  // by robot
  std::vector<CloseWaits::Wait> now_;    // by robot: of the event that is looked at
  std::vector<std::uint32_t> touched_;
  std::vector<std::uint32_t> heard_of_;
};

/// One call of findCloseWaits().
class WaitSearch {
 public:
  WaitSearch(const Precedence& precedence, const CloseMoves& moves)
      : order_(precedence),
        moves_(moves),
        latest_(moves.moves(), kNoVisit),
        begins_(precedence.size(), 0),
        ends_(precedence.size(), 0) {}

  CloseWaits run() {
    const std::vector<VisitId> events = order_.inPlanOrder();
    for (std::size_t i = 0, end = 0; i < events.size(); i = end) {
      // Those of a ring begin together.
      while (end < events.size() && order_[events[end]].step == order_[events[i]].step) ++end;
      for (std::size_t j = i; j < end; ++j) look(events[j]);
      for (std::size_t j = i; j < end; ++j) remember(events[j]);
    }
    return news();
  }

 private:
  MoveId moveInto(VisitId event) const {
    if (order_.isFirst(event)) return kNoMove;
    return moves_.moveOf(order_[event - 1].vertex, order_[event].vertex);
  }

  /// The last event of every close move, of those that come before in the plan.
  void look(VisitId event) {
    begins_[event] = static_cast<std::uint32_t>(found_.size());
    const MoveId move = moveInto(event);
    if (move != kNoMove) {
      for (const CloseMoves::Close& close : moves_.closeTo(move)) {
        const VisitId before = latest_[close.move];
        if (before == kNoVisit || order_[before].robot == order_[event].robot) continue;
        found_.push_back({before, close.release});
      }
    }
    ends_[event] = static_cast<std::uint32_t>(found_.size());
  }

  void remember(VisitId event) {
    const MoveId move = moveInto(event);
    if (move != kNoMove) latest_[move] = event;
  }

  CloseWaits news() const {
    CloseWaits result;
    result.first.reserve(order_.size() + std::size_t{1});
    result.first.push_back(0);
    NewsOfARobot news(order_.robots());
    for (VisitId event = 0; event < order_.size(); ++event) {
      if (order_.isFirst(event)) news.forget();
      for (std::uint32_t i = begins_[event]; i < ends_[event]; ++i) {
        news.add(order_[found_[i].awaited].robot, found_[i]);
      }
      news.append(result.all);
      result.first.push_back(static_cast<std::uint32_t>(result.all.size()));
    }
    return result;
  }

  const Precedence& order_;
  const CloseMoves& moves_;
  std::vector<VisitId> latest_;  // by move
  std::vector<CloseWaits::Wait> found_;
  std::vector<std::uint32_t> begins_;  // by event, in found_
  std::vector<std::uint32_t> ends_;
};

}  // namespace

CloseWaits findCloseWaits(const Precedence& precedence, const CloseMoves& moves) {
  return WaitSearch(precedence, moves).run();
}

}  // namespace split_mapf
