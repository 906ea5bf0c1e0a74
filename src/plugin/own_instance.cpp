#include "plugin/own_instance.h"

#include <utility>

namespace split_mapf {

Instance ownInstance(const Instance& instance) {
  // Tables of a pool belong to one reader at a time, and the pool to whoever uses it last.
  if (instance.isBounded()) return Instance::partOf(instance, instance.problem());
  DistanceTables::Standing standing(instance.robots());
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    std::shared_ptr<const DistanceTable> table = instance.shareDistances(robot);
    if (table->isShareable()) standing[robot] = std::move(table);
  }
  return Instance(instance.problem(), DistanceExtent::kAll, standing);
}

}  // namespace split_mapf
