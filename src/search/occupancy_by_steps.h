#pragma once

#include <cstdint>
#include <vector>

#include "search/heading_graph.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// The paths of a valid plan, step by step: for each step one code a vertex, that says who is there
/// and who was or will be. For searches that go from step to step: of each they look at a few cache
/// lines. Memory: vertices x greatest arrival / 2 bytes. Not thread-safe; const members are.
class OccupancyBySteps {
 public:
  /// @pre the plan has no conflicts, its paths end at their arrivals; the graph is valid and
  /// outlives this object.
  OccupancyBySteps(const HeadingGraph& graph, std::uint32_t vertices, const Plan& plan);

  /// All vertices at one step.
  class Step {
   public:
    bool isTaken(Vertex v) const { return code(v) >= kStays; }
    /// At how many of both steps beside this one somebody is there. @pre nobody is at this one.
    std::uint32_t countBeside(Vertex v) const { return code(v); }
    /// Whether somebody comes to `v` at this step, moving with this heading.
    bool isEntered(Vertex v, Heading heading) const { return code(v) == kEntered + heading; }

    /// Has what is known of `v` loaded, as it will be asked for soon.
    void prefetch(Vertex v) const { __builtin_prefetch(codes_ + v / 2); }

   private:
    friend class OccupancyBySteps;
    explicit Step(const std::uint8_t* codes) : codes_(codes) {}
    std::uint32_t code(Vertex v) const { return codes_[v / 2] >> (v % 2 * 4) & 15U; }
    const std::uint8_t* codes_;
  };
  /// @pre t is no later than the greatest arrival.
  Step at(std::uint32_t t) const { return Step(codes_.data() + t * bytes_); }

  /// At how many of both steps beside `t`, of a robot that comes to `v` then, another is there.
  /// @param own  the path of the robot in the table.
  std::uint32_t countClose(Vertex v, std::uint32_t t, const Path& own) const {
    return (isOthers(v, t - 1, own) ? 1 : 0) + (isOthers(v, t + 1, own) ? 1 : 0);
  }

  /// Gives a robot the other path, where no robot is in its way; `own` and `path` then change
  /// places. @return whether it has it. @pre `own` is a path of the table, the other one begins and
  /// ends where it does and is no longer.
  bool exchange(Path& own, Path& path);

 private:
  // 0 to 2: nobody; at so many of both steps beside somebody is.
  static constexpr std::uint32_t kStays = 3;
  static constexpr std::uint32_t kEntered = 4;  // with heading 0; 5 to 7 with the others

  bool isOthers(Vertex v, std::uint32_t t, const Path& own) const {
    return t < steps_ && at(t).isTaken(v) && positionAt(own, t) != v;
  }
  void set(Vertex v, std::uint32_t t, std::uint32_t code);
  void noteBeside(Vertex v, std::uint32_t t);
  void insert(const Path& path, std::uint32_t begin, std::uint32_t end);
  void remove(const Path& path, std::uint32_t begin, std::uint32_t end);
  bool isFree(const Path& path, std::uint32_t t, const Path& own) const;

  const HeadingGraph& graph_;
  std::size_t bytes_;  // of a step
  std::uint32_t steps_ = 0;
  std::vector<std::uint8_t> codes_;
};

}  // namespace split_mapf
