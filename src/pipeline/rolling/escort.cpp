#include "pipeline/rolling/escort.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "split/region_grids.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/solver/lacam.h"

namespace split_mapf::rolling {
namespace {

constexpr std::uint64_t kEscortExpansions = 400000;

/// One region, tried.
class EscortTry {
 public:
  explicit EscortTry(const EscortQuestion& question) : question_(question) {
    findRegion(question.radius);
  }

  std::optional<Escort> run() {
    if (!findMembers()) return std::nullopt;
    const std::optional<Plan> plan = solve();
    if (!plan) return std::nullopt;
    Escort escort;
    escort.leader = leader().id;
    escort.target = target_;
    escort.region = region_;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      const RollingRobot& robot = question_.fleet->robots[members_[i]];
      Path path = robot.prefix;
      path.resize(begin_ + std::size_t{1}, path.back());
      for (std::size_t t = 1; t < plan->paths[i].size(); ++t) {
        path.push_back(region_[plan->paths[i][t]]);
      }
      escort.members.push_back(robot.id);
      escort.paths.push_back(std::move(path));
    }
    endAtTarget(escort);
    return escort;
  }

 private:
  /// Cuts all paths where the leader is there.
  void endAtTarget(Escort& escort) const {
    const auto own = std::find(escort.members.begin(), escort.members.end(), escort.leader);
    const Path& way = escort.paths[static_cast<std::size_t>(own - escort.members.begin())];
    const auto steps = std::find(way.begin(), way.end(), target_) - way.begin();
    for (Path& path : escort.paths) {
      path.resize(static_cast<std::size_t>(steps) + 1, path.back());
    }
  }

  const RollingRobot& leader() const { return question_.fleet->robots[question_.leader]; }

  /// Vertices at most so many steps from the leader, in order.
  void findRegion(std::uint32_t radius) {
    const MoveGraph& graph = *question_.graph;
    std::vector<std::pair<Vertex, std::uint32_t>> queue = {{leader().prefix.back(), 0}};
    inside_.assign(graph.size(), false);
    inside_[leader().prefix.back()] = true;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const auto [v, steps] = queue[head];
      if (steps == radius) continue;
      for (const Vertex u : graph[v].next) {
        if (inside_[u] || (*question_.closed)[u]) continue;
        inside_[u] = true;
        queue.emplace_back(u, steps + 1);
      }
    }
    for (const auto& entry : queue) region_.push_back(entry.first);
    std::sort(region_.begin(), region_.end());
  }

  /// @return false if somebody is bound to cross the region's border, or is not to move.
  bool findMembers() {
    begin_ = 0;
    for (std::uint32_t robot = 0; robot < question_.fleet->robots.size(); ++robot) {
      const Path& prefix = question_.fleet->robots[robot].prefix;
      const auto in =
          std::count_if(prefix.begin(), prefix.end(), [this](Vertex v) { return inside_[v]; });
      if (in == 0) continue;
      if (static_cast<std::size_t>(in) < prefix.size()) return false;
      if (!question_.fleet->robots[robot].may_move) return false;
      begin_ = std::max(begin_, static_cast<std::uint32_t>(prefix.size()) - 1);
      members_.push_back(robot);
    }
    return findTarget();
  }

  /// The last vertex of the region on the leader's way. @return whether it has never been so near.
  bool findTarget() {
    const Slope& slope = *question_.slope;
    target_ = leader().prefix.back();
    std::uint32_t left = slope.distance(*question_.graph, target_, 0xffffffffU);
    for (std::uint32_t bits = slope[target_] & 0xfU; bits != 0; bits = slope[target_] & 0xfU) {
      const Vertex to =
          (*question_.graph)[target_].next[static_cast<std::size_t>(__builtin_ctz(bits))];
      if (!inside_[to]) break;
      target_ = to;
      --left;
    }
    return left < question_.best;
  }

  std::uint32_t numberOf(Vertex v) const {
    return static_cast<std::uint32_t>(std::lower_bound(region_.begin(), region_.end(), v) -
                                      region_.begin());
  }

  std::optional<Plan> solve() const {
    Problem problem{planningGraphOf(*question_.grid, region_), {}, {}};
    for (const std::uint32_t robot : members_) {
      const Vertex at = question_.fleet->robots[robot].prefix.back();
      Vertex goal = at == target_ ? leader().prefix.back() : at;
      if (robot == question_.leader) goal = target_;
      problem.starts.push_back(numberOf(at));
      problem.goals.push_back(numberOf(goal));
    }
    const Instance instance(std::move(problem));
    SolverOptions options;
    options.objective = Objective::kSumOfCosts;
    options.expansion_limit = kEscortExpansions;
    return LacamSolver(options).solve(instance, Deadline()).plan;
  }

  const EscortQuestion& question_;
  std::vector<bool> inside_;
  std::vector<Vertex> region_;          // in order
  std::vector<std::uint32_t> members_;  // indices in the fleet
  Vertex target_ = kNoVertex;
  std::uint32_t begin_ = 0;  // [steps] when all members are free
};

}  // namespace

std::optional<Escort> findEscort(const EscortQuestion& question) {
  return EscortTry(question).run();
}

}  // namespace split_mapf::rolling
