#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/core/grid.h"

namespace split_mapf {

class DistanceTable;

/// How much of a distance table is computed at once.
enum class DistanceExtent {
  kAll,       ///< everything, in the constructor: the table is immutable then
  kOnDemand,  ///< as far from the goal as somebody asks: for tables of which little is read
};

/// Tells a table on demand that it will be read on the short ways from one vertex to its goal and
/// little elsewhere, and what it may know beforehand about these.
struct DistanceGuide {
  const Grid* grid = nullptr;  ///< of the graph: no way has fewer steps than rows and columns
  Vertex from = kNoVertex;
  /// Distances on the same graph to whatever goal, which has a way from `from`; null: none are
  /// known. One of kAll that takes 16 bits; any other is left aside.
  std::shared_ptr<const DistanceTable> known;
  /// Whether the table takes a search of all once it has seen a good part of the graph, so that it
  /// never costs much more than one of kAll.
  bool may_complete = false;
};

/// Exact shortest distances [steps] from every vertex to one goal, by breadth-first search.
/// Entries take 16 bits while every distance fits, 32 bits otherwise. A table of kAll is safe to
/// read from several threads; one of kOnDemand grows while it is read and belongs to one thread at
/// a time. Cost: O(V + E) time and 2 or 4 bytes a vertex; kOnDemand pays only for the part within
/// the greatest distance asked for, with a guide for what lies on ways from there no longer than
/// that over the vertex asked for, and one that may complete mostly for a way from that vertex.
class DistanceTable {
 public:
  /// The distance of a vertex that cannot reach the goal.
  static constexpr std::uint32_t kUnreachable = 0xffffffffU;

  /// @pre kOnDemand: `graph` outlives the table. @throws Interrupted: a search of all hears the
  /// deadline, one on demand is not bound by it.
  DistanceTable(const Graph& graph, Vertex goal, DistanceExtent extent = DistanceExtent::kAll,
                const Deadline& deadline = {});
  /// One on demand. @pre guide.grid outlives the table, goal and guide.from are vertices of it.
  DistanceTable(Vertex goal, DistanceGuide guide);
  ~DistanceTable();

  Vertex goal() const { return goal_; }
  std::uint32_t operator()(Vertex v) const {
    if (!wide_.empty()) return wide_[v] != kUnreachable ? wide_[v] : search(v);
    const std::uint16_t d = graph_ == nullptr ? narrow_[v] : narrow_[placeOf(v)];
    return d != kNarrowUnknown ? d : search(v);
  }
  bool isWide() const { return !wide_.empty(); }
  /// Whether several threads may read it.
  bool isShareable() const { return graph_ == nullptr; }
  /// The entries of a table of kAll that takes 16 bits, by vertex, 0xffff where there is no way;
  /// null for any other table. For loops that read nothing but distances.
  const std::uint16_t* narrowEntries() const {
    return graph_ == nullptr && wide_.empty() ? narrow_.data() : nullptr;
  }
  /// Memory that it takes now [bytes], nearly.
  std::size_t bytes() const;

 private:
  static constexpr std::uint16_t kNarrowUnknown = 0xffffU;

  static constexpr std::uint32_t kPageBits = 6;
  static constexpr std::uint32_t kPageSize = 1U << kPageBits;

  std::size_t placeOf(Vertex v) const {
    return std::size_t{page_of_[v >> kPageBits]} * kPageSize + v % kPageSize;
  }
  void searchAll(const Graph& graph, const Deadline& deadline);
  /// Goes on until the queue is empty or a distance outgrows 16 bits. @pre the queue has room for
  /// one vertex more than the graph has.
  void searchByFours(const Vertex* rows, Vertex* queue, std::size_t& head, std::size_t& tail,
                     const Deadline& deadline);
  /// Goes on with 32 bits from a queue whose distances outgrow 16.
  void searchWide(const Graph& graph, std::vector<Vertex>& queue, std::size_t head,
                  std::size_t tail, const Deadline& deadline);
  struct GuidedSearch;
  struct DetourSearch;
  // At this share of the vertices a search of parts has taken more than half as long as one of all.
  static constexpr std::size_t kShareWorthCompleting = 8;

  void startOnDemand(const Graph& graph);
  /// Goes on with the search until it meets `v` or ends.
  std::uint32_t search(Vertex v) const;
  std::uint32_t searchGuided(Vertex v) const;
  std::size_t bytesOfGuide() const;
  /// Whether the table begins with the ways from wherever somebody asks, see DetourSearch.
  static bool paysDetours(const DistanceGuide& guide);
  void startDetours(DistanceGuide guide);
  void leaveDetours() const;
  std::uint32_t searchDetours(Vertex v) const;
  void tryNextMove() const;
  std::uint8_t& leastDetour(Vertex v) const;
  std::size_t bytesOfDetours() const;
  /// Whether so much is known that a search of all is the cheaper way to the rest.
  bool isWorthCompleting() const;
  /// @throws std::bad_alloc; the table is then as it was.
  void complete() const;
  /// Puts the neighbours of a vertex where they belong; returns whether `v` is now known.
  bool expandGuided(Vertex from, Vertex v) const;
  bool isKnown(Vertex v) const {
    return wide_.empty() ? narrow_[placeOf(v)] != kNarrowUnknown : wide_[v] != kUnreachable;
  }
  void settle(Vertex v, std::uint32_t distance) const;
  /// Makes room for the distance of `v`. @pre distances take 16 bits.
  void takePage(Vertex v) const;
  void widen() const;

