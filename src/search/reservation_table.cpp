#include "search/reservation_table.h"

#include <algorithm>

namespace split_mapf {

ReservationTable::ReservationTable(std::uint32_t vertices, std::uint32_t headway)
    : paths_(vertices, headway), bits_(vertices, 0), held_(headway > 0 ? vertices : 0, 0) {}

ReservationTable::ReservationTable(std::uint32_t vertices, const Plan& plan, std::uint32_t headway)
    : ReservationTable(vertices, headway) {
  std::size_t steps = 0;
  for (const Path& path : plan.paths) steps = std::max(steps, path.size());
  coverSteps(steps + headway);
  paths_.insertAll(plan.paths);
  for (Vertex v = 0; v < vertices; ++v) {
    for (const Stay& stay : at(v)) hold(v, stay.begin, stay.end);
    if (headway == 0 || at(v).empty()) continue;
    for (std::uint32_t word = 0; word < words_; ++word) showHeld(v, word);
  }
}

/// Sets the bits of steps begin .. end-1 of who is at `v`, or has just left.
void ReservationTable::hold(Vertex v, std::uint32_t begin, std::uint32_t end) {
  std::uint64_t* const row = (headway() > 0 ? held_ : bits_).data() + std::size_t{v} * words_;
  const std::uint32_t last = std::min(end, 64 * words_) - 1;
  const std::uint64_t from = ~std::uint64_t{0} << (begin % 64);
  const std::uint64_t to = ~std::uint64_t{0} >> (63 - last % 64);
  if (begin / 64 == last / 64) {
    row[begin / 64] |= from & to;
    return;
  }
  row[begin / 64] |= from;
  for (std::uint32_t word = begin / 64 + 1; word < last / 64; ++word) row[word] = ~std::uint64_t{0};
  row[last / 64] |= to;
}

void ReservationTable::insert(std::uint32_t robot, const Path& path) {
  coverSteps(path.size() + headway());
  paths_.insert(robot, path);
  flip(path, 0);
}

void ReservationTable::remove(std::uint32_t robot, const Path& path) {
  paths_.remove(robot, path);
  flip(path, 0);
}

bool ReservationTable::exchange(std::uint32_t robot, Path& own, Path& path) {
  remove(robot, own);
  const bool free = isFree(path, 0);
  if (free) own.swap(path);
  insert(robot, own);
  return free;
}

void ReservationTable::removeTail(std::uint32_t robot, const Path& path, std::uint32_t from) {
  coverSteps(from + std::size_t{2} + headway());
  paths_.removeTail(robot, path, from);
  flip(path, from + 1);
  toggleHeadway(path, from);
}

void ReservationTable::insertTail(std::uint32_t robot, const Path& path, std::uint32_t from) {
  coverSteps(std::max<std::size_t>(path.size(), from + std::size_t{2}) + headway());
  paths_.insertTail(robot, path, from);
  toggleHeadway(path, from);
  flip(path, from + 1);
}

bool ReservationTable::isFree(const Path& path, std::uint32_t from) const {
  const std::vector<Stay>& at_goal = at(path.back());
  if (!at_goal.empty() && at_goal.back().begin >= path.size()) return false;
  for (auto t = static_cast<std::uint32_t>(path.size() - 1); t > from; --t) {
    if (isTaken(path[t], t) || oncoming(path[t - 1], path[t], t) != nullptr) return false;
  }
  return true;
}

void ReservationTable::removeHead(std::uint32_t robot, const Path& path, std::uint32_t from) {
  paths_.removeHead(robot, path, from);
  flipSteps(path, 0, from + 1);
  toggleHeadway(path, from);
}

std::uint32_t ReservationTable::takenAfter(Vertex v, std::uint32_t t, std::uint32_t last) const {
  std::uint64_t steps = ~std::uint64_t{0} << (t % 64) << 1U;
  for (std::uint32_t word = t / 64; word <= last / 64; ++word) {
    const std::uint64_t seen = taken(v, word) & steps;
    if (seen != 0) {
      return std::min(64 * word + static_cast<std::uint32_t>(__builtin_ctzll(seen)), last + 1);
    }
    steps = ~std::uint64_t{0};
  }
  return last + 1;
}

std::uint32_t ReservationTable::freeSince(Vertex v, std::uint32_t t) const {
  if (t == 0) return 0;
  std::uint64_t steps = ~std::uint64_t{0} >> (63 - (t - 1) % 64);
  for (std::uint32_t word = (t - 1) / 64 + 1; word-- > 0;) {
    const std::uint64_t seen = heldSteps(v, word) & steps;
    if (seen != 0) return 64 * (word + 1) - static_cast<std::uint32_t>(__builtin_clzll(seen));
    steps = ~std::uint64_t{0};
  }
  return 0;
}

/// Who would be there in the step before a visit would not have left for long enough.
void ReservationTable::showHeld(Vertex v, std::uint32_t word) {
  const std::uint64_t held = heldSteps(v, word);
  bits_[std::size_t{v} * words_ + word] = held | held >> 1U | heldSteps(v, word + 1) << 63U;
}

void ReservationTable::toggleHeld(Vertex v, std::uint32_t t) {
  const std::uint32_t word = t / 64;
  held_[std::size_t{v} * words_ + word] ^= std::uint64_t{1} << (t % 64);
  showHeld(v, word);
  if (t % 64 == 0 && word > 0) showHeld(v, word - 1);
}

/// Steps from .. to-1. A robot is alone where it is, so its bits are all unset or all set.
void ReservationTable::flipSteps(const Path& path, std::uint32_t from, std::uint32_t to) {
  for (std::uint32_t t = from; t < to; ++t) {
    const Vertex at = positionAt(path, t);
    toggleStep(at, t);
    if (headway() > 0 && t > 0 && positionAt(path, t - 1) != at) toggleStep(path[t - 1], t);
  }
}

/// From step `from` on.
void ReservationTable::flip(const Path& path, std::uint32_t from) {
  const std::uint32_t size = std::max(static_cast<std::uint32_t>(path.size()), from);
  flipSteps(path, from, size);
  // At its goal for good.
  std::vector<std::uint64_t>& bits = headway() > 0 ? held_ : bits_;
  std::uint64_t* const row = bits.data() + std::size_t{path.back()} * words_;
  if (size % 64 != 0) row[size / 64] ^= ~std::uint64_t{0} << (size % 64);
  for (std::uint32_t word = (size + 63) / 64; word < words_; ++word) row[word] = ~row[word];
  if (headway() == 0) return;
  for (std::uint32_t word = size / 64 - (size >= 64 ? 1 : 0); word < words_; ++word) {
    showHeld(path.back(), word);
  }
}

void ReservationTable::coverSteps(std::size_t steps) {
  if (steps <= std::size_t{64} * words_) return;
  const auto needed = static_cast<std::uint32_t>((steps + 63) / 64);
  const std::uint32_t words = std::max(needed, words_ + words_ / 4 + 1);
  const std::size_t vertices = bits_.size() / words_;
  for (std::vector<std::uint64_t>* const known : {&bits_, &held_}) {
    if (known->empty()) continue;
    std::vector<std::uint64_t> bits(vertices * words);
    for (std::size_t v = 0; v < vertices; ++v) {
      const auto row = known->begin() + static_cast<std::ptrdiff_t>(v * words_);
      const auto end =
          std::copy(row, row + words_, bits.begin() + static_cast<std::ptrdiff_t>(v * words));
      std::fill(end, bits.begin() + static_cast<std::ptrdiff_t>((v + 1) * words),
                everAfter(row[words_ - 1]));
    }
    *known = std::move(bits);
  }
  words_ = words;
}

const Stay* ReservationTable::oncoming(Vertex from, Vertex to, std::uint32_t t) const {
  if (!isTaken(to, t - 1) || !isTaken(from, t)) return nullptr;
  const std::vector<Stay>& stays = at(to);
  const auto before = std::partition_point(stays.begin(), stays.end(),
                                           [t](const Stay& stay) { return stay.end < t; });
  const bool comes = before != stays.end() && before->end == t && before->next == from;
  return comes ? &*before : nullptr;
}

ReservationTable tableOf(std::uint32_t vertices, const Plan& plan, const Reservations* reserved,
                         std::uint32_t headway) {
  ReservationTable table(vertices, plan, headway);
  if (reserved == nullptr) return table;
  auto number = static_cast<std::uint32_t>(plan.paths.size());
  for (const Path& path : reserved->paths()) table.insert(number++, path);
  return table;
}

}  // namespace split_mapf
