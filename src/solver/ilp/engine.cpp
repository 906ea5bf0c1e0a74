#include "solver/ilp/engine.h"

#include <algorithm>

namespace split_mapf::ilp {

void SearchCounts::add(const SearchCounts& later) {
  nodes += later.nodes;
  linear_programs += later.linear_programs;
  columns = std::max(columns, later.columns);
  rows = std::max(rows, later.rows);
  expansions += later.expansions;
}

Effort restOf(const Effort& effort, const SearchCounts& counts) {
  Effort rest = effort;
  if (effort.expansions > 0) {
    rest.expansions = effort.expansions - std::min(effort.expansions - 1, counts.expansions);
  }
  return rest;
}

bool fitsMemory(std::uint64_t needed_bytes, const Effort& effort, EngineResult& result) {
  if (needed_bytes <= effort.memory_mb * kBytesAMegabyte) return true;
  result.end = SearchEnd::kMemory;
  result.needed_mb = needed_bytes / kBytesAMegabyte + 1;
  return false;
}

}  // namespace split_mapf::ilp
