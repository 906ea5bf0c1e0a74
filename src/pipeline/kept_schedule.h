#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Where all robots would be, had nothing happened since a replan.
struct KeptSchedule {
  Plan plan;
  std::uint64_t begin = 0;    ///< of its steps [ticks of the caller's clock]
  std::uint32_t headway = 0;  ///< that it keeps [steps], see ReservationTable
};

/// What becomes of an execution if all robots that can go on as they were meant to. When one is
/// late, orders that are kept make hundreds late that have nothing to do with it.
struct ScheduleDraft {
  Plan plan;  ///< without conflicts, but for those who have no place
  /// Who is not where it was meant to be, and whose way leads over where such a one stands.
  std::vector<std::uint32_t> unplaced;
  std::uint64_t saved = 0;  ///< by how many steps more the others arrive sooner than later
};

/// @param rest  what becomes of it if all orders are kept: a plan with the same goals; robots
/// without a place keep what they have there. @param departures  steps until which each robot stays
/// at the start of `rest`. @param passed  steps since the schedule began.
/// @return no robot has a place where the schedule is of other robots. Cost: O(entries of the
/// plans).
ScheduleDraft draftBySchedule(const KeptSchedule& schedule, const Plan& rest,
                              const std::vector<std::uint32_t>& departures, std::uint32_t passed,
                              std::uint32_t vertices);

}  // namespace split_mapf
