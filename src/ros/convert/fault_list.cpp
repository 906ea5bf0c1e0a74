#include "split_mapf/ros/fault_list.h"

#include <algorithm>
#include <utility>

namespace split_mapf {

void FaultList::add(std::size_t robot, RobotFault fault) {
  ++total_;
  entries_.push_back({robot, std::move(fault)});
  if (entries_.size() >= 2 * kMostFaults) cut(entries_);
}

std::vector<RobotFault> FaultList::first() const {
  std::vector<Entry> entries = entries_;
  cut(entries);
  std::vector<RobotFault> faults;
  faults.reserve(entries.size());
  for (Entry& entry : entries) faults.push_back(std::move(entry.fault));
  return faults;
}

void FaultList::cut(std::vector<Entry>& entries) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.robot < b.robot; });
  if (entries.size() > kMostFaults) {
    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(kMostFaults), entries.end());
  }
}

}  // namespace split_mapf
