#include "pipeline/rolling/escort.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "pipeline/rolling/leader_search.h"

namespace split_mapf::rolling {
namespace {

// Steps that a leader gains where its goal is not nearer, and where it is urgent (where there is
// room around it, more are beyond the visits); the region that it is led through at first, and the
// vertices that are visited for one escort, about.
constexpr std::uint32_t kGain = 32;
constexpr std::uint32_t kUrgentGain = 8;
constexpr std::uint32_t kFirstRadius = 16;
constexpr std::uint64_t kVisits = 100000;

/// One leader, led.
class EscortTry {
 public:
  explicit EscortTry(const EscortQuestion& question)
      : question_(question), standing_(question.graph->size(), false) {
    for (const RollingRobot& robot : question.fleet->robots) standing_[robot.prefix.back()] = true;
  }

  std::optional<Escort> run() {
    const std::optional<std::vector<LeaderMove>> moves = findMoves();
    if (!moves || !findMembers(*moves)) return std::nullopt;
    return escortOf(*moves);
  }

 private:
  const RollingRobot& leader() const { return question_.fleet->robots[question_.leader]; }

  /// In a region that reaches further and further.
  std::optional<std::vector<LeaderMove>> findMoves() const {
    LeaderQuestion search;
    search.graph = question_.graph;
    search.occupied = &standing_;
    search.leader = leader().prefix.back();
    search.slope = question_.slope;
    search.left = question_.slope->distance(*question_.graph, search.leader, 0xffffffffU);
    search.aim = question_.best - std::min(question_.best, kGain);
    if (question_.is_urgent && search.left > search.aim + kFirstRadius) {
      search.aim = question_.best - std::min(question_.best, kUrgentGain);
    }
    if (search.left <= search.aim) return std::nullopt;
    search.visits = kVisits;
    std::size_t before = 0;
    for (std::uint32_t radius = kFirstRadius;; radius *= 2) {
      std::size_t count = 0;
      const std::vector<bool> inside = regionAround(radius, count);
      if (count == before) return std::nullopt;
      before = count;
      search.inside = &inside;
      LeaderSearch leader_search(search);
      std::optional<std::vector<LeaderMove>> moves = leader_search.find();
      if (moves || leader_search.visits() >= search.visits) return moves;
      search.visits -= leader_search.visits();
    }
  }

  /// Vertices at most so many steps from the leader.
  std::vector<bool> regionAround(std::uint32_t radius, std::size_t& count) const {
    const MoveGraph& graph = *question_.graph;
    const Vertex begin = leader().prefix.back();
    std::vector<std::pair<Vertex, std::uint32_t>> queue = {{begin, 0}};
    std::vector<bool> inside(graph.size(), false);
    inside[begin] = true;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const auto [v, steps] = queue[head];
      if (steps == radius) continue;
      for (const Vertex u : graph[v].next) {
        if (inside[u] || (*question_.closed)[u]) continue;
        inside[u] = true;
        queue.emplace_back(u, steps + 1);
      }
    }
    count = queue.size();
    return inside;
  }

  /// The region is what is touched, and whatever those that are there are bound to.
  /// @return false if that is not theirs alone.
  bool findMembers(const std::vector<LeaderMove>& moves) {
    std::vector<bool> touched(question_.graph->size(), false);
    touched[leader().prefix.back()] = true;
    for (const LeaderMove& move : moves) touched[move.from] = touched[move.to] = true;
    const std::vector<RollingRobot>& robots = question_.fleet->robots;
    std::vector<bool> is_in(robots.size(), false);
    for (bool grows = true; grows;) {
      grows = false;
      for (std::uint32_t robot = 0; robot < robots.size(); ++robot) {
        const Path& prefix = robots[robot].prefix;
        if (is_in[robot]) continue;
        if (std::none_of(prefix.begin(), prefix.end(), [&](Vertex v) { return touched[v]; })) {
          continue;
        }
        if (!robots[robot].may_move) return false;
        is_in[robot] = true;
        grows = grows || prefix.size() > 1;
        for (const Vertex v : prefix) {
          if ((*question_.closed)[v]) return false;
          touched[v] = true;
        }
        begin_ = std::max(begin_, static_cast<std::uint32_t>(prefix.size()) - 1);
      }
    }
    for (std::uint32_t robot = 0; robot < robots.size(); ++robot) {
      if (is_in[robot]) members_.push_back(robot);
    }
    for (Vertex v = 0; v < touched.size(); ++v) {
      if (touched[v]) region_.push_back(v);
    }
    return true;
  }

  /// Each move as soon as its robot has come and the one before it has left.
  Escort escortOf(const std::vector<LeaderMove>& moves) const {
    Escort escort;
    escort.leader = leader().id;
    escort.target = moves.back().to;
    escort.region = region_;
    std::vector<std::uint32_t> who(question_.graph->size(), kNoRobot);
    std::vector<std::size_t> left(question_.graph->size(), begin_);  // in this step at the latest
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      const RollingRobot& robot = question_.fleet->robots[members_[i]];
      escort.members.push_back(robot.id);
      escort.paths.push_back(robot.prefix);
      escort.paths.back().resize(begin_ + std::size_t{1}, robot.prefix.back());
      who[robot.prefix.back()] = i;
    }
    std::size_t last = 0;
    for (const LeaderMove& move : moves) {
      const std::uint32_t robot = who[move.from];
      Path& path = escort.paths[robot];
      last = std::max(path.size(), left[move.to]);
      path.resize(last, move.from);
      path.push_back(move.to);
      left[move.from] = last;
      who[move.to] = robot;
      who[move.from] = kNoRobot;
    }
    // The last move is the leader's; what others do behind it is not of use.
    for (Path& path : escort.paths) path.resize(last + 1, path.back());
    return escort;
  }

  const EscortQuestion& question_;
  std::vector<bool> standing_;          // by vertex: somebody, once nobody is bound
  std::vector<Vertex> region_;          // in order
  std::vector<std::uint32_t> members_;  // indices in the fleet
  std::uint32_t begin_ = 0;             // [steps] when all members are free
};

}  // namespace

std::optional<Escort> findEscort(const EscortQuestion& question) {
  return EscortTry(question).run();
}

}  // namespace split_mapf::rolling
