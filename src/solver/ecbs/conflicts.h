#pragma once

#include <cstdint>
#include <vector>

#include "search/constraints.h"
#include "search/path_table.h"

namespace split_mapf {

/// The earliest collision of two robots.
struct Conflict {
  enum class Kind {
    kVertex,  ///< both at `vertex` at `step`
    kSwap,    ///< first goes from `vertex` to `other` arriving at `step`, second the other way
    kTarget,  ///< second has arrived for good at `vertex`; first is there at `step`
  };
  Kind kind = Kind::kVertex;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::uint32_t step = 0;
  Vertex vertex = kNoVertex;
  Vertex other = kNoVertex;
};

/// Finds the robots that a path runs into. Keeps its memory; not thread-safe.
class ConflictFinder {
 public:
  /// @param targets  whether to tell kTarget from kVertex.
  explicit ConflictFinder(std::uint32_t robots, bool targets = true)
      : targets_(targets), slot_(robots, kNoSlot) {}
  /// From now on finds none with other robots than these.
  void attendOnlyTo(const std::vector<std::uint32_t>& robots);
  /// Appends the earliest conflict of `robot` on `path` with each other robot of the table.
  /// Cost: the visits at the vertices of the path.
  void find(std::uint32_t robot, const Path& path, const PathTable& table,
            std::vector<Conflict>& out);

 private:
  static constexpr std::uint32_t kNoSlot = 0xffffffffU;
  static constexpr std::uint32_t kIgnored = 0xfffffffeU;
  void note(const Conflict& conflict, std::uint32_t other, std::size_t first,
            std::vector<Conflict>& out);

  bool targets_;
  std::vector<std::uint32_t> slot_;  // other robot -> place of its conflict in `out`
};

/// What a child of the constraint tree forbids one robot.
struct Constraint {
  enum class Kind { kVertexBan, kMoveBan, kLaterArrival };
  Kind kind = Kind::kVertexBan;
  std::uint32_t robot = 0;
  Vertex vertex = kNoVertex;  ///< banned, or left by the banned move
  Vertex to = kNoVertex;      ///< reached by the banned move
  std::uint32_t begin = 0;    ///< first banned step, step of the move, or earliest arrival
  std::uint32_t end = 0;      ///< behind the last banned step
};

/// The two constraints of which every conflict-free plan obeys at least one.
struct Branches {
  Constraint first;
  Constraint second;
};
Branches branchOn(const Conflict& conflict);
/// Adds a constraint to those of its robot.
void apply(const Constraint& constraint, RobotConstraints& constraints);

}  // namespace split_mapf
