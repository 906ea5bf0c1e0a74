#include "solver/ilp/clique_cuts.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace split_mapf::ilp {
namespace {

constexpr double kViolated = 1.02;
constexpr double kDecided = 1 - 1e-6;
// Growing one clique ends here; it may then be less than the best.
constexpr std::uint32_t kMostTries = 200;

}  // namespace

void CliqueCuts::find(const std::vector<UsedPath>& used, std::size_t most,
                      std::vector<ConflictRow>& rows) {
  cliques_.clear();
  collect(used);
  for (const std::vector<Node>& nodes : steps_) searchStep(nodes);
  std::stable_sort(cliques_.begin(), cliques_.end(),
                   [](const Clique& a, const Clique& b) { return a.value > b.value; });
  if (cliques_.size() > most) cliques_.resize(most);
  for (Clique& clique : cliques_) {
    lift(clique);
    ConflictRow row;
    row.terms = std::move(clique.terms);
    rows.push_back(std::move(row));
  }
}

/// The moves of robots that are undecided, by step.
void CliqueCuts::collect(const std::vector<UsedPath>& used) {
  steps_.assign(space_.horizon(), {});
  for (const UsedPath& path : used) {
    if (path.value > kDecided) continue;
    for (std::uint32_t t = 0; t < space_.horizon(); ++t) {
      std::vector<Node>& nodes = steps_[t];
      const MoveId move = (*path.moves)[t];
      const auto same = std::find_if(nodes.rbegin(), nodes.rend(), [&](const Node& node) {
        return node.robot == path.robot && node.move == move;
      });
      if (same == nodes.rend()) {
        nodes.push_back({path.robot, move, path.value});
      } else {
        same->value += path.value;
      }
    }
  }
}

bool CliqueCuts::collide(MoveId a, MoveId b) const {
  const Vertex from = space_.fromOf(a);
  const Vertex to = space_.toOf(a);
  const Vertex other_from = space_.fromOf(b);
  const Vertex other_to = space_.toOf(b);
  return from == other_from || to == other_to || (from == other_to && to == other_from);
}

bool CliqueCuts::exclude(const Node& a, const Node& b) const {
  return a.robot == b.robot || collide(a.move, b.move);
}

void CliqueCuts::searchStep(const std::vector<Node>& nodes) {
  for (std::uint32_t seed = 0; seed < nodes.size(); ++seed) {
    if (nodes[seed].value > kDecided) continue;
    // Each clique is found from its first node.
    std::vector<std::uint32_t> candidates;
    double most = nodes[seed].value;
    for (std::uint32_t i = seed + 1; i < nodes.size(); ++i) {
      if (nodes[i].value > kDecided || !exclude(nodes[seed], nodes[i])) continue;
      candidates.push_back(i);
      most += nodes[i].value;
    }
    if (most <= kViolated) continue;
    std::vector<std::uint32_t> chosen = {seed};
    std::vector<std::uint32_t> best;
    double best_value = kViolated;
    tries_ = 0;
    grow(nodes, candidates, chosen, nodes[seed].value, best, best_value);
    if (best.empty()) continue;
    Clique clique;
    clique.value = best_value;
    for (const std::uint32_t i : best) clique.terms.push_back({nodes[i].move, nodes[i].robot});
    cliques_.push_back(std::move(clique));
  }
}

void CliqueCuts::grow(const std::vector<Node>& nodes, const std::vector<std::uint32_t>& candidates,
                      std::vector<std::uint32_t>& chosen, double value,
                      std::vector<std::uint32_t>& best, double& best_value) {
  if (value > best_value) {
    best = chosen;
    best_value = value;
  }
  double rest = 0;
  for (const std::uint32_t i : candidates) rest += nodes[i].value;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (value + rest <= best_value || ++tries_ > kMostTries) return;
    const std::uint32_t next = candidates[k];
    std::vector<std::uint32_t> left;
    for (std::size_t m = k + 1; m < candidates.size(); ++m) {
      if (exclude(nodes[next], nodes[candidates[m]])) left.push_back(candidates[m]);
    }
    chosen.push_back(next);
    grow(nodes, left, chosen, value + nodes[next].value, best, best_value);
    chosen.pop_back();
    rest -= nodes[next].value;
  }
}

/// Adds the unused moves of its robots that the clique admits.
void CliqueCuts::lift(Clique& clique) const {
  std::vector<std::uint32_t> robots;
  for (const ConflictRow::Term& term : clique.terms) {
    if (std::find(robots.begin(), robots.end(), term.robot) == robots.end()) {
      robots.push_back(term.robot);
    }
  }
  const std::uint32_t step = space_.stepOf(clique.terms.front().move);
  std::vector<MoveId> near;
  for (const ConflictRow::Term& term : clique.terms) {
    const Vertex from = space_.fromOf(term.move);
    const Vertex to = space_.toOf(term.move);
    near.push_back(space_.move(step, from, from));
    near.push_back(space_.move(step, to, to));
    near.push_back(space_.move(step, to, from));
    for (const Vertex v : space_.graph().neighbours(from))
      near.push_back(space_.move(step, from, v));
    for (const Vertex v : space_.graph().neighbours(to)) near.push_back(space_.move(step, v, to));
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  for (const std::uint32_t robot : robots) {
    for (const MoveId move : near) {
      const bool fits =
          std::all_of(clique.terms.begin(), clique.terms.end(), [&](const ConflictRow::Term& term) {
            return term.robot == robot ? term.move != move : collide(term.move, move);
          });
      if (fits) clique.terms.push_back({move, robot});
    }
  }
}

}  // namespace split_mapf::ilp
