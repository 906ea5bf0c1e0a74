#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "split/assignment.h"
#include "split/shortest_ways.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// Steps that the piece to come and all pieces after it should take at most.
struct TimeShare {
  std::uint32_t piece = 0;  ///< T1
  std::uint32_t rest = 0;   ///< T2
};

/// Chooses, robot by robot, where each should be when a piece of a time split ends. Keeps its
/// memory between pieces; not thread-safe.
class IntermediateStates {
 public:
  explicit IntermediateStates(const Instance& instance);

  /// From now on robots that choose take the best state on their way, if nobody has it yet.
  /// @param ways  see ShortestWays.
  void follow(std::vector<Path> ways) { ways_.emplace(instance_.graph(), std::move(ways)); }
  /// Has the ways drawn again, if there are any, to other states.
  void drawWaysAgain() {
    if (ways_) ways_->forget();
  }

  /// Robots whose target is their goal get it; the others choose after them, the longest way first.
  /// @param from    where the robots are when the piece begins.
  /// @param target  steps on its way that each robot should have made; a preference.
  /// @return one vertex a robot, all different; empty when the deadline expired.
  std::vector<Vertex> choose(const std::vector<Vertex>& from,
                             const std::vector<std::uint32_t>& target, TimeShare share,
                             RandomEngine& engine, const Deadline& deadline);
  /// The same at the least total cost over all robots instead of one after another; robots whose
  /// few best candidates all went to others are then served as above.
  std::vector<Vertex> match(const std::vector<Vertex>& from,
                            const std::vector<std::uint32_t>& target, TimeShare share,
                            RandomEngine& engine, const Deadline& deadline);

 private:
  struct Rating {
    std::uint32_t excess;     // steps beyond T1 and T2
    std::uint32_t detour;     // steps beyond the shortest way
    std::uint32_t deviation;  // from the target
  };
  struct Query {
    std::uint32_t robot;
    const DistanceTable* to_goal;
    Vertex from;
    std::uint32_t length;  // of the shortest way from here
    std::uint32_t target;
    TimeShare share;
  };

  std::vector<std::uint32_t> longestFirst(const std::vector<Vertex>& from) const;
  /// @param to_goal  the robot's; it outlives the query.
  static Query queryFor(std::uint32_t robot, const DistanceTable& to_goal, Vertex from,
                        std::uint32_t target, TimeShare share);
  /// The state on its way that the robot rates best; kNoVertex where it is taken or there is none.
  Vertex chooseOnWay(const Query& query, RandomEngine& engine);
  /// Walks all cells that cost at most `detour` extra steps; calls visit(vertex, steps walked).
  template <typename Visit>
  void walk(const Query& query, std::uint32_t detour, Visit visit);
  std::vector<Candidate> candidatesOf(const Query& query, RandomEngine& engine);
  static Rating rate(const Query& query, Vertex v, std::uint32_t walked);
  Vertex chooseOne(const Query& query, RandomEngine& engine);
  void searchWithDetour(const Query& query, std::uint32_t detour, RandomEngine& engine);
  void consider(const Query& query, Vertex v, std::uint32_t walked, RandomEngine& engine);
  static bool better(const Rating& a, const Rating& b);

  const Instance& instance_;
  std::optional<ShortestWays> ways_;
  std::vector<bool> used_;
  std::vector<std::uint32_t> seen_;    // number of the search that met the vertex last
  std::vector<std::uint32_t> walked_;  // distance from the robot, valid where seen
  std::vector<Vertex> queue_;
  std::uint32_t search_number_ = 0;

  // The best candidate so far, and how many as good as it were met.
  Vertex best_ = kNoVertex;
  Rating best_rating_{};
  std::uint64_t equals_ = 0;
};

}  // namespace split_mapf
