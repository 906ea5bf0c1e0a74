#include "split/region_states.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace split_mapf {
namespace {

// Costs are whole numbers: this many a step.
constexpr std::uint32_t kAStep = 16;
// What distance to the goal weighs between cells that are equal otherwise, and the dice.
constexpr std::uint32_t kAStepOfProgress = 2;
constexpr std::uint32_t kDice = 4;
// A robot that has a phase to spare may stay in its region for want of room: steps of detour that
// leaving is worth. One that has none to spare pays for the phase that it adds.
constexpr std::uint32_t kLeavingIsWorth = 12 * kAStep;
constexpr std::uint32_t kPhaseTooMany = 40 * kAStep;
// Cells kept for the matching of one robot.
constexpr std::size_t kMostCandidates = 32;
constexpr std::uint32_t kDearest = 1U << 30;

/// A number that looks random and depends on nothing but its arguments.
std::uint32_t diceOf(std::uint64_t seed, std::uint32_t robot, Vertex v) {
  std::uint64_t x = seed * 0x9e3779b97f4a7c15ULL + (std::uint64_t{robot} << 32) + v;
  x ^= x >> 31;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 29;
  return static_cast<std::uint32_t>(x % kDice);
}

std::uint32_t weighted(double weight, double steps) {
  return static_cast<std::uint32_t>(
      std::min(weight * steps * kAStep, static_cast<double>(kDearest)));
}

std::uint32_t over(std::uint32_t value, std::uint32_t limit) {
  return std::max(value, limit) - limit;
}

}  // namespace

RegionStates::RegionStates(const Instance& instance, const Partition& partition,
                           const SpaceSplitOptions& options)
    : instance_(instance),
      partition_(partition),
      options_(options),
      regions_(partition),
      region_count_{regionCount(partition.ownerships[0]), regionCount(partition.ownerships[1])},
      nearest_(instance.robots()),
      used_(instance.graph().size(), false),
      seen_(instance.graph().size(), 0),
      walked_(instance.graph().size(), 0) {}

std::uint32_t RegionStates::phasesNeeded(std::uint32_t robot, Vertex from,
                                         std::uint32_t turn) const {
  const Vertex goal = instance_.goal(robot);
  if (from == goal) return 0;
  return 1 + regions_.hopsTo(goal, turn)[partition_.ownerships[turn][from]];
}

const std::uint32_t* RegionStates::nearest(std::uint32_t robot, const DistanceTable& to_goal,
                                           std::uint32_t turn) const {
  std::vector<std::uint32_t>& known = nearest_[robot];
  if (known.empty()) {
    known.assign(region_count_[0] + region_count_[1], DistanceTable::kUnreachable);
    for (Vertex v = 0; v < instance_.graph().size(); ++v) {
      const std::uint32_t distance = to_goal(v);
      std::uint32_t& even = known[partition_.ownerships[0][v]];
      std::uint32_t& odd = known[region_count_[0] + partition_.ownerships[1][v]];
      even = std::min(even, distance);
      odd = std::min(odd, distance);
    }
  }
  return known.data() + (turn == 0 ? 0 : region_count_[0]);
}

RegionStates::Rater RegionStates::raterFor(const RegionQuestion& question, std::uint32_t robot,
                                           const DistanceTable& to_goal) const {
  const Vertex from = (*question.from)[robot];
  Rater rater{};
  rater.robot = robot;
  rater.to_goal = &to_goal;
  rater.length = to_goal(from);
  rater.phases_now = phasesNeeded(robot, from, question.turn);
  rater.nearest_now =
      nearest(robot, to_goal, question.turn)[partition_.ownerships[question.turn][from]];
  rater.next_region = question.former != nullptr
                          ? partition_.ownerships[1 - question.turn][(*question.former)[robot]]
                          : kNoRegion;
  rater.next_hops = regions_.hopsTo(instance_.goal(robot), 1 - question.turn);
  rater.next_nearest = nearest(robot, to_goal, 1 - question.turn);
  return rater;
}

std::uint32_t RegionStates::narrowness(Vertex v) const {
  constexpr std::uint32_t kOpen = 4;
  const std::uint32_t exits = std::min(instance_.graph().neighbours(v).size(), kOpen);
  return (kOpen - exits) * (kOpen - exits);
}

std::uint32_t RegionStates::takenAround(Vertex v) const {
  std::uint32_t taken = used_[v] ? 1 : 0;
  for (const Vertex u : instance_.graph().neighbours(v)) taken += used_[u] ? 1 : 0;
  return taken;
}

std::uint32_t RegionStates::stayPenalty(const RegionQuestion& question, const Rater& rater,
                                        Vertex v) const {
  if (v == instance_.goal(rater.robot)) return 0;
  const std::uint32_t next = partition_.ownerships[1 - question.turn][v];
  const std::uint32_t needed = 1 + rater.next_hops[next];
  const std::uint32_t late = over(needed, question.phases_left - 1);
  if (late > 0) return late * kPhaseTooMany;
  const bool leaves = rater.phases_now <= 1 ? needed <= 1
                                            : needed < rater.phases_now ||
                                                  rater.next_nearest[next] < rater.nearest_now;
  return leaves ? 0 : kLeavingIsWorth;
}

