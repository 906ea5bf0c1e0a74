#include "solver/ilp/plan_improver.h"

#include <algorithm>
#include <numeric>

namespace split_mapf::ilp {
namespace {

constexpr std::uint64_t kFewest = 2;
constexpr std::uint64_t kMost = 14;
constexpr std::uint32_t kWalks = 8;

std::uint32_t arrivalOf(const Path& path) { return static_cast<std::uint32_t>(path.size()) - 1; }

}  // namespace

PlanImprover::PlanImprover(const Instance& instance, std::uint64_t seed)
    : instance_(instance),
      engine_(seed),
      search_(instance.graph()),
      table_(instance.graph().size()) {}

Path PlanImprover::planAmongOthers(std::uint32_t robot, std::uint32_t latest_arrival,
                                   const Deadline& deadline) {
  SearchQuery query;
  query.robot = robot;
  query.start = instance_.start(robot);
  query.distances = &instance_.distances(robot);
  query.others = &table_;
  query.mode = OthersAre::kObstacles;
  query.latest_arrival = latest_arrival;
  SearchAnswer answer = search_.search(query, deadline);
  expansions_ += answer.expansions;
  return std::move(answer.path);
}

bool PlanImprover::isFree(std::uint32_t robot, const Path& path) const {
  bool free = true;
  forEachStay(path, [&](Vertex v, std::uint32_t begin, std::uint32_t end, Vertex next) {
    for (const Stay& stay : table_.at(v)) {
      if (stay.begin < end && begin < stay.end) free = false;
    }
    if (next != kNoVertex && table_.countSwaps(robot, v, next, end) > 0) free = false;
  });
  return free;
}

std::optional<Plan> PlanImprover::complete(const std::vector<UsedPath>& used,
                                           std::uint32_t latest_arrival, const Deadline& deadline) {
  std::vector<const UsedPath*> best(instance_.robots(), nullptr);
  for (const UsedPath& path : used) {
    if (best[path.robot] == nullptr || path.value > best[path.robot]->value) {
      best[path.robot] = &path;
    }
  }
  Robots order(instance_.robots());
  std::iota(order.begin(), order.end(), 0U);
  const auto certainty = [&](std::uint32_t robot) {
    return best[robot] == nullptr ? 0.0 : best[robot]->value;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return certainty(a) > certainty(b); });
  table_.clear();
  Plan plan;
  plan.paths.resize(instance_.robots());
  for (const std::uint32_t robot : order) {
    Path path;
    if (best[robot] != nullptr) {
      path = *best[robot]->path;
      path.resize(costOf(path) + std::size_t{1});
    }
    if (path.empty() || !isFree(robot, path)) {
      path = planAmongOthers(robot, latest_arrival, deadline);
    }
    if (path.empty()) return std::nullopt;
    table_.insert(robot, path);
    plan.paths[robot] = std::move(path);
  }
  return plan;
}

Plan PlanImprover::improve(Plan plan, std::uint64_t floor, std::uint64_t patience,
                           const Deadline& deadline) {
  trimToArrival(plan);
  table_.clear();
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) table_.insert(i, plan.paths[i]);
  std::uint64_t cost = sumOfCostsOf(plan);
  for (std::uint64_t idle = 0; idle < patience && cost > floor && !deadline.expired(); ++idle) {
    if (!replan(chooseNeighbourhood(plan), plan, deadline)) continue;
    const std::uint64_t now = sumOfCostsOf(plan);
    if (now < cost) idle = 0;
    cost = now;
  }
  return plan;
}

PlanImprover::Robots PlanImprover::chooseNeighbourhood(const Plan& plan) {
  const std::size_t most =
      std::min<std::size_t>(instance_.robots(), kFewest + drawBelow(engine_, kMost - kFewest + 1));
  Robots robots;
  const std::uint64_t kind = drawBelow(engine_, 10);
  if (kind < 7) {
    const std::uint32_t delayed = chooseDelayed(plan);
    robots.push_back(delayed);
    for (std::uint32_t walk = 0; walk < kWalks && robots.size() < most; ++walk) {
      addInTheWay(plan, delayed, most, robots);
    }
  } else if (kind < 9) {
    addAround(static_cast<Vertex>(drawBelow(engine_, instance_.graph().size())), most, robots);
  }
  while (robots.size() < std::min<std::size_t>(most, kFewest)) {
    add(static_cast<std::uint32_t>(drawBelow(engine_, instance_.robots())), robots);
  }
  shuffle(robots, engine_);
  return robots;
}

