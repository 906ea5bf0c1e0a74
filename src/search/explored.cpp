#include "search/explored.h"

namespace split_mapf {
namespace {

constexpr std::size_t kFirstSlots = 1024;

}  // namespace

std::uint64_t placeHash(std::uint32_t robot, Vertex v) {
  // The finalizer of splitmix64.
  std::uint64_t x = (std::uint64_t{robot} << 32 | v) + 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

std::uint64_t hashOf(const Configuration& configuration) {
  std::uint64_t hash = 0;
  for (std::uint32_t i = 0; i < configuration.size(); ++i) hash ^= placeHash(i, configuration[i]);
  return hash;
}

Explored::Explored(std::uint32_t robots, std::uint32_t vertices)
    : rows_(robots, vertices - 1), slots_(kFirstSlots, kFree) {}

std::optional<std::uint32_t> Explored::find(const Configuration& configuration,
                                            std::uint64_t hash) const {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = hash & mask; slots_[slot] != kFree; slot = (slot + 1) & mask) {
    const std::uint32_t number = slots_[slot];
    if (hashes_[number] == hash && rows_.equals(number, configuration)) return number;
  }
  return std::nullopt;
}

std::uint32_t Explored::add(const Configuration& configuration, std::uint64_t hash) {
  const std::uint32_t number = rows_.size();
  rows_.append(configuration);
  hashes_.push_back(hash);
  if (2 * hashes_.size() > slots_.size()) {
    grow();
  } else {
    place(number);
  }
  return number;
}

void Explored::place(std::uint32_t number) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hashes_[number] & mask;
  while (slots_[slot] != kFree) slot = (slot + 1) & mask;
  slots_[slot] = number;
}

void Explored::grow() {
  slots_.assign(2 * slots_.size(), kFree);
  for (std::uint32_t number = 0; number < rows_.size(); ++number) place(number);
}

}  // namespace split_mapf
