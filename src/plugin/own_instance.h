#pragma once

#include "split_mapf/core/instance.h"

namespace split_mapf {

/// The same problem with distance tables that several threads may use: those of the instance where
/// they are such, new ones elsewhere. For calls that may outlive their callers.
Instance ownInstance(const Instance& instance);

}  // namespace split_mapf
