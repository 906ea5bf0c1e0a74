#include "split_mapf/core/precedence.h"

#include <algorithm>
#include <utility>

namespace split_mapf {
namespace {

std::vector<Visit> visitsOf(const Plan& plan, const Deadline& deadline) {
  std::size_t count = 0;
  for (const Path& path : plan.paths) {
    deadline.require();
    for (std::size_t t = 0; t < path.size(); ++t) count += t == 0 || path[t] != path[t - 1] ? 1 : 0;
  }
  std::vector<Visit> visits;
  visits.reserve(count);
  for (std::uint32_t robot = 0; robot < plan.paths.size(); ++robot) {
    deadline.require();
    const Path& path = plan.paths[robot];
    for (std::uint32_t t = 0; t < path.size(); ++t) {
      if (t > 0 && path[t] == path[t - 1]) continue;
      visits.push_back({path[t], robot, t, kNoVisit, kNoVisit});
    }
  }
  return visits;
}

/// The event of the same step that an event awaits; kNoVisit if there is none.
VisitId leaderOf(const Precedence& precedence, VisitId event) {
  const VisitId leader = precedence.awaits(event);
  if (leader == kNoVisit || precedence[leader].step != precedence[event].step) return kNoVisit;
  return leader;
}

}  // namespace

Precedence::Precedence(const Plan& plan, std::uint32_t vertices, const Deadline& deadline)
    : Precedence(visitsOf(plan, deadline), vertices, deadline) {}

Precedence Precedence::fromVisits(std::vector<Visit> visits, std::uint32_t vertices) {
  return Precedence(std::move(visits), vertices, Deadline());
}

Precedence::Precedence(std::vector<Visit>&& visits, std::uint32_t vertices,
                       const Deadline& deadline)
    : vertices_(vertices), visits_(std::move(visits)) {
  for (VisitId v = 0; v < visits_.size(); ++v) {
    if (v == 0 || visits_[v].robot != visits_[v - 1].robot) first_.push_back(v);
  }
  first_.push_back(size());
  link(deadline);
}

/// By counting: steps are small numbers.
std::vector<VisitId> Precedence::inPlanOrder() const {
  std::uint32_t last = 0;
  for (const Visit& visit : visits_) last = std::max(last, visit.step);
  std::vector<std::uint32_t> place(last + std::size_t{2}, 0);
  for (const Visit& visit : visits_) ++place[visit.step + 1];
  for (std::size_t t = 1; t < place.size(); ++t) place[t] += place[t - 1];
  std::vector<VisitId> order(visits_.size());
  for (VisitId v = 0; v < visits_.size(); ++v) order[place[visits_[v].step]++] = v;
  return order;
}

void Precedence::link(const Deadline& deadline) {
  std::vector<VisitId> latest(vertices_, kNoVisit);
  SparsePoll poll(deadline);
  forEachInPlanOrder([&](VisitId v) {
    poll();
    VisitId& before = latest[visits_[v].vertex];
    visits_[v].before = before;
    if (before != kNoVisit) visits_[before].after = v;
    before = v;
  });
}

// An event awaits one other at most and is awaited by one at most, so events of a step that depend
// on each other form chains and rings, and no chain runs into a ring.
std::vector<Ring> findRings(const Precedence& precedence) {
  std::vector<bool> seen(precedence.size(), false);
  std::vector<Ring> rings;
  Ring chain;
  for (VisitId start = 0; start < precedence.size(); ++start) {
    chain.clear();
    VisitId event = start;
    while (event != kNoVisit && !seen[event]) {
      seen[event] = true;
      chain.push_back(event);
      event = leaderOf(precedence, event);
    }
    if (event == start && !chain.empty()) rings.push_back(chain);
  }
  std::stable_sort(rings.begin(), rings.end(), [&](const Ring& a, const Ring& b) {
    return precedence[a.front()].step < precedence[b.front()].step;
  });
  return rings;
}

Precedence inOneOrder(const Precedence& precedence) {
  std::vector<Visit> visits(precedence.size());
  std::vector<bool> has_step(precedence.size(), false);
  std::vector<VisitId> chain;
  std::uint32_t step = 0;
  for (const VisitId event : precedence.inPlanOrder()) {
    chain.clear();
    VisitId leader = event;
    while (leader != kNoVisit && !has_step[leader]) {
      has_step[leader] = true;
      chain.push_back(leader);
      leader = leaderOf(precedence, leader);
    }
    const bool is_ring = !chain.empty() && leader == event;
    for (auto v = chain.rbegin(); v != chain.rend(); ++v) {
      visits[*v] = precedence[*v];
      visits[*v].before = visits[*v].after = kNoVisit;
      visits[*v].step = step;
      if (!is_ring) ++step;
    }
    if (is_ring) ++step;
  }
  return Precedence::fromVisits(std::move(visits), precedence.vertices());
}

namespace {

/// Gives events their earliest steps in plan order, chains of a step from their leaders on.
class EarliestSchedule {
 public:
  EarliestSchedule(const Precedence& precedence, const std::vector<std::uint32_t>& departures,
                   const Deadline& deadline, std::uint32_t headway)
      : precedence_(precedence),
        departures_(departures),
        headway_(headway),
        poll_(deadline),
        steps_(precedence.size(), kOpen) {}

