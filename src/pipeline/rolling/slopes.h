#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "parallel/thread_team.h"
#include "pipeline/rolling/move_graph.h"

namespace split_mapf::rolling {

/// For every vertex, which ways out of it lead nearer to one goal: a byte a vertex, the lower four
/// bits for slots that lead a step nearer, the upper four for those that lead neither nearer nor
/// farther. One look says what all moves from a vertex cost. Immutable, safe to share.
class Slope {
 public:
  /// All ways are as good as waiting. No vertex with a way to the goal has that.
  static constexpr std::uint8_t kCutOff = 0xf0U;

  explicit Slope(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}
  const std::uint8_t* data() const { return bytes_.data(); }
  std::uint8_t operator[](Vertex v) const { return bytes_[v]; }
  bool reachable(Vertex from) const { return bytes_[from] != kCutOff; }
  /// Steps from a vertex to the goal, `most` at most. Cost: O(result).
  /// @pre the goal can be reached from there.
  std::uint32_t distance(const MoveGraph& graph, Vertex from, std::uint32_t most) const;

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Slopes by goal, found when first asked for and kept while they fit into so many bytes; those in
/// use are kept whatever that is. Closed vertices are led out of, never into. Not thread-safe; what
/// it returns is. Cost: one breadth-first search for each slope that is not there.
class SlopeCache {
 public:
  /// @pre graph outlives this object.
  SlopeCache(const MoveGraph& graph, std::size_t most_bytes)
      : graph_(graph), most_bytes_(most_bytes), closed_(graph.size(), false) {}

  /// Forgets all slopes if other vertices are closed than before.
  /// @return whether that was so.
  bool close(const std::vector<bool>& closed);
  std::shared_ptr<const Slope> find(Vertex goal);
  /// Null when it is not there.
  std::shared_ptr<const Slope> known(Vertex goal);
  /// The same for many, searched by all threads of a team and put behind `found` in their order.
  void findAll(const std::vector<Vertex>& goals, ThreadTeam& team,
               std::vector<std::shared_ptr<const Slope>>& found);
  bool has(Vertex goal) const { return entries_.count(goal) > 0; }
  std::size_t bytes() const { return entries_.size() * graph_.size(); }

 private:
  struct Entry {
    std::shared_ptr<const Slope> slope;
    std::uint64_t used = 0;  // when it was asked for last
  };
  /// What a search needs for itself.
  struct Search {
    std::vector<std::uint8_t> levels;
    std::vector<Vertex> queue;
  };
  std::shared_ptr<const Slope> make(Vertex goal, Search& search) const;
  void findLevels(Vertex goal, Search& search) const;
  void leadAround(Vertex goal, std::vector<std::uint8_t>& slope) const;
  void makeRoom();

  const MoveGraph& graph_;
  std::size_t most_bytes_;
  std::vector<bool> closed_;
  bool any_closed_ = false;
  std::unordered_map<Vertex, Entry> entries_;
  std::uint64_t uses_ = 0;
  std::vector<Search> searches_ = std::vector<Search>(1);  // by member of a team
};

}  // namespace split_mapf::rolling
