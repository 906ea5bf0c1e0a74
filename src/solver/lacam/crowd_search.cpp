#include "solver/lacam/crowd_search.h"

#include <algorithm>
#include <utility>

#include "solver/lacam/crowd_walk.h"

namespace split_mapf {
namespace {

// Ways by prices may be so many times as much longer than the shortest as those of other guidance.
constexpr std::uint64_t kMargins = 4;

CrowdWalkOptions walkOptions(const LacamSettings& settings, const LentThreads& threads) {
  CrowdWalkOptions options;
  options.interval = settings.guide_again;
  options.expansion_limit = settings.expansion_limit;
  options.guides.rounds = settings.guidance.value_or(options.guides.rounds);
  options.guides.margin = static_cast<std::uint32_t>(kMargins * settings.margin);
  options.guides.seed = settings.seed;
  options.guides.threads = threads;
  return options;
}

/// From where the walk ends. Few are away, so paths through space would be of no use.
LacamSettings settingsOfRest(LacamSettings settings, std::uint64_t expansions) {
  settings.guidance = 0;
  if (settings.expansion_limit > 0) {
    settings.expansion_limit -= std::min(settings.expansion_limit - 1, expansions);
  }
  return settings;
}

void append(const Plan& rest, Plan& plan) {
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    const Path& path = rest.paths[i];
    plan.paths[i].insert(plan.paths[i].end(), path.begin() + 1, path.end());
  }
}

}  // namespace

CrowdSearchResult searchCrowd(const Instance& instance, const LacamSettings& settings,
                              const LentThreads& threads, const Deadline& deadline) {
  CrowdSearchResult result;
  Configuration end;
  {  // its tables are free before the next are held
    CrowdWalk walk(instance, walkOptions(settings, threads), deadline);
    const CrowdWalk::Outcome outcome = walk.run();
    result.expansions = walk.expansions();
    if (outcome == CrowdWalk::Outcome::kSpent) result.outcome = LacamSearch::Outcome::kSpent;
    if (outcome != CrowdWalk::Outcome::kDone) return result;
    end = walk.at();
    result.plan = walk.takePlan();
  }
  const Instance rest = Instance::stretchOf(instance, end, instance.goals());
  const LacamSettings rest_settings = settingsOfRest(settings, result.expansions);
  LacamSearch search(rest, rest_settings, threads, deadline);
  result.outcome = search.run();
  result.configurations = search.configurations();
  result.expansions += search.expansions();
  if (result.outcome != LacamSearch::Outcome::kFound) return result;
  append(search.plan(), result.plan);
  trimToArrival(result.plan);
  return result;
}

}  // namespace split_mapf
