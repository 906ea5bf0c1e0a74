#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/ilp/conflict_row.h"
#include "solver/ilp/glpk_model.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/plan.h"

namespace split_mapf::ilp {

/// Limits of one search.
struct Effort {
  Deadline deadline;
  std::size_t memory_mb = 1024;
  std::uint64_t expansions = 0;  ///< states of pricing and work of the simplex method; 0: no limit
};

/// What a search has used.
struct SearchCounts {
  std::uint64_t nodes = 0;
  std::uint64_t linear_programs = 0;
  std::uint64_t columns = 0;  ///< of the largest linear program
  std::uint64_t rows = 0;     ///< likewise
  std::uint64_t expansions = 0;

  /// Adds the counts of a search that came after.
  void add(const SearchCounts& later);
};

/// Why a search ended.
enum class SearchEnd {
  kExhausted,    ///< finished: the bound is proved and so is the plan
  kInterrupted,  ///< by the deadline
  kEffort,       ///< by the limit of expansions
  kMemory,       ///< by the limit of memory
  kFailed,       ///< GLPK gave up
};

/// What an engine has found and proved.
struct EngineResult {
  SearchEnd end = SearchEnd::kExhausted;
  std::optional<Plan> plan;       ///< better than what was known, if any
  std::uint64_t lower_bound = 0;  ///< proved
  std::uint64_t needed_mb = 0;    ///< set when a model was refused for its size
  std::string failure;            ///< set when kFailed
  SearchCounts counts;
};

/// What is left of an effort after searches that have used `counts`; at least one expansion.
Effort restOf(const Effort& effort, const SearchCounts& counts);

/// False, with the result's end set, when a search would need more memory than it may take.
bool fitsMemory(std::uint64_t needed_bytes, const Effort& effort, EngineResult& result);

/// Runs a search and takes over its end, its plan if it has one, and what it used. A failure of
/// GLPK becomes the end.
template <typename Search>
void runSearch(Search& search, EngineResult& result) {
  try {
    result.end = search.run();
  } catch (const GlpkError& error) {
    result.end = error.kind() == GlpkError::Kind::kMemory ? SearchEnd::kMemory : SearchEnd::kFailed;
    result.failure = error.what();
  }
  result.counts.add(search.counts());
  if (search.plan()) result.plan = search.plan();
}

/// Turns a fractional solution into a plan that costs less than the limit, or into nothing.
using Rounding =
    std::function<std::optional<Plan>(const std::vector<UsedPath>& used, std::uint64_t cost_limit)>;

constexpr std::uint64_t kBytesAMegabyte = 1U << 20;

}  // namespace split_mapf::ilp
