#include "core/table_pool.h"

#include <iterator>

namespace split_mapf {

std::uint64_t TablePool::enlist() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return ++owners_;
}

std::size_t TablePool::bytes() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return bytes_;
}

std::unique_ptr<const DistanceTable> TablePool::take(std::uint64_t owner, std::uint32_t number) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto place = places_.find({owner, number});
  if (place == places_.end()) return nullptr;
  std::unique_ptr<const DistanceTable> table = std::move(place->second->table);
  bytes_ -= place->second->bytes;
  entries_.erase(place->second);
  places_.erase(place);
  return table;
}

void TablePool::put(std::uint64_t owner, std::uint32_t number,
                    std::unique_ptr<const DistanceTable> table) {
  const std::size_t bytes = table->bytes();
  Entries gone;  // freed behind the lock
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = places_.find({owner, number});
  if (known != places_.end()) {
    Entry& other = *known->second;
    if (other.bytes < bytes) {
      other.table.swap(table);
      bytes_ += bytes - other.bytes;
      other.bytes = bytes;
    }
    entries_.splice(entries_.begin(), entries_, known->second);
  } else {
    Entries fresh;  // memory may run out at either step, with nothing changed
    fresh.push_front({owner, number, bytes, std::move(table)});
    places_.emplace(Key{owner, number}, fresh.begin());
    entries_.splice(entries_.begin(), fresh);
    bytes_ += bytes;
  }
  while (bytes_ > most_bytes_ && !entries_.empty()) {
    const auto last = std::prev(entries_.end());
    places_.erase({last->owner, last->number});
    bytes_ -= last->bytes;
    gone.splice(gone.begin(), entries_, last);
  }
}

}  // namespace split_mapf
