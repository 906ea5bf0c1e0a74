#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// The orders that makeOrder() knows: shortest_first, longest_first, random, given.
const std::vector<std::string>& robotOrders();
/// All robots in an order of robotOrders(); of equal lengths in ascending order. Draws from the
/// engine for `random` only.
std::vector<std::uint32_t> makeOrder(const Instance& instance, const std::string& name,
                                     RandomEngine& engine);
/// Sorts robots by their shortest paths, keeping the order of equal ones.
void sortShortestFirst(const Instance& instance, std::vector<std::uint32_t>& robots);

}  // namespace split_mapf
