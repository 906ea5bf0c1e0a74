#include "search/placement.h"

#include <algorithm>
#include <utility>

namespace split_mapf {
namespace {

// Keeps the weight of a whole path within 32 bits.
constexpr std::uint32_t kMostQueued = 1000;
constexpr std::uint32_t kLongestDelay = 20;
// What is over sooner is no jam, whatever is foreseen: what few robots take of late says little.
constexpr std::uint64_t kLeastJam = 500000;
// In a hurry: a team with so many cells a robot takes one expansion a step of the robot's way
// before it hurries, one with twice as many two. Where there is room most paths are found so, and
// are the first to arrive; dense teams would look at half the rectangle between start and goal.
constexpr std::size_t kCellsAnExpansion = 16;
// After so many more it is greedy.
constexpr std::uint64_t kPatientAStep = 2;
// Then the search may take so many more until somebody is displaced.
constexpr std::uint64_t kHurriedAStep = 8;
constexpr std::uint64_t kHurried = 4000;

// Steps that a shortest way may have besides rows and columns where these stand in for distances: a
// look at a distance beside the way costs more there than what is searched in vain.
constexpr std::uint32_t kMostDetour = 8;

bool goesStraight(const Instance& instance, std::uint32_t robot) {
  const Grid& grid = instance.grid();
  if (!grid.hasUnitMoves()) return false;
  const Cell start = grid.cellOf(instance.start(robot));
  const Cell goal = grid.cellOf(instance.goal(robot));
  return instance.shortestLength(robot) <= rowsAndColumns(start, goal) + kMostDetour;
}

Hurry hurryOf(const Instance& instance, std::uint32_t length) {
  Hurry hurry;
  hurry.begin = instance.graph().size() / instance.robots() / kCellsAnExpansion * length;
  hurry.greedy = hurry.begin + kPatientAStep * length;
  hurry.end = hurry.begin + kHurriedAStep * length + kHurried;
  return hurry;
}

}  // namespace

Placement::Placement(const Instance& instance, const std::vector<std::uint32_t>& queue,
                     std::uint64_t seed, const LentThreads& threads, const Reservations* reserved)
    : instance_(instance),
      is_reserved_(reserved != nullptr && !reserved->empty()),
      engine_(seed),
      team_(threads),
      searches_(threads.most(), {EvictionSearch(instance.graph())}),
      table_(instance.graph().size()),
      queued_(instance.robots(), 0),
      weights_(instance.robots(), 1),
      placed_in_(instance.robots(), 0) {
  plan_.paths.resize(instance.robots());
  if (reserved != nullptr) {
    for (const Path& path : reserved->paths()) {
      table_.insert(static_cast<std::uint32_t>(weights_.size()), path);
      weights_.push_back(EvictionQuery::kFixed);
    }
  }
  for (const std::uint32_t robot : queue) requeue(robot);
}

Placement::Placement(const Instance& instance, const Plan& plan, std::uint32_t horizon,
                     std::uint64_t seed, const LentThreads& threads, const Reservations* reserved)
    : Placement(instance, {}, seed, threads, reserved) {
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Path& path = plan.paths[robot];
    if (path.size() - 1 > horizon) {
      requeue(robot);
    } else {
      plan_.paths[robot] = path;
      table_.insert(robot, path);
    }
  }
}

void Placement::requeue(std::uint32_t robot) {
  queue_.push_back(robot);
  queued_[robot] = std::min(queued_[robot] + 1, kMostQueued);
  weights_[robot] = queued_[robot] * queued_[robot];
}

void Placement::remove(std::uint32_t robot) {
  table_.remove(robot, plan_.paths[robot]);
  plan_.paths[robot].clear();
}

std::uint32_t Placement::drawDeparture(std::uint32_t robot, std::uint32_t horizon,
                                       std::uint32_t one_in) {
  // One that departs late might not come around what is reserved in time.
  if (is_reserved_ || one_in == 0 || drawBelow(engine_, one_in) > 0) return 0;
  const std::uint32_t length = instance_.shortestLength(robot);
  if (length == 0) return 0;  // its arrival is step 0, whatever it waits
  const std::uint32_t slack = horizon - length;
  return static_cast<std::uint32_t>(drawBelow(engine_, std::min(slack, kLongestDelay) + 1));
}

void Placement::drawBatch(std::uint32_t horizon, const Effort& effort) {
  batch_.resize(std::min(batch_size_.get(), queue_.size()));
  for (std::size_t i = 0; i < batch_.size(); ++i) {
    batch_[i].robot = queue_[i];
    batch_[i].departure = drawDeparture(queue_[i], horizon, effort.delayed_one_in);
  }
  ++batch_number_;
}

void Placement::searchBatch(std::uint32_t horizon, const Effort& effort, const Deadline& deadline) {
  team_.forEach(static_cast<std::uint32_t>(batch_.size()),
                [&](std::uint32_t i, std::uint32_t member) {
                  search(batch_[i], searches_[member].value, horizon, effort, deadline);
                });
}

