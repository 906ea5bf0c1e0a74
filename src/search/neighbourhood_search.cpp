#include "search/neighbourhood_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "search/delayed_robots.h"

namespace split_mapf {

NeighbourhoodSearch::NeighbourhoodSearch(const Instance& instance, Plan plan,
                                         std::uint32_t latest_arrival, std::uint64_t seed,
                                         const Departures& departures, const Reservations* reserved,
                                         std::uint32_t headway)
    : NeighbourhoodSearch{instance,
                          tableOf(instance.graph().size(), plan, reserved, headway),
                          std::move(plan),
                          latest_arrival,
                          seed,
                          departures,
                          reserved != nullptr ? reserved->paths().size() : 0} {}

NeighbourhoodSearch::NeighbourhoodSearch(const Instance& instance, ReservationTable table,
                                         Plan plan, std::uint32_t latest_arrival,
                                         std::uint64_t seed, const Departures& departures,
                                         std::size_t reserved)
    : instance_(instance),
      departures_(departures),
      latest_arrival_(latest_arrival),
      picker_(instance, seed, departures),
      engine_(seed),
      search_(instance.graph()),
      chain_(instance, latest_arrival, departures, reserved),
      plan_(std::move(plan)),
      table_(std::move(table)) {}

void NeighbourhoodSearch::replace(std::uint32_t robot, Path path) {
  table_.remove(robot, plan_.paths[robot]);
  plan_.paths[robot] = std::move(path);
  table_.insert(robot, plan_.paths[robot]);
}

/// Exponentially distributed, so that a loss of so many steps is accepted as often as the
/// Metropolis rule accepts it.
std::uint64_t NeighbourhoodSearch::drawLoss(double temperature) {
  if (temperature <= 0) return 0;
  constexpr std::uint64_t kSteps = 1U << 20U;
  const double share = static_cast<double>(drawBelow(engine_, kSteps) + 1) / kSteps;
  return static_cast<std::uint64_t>(-temperature * std::log(share));
}

/// @return whether there is anything to gain.
bool NeighbourhoodSearch::pick(double temperature) {
  picker_.pick(plan_, table_.paths(), picked_);
  members_.clear();
  budget_ = loss_ = drawLoss(temperature);
  set_aside_ = 0;
  std::uint64_t least = 0;
  for (const std::uint32_t robot : picked_.robots) {
    const Path& path = plan_.paths[robot];
    if (departures_.holds(robot, path)) return false;
    Member member;
    member.robot = robot;
    member.kept = picked_.keptUntil(path, departures_(robot));
    member.cost = static_cast<std::uint32_t>(path.size() - 1);
    const std::uint32_t way = instance_.distances(robot)(path[member.kept]);
    const std::uint32_t soonest = way > 0 ? member.kept + way : beginOfStay(path, member.kept);
    member.set_aside = picked_.keeps ? member.cost : soonest;
    members_.push_back(member);
    budget_ += member.cost;
    set_aside_ += member.set_aside;
    least += soonest;
  }
  return least < budget_ - loss_;
}

Path NeighbourhoodSearch::search(const Member& member, std::uint32_t latest_arrival,
                                 const Deadline& deadline) {
  const Path& before = plan_.paths[member.robot];
  const HeldDistances distances = instance_.distances(member.robot);
  const GapQuery query = queryFrom(before, member.kept, *distances, table_, latest_arrival);
  table_.toggleHeadway(before, member.kept);
  GapAnswer answer = search_.search(query, deadline);
  work_ += answer.work;
  if (!answer.path.empty()) {
    std::copy_n(before.begin(), member.kept, answer.path.begin());
    while (answer.path.size() > 1 && *(answer.path.end() - 2) == answer.path.back()) {
      answer.path.pop_back();
    }
    waits_.place(table_, answer.path, member.kept);
  }
  table_.toggleHeadway(before, member.kept);
  return std::move(answer.path);
}

/// Of the next member, before what it set aside is taken back.
std::uint32_t NeighbourhoodSearch::latestArrival(const Member& member) const {
  std::uint64_t latest = budget_ - (set_aside_ - member.set_aside);
  if (changes_.empty() && !picked_.sideways) {
    latest = std::min<std::uint64_t>(latest, member.cost - 1);
  }
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(latest, latest_arrival_));
}