  std::vector<std::uint32_t> run() {
    precedence_.forEachInPlanOrder([this](VisitId event) {
      poll_();
      if (steps_[event] == kOpen) settleChain(event);
    });
    return std::move(steps_);
  }

 private:
  static constexpr std::uint32_t kOpen = 0xffffffffU;

  /// What the robot itself allows.
  std::uint32_t soonestOf(VisitId event) const {
    if (precedence_.isFirst(event)) return 0;
    const std::uint32_t robot = precedence_[event].robot;
    const std::uint32_t before = steps_[event - 1];
    const bool departs = precedence_.isFirst(event - 1) && !departures_.empty();
    return (departs ? std::max(before, departures_[robot]) : before) + 1;
  }

  void settleChain(VisitId event) {
    chain_.clear();
    VisitId leader = event;
    do {
      chain_.push_back(leader);
      leader = leaderOf(precedence_, leader);
    } while (leader != kNoVisit && steps_[leader] == kOpen && leader != event);
    if (leader == event) return settleRing();
    for (auto follower = chain_.rbegin(); follower != chain_.rend(); ++follower) settle(*follower);
  }

  void settle(VisitId event) {
    const VisitId awaited = precedence_.awaits(event);
    const std::uint32_t soonest = soonestOf(event);
    steps_[event] = awaited == kNoVisit ? soonest : std::max(soonest, steps_[awaited] + headway_);
  }

  void settleRing() {
    std::uint32_t soonest = 0;
    for (const VisitId event : chain_) soonest = std::max(soonest, soonestOf(event));
    for (const VisitId event : chain_) steps_[event] = soonest;
  }

  const Precedence& precedence_;
  const std::vector<std::uint32_t>& departures_;
  const std::uint32_t headway_;
  SparsePoll poll_;
  std::vector<std::uint32_t> steps_;
  std::vector<VisitId> chain_;
};

}  // namespace

std::vector<std::uint32_t> earliestSteps(const Precedence& precedence,
                                         const std::vector<std::uint32_t>& departures,
                                         const Deadline& deadline, std::uint32_t headway) {
  return EarliestSchedule(precedence, departures, deadline, headway).run();
}

Plan planOf(const Precedence& precedence, const std::vector<std::uint32_t>& steps) {
  Plan plan;
  plan.paths.resize(precedence.robots());
  for (std::uint32_t robot = 0; robot < precedence.robots(); ++robot) {
    Path& path = plan.paths[robot];
    path.reserve(steps[precedence.last(robot)] + std::size_t{1});
    for (VisitId v = precedence.first(robot); v < precedence.last(robot); ++v) {
      path.resize(steps[v + 1], precedence[v].vertex);
    }
    path.push_back(precedence[precedence.last(robot)].vertex);
  }
  return plan;
}

}  // namespace split_mapf
