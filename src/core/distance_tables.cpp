#include <exception>
#include <new>
#include <utility>

#include "core/table_pool.h"
#include "split_mapf/core/distance_table.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kUnknownLength = DistanceTable::kUnreachable - 1;

}  // namespace

HeldDistances::HeldDistances(std::unique_ptr<const DistanceTable> own, const DistanceTables& from,
                             std::uint32_t number)
    : table_(own.get()), own_(std::move(own)), from_(&from), number_(number) {}

HeldDistances::HeldDistances(HeldDistances&& other) noexcept
    : table_(other.table_),
      own_(std::move(other.own_)),
      from_(other.from_),
      number_(other.number_) {}

HeldDistances& HeldDistances::operator=(HeldDistances&& other) noexcept {
  if (this == &other) return *this;
  giveBack();
  table_ = other.table_;
  own_ = std::move(other.own_);
  from_ = other.from_;
  number_ = other.number_;
  return *this;
}

HeldDistances::~HeldDistances() { giveBack(); }

void HeldDistances::giveBack() {
  // What was read when memory ran out may have lost a part of its search.
  if (!own_ || std::uncaught_exceptions() > 0) return own_.reset();
  try {
    from_->pool_->put(from_->number_in_pool_, number_, std::move(own_));
  } catch (const std::bad_alloc&) {
    // Then it is made again when somebody asks for it.
  }
}

DistanceTables::DistanceTables(const Graph& graph, const std::vector<Vertex>& goals,
                               DistanceExtent extent)
    : graph_(&graph), goals_(goals), extent_(extent), slots_(goals.size()) {}

DistanceTables::DistanceTables(const Grid& grid, const std::vector<Vertex>& goals,
                               DistanceExtent extent, const Standing& standing)
    : grid_(&grid), goals_(goals), extent_(extent), slots_(goals.size()) {
  for (std::size_t i = 0; i < standing.size(); ++i) slots_[i].table = standing[i];
}

DistanceTables::DistanceTables(const Grid& grid, const std::vector<Vertex>& starts,
                               const std::vector<Vertex>& goals,
                               std::shared_ptr<const DistanceTables> known,
                               const Standing& standing)
    : DistanceTables(grid, goals, DistanceExtent::kOnDemand, standing) {
  starts_ = starts;
  known_ = std::move(known);
}

DistanceTables::DistanceTables(const Grid& grid, const std::vector<Vertex>& starts,
                               const std::vector<Vertex>& goals, std::shared_ptr<TablePool> pool)
    : grid_(&grid),
      goals_(goals),
      extent_(DistanceExtent::kOnDemand),
      starts_(starts),
      pool_(std::move(pool)),
      number_in_pool_(pool_->enlist()),
      lengths_(goals.size()) {
  for (std::atomic<std::uint32_t>& length : lengths_) length = kUnknownLength;
}

DistanceTables::~DistanceTables() {
  for (std::uint32_t i = 0; pool_ && i < goals_.size(); ++i) giveUp(i);
}

std::shared_ptr<const DistanceTable> DistanceTables::make(std::uint32_t i,
                                                          const Deadline& deadline) const {
  if (starts_.empty()) {
    const Graph& graph = graph_ != nullptr ? *graph_ : grid_->graph(deadline);
    return std::make_shared<const DistanceTable>(graph, goals_[i], extent_, deadline);
  }
  return std::make_shared<const DistanceTable>(
      goals_[i], DistanceGuide{grid_, starts_[i], known_->share(i), false});
}

const DistanceTable& DistanceTables::find(std::uint32_t i, const Deadline& deadline) const {
  Slot& slot = slots_[i];
  std::call_once(slot.once, [&] {
    if (!slot.table) slot.table = make(i, deadline);
  });
  return *slot.table;
}

HeldDistances DistanceTables::hold(std::uint32_t i, const Deadline& deadline) const {
  if (!pool_) return HeldDistances(find(i, deadline));
  std::unique_ptr<const DistanceTable> table = pool_->take(number_in_pool_, i);
  if (!table) {
    table = std::make_unique<const DistanceTable>(goals_[i],
                                                  DistanceGuide{grid_, starts_[i], nullptr, true});
  }
  return HeldDistances(std::move(table), *this, i);
}

std::uint32_t DistanceTables::lengthFrom(Vertex start, std::uint32_t i) const {
  if (!pool_) return find(i, {})(start);
  std::uint32_t length = lengths_[i].load(std::memory_order_relaxed);
  if (length == kUnknownLength) {
    length = hold(i, {})(start);
    lengths_[i].store(length, std::memory_order_relaxed);
  }
  return length;
}

void DistanceTables::giveUp(std::uint32_t i) const {
  if (pool_) pool_->take(number_in_pool_, i);
}

std::shared_ptr<const DistanceTable> DistanceTables::share(std::uint32_t i) const {
  find(i, {});
  return slots_[i].table;
}

std::size_t DistanceTables::bytesOfAll() const {
  const std::size_t vertices = graph_ != nullptr ? graph_->size() : grid_->size();
  return goals_.size() * vertices * sizeof(std::uint16_t);
}

}  // namespace split_mapf
