#include "solver/lacam/crowd_guides.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "solver/lacam/swap_rule.h"

namespace split_mapf {
namespace {

// Robots that choose side by side, so that none of them sees the others' new ways.
constexpr std::uint32_t kBatch = 8;
// Prices in tenths of a step: of ways that are not known, beside their distance, and of cells where
// somebody stands that is under way, or at home.
constexpr std::uint32_t kOffTheWays = 100;
constexpr std::uint32_t kTaken = 3;
constexpr std::uint32_t kTakenAtHome = 6;
// Who has waited as long pushes whomever it meets.
constexpr std::uint32_t kPatience = 20;
constexpr std::uint32_t kMostLoss = 10000;

}  // namespace

CrowdGuides::CrowdGuides(const Instance& instance, const RobotDistances& distances,
                         const CrowdState& state, const CrowdGuideOptions& options)
    : instance_(instance),
      distances_(distances),
      state_(state),
      rounds_(options.rounds),
      engine_(options.seed),
      passes_(instance),
      traffic_(instance),
      guides_(instance.robots()),
      ways_(instance.robots()),
      team_(options.threads.atMost(std::min(kBatch, options.threads.most()))),
      searches_(team_.threads(),
                {PricedSearch(instance, distances, passes_, traffic_, options.margin)}),
      searched_(kBatch) {}

bool CrowdGuides::renew(const Deadline& deadline, std::uint64_t most) {
  keepRestOfGuides();
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) {
    if (state_.isAway(i)) order.push_back(i);
  }
  for (std::uint64_t rounds = std::exchange(rounds_, 1); rounds > 0; --rounds) {
    shuffle(order, engine_);
    for (std::size_t first = 0; first < order.size(); first += kBatch) {
      if (deadline.expired() || (most > 0 && expansions_ > most)) return false;
      const std::size_t count = std::min<std::size_t>(kBatch, order.size() - first);
      chooseBatch(order.data() + first, static_cast<std::uint32_t>(count));
    }
  }
  return true;
}

void CrowdGuides::keepRestOfGuides() {
  passes_.clear();
  traffic_.clear();
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) {
    Path& guide = guides_[i];
    guide.erase(guide.begin(), std::find(guide.begin(), guide.end(), state_.at[i]));
    if (!state_.isAway(i)) forget(i);
    const std::uint32_t soonest = state_.step + Traffic::delayed(distances_(i, state_.at[i]));
    passes_.setArrival(i, state_.isAway(i) ? soonest : state_.home_since[i]);
    putIn(i);
  }
}

void CrowdGuides::chooseBatch(const std::uint32_t* robots, std::uint32_t count) {
  for (std::uint32_t k = 0; k < count; ++k) takeOut(robots[k]);
  team_.forEach(count, [&](std::uint32_t k, std::uint32_t member) {
    const std::uint32_t robot = robots[k];
    PricedSearch& search = searches_[member].value;
    search.find(robot, state_.at[robot], state_.step);
    search.copyWaysTo(ways_[robot]);
    guides_[robot] = search.guide();
    searched_[k] = search.expansions();
  });
  for (std::uint32_t k = 0; k < count; ++k) {
    putIn(robots[k]);
    expansions_ += searched_[k];
  }
}

void CrowdGuides::takeOut(std::uint32_t robot) {
  const Path& guide = guides_[robot];
  traffic_.remove(guide);
  for (std::size_t k = 1; k < guide.size(); ++k) passes_.remove(guide[k], robot);
}

void CrowdGuides::putIn(std::uint32_t robot) {
  const Path& guide = guides_[robot];
  traffic_.insert(guide);
  for (std::uint32_t k = 1; k < guide.size(); ++k) {
    passes_.insert(guide[k], robot, state_.step + Traffic::delayed(k));
  }
  if (guide.empty() || guide.back() != instance_.goal(robot)) return;
  const auto steps = static_cast<std::uint32_t>(guide.size() - 1);
  passes_.setArrival(robot, state_.step + Traffic::delayed(steps));
}

std::uint32_t CrowdGuides::priceOf(std::uint32_t robot, Vertex v, std::uint32_t occupant) const {
  std::uint32_t price = state_.isAway(robot) ? ways_[robot](v) : PricedWays::kUnknown;
  if (price == PricedWays::kUnknown) {
    price = PricedSearch::kStep * distances_(robot, v) + (state_.isAway(robot) ? kOffTheWays : 0);
  }
  if (occupant == kNoRobot || occupant == robot) return price;
  return price + priceOfPush(robot, v, occupant);
}

std::uint32_t CrowdGuides::priceOfPush(std::uint32_t robot, Vertex v,
                                       std::uint32_t occupant) const {
  if (state_.isAway(occupant)) return kTaken;
  const std::uint32_t waited = std::min(state_.waited[robot], kPatience);
  const std::uint32_t loss =
      std::min(kMostLoss, passes_.lossNow(v, state_.home_since[occupant], state_.step));
  return kTakenAtHome + PricedSearch::kStep * loss * (kPatience - waited) / kPatience;
}

}  // namespace split_mapf