void Placement::search(Candidate& candidate, EvictionSearch& search, std::uint32_t horizon,
                       const Effort& effort, const Deadline& deadline) const {
  EvictionQuery query;
  query.placed = &table_;
  query.weights = effort.displacements > 0 ? &weights_ : nullptr;
  query.hasty = effort.hasty;
  query.latest_arrival = horizon;
  query.start = instance_.start(candidate.robot);
  const HeldDistances distances = instance_.distances(candidate.robot);
  query.distances = &*distances;
  query.departure = candidate.departure;
  if (effort.hurries) {
    query.hurry = hurryOf(instance_, instance_.shortestLength(candidate.robot));
    if (goesStraight(instance_, candidate.robot)) query.rows_and_columns = &instance_.grid();
  }
  candidate.answer = search.search(query, deadline);
  if (!candidate.answer.cut_short) return;
  // It ends when there is none.
  const SearchWork work = candidate.answer.work;
  query.hurry.end = Hurry::kNever;
  candidate.answer = search.search(query, deadline);
  candidate.answer.work += work;
}

bool Placement::mayDisplace(const std::vector<std::uint32_t>& robots,
                            std::uint64_t displacements) const {
  return std::all_of(robots.begin(), robots.end(), [&](std::uint32_t robot) {
    return queued_[robot] - 1 < displacements;  // it waited once before it was placed first
  });
}

void Placement::tellWhenLate(const Effort& effort) {
  if (is_late_ || effort.on_late == nullptr || expansions_ <= effort.late_after) return;
  is_late_ = true;
  (*effort.on_late)();
}

bool Placement::isJammed(PlacementForecast& forecast, std::uint64_t jam_limit) const {
  if (jam_limit == 0) return false;
  const bool exceeds = forecast.exceeds(jam_limit, batch_.size(), queue_.size(), expansions_);
  return exceeds && expansions_ > kLeastJam;
}

/// @return whether the robot's turn is over: it is placed, or left over.
bool Placement::place(Candidate& candidate, std::uint64_t displacements) {
  Path& path = candidate.answer.path;
  if (path.empty()) {
    left_over_.push_back(candidate.robot);
    return true;
  }
  const std::vector<std::uint32_t> in_the_way = robotsInTheWay(table_.paths(), path);
  for (const std::uint32_t other : in_the_way) {
    if (placed_in_[other] == batch_number_) return false;
  }
  if (!mayDisplace(in_the_way, displacements)) {
    left_over_.push_back(candidate.robot);
    return true;
  }
  for (const std::uint32_t other : in_the_way) {
    remove(other);
    requeue(other);
  }
  table_.insert(candidate.robot, path);
  // Who was displaced once is likely to be again.
  if (queued_[candidate.robot] == 1) instance_.giveUpDistances(candidate.robot);
  placed_in_[candidate.robot] = batch_number_;
  plan_.paths[candidate.robot] = std::move(path);
  return true;
}

Placement::Outcome Placement::run(std::uint32_t horizon, const Effort& effort,
                                  const Deadline& deadline) {
  std::size_t fewest = queue_.size();
  std::vector<std::uint32_t> postponed;
  PlacementForecast forecast = PlacementForecast::ofCrowd(instance_.robots());
  PlacementForecast jam = PlacementForecast::ofJam(instance_.robots());
  for (std::uint64_t left = effort.patience; !queue_.empty();) {
    if (left == 0) return Outcome::kSpent;
    if (effort.expansion_limit > 0 && expansions_ > effort.expansion_limit) {
      return Outcome::kExhausted;
    }
    if (deadline.expired()) return Outcome::kInterrupted;
    drawBatch(horizon, effort);
    searchBatch(horizon, effort, deadline);
    queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(batch_.size()));
    postponed.clear();
    bool interrupted = false;
    for (Candidate& candidate : batch_) {
      expansions_ += candidate.answer.work.expansions;
      interrupted = interrupted || candidate.answer.interrupted;
      if (interrupted || !place(candidate, effort.displacements)) {
        postponed.push_back(candidate.robot);
      } else if (left > 0) {
        --left;
      }
    }
    queue_.insert(queue_.begin(), postponed.begin(), postponed.end());
    if (interrupted) return Outcome::kInterrupted;
    tellWhenLate(effort);
    batch_size_.adapt(batch_.size(), postponed.size());
    if (effort.forecasts && effort.expansion_limit > 0 &&
        forecast.exceeds(effort.expansion_limit, batch_.size(), queue_.size(), expansions_)) {
      return Outcome::kHopeless;
    }
    if (isJammed(jam, effort.jam_limit)) return Outcome::kJammed;
    if (queue_.size() < fewest) {
      fewest = queue_.size();
      left = effort.patience;
    }
  }
  return Outcome::kDone;
}

}  // namespace split_mapf
