#pragma once

#include <cstdint>

#include "solver/lacam/lacam_search.h"
#include "solver/lacam/settings.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// What searchCrowd() found.
struct CrowdSearchResult {
  LacamSearch::Outcome outcome = LacamSearch::Outcome::kInterrupted;
  Plan plan;  ///< if found; paths end at their arrivals
  std::uint32_t configurations = 0;
  std::uint64_t expansions = 0;
};

/// Walks a crowd home, guided again and again (CrowdWalk), and searches from where it ends for
/// whoever is left (LacamSearch). Complete: each move can be taken back, so where the walk ends
/// there is a plan if there is one from the starts. The plan depends on no thread.
/// @pre settings.guide_again > 0; nobody is cut off.
CrowdSearchResult searchCrowd(const Instance& instance, const LacamSettings& settings,
                              const LentThreads& threads, const Deadline& deadline);

}  // namespace split_mapf
