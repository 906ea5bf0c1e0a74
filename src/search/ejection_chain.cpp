#include "search/ejection_chain.h"

#include <algorithm>
#include <utility>

#include "split_mapf/core/collision.h"

namespace split_mapf {
namespace {

// Keeps the weight of a path within 32 bits.
constexpr std::uint32_t kMostWeight = 1024;

}  // namespace

EjectionChain::EjectionChain(const Instance& instance, std::uint32_t latest_arrival,
                             Departures departures, std::size_t reserved)
    : instance_(instance),
      departures_(std::move(departures)),
      latest_arrival_(latest_arrival),
      search_(instance.graph()),
      weights_(instance.robots(), 1) {
  weights_.resize(weights_.size() + reserved, EvictionQuery::kFixed);
}

EjectionChain::Link& EjectionChain::linkOf(std::uint32_t robot) {
  const auto link = std::find_if(links_.begin(), links_.end(),
                                 [robot](const Link& known) { return known.robot == robot; });
  if (link != links_.end()) return *link;
  links_.push_back({robot, plan_->paths[robot]});
  return links_.back();
}

/// From its step `kept` on the robot has no place any more.
void EjectionChain::wait(std::size_t link, std::uint32_t kept) {
  Link& waiting = links_[link];
  table_->removeTail(waiting.robot, waiting.path, kept);
  waiting.kept = kept;
  waiting.waits = true;
  waiting_.push_back(link);
}

/// Takes a robot out of another's way.
void EjectionChain::eject(std::uint32_t robot, const Path& by, std::uint32_t reach) {
  Link& link = linkOf(robot);
  if (!link.waits) {
    spare_ += costOf(link.path) - oldCost(link);
    wait(static_cast<std::size_t>(&link - links_.data()),
         std::max(departures_(robot), keptUntil(link.path, firstInTheWay(by, link.path), reach)));
    return;
  }
  // It waits for its turn, and even what it keeps is in the way: it will begin at its start.
  table_->removeHead(robot, link.path, link.kept);
  table_->insert(robot, link.path);
  link.kept = departures_(robot);
  table_->removeTail(robot, link.path, link.kept);
}

/// The first step at whose end somebody is in the way. @pre somebody is.
std::uint32_t EjectionChain::firstInTheWay(const Path& by, const Path& path) const {
  return table_->headway() > 0 ? *firstFollowing(by, path) : *firstConflict(by, path);
}

/// Nobody is ejected from where it has to stand.
bool EjectionChain::mayAllBeEjected(std::size_t link, const Path& by) const {
  const std::uint32_t headway = table_->headway();
  if (!departures_.any() && headway == 0) return true;
  const std::vector<std::uint32_t> robots = robotsInTheWay(table_->paths(), by);
  return std::all_of(robots.begin(), robots.end(), [&](std::uint32_t robot) {
    if (robot == links_[link].robot) return true;
    const auto known = std::find_if(links_.begin(), links_.end(),
                                    [robot](const Link& other) { return other.robot == robot; });
    const Path& path = known != links_.end() ? known->path : plan_->paths[robot];
    if (departures_.holds(robot, path)) return false;
    const std::uint32_t held = departures_(robot) + headway;
    return held == 0 || firstInTheWay(by, path) > held;
  });
}

/// @param more  steps by which it may arrive later than before.
Path EjectionChain::search(const ChainStart& start, const Link& link, std::int64_t more,
                           bool may_eject, const Deadline& deadline) {
  const std::int64_t latest = std::min<std::int64_t>(oldCost(link) + more, latest_arrival_);
  if (latest < 0) return {};
  const HeldDistances distances = instance_.distances(link.robot);
  EvictionQuery query = {
      queryFrom(link.path, link.kept, *distances, *table_, static_cast<std::uint32_t>(latest))};
  query.weights = may_eject ? &weights_ : nullptr;
  query.hasty = start.hasty;
  table_->toggleHeadway(link.path, link.kept);
  GapAnswer answer = search_.search(query, deadline);
  table_->toggleHeadway(link.path, link.kept);
  work_ += answer.work;
  if (!answer.path.empty()) {
    std::copy_n(link.path.begin(), link.kept, answer.path.begin());
    while (answer.path.size() > 1 && *(answer.path.end() - 2) == answer.path.back()) {
      answer.path.pop_back();
    }
  }
  return std::move(answer.path);
}

/// What the next robot may cost more than before.
std::int64_t EjectionChain::mostMore(std::uint32_t slack) const {
  if (slack_ > 0) return std::min<std::int64_t>(spare_, slack);
  return links_.size() == 1 ? -1 : spare_;
}

void EjectionChain::weighMore(std::uint32_t robot) {
  std::uint32_t& weight = weights_[robot];
  if (weight != EvictionQuery::kFixed) weight = std::min(2 * weight, kMostWeight);
}

/// @return whether the robot that waits longest has a path now. Others may wait for theirs.
bool EjectionChain::placeNext(const ChainStart& start, const Deadline& deadline) {
  if (waiting_.size() > searches_left_) return false;
  const bool may_eject = waiting_.size() < searches_left_;
  --searches_left_;
  const std::size_t index = waiting_.front();
  Path path = search(start, links_[index], mostMore(slack_), may_eject, deadline);
  const std::uint32_t more_slack = RepairStart::kMoreSlack * slack_;
  if (path.empty() && mostMore(more_slack) > mostMore(slack_)) {
    path = search(start, links_[index], mostMore(more_slack), may_eject, deadline);
  }
  if (path.empty() || !mayAllBeEjected(index, path)) return false;
  waiting_.pop_front();
  const std::uint32_t robot = links_[index].robot;
  table_->removeHead(robot, links_[index].path, links_[index].kept);
  links_[index].waits = false;
  weighMore(robot);
  for (const std::uint32_t other : robotsInTheWay(table_->paths(), path)) {
    eject(other, path, start.reach);
  }
  Link& link = links_[index];
  link.path = std::move(path);
  table_->insert(robot, link.path);
  spare_ -= costOf(link.path) - oldCost(link);
  return true;
}

bool EjectionChain::placeAll(const ChainStart& start, const Deadline& deadline) {
  links_.clear();
  waiting_.clear();
  searches_left_ = start.searches;
  spare_ = loss_ = start.loss;
  table_->remove(start.robot, plan_->paths[start.robot]);
  table_->insert(start.robot, start.path);
  links_.push_back({start.robot, start.path});
  wait(0, std::max(departures_(start.robot), keptUntil(start.path, start.event, start.reach)));
  while (!waiting_.empty()) {
    if (!placeNext(start, deadline)) return false;
  }
  return true;
}

/// Leaves waits where they disturb least.
void EjectionChain::finish() {
  changes_.clear();
  for (Link& link : links_) {
    table_->remove(link.robot, link.path);
    waits_.place(*table_, link.path);
    table_->insert(link.robot, link.path);
  }
  for (Link& link : links_) changes_.push_back({link.robot, std::move(link.path)});
}

bool EjectionChain::run(const ChainStart& start, const Plan& plan, ReservationTable& table,
                        const Deadline& deadline) {
  plan_ = &plan;
  table_ = &table;
  const bool placed = placeAll(start, deadline);
  for (const Link& link : links_) weights_[link.robot] = 1;
  if (placed) {
    finish();
    return true;
  }
  for (const Link& link : links_) {
    if (link.waits) {
      table.removeHead(link.robot, link.path, link.kept);
    } else {
      table.remove(link.robot, link.path);
    }
  }
  for (const Link& link : links_) table.insert(link.robot, plan.paths[link.robot]);
  return false;
}

bool EjectionChain::repair(const RepairStart& start, const Plan& plan, ReservationTable& table,
                           const Deadline& deadline) {
  plan_ = &plan;
  table_ = &table;
  links_.clear();
  waiting_.clear();
  searches_left_ = start.searches;
  spare_ = static_cast<std::int64_t>(start.spare);
  loss_ = 0;
  slack_ = start.slack;
  const std::vector<std::uint32_t> weights = weights_;
  for (const std::uint32_t robot : start.standing) weights_[robot] = EvictionQuery::kFixed;
  for (const std::uint32_t robot : start.unplaced) {
    // Where it stands, for as long as that is known.
    links_.push_back({robot, Path(departures_(robot) + std::size_t{1}, plan.paths[robot].front())});
    table.insert(robot, links_.back().path);
    wait(links_.size() - 1, departures_(robot));
  }
  ChainStart chain;
  chain.reach = start.reach;
  bool placed = true;
  while (placed && !waiting_.empty()) placed = placeNext(chain, deadline);
  weights_ = weights;
  slack_ = 0;
  if (placed) finish();
  return placed;
}

void EjectionChain::undo(const Plan& plan, ReservationTable& table) {
  for (const PathChange& change : changes_) table.remove(change.robot, change.path);
  for (const PathChange& change : changes_) table.insert(change.robot, plan.paths[change.robot]);
}

}  // namespace split_mapf