std::uint32_t RegionStates::rate(const RegionQuestion& question, const Rater& rater, Vertex v,
                                 std::uint32_t walked) const {
  const std::uint32_t left = (*rater.to_goal)(v);
  const std::uint32_t excess = over(walked, question.share.piece) + over(left, question.share.rest);
  std::uint32_t cost = weighted(options_.lambda1, excess) +
                       kAStep * (walked + left - rater.length) + kAStepOfProgress * left +
                       stayPenalty(question, rater, v) +
                       diceOf(options_.seed + question.attempt, rater.robot, v);
  if (v == instance_.goal(rater.robot)) return cost;
  if (options_.assignment == StateAssignment::kGreedy) {
    const double closed = instance_.graph().neighbours(v).size() + 1.0;
    return cost + weighted(options_.lambda2, takenAround(v) / closed);
  }
  // Who takes what is decided at once, so density is foreseen: cells of one colour of a
  // chequerboard come first, and wide places before narrow ones, the more the more often a draw was
  // refused.
  const Cell cell = instance_.grid().cellOf(v);
  const auto field = static_cast<std::int32_t>(instance_.grid().longestMove());
  const double second_colour = ((cell.x / field + cell.y / field) & 1) != 0 ? 0.4 : 0;
  return cost +
         weighted(options_.lambda2, second_colour + narrowness(v) * (0.1 + 0.5 * question.attempt));
}

void RegionStates::rateAll(const RegionQuestion& question, std::uint32_t robot) {
  const HeldDistances to_goal = instance_.distances(robot);
  const Rater rater = raterFor(question, robot, *to_goal);
  const Ownership& ownership = *question.ownership;
  const Vertex from = (*question.from)[robot];
  ++search_number_;
  rated_.clear();
  queue_.assign(1, from);
  seen_[from] = search_number_;
  walked_[from] = 0;
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const Vertex v = queue_[head];
    const bool open = rater.next_region == kNoRegion ||
                      rater.next_region == partition_.ownerships[1 - question.turn][v];
    if (open && !used_[v]) rated_.push_back({v, rate(question, rater, v, walked_[v])});
    for (const Vertex u : instance_.graph().neighbours(v)) {
      if (seen_[u] == search_number_ || ownership[u] != question.region) continue;
      seen_[u] = search_number_;
      walked_[u] = walked_[v] + 1;
      queue_.push_back(u);
    }
  }
}

Vertex RegionStates::takeBest(const RegionQuestion& question, std::uint32_t robot) {
  rateAll(question, robot);
  const auto best =
      std::min_element(rated_.begin(), rated_.end(),
                       [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  if (best == rated_.end()) return kNoVertex;
  used_[best->vertex] = true;
  return best->vertex;
}

std::vector<std::uint32_t> RegionStates::servingOrder(const RegionQuestion& question) const {
  std::vector<std::uint32_t> order(question.robots.size());
  std::vector<std::uint32_t> length(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const std::uint32_t robot = question.robots[i];
    order[i] = i;
    length[i] = instance_.distances(robot)((*question.from)[robot]);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return length[a] > length[b]; });
  return order;
}

std::vector<Vertex> RegionStates::matchAll(const RegionQuestion& question,
                                           const Deadline& deadline) {
  std::vector<std::vector<Candidate>> candidates(question.robots.size());
  for (std::size_t i = 0; i < question.robots.size(); ++i) {
    if (deadline.expired()) return {};
    rateAll(question, question.robots[i]);
    const std::size_t kept = std::min(kMostCandidates, rated_.size());
    const auto cheaper = [](const Candidate& a, const Candidate& b) {
      return a.cost != b.cost ? a.cost < b.cost : a.vertex < b.vertex;
    };
    std::partial_sort(rated_.begin(), rated_.begin() + static_cast<std::ptrdiff_t>(kept),
                      rated_.end(), cheaper);
    candidates[i].assign(rated_.begin(), rated_.begin() + static_cast<std::ptrdiff_t>(kept));
  }
  return assignAtLeastCost(candidates);
}

std::vector<Vertex> RegionStates::choose(const RegionQuestion& question, const Deadline& deadline) {
  std::vector<Vertex> chosen(question.robots.size(), kNoVertex);
  if (options_.assignment == StateAssignment::kMatching) {
    chosen = matchAll(question, deadline);
    if (chosen.empty()) return {};
    for (const Vertex v : chosen) {
      if (v != kNoVertex) used_[v] = true;
    }
  }
  bool complete = true;
  for (const std::uint32_t i : servingOrder(question)) {
    if (chosen[i] != kNoVertex) continue;
    if (!deadline.expired()) chosen[i] = takeBest(question, question.robots[i]);
    complete = complete && chosen[i] != kNoVertex;
  }
  for (const Vertex v : chosen) {
    if (v != kNoVertex) used_[v] = false;
  }
  return complete ? chosen : std::vector<Vertex>();
}

}  // namespace split_mapf