  Vertex goal_;
  // What a search on demand changes; all is known when its head meets the queue's end. Its 16 bit
  // distances lie in pages, taken when a vertex of theirs is met; page 0 is the unknown one.
  mutable std::vector<std::uint16_t> narrow_;
  mutable std::vector<std::uint32_t> page_of_;
  mutable std::vector<std::uint32_t> wide_;
  mutable std::vector<Vertex> queue_;
  mutable std::size_t head_ = 0;
  mutable const Graph* graph_ = nullptr;  // null: everything was searched at once
  mutable std::unique_ptr<GuidedSearch> guided_;
  mutable std::unique_ptr<DetourSearch> detours_;
};

class DistanceTables;
class TablePool;

/// A table while somebody reads it. It stands until then, whatever becomes of the others. One of a
/// pool belongs to the holder alone, which gives it back at its end. @pre the tables that it comes
/// from outlive it.
class HeldDistances {
 public:
  /// Of a table that stands as long as its tables.
  explicit HeldDistances(const DistanceTable& kept) : table_(&kept) {}
  HeldDistances(std::unique_ptr<const DistanceTable> own, const DistanceTables& from,
                std::uint32_t number);
  HeldDistances(HeldDistances&& other) noexcept;
  HeldDistances& operator=(HeldDistances&& other) noexcept;
  HeldDistances(const HeldDistances&) = delete;
  HeldDistances& operator=(const HeldDistances&) = delete;
  ~HeldDistances();

  const DistanceTable& operator*() const& { return *table_; }
  const DistanceTable& operator*() const&& = delete;  // it would be gone
  const DistanceTable* operator->() const& { return table_; }
  const DistanceTable* operator->() const&& = delete;
  std::uint32_t operator()(Vertex v) const { return (*table_)(v); }

 private:
  void giveBack();

  const DistanceTable* table_;
  std::unique_ptr<const DistanceTable> own_;  // null: it stands elsewhere
  const DistanceTables* from_ = nullptr;
  std::uint32_t number_ = 0;
};

/// One distance table a goal, each computed when first asked for and kept from then on.
/// Thread-safe: two threads asking for the same table compute it once; what they may do with it,
/// DistanceExtent says. Those of a pool are kept while there is room, and made again when they are
/// asked for again: each is found on demand and belongs to one holder at a time, so two threads
/// asking for the same table get two.
class DistanceTables {
 public:
  /// Tables that stand already, by number; null: it does not. So stages never search for the same
  /// goal twice.
  using Standing = std::vector<std::shared_ptr<const DistanceTable>>;

  /// @pre `graph` outlives this object.
  DistanceTables(const Graph& graph, const std::vector<Vertex>& goals,
                 DistanceExtent extent = DistanceExtent::kAll);
  /// The same on the graph of a grid, which is asked for with the first table.
  /// @param standing  empty, or one a goal, to this goal. @pre `grid` outlives this object.
  DistanceTables(const Grid& grid, const std::vector<Vertex>& goals, DistanceExtent extent,
                 const Standing& standing = {});
  /// Tables on demand for robots on the way from `starts` to `goals`. @param known  tables of the
  /// same robots to other goals. @pre `grid` outlives this object; every goal can be reached.
  DistanceTables(const Grid& grid, const std::vector<Vertex>& starts,
                 const std::vector<Vertex>& goals, std::shared_ptr<const DistanceTables> known,
                 const Standing& standing);
  /// Tables of a pool, which others may share. @pre `grid` outlives this object.
  DistanceTables(const Grid& grid, const std::vector<Vertex>& starts,
                 const std::vector<Vertex>& goals, std::shared_ptr<TablePool> pool);
  ~DistanceTables();
  DistanceTables(const DistanceTables&) = delete;
  DistanceTables& operator=(const DistanceTables&) = delete;

  HeldDistances operator[](std::uint32_t i) const { return hold(i, {}); }
  /// The same until the deadline: who comes later tries again. @throws Interrupted.
  HeldDistances hold(std::uint32_t i, const Deadline& deadline) const;
  /// The distance of a vertex that is known from now on. @pre always the same vertex for a table.
  std::uint32_t lengthFrom(Vertex start, std::uint32_t i) const;
  /// Frees a table of a pool that nobody is likely to read soon.
  void giveUp(std::uint32_t i) const;
  /// Null: they belong to no pool.
  const std::shared_ptr<TablePool>& pool() const { return pool_; }
  /// @pre they belong to no pool.
  std::shared_ptr<const DistanceTable> share(std::uint32_t i) const;
  /// Bytes of all tables once everything is known.
  std::size_t bytesOfAll() const;
  bool areAll() const { return extent_ == DistanceExtent::kAll; }

 private:
  friend class HeldDistances;
  const DistanceTable& find(std::uint32_t i, const Deadline& deadline) const;
  struct Slot {
    std::once_flag once;
    std::shared_ptr<const DistanceTable> table;
  };
  std::shared_ptr<const DistanceTable> make(std::uint32_t i, const Deadline& deadline) const;

  const Graph* graph_ = nullptr;  // null: the grid's
  const Grid* grid_ = nullptr;
  std::vector<Vertex> goals_;
  DistanceExtent extent_;
  std::vector<Vertex> starts_;  // empty: without guides
  std::shared_ptr<const DistanceTables> known_;
  mutable std::vector<Slot> slots_;  // of tables that are kept
  std::shared_ptr<TablePool> pool_;
  std::uint64_t number_in_pool_ = 0;
  mutable std::vector<std::atomic<std::uint32_t>> lengths_;  // of a pool: see lengthFrom()
};

}  // namespace split_mapf
