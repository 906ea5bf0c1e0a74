#include "ros/convert/text_limits.h"

#include "split_mapf/core/wording.h"

namespace split_mapf {

std::string faultOfName(const std::string& name) {
  if (name.size() <= kMostNameBytes) return "";
  return "has " + counted(name.size(), "byte") + "; at most " + std::to_string(kMostNameBytes) +
         " are possible";
}

std::string faultOfRobotId(const std::string& id) {
  if (id.empty()) return "is empty";
  return isUtf8(id) ? faultOfName(id) : "is no UTF-8";
}

}  // namespace split_mapf
