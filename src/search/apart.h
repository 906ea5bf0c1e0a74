#pragma once

namespace split_mapf {

/// An element of an array that shares no cache line with the next one (two are fetched at once).
/// For searches of different threads: each writes to itself at every state, and where two such
/// lines were one, two threads were no faster than one.
template <typename T>
struct alignas(128) Apart {
  T value;
};

}  // namespace split_mapf
