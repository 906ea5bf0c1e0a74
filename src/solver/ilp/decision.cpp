#include "solver/ilp/decision.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace split_mapf::ilp {
namespace {

// Less than this is taken for a rounding error.
constexpr double kUndecided = 1e-5;

/// How far a share is from being decided: 0 to 0.5.
double doubt(double share) { return std::min(share, 1 - share); }

using Paths = std::vector<const UsedPath*>;

void weighArrivals(const Paths& paths, Fork& best) {
  std::map<std::uint32_t, double> share;
  for (const UsedPath* used : paths) {
    share[static_cast<std::uint32_t>(used->path->size()) - 1] += used->value;
  }
  double sum = 0;
  for (const auto& [arrival, value] : share) {
    sum += value;
    if (doubt(sum) <= best.doubt) continue;
    best.doubt = doubt(sum);
    best.first = {Decision::Kind::kArriveBy, paths.front()->robot, kNoVertex, arrival};
  }
}

void weighVertices(const Paths& paths, Fork& best) {
  std::size_t longest = 0;
  for (const UsedPath* used : paths) longest = std::max(longest, used->path->size());
  std::vector<std::pair<Vertex, double>> share;
  for (std::uint32_t t = 1; t < longest; ++t) {
    share.clear();
    for (const UsedPath* used : paths) {
      const Vertex v = positionAt(*used->path, t);
      const auto known =
          std::find_if(share.begin(), share.end(), [v](const auto& s) { return s.first == v; });
      if (known == share.end()) {
        share.emplace_back(v, used->value);
      } else {
        known->second += used->value;
      }
    }
    for (const auto& [v, value] : share) {
      if (doubt(value) <= best.doubt) continue;
      best.doubt = doubt(value);
      best.first = {Decision::Kind::kAt, paths.front()->robot, v, t};
    }
  }
}

/// The best fork of each robot by one measure, the most doubtful first.
template <typename Weigh>
std::vector<Fork> forksBy(const std::vector<UsedPath>& used, std::size_t most, Weigh weigh) {
  std::vector<Fork> forks;
  Paths paths;
  for (std::size_t i = 0; i < used.size();) {
    paths.clear();
    const std::uint32_t robot = used[i].robot;
    for (; i < used.size() && used[i].robot == robot; ++i) paths.push_back(&used[i]);
    Fork best;
    best.doubt = kUndecided;
    weigh(paths, best);
    if (best.first.kind != Decision::Kind::kNone) forks.push_back(best);
  }
  std::stable_sort(forks.begin(), forks.end(),
                   [](const Fork& a, const Fork& b) { return a.doubt > b.doubt; });
  if (forks.size() > most) forks.resize(most);
  for (Fork& fork : forks) {
    fork.second = fork.first;
    fork.second.kind = fork.first.kind == Decision::Kind::kAt ? Decision::Kind::kNotAt
                                                              : Decision::Kind::kArriveAfter;
  }
  return forks;
}

}  // namespace

void apply(const Decision& decision, const Instance& instance, std::vector<RobotRules>& rules) {
  RobotRules& own = rules[decision.robot];
  const auto ban_others = [&](const RobotRules::Ban& ban) {
    for (std::uint32_t i = 0; i < rules.size(); ++i) {
      if (i != decision.robot) rules[i].bans.push_back(ban);
    }
  };
  switch (decision.kind) {
    case Decision::Kind::kNone:
      return;
    case Decision::Kind::kAt:
      own.posts.push_back({decision.vertex, decision.step});
      ban_others({decision.vertex, decision.step, decision.step + 1});
      return;
    case Decision::Kind::kNotAt:
      own.bans.push_back({decision.vertex, decision.step, decision.step + 1});
      return;
    case Decision::Kind::kArriveBy:
      own.latest_arrival = std::min(own.latest_arrival, decision.step);
      ban_others({instance.goal(decision.robot), decision.step, RobotRules::kNever});
      return;
    case Decision::Kind::kArriveAfter:
      own.earliest_arrival = std::max(own.earliest_arrival, decision.step + 1);
      return;
  }
}

bool obeys(std::uint32_t robot, const Path& path, const Decision& decision,
           const Instance& instance) {
  const bool own = robot == decision.robot;
  const auto arrival = static_cast<std::uint32_t>(path.size()) - 1;
  switch (decision.kind) {
    case Decision::Kind::kNone:
      return true;
    case Decision::Kind::kAt:
      return (positionAt(path, decision.step) == decision.vertex) == own;
    case Decision::Kind::kNotAt:
      return !own || positionAt(path, decision.step) != decision.vertex;
    case Decision::Kind::kArriveAfter:
      return !own || arrival > decision.step;
    case Decision::Kind::kArriveBy:
      break;
  }
  if (own) return arrival <= decision.step;
  const Vertex goal = instance.goal(decision.robot);
  for (std::uint32_t t = decision.step; t <= arrival; ++t) {
    if (path[t] == goal) return false;
  }
  return true;
}

std::vector<Fork> chooseForks(const std::vector<UsedPath>& used, bool by_arrival,
                              std::size_t most) {
  std::vector<Fork> forks;
  if (by_arrival) forks = forksBy(used, most, weighArrivals);
  const std::vector<Fork> more = forksBy(used, most, weighVertices);
  forks.insert(forks.end(), more.begin(), more.end());
  return forks;
}

bool isUndecided(const std::vector<UsedPath>& used, bool by_arrival) {
  return !chooseForks(used, by_arrival, 1).empty();
}

}  // namespace split_mapf::ilp