/// A robot that arrives later than it could alone, if there is one.
std::uint32_t PlanImprover::chooseDelayed(const Plan& plan) {
  std::uint64_t delay = 0;
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) {
    delay += arrivalOf(plan.paths[i]) - instance_.shortestLength(i);
  }
  if (delay == 0) return static_cast<std::uint32_t>(drawBelow(engine_, instance_.robots()));
  std::uint64_t drawn = drawBelow(engine_, delay);
  std::uint32_t robot = 0;
  while (true) {
    const std::uint64_t own = arrivalOf(plan.paths[robot]) - instance_.shortestLength(robot);
    if (drawn < own) return robot;
    drawn -= own;
    ++robot;
  }
}

/// Walks at random from some step of the robot's path on towards an earlier arrival, and collects
/// who stands in the way.
void PlanImprover::addInTheWay(const Plan& plan, std::uint32_t robot, std::size_t most,
                               Robots& robots) {
  const Path& path = plan.paths[robot];
  auto t = static_cast<std::uint32_t>(drawBelow(engine_, path.size()));
  Vertex at = path[t];
  const DistanceTable& distance = instance_.distances(robot);
  std::vector<Vertex> ways;
  while (robots.size() < most) {
    ways.clear();
    ++t;
    if (t + distance(at) < path.size() - 1) ways.push_back(at);
    for (const Vertex to : instance_.graph().neighbours(at)) {
      if (t + distance(to) < path.size() - 1) ways.push_back(to);
    }
    if (ways.empty()) return;
    const Vertex to = ways[drawBelow(engine_, ways.size())];
    addVisitors(to, t, most, robots);
    addVisitors(at, t, most, robots);  // who comes the other way is there by then
    at = to;
  }
}

void PlanImprover::addVisitors(Vertex v, std::uint32_t t, std::size_t most, Robots& robots) const {
  for (const Stay& stay : table_.at(v)) {
    if (stay.begin <= t && t < stay.end && robots.size() < most) add(stay.robot, robots);
  }
}

/// Robots that visit a vertex or its surroundings, nearest first.
void PlanImprover::addAround(Vertex centre, std::size_t most, Robots& robots) {
  std::vector<Vertex> queue = {centre};
  for (std::size_t head = 0; head < queue.size() && robots.size() < most; ++head) {
    for (const Stay& stay : table_.at(queue[head])) {
      if (robots.size() < most) add(stay.robot, robots);
    }
    for (const Vertex next : instance_.graph().neighbours(queue[head])) {
      if (std::find(queue.begin(), queue.end(), next) == queue.end()) queue.push_back(next);
    }
  }
}

bool PlanImprover::add(std::uint32_t robot, Robots& robots) const {
  if (std::find(robots.begin(), robots.end(), robot) != robots.end()) return false;
  robots.push_back(robot);
  return true;
}

/// Plans the robots anew in this order; keeps the result unless it costs more.
bool PlanImprover::replan(const Robots& robots, Plan& plan, const Deadline& deadline) {
  std::int64_t budget = 0;  // steps that may still be spent
  std::vector<Path> old;
  for (const std::uint32_t robot : robots) {
    table_.remove(robot, plan.paths[robot]);
    budget += arrivalOf(plan.paths[robot]) - instance_.shortestLength(robot);
    old.push_back(plan.paths[robot]);
  }
  std::size_t done = 0;
  for (; done < robots.size(); ++done) {
    const std::uint32_t robot = robots[done];
    const std::uint32_t shortest = instance_.shortestLength(robot);
    const auto latest = shortest + static_cast<std::uint32_t>(budget);
    Path path = planAmongOthers(robot, latest, deadline);
    if (path.empty()) break;
    budget -= arrivalOf(path) - shortest;
    table_.insert(robot, path);
    plan.paths[robot] = std::move(path);
  }
  if (done == robots.size()) return true;
  for (std::size_t i = 0; i < done; ++i) table_.remove(robots[i], plan.paths[robots[i]]);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    table_.insert(robots[i], old[i]);
    plan.paths[robots[i]] = std::move(old[i]);
  }
  return false;
}

}  // namespace split_mapf::ilp
