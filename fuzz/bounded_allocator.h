#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace split_mapf::fuzz {

/// The usual allocator with a bound on each request. roscpp makes room for as many elements as a
/// message says that it has, before it looks whether they follow.
template <class T>
struct BoundedAllocator {
  static constexpr std::size_t kMostBytes = std::size_t{1} << 20U;

  using value_type = T;  // NOLINT(readability-identifier-naming): the standard's names
  template <class Other>
  struct rebind {                           // NOLINT(readability-identifier-naming)
    using other = BoundedAllocator<Other>;  // NOLINT(readability-identifier-naming)
  };

  BoundedAllocator() = default;
  template <class Other>
  BoundedAllocator(const BoundedAllocator<Other>& /*other*/) {}  // NOLINT: converts, as others do

  T* allocate(std::size_t count) {
    if (count > kMostBytes / sizeof(T)) throw std::bad_alloc();
    return std::allocator<T>().allocate(count);
  }
  void deallocate(T* at, std::size_t count) { std::allocator<T>().deallocate(at, count); }

  bool operator==(const BoundedAllocator& /*other*/) const { return true; }
  bool operator!=(const BoundedAllocator& /*other*/) const { return false; }
};

}  // namespace split_mapf::fuzz
