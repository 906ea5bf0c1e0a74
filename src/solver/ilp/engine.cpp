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

}  // namespace split_mapf::ilp
