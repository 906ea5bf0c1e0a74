#include "solver/lacam/guidance.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "parallel/thread_team.h"
#include "search/apart.h"
#include "search/robot_order.h"
#include "solver/lacam/scatter_search.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

Guidance::Guidance(const std::vector<Path>& paths) : first_(paths.size()), mask_(paths.size()) {
  std::size_t total = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::uint32_t size = 2;
    while (size < 2 * paths[i].size()) size *= 2;
    first_[i] = total;
    mask_[i] = size - 1;
    total += size;
  }
  entries_.resize(total);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    Entry* const entries = entries_.data() + first_[i];
    for (std::size_t t = 0; t + 1 < paths[i].size(); ++t) {
      std::uint32_t slot = slotOf(paths[i][t]) & mask_[i];
      while (entries[slot].from != kNoVertex) slot = (slot + 1) & mask_[i];
      entries[slot] = {paths[i][t], paths[i][t + 1]};
    }
  }
}

namespace {

/// One call of scatterPaths().
class Scattering {
 public:
  Scattering(const Instance& instance, const ScatterOptions& options)
      : options_(options),
        table_(instance.graph()),
        team_(options.threads.atMost(std::min(options.batch, options.threads.most()))),
        searches_(team_.threads(), {ScatterSearch(instance, table_, options.margin)}),
        answers_(options.batch) {
    result_.paths.resize(instance.robots());
  }

  /// @return the collisions of the new paths; nothing when the limit or the deadline came first.
  std::optional<std::uint64_t> chooseAnew(const std::vector<std::uint32_t>& order,
                                          const Deadline& deadline) {
    std::uint64_t collisions = 0;
    for (std::size_t first = 0; first < order.size(); first += options_.batch) {
      const std::uint64_t limit = options_.expansion_limit;
      if ((limit > 0 && result_.expansions > limit) || deadline.expired()) return std::nullopt;
      const auto count =
          static_cast<std::uint32_t>(std::min<std::size_t>(options_.batch, order.size() - first));
      collisions += chooseBatch(order.data() + first, count);
    }
    return collisions;
  }

  ScatteredPaths takeResult() { return std::move(result_); }

 private:
  struct Answer {
    Path path;
    std::uint64_t collisions = 0;
    std::uint64_t expansions = 0;
  };

  std::uint64_t chooseBatch(const std::uint32_t* robots, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) table_.remove(result_.paths[robots[i]]);
    team_.forEach(count, [&](std::uint32_t i, std::uint32_t member) {
      ScatterSearch& search = searches_[member].value;
      answers_[i].path = search.find(robots[i]);
      answers_[i].collisions = search.collisions();
      answers_[i].expansions = search.expansions();
    });
    std::uint64_t collisions = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      result_.expansions += answers_[i].expansions;
      collisions += answers_[i].collisions;
      table_.insert(answers_[i].path);
      result_.paths[robots[i]] = std::move(answers_[i].path);
    }
    return collisions;
  }

  const ScatterOptions& options_;
  Crossings table_;
  ThreadTeam team_;
  std::vector<Apart<ScatterSearch>> searches_;  // one a thread
  std::vector<Answer> answers_;
  ScatteredPaths result_;
};

}  // namespace

ScatteredPaths scatterPaths(const Instance& instance, const ScatterOptions& options,
                            const Deadline& deadline) {
  Scattering scattering(instance, options);
  RandomEngine engine(options.seed);
  std::uint64_t last_collisions = 0;
  for (std::uint64_t round = 0; round < options.rounds; ++round) {
    const auto collisions = scattering.chooseAnew(makeOrder(instance, "random", engine), deadline);
    if (!collisions || *collisions == 0 || (round > 1 && *collisions >= last_collisions)) break;
    last_collisions = *collisions;
  }
  return scattering.takeResult();
}

}  // namespace split_mapf
