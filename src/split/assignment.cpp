#include "split/assignment.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/successive_shortest_path_nonnegative_weights.hpp>
#include <boost/pending/disjoint_sets.hpp>

namespace split_mapf {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
using FlowGraph = boost::adjacency_list<
    boost::vecS, boost::vecS, boost::directedS, boost::no_property,
    boost::property<boost::edge_capacity_t, long,
                    boost::property<boost::edge_residual_capacity_t, long,
                                    boost::property<boost::edge_reverse_t, Traits::edge_descriptor,
                                                    boost::property<boost::edge_weight_t, long>>>>>;

using Robots = std::vector<std::uint32_t>;

/// Robots that are linked through candidates they share.
std::vector<Robots> groupsOf(const std::vector<std::vector<Candidate>>& candidates) {
  const auto robots = static_cast<std::uint32_t>(candidates.size());
  std::vector<std::uint32_t> rank(robots, 0);
  std::vector<std::uint32_t> parent(robots);
  boost::disjoint_sets<std::uint32_t*, std::uint32_t*> sets(rank.data(), parent.data());
  std::unordered_map<Vertex, std::uint32_t> first_with;
  for (std::uint32_t i = 0; i < robots; ++i) sets.make_set(i);
  for (std::uint32_t i = 0; i < robots; ++i) {
    for (const Candidate& candidate : candidates[i]) {
      const auto known = first_with.emplace(candidate.vertex, i);
      if (!known.second) sets.union_set(i, known.first->second);
    }
  }
  std::vector<Robots> by_root(robots);
  for (std::uint32_t i = 0; i < robots; ++i) by_root[sets.find_set(i)].push_back(i);
  by_root.erase(std::remove_if(by_root.begin(), by_root.end(),
                               [](const Robots& group) { return group.empty(); }),
                by_root.end());
  return by_root;
}

/// The assignment of one group as a flow from a source over robots and vertices to a sink.
class GroupFlow {
 public:
  GroupFlow(const Robots& group, const std::vector<std::vector<Candidate>>& candidates)
      : group_(group),
        candidates_(candidates),
        number_(numberVertices(group, candidates)),
        graph_(2 + group.size() + number_.size()) {
    for (std::size_t i = 0; i < group_.size(); ++i) {
      addArc(kSource, 2 + i, 0);
      for (const Candidate& candidate : candidates_[group_[i]]) {
        addArc(2 + i, nodeOf(candidate.vertex), candidate.cost);
      }
    }
    for (const auto& entry : number_) addArc(2 + group_.size() + entry.second, kSink, 0);
  }

  void solve(std::vector<Vertex>& assigned) {
    boost::successive_shortest_path_nonnegative_weights(graph_, kSource, kSink);
    const auto residual = boost::get(boost::edge_residual_capacity, graph_);
    const auto capacity = boost::get(boost::edge_capacity, graph_);
    for (std::size_t i = 0; i < group_.size(); ++i) {
      for (const Candidate& candidate : candidates_[group_[i]]) {
        const auto arc = boost::edge(2 + i, nodeOf(candidate.vertex), graph_).first;
        if (capacity[arc] == 1 && residual[arc] == 0) assigned[group_[i]] = candidate.vertex;
      }
    }
  }

 private:
  static constexpr std::size_t kSource = 0;
  static constexpr std::size_t kSink = 1;

  static std::unordered_map<Vertex, std::size_t> numberVertices(
      const Robots& group, const std::vector<std::vector<Candidate>>& candidates) {
    std::unordered_map<Vertex, std::size_t> number;
    for (const std::uint32_t robot : group) {
      for (const Candidate& candidate : candidates[robot]) {
        number.emplace(candidate.vertex, number.size());
      }
    }
    return number;
  }

  std::size_t nodeOf(Vertex v) const { return 2 + group_.size() + number_.at(v); }

  void addArc(std::size_t from, std::size_t to, long cost) {
    const auto arc = boost::add_edge(from, to, graph_).first;
    const auto back = boost::add_edge(to, from, graph_).first;
    boost::put(boost::edge_capacity, graph_, arc, 1);
    boost::put(boost::edge_capacity, graph_, back, 0);
    boost::put(boost::edge_weight, graph_, arc, cost);
    boost::put(boost::edge_weight, graph_, back, -cost);
    boost::put(boost::edge_reverse, graph_, arc, back);
    boost::put(boost::edge_reverse, graph_, back, arc);
  }

  const Robots& group_;
  const std::vector<std::vector<Candidate>>& candidates_;
  std::unordered_map<Vertex, std::size_t> number_;
  FlowGraph graph_;
};

}  // namespace

std::vector<Vertex> assignAtLeastCost(const std::vector<std::vector<Candidate>>& candidates) {
  std::vector<Vertex> assigned(candidates.size(), kNoVertex);
  for (const Robots& group : groupsOf(candidates)) {
    if (group.size() == 1) {
      const std::vector<Candidate>& own = candidates[group.front()];
      if (own.empty()) continue;
      assigned[group.front()] =
          std::min_element(own.begin(), own.end(), [](const Candidate& a, const Candidate& b) {
            return a.cost < b.cost;
          })->vertex;
    } else {
      GroupFlow(group, candidates).solve(assigned);
    }
  }
  return assigned;
}

}  // namespace split_mapf
