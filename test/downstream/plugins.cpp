// A package of somebody else that brings a solver and a splitter to the programs of split_mapf.
#include <cstdint>
#include <memory>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#ifndef PLUGINS_WITHOUT_ROS
#include <pluginlib/class_list_macros.hpp>
#endif

#include "split_mapf/core/error.h"
#include "split_mapf/plugin/export_plugins.h"

namespace split_mapf_downstream {

using split_mapf::Path;
using split_mapf::Vertex;

/// Robots go one after another, each along a shortest way around those that stand.
class OneByOne : public split_mapf::Solver {
 public:
  OneByOne() : Solver("one_by_one", {}) {}

 private:
  split_mapf::SolveResult run(const split_mapf::SolveRequest& request) const override {
    const split_mapf::Instance& instance = request.instance;
    std::vector<Vertex> standing = instance.starts();
    std::vector<bool> has_gone(instance.robots());
    split_mapf::SolveResult result;
    split_mapf::Plan plan;
    for (const Vertex start : standing) plan.paths.push_back({start});
    std::uint32_t now = 0;  // the step at which the next one may go
    for (std::uint32_t gone = 0; gone < instance.robots(); ++gone) {
      std::optional<Path> way;
      for (std::uint32_t robot = 0; robot < instance.robots() && !way; ++robot) {
        if (has_gone[robot]) continue;
        if (request.deadline.expired()) {
          result.termination = split_mapf::interruptionOf(request.deadline);
          return result;
        }
        way = findWay(instance, standing, robot);
        if (!way) continue;
        Path& path = plan.paths[robot];
        path.resize(now + 1, path.back());
        path.insert(path.end(), way->begin() + 1, way->end());
        now += static_cast<std::uint32_t>(way->size()) - 1;
        standing[robot] = instance.goal(robot);
        has_gone[robot] = true;
      }
      if (way) continue;
      result.message = "whoever goes next, others stand in the way";
      return result;
    }
    result.termination = split_mapf::Termination::kSolved;
    result.plan = std::move(plan);
    return result;
  }

  static std::optional<Path> findWay(const split_mapf::Instance& instance,
                                     const std::vector<Vertex>& standing, std::uint32_t robot) {
    const Vertex start = standing[robot];
    const Vertex goal = instance.goal(robot);
    // Searched from the goal, so that the way can be read off from the start.
    std::vector<Vertex> next(instance.graph().size(), split_mapf::kNoVertex);
    std::vector<bool> is_taken(instance.graph().size());
    for (const Vertex v : standing) is_taken[v] = true;
    is_taken[start] = false;
    if (is_taken[goal]) return std::nullopt;
    std::queue<Vertex> open({goal});
    next[goal] = goal;
    while (!open.empty() && next[start] == split_mapf::kNoVertex) {
      const Vertex v = open.front();
      open.pop();
      for (const Vertex w : instance.graph().neighbours(v)) {
        if (is_taken[w] || next[w] != split_mapf::kNoVertex) continue;
        next[w] = v;
        open.push(w);
      }
    }
    if (next[start] == split_mapf::kNoVertex) return std::nullopt;
    Path way = {start};
    while (way.back() != goal) way.push_back(next[way.back()]);
    return way;
  }
};

class OneByOnePlugin : public split_mapf::SolverPlugin {
  split_mapf::SolverInfo info() const override {
    split_mapf::SolverInfo info;
    info.name = "one_by_one";
    info.description = "robots go one after another";
    info.make = [](const split_mapf::SolverOptions&) { return std::make_unique<OneByOne>(); };
    return info;
  }
};

/// Every other robot goes first, then the others.
class EveryOther : public split_mapf::WholeWhereItFails {
 public:
  using WholeWhereItFails::WholeWhereItFails;
  bool split(const split_mapf::Deadline& /*deadline*/) override {
    std::vector<Vertex> between = instance().starts();
    for (std::uint32_t robot = 0; robot < instance().robots(); robot += 2) {
      between[robot] = instance().goal(robot);
    }
    // A goal on which one of the others still stands: no such split.
    try {
      setTree(split_mapf::PieceTree::sequence(
          {piece(instance().starts(), between), piece(between, instance().goals())}));
    } catch (const split_mapf::InstanceError&) {
      return WholeWhereItFails::split({});
    }
    return true;
  }

 private:
  split_mapf::PieceHandle piece(const std::vector<Vertex>& from, const std::vector<Vertex>& to) {
    const auto part = split_mapf::Instance::fromVertices(instance().sharedGrid(), from, to);
    split_mapf::Piece piece = *split_mapf::wholePiece(part, nextId());
    piece.shares = 1;
    return std::make_shared<const split_mapf::Piece>(std::move(piece));
  }
};

class EveryOtherPlugin : public split_mapf::SplitterPlugin {
  split_mapf::SplitterInfo info() const override {
    split_mapf::SplitterInfo info;
    info.name = "every_other";
    info.description = "every other robot goes first";
    info.make = [](const split_mapf::SplitRequest&, const split_mapf::SplitQuestion& question) {
      return std::make_unique<EveryOther>(question.instance);
    };
    return info;
  }
};

}  // namespace split_mapf_downstream

SPLIT_MAPF_EXPORT_PLUGINS(split_mapf_downstream::OneByOnePlugin,
                          split_mapf_downstream::EveryOtherPlugin)
#ifndef PLUGINS_WITHOUT_ROS
PLUGINLIB_EXPORT_CLASS(split_mapf_downstream::OneByOnePlugin, split_mapf::SolverPlugin)
PLUGINLIB_EXPORT_CLASS(split_mapf_downstream::EveryOtherPlugin, split_mapf::SplitterPlugin)
#endif
