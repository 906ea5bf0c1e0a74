#include "search/robot_order.h"

#include <algorithm>
#include <numeric>

namespace split_mapf {

const std::vector<std::string>& robotOrders() {
  static const std::vector<std::string> names = {"shortest_first", "longest_first", "random",
                                                 "given"};
  return names;
}

std::vector<std::uint32_t> makeOrder(const Instance& instance, const std::string& name,
                                     RandomEngine& engine) {
  std::vector<std::uint32_t> order(instance.robots());
  std::iota(order.begin(), order.end(), 0U);
  if (name == "random") shuffle(order, engine);
  if (name == "shortest_first") sortShortestFirst(instance, order);
  if (name == "longest_first") {
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return instance.shortestLength(b) < instance.shortestLength(a);
    });
  }
  return order;
}

void sortShortestFirst(const Instance& instance, std::vector<std::uint32_t>& robots) {
  std::stable_sort(robots.begin(), robots.end(), [&](std::uint32_t a, std::uint32_t b) {
    return instance.shortestLength(a) < instance.shortestLength(b);
  });
}

}  // namespace split_mapf