/// Members but the first go back to their paths where these are free, and are none any more.
void NeighbourhoodSearch::releaseWhoIsFree() {
  const auto release = [this](const Member& member) {
    const Path& path = plan_.paths[member.robot];
    table_.toggleHeadway(path, member.kept);
    const bool is_free = table_.isFree(path, member.kept);
    table_.toggleHeadway(path, member.kept);
    if (!is_free) return false;
    table_.insertTail(member.robot, path, member.kept);
    budget_ -= member.cost;
    set_aside_ -= member.set_aside;
    return true;
  };
  members_.erase(std::remove_if(members_.begin() + 1, members_.end(), release), members_.end());
}

/// What is left of the budget, beyond the loss that may be, is what was gained.
bool NeighbourhoodSearch::replan(const Deadline& deadline) {
  changes_.clear();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Member& member = members_[i];
    Path path = search(member, latestArrival(member), deadline);
    if (path.empty()) return false;
    budget_ -= path.size() - 1;
    set_aside_ -= member.set_aside;
    table_.insertTail(member.robot, path, member.kept);
    changes_.push_back({member.robot, std::move(path)});
    if (i == 0 && picked_.keeps) releaseWhoIsFree();
  }
  return true;
}

/// The old paths take the places of the new ones.
void NeighbourhoodSearch::undo() {
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    table_.removeTail(changes_[i].robot, changes_[i].path, members_[i].kept);
  }
  for (const Member& member : members_) {
    table_.insertTail(member.robot, plan_.paths[member.robot], member.kept);
  }
}

std::int64_t NeighbourhoodSearch::tryNeighbourhood(const Deadline& deadline, const Accept& accept,
                                                   double temperature) {
  if (!pick(temperature)) {
    picker_.reward(0, 0);
    return 0;
  }
  const std::uint64_t expansions_before = work_.expansions;
  for (const Member& member : members_) {
    table_.removeTail(member.robot, plan_.paths[member.robot], member.kept);
  }
  const bool taken = replan(deadline) && accept(changes_);
  if (taken) {
    for (PathChange& change : changes_) plan_.paths[change.robot] = std::move(change.path);
  } else {
    undo();
  }
  const std::int64_t gain =
      taken ? static_cast<std::int64_t>(budget_) - static_cast<std::int64_t>(loss_) : 0;
  picker_.reward(static_cast<std::uint64_t>(std::max<std::int64_t>(0, gain)),
                 work_.expansions - expansions_before);
  return gain;
}

std::int64_t NeighbourhoodSearch::tryChain(const Deadline& deadline, const Accept& accept,
                                           double temperature) {
  ChainStart start;
  start.robot = picker_.delayed().draw(plan_, engine_);
  if (departures_.holds(start.robot, plan_.paths[start.robot])) return 0;
  // Its waits may be far from what keeps it.
  start.path = soonestAlong(table_, plan_.paths[start.robot], departures_(start.robot));
  start.event = drawLostStep(start.path, instance_.distances(start.robot), engine_);
  start.reach = kChainReaches[chain_reaches_.draw(engine_)];
  start.searches = kChainSearches[chain_searches_.draw(engine_)];
  start.hasty = chain_hastes_.draw(engine_) == 1;
  start.loss = static_cast<std::uint32_t>(drawLoss(temperature));
  const bool placed = chain_.run(start, plan_, table_, deadline);
  const bool taken = placed && accept(chain_.changes());
  if (taken) {
    for (PathChange& change : chain_.changes()) plan_.paths[change.robot] = std::move(change.path);
  } else if (placed) {
    chain_.undo(plan_, table_);
  }
  return taken ? chain_.gain() : 0;
}

std::int64_t NeighbourhoodSearch::tryOne(const Deadline& deadline, const Accept& accept,
                                         double temperature) {
  const std::uint64_t expansions_before = expansions();
  const bool chain = methods_.draw(engine_) == kChain;
  const std::int64_t gain = chain ? tryChain(deadline, accept, temperature)
                                  : tryNeighbourhood(deadline, accept, temperature);
  const double rate = gainRate(static_cast<std::uint64_t>(std::max<std::int64_t>(0, gain)),
                               expansions() - expansions_before);
  methods_.reward(rate);
  if (chain) {
    chain_reaches_.reward(rate);
    chain_searches_.reward(rate);
    chain_hastes_.reward(rate);
  }
  return gain;
}

}  // namespace split_mapf
