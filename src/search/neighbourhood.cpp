#include "search/neighbourhood.h"

#include <algorithm>
#include <utility>

namespace split_mapf {

std::uint32_t Neighbourhood::keptUntil(const Path& path, std::uint32_t departure) const {
  return std::max(departure, split_mapf::keptUntil(path, event, reach));
}

NeighbourhoodPicker::NeighbourhoodPicker(const Instance& instance, std::uint64_t seed,
                                         Departures departures)
    : instance_(instance),
      departures_(std::move(departures)),
      delayed_(departures_.soonestArrivals(instance)),
      engine_(seed),
      marks_(instance.robots(), 0) {}

std::uint32_t NeighbourhoodPicker::keptUntil(const Plan& plan, std::uint32_t robot,
                                             const Neighbourhood& picked) const {
  return picked.keptUntil(plan.paths[robot], departures_(robot));
}

void NeighbourhoodPicker::reward(std::uint64_t gain, std::uint64_t expansions) {
  const double rate = gainRate(gain, expansions);
  ways_.reward(rate);
  sizes_.reward(rate);
  reaches_.reward(rate);
  keeps_.reward(rate);
  if (expansions > 0) in_vain_ = gain > 0 ? 0 : in_vain_ + 1;
}

void NeighbourhoodPicker::add(std::uint32_t robot, std::vector<std::uint32_t>& robots) {
  if (marks_[robot] == pick_number_) return;
  marks_[robot] = pick_number_;
  robots.push_back(robot);
}

std::uint32_t NeighbourhoodPicker::drawStep(const Plan& plan, std::uint32_t robot,
                                            const Neighbourhood& picked) {
  const std::uint32_t kept = keptUntil(plan, robot, picked);
  const auto arrival = static_cast<std::uint32_t>(plan.paths[robot].size() - 1);
  const std::uint32_t last = std::max(kept, std::min(picked.event, arrival));
  return kept + static_cast<std::uint32_t>(drawBelow(engine_, last - kept + 1));
}

void NeighbourhoodPicker::addOccupants(const PathTable& table, Vertex v, std::uint32_t from,
                                       std::uint32_t to, std::size_t size,
                                       std::vector<std::uint32_t>& robots) {
  for (const Stay& stay : table.at(v)) {
    if (stay.begin > to || robots.size() >= size) return;
    if (stay.end > from && stay.robot < instance_.robots()) add(stay.robot, robots);
  }
}

void NeighbourhoodPicker::walkInTheWay(const Plan& plan, const PathTable& table,
                                       std::uint32_t robot, std::size_t size,
                                       Neighbourhood& picked) {
  const Path& path = plan.paths[robot];
  const HeldDistances distances = instance_.distances(robot);
  const auto cost = static_cast<std::uint32_t>(path.size() - 1);
  constexpr int kWalks = 10;
  for (int walk = 0; walk < kWalks && picked.robots.size() < size; ++walk) {
    std::uint32_t t = drawStep(plan, robot, picked);
    Vertex at = positionAt(path, t);
    while (picked.robots.size() < size) {
      // Any step from which the robot could still arrive earlier than it does.
      Vertex next = kNoVertex;
      std::uint64_t choices = 0;
      const auto consider = [&](Vertex v) {
        if (t + 1 + distances(v) < cost && drawBelow(engine_, ++choices) == 0) next = v;
      };
      for (const Vertex v : instance_.graph().neighbours(at)) consider(v);
      consider(at);
      if (next == kNoVertex) break;
      addOccupants(table, next, t, t + 1, size, picked.robots);
      at = next;
      ++t;
    }
  }
}

void NeighbourhoodPicker::takeAroundArrival(const Plan& plan, const PathTable& table,
                                            std::uint32_t robot, std::size_t size,
                                            Neighbourhood& picked) {
  const Path& path = plan.paths[robot];
  const HeldDistances distances = instance_.distances(robot);
  const auto cost = static_cast<std::uint32_t>(path.size() - 1);
  std::uint32_t t = keptUntil(plan, robot, picked);
  Vertex at = positionAt(path, t);
  // Who passes its goal when it could be there.
  addOccupants(table, path.back(), t + distances(at), cost, size, picked.robots);
  // Who stands on a shortest way to it.
  for (++t; distances(at) > 0 && picked.robots.size() < size; ++t) {
    Vertex next = kNoVertex;
    std::uint64_t choices = 0;
    for (const Vertex v : instance_.graph().neighbours(at)) {
      if (distances(v) < distances(at) && drawBelow(engine_, ++choices) == 0) next = v;
    }
    at = next;
    addOccupants(table, at, t - 1, t + 1, size, picked.robots);
  }
}

void NeighbourhoodPicker::takeCrowd(const Plan& plan, const PathTable& table, std::uint32_t robot,
                                    std::size_t size, Neighbourhood& picked) {
  const std::uint32_t t = drawStep(plan, robot, picked);
  std::vector<Vertex> queue = {positionAt(plan.paths[robot], t)};
  constexpr std::size_t kMostCells = 60;
  constexpr std::uint32_t kSpan = 3;
  for (std::size_t i = 0; i < queue.size() && picked.robots.size() < size; ++i) {
    addOccupants(table, queue[i], t > kSpan ? t - kSpan : 0, t + kSpan, size, picked.robots);
    for (const Vertex v : instance_.graph().neighbours(queue[i])) {
      if (queue.size() >= kMostCells) break;
      if (std::find(queue.begin(), queue.end(), v) == queue.end()) queue.push_back(v);
    }
  }
}

/// Who stands at its goal for now stays there; but for the first robot, which no other may replace.
void NeighbourhoodPicker::dropWhoStays(const Plan& plan, std::uint32_t first,
                                       std::vector<std::uint32_t>& robots) const {
  if (!departures_.any()) return;
  robots.erase(std::remove_if(robots.begin(), robots.end(),
                              [&](std::uint32_t robot) {
                                return robot != first &&
                                       departures_.holds(robot, plan.paths[robot]);
                              }),
               robots.end());
}

void NeighbourhoodPicker::pick(const Plan& plan, const PathTable& table, Neighbourhood& picked) {
  std::vector<std::uint32_t>& robots = picked.robots;
  robots.clear();
  ++pick_number_;
  const std::size_t way = ways_.draw(engine_);
  const std::size_t size = std::min<std::size_t>(kSizes[sizes_.draw(engine_)], instance_.robots());
  const std::uint32_t robot = delayed_.draw(plan, engine_);
  picked.reach = kReaches[reaches_.draw(engine_)];
  picked.event = drawLostStep(plan.paths[robot], instance_.distances(robot), engine_);
  picked.sideways = drawBelow(engine_, in_vain_ + instance_.robots()) < in_vain_;
  // Sideways it is the first robots' new ways that make the others look for new ones.
  picked.keeps = keeps_.draw(engine_) == 1 && !picked.sideways;
  add(robot, robots);
  if (way == kInTheWay) walkInTheWay(plan, table, robot, size, picked);
  if (way == kAroundArrival) takeAroundArrival(plan, table, robot, size, picked);
  if (way == kCrowd) takeCrowd(plan, table, robot, size, picked);
  if (way == kRandom) {
    while (robots.size() < size) {
      add(static_cast<std::uint32_t>(drawBelow(engine_, instance_.robots())), robots);
    }
  }
  dropWhoStays(plan, robot, robots);
  shuffle(robots, engine_);
  if (picked.sideways) return;
  std::swap(robots.front(), *std::find(robots.begin(), robots.end(), robot));
}

}  // namespace split_mapf
