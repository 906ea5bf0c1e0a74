#include "split_mapf/core/error.h"

#include <utility>

#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

std::string summarise(const std::vector<InstanceFault>& faults) {
  if (faults.empty()) return "ill-posed instance";
  std::string text = faults.front().message;
  if (faults.size() > 1) {
    text += " (and " + counted(faults.size() - 1, "more robot") + " at fault)";
  }
  return text;
}

}  // namespace

InstanceError::InstanceError(std::vector<InstanceFault> faults)
    : InputError(summarise(faults)), faults_(std::move(faults)) {}

}  // namespace split_mapf
