#include "improve/refine_worker.h"

#include <utility>
#include <vector>

namespace split_mapf {

RefineWorker::RefineWorker(const Instance& instance, Incumbent& incumbent,
                           std::uint32_t latest_arrival, std::uint64_t seed,
                           const Reservations* reserved)
    : incumbent_(incumbent),
      search_(instance, incumbent.plan(), latest_arrival, seed, {}, reserved),
      version_(incumbent.version()) {}

void RefineWorker::follow() {
  if (incumbent_.version() == version_) return;
  std::vector<PathChange> changes;
  version_ = incumbent_.changesSince(version_, changes);
  for (PathChange& change : changes) search_.replace(change.robot, std::move(change.path));
}

void RefineWorker::run(const Deadline& deadline, const Annealing* annealing) {
  const auto offer = [this](const std::vector<PathChange>& changes) {
    return incumbent_.offer(version_, changes);
  };
  while (!deadline.expired()) {
    follow();
    search_.tryOne(deadline, offer, annealing != nullptr ? annealing->temperature() : 0);
  }
  follow();
}

}  // namespace split_mapf
