#pragma once

#include <vector>

#include "search/path_table.h"
#include "solver/ecbs/low_level.h"
#include "solver/ecbs/settings.h"
#include "solver/reserved_paths.h"
#include "split_mapf/core/instance.h"

namespace split_mapf {

/// What all trees of one run share. Not thread-safe.
struct EcbsRun {
  /// @pre all arguments outlive this object.
  EcbsRun(const Instance& for_instance, const EcbsSettings& with_settings,
          const ReservedPaths& around_reserved, const Deadline& until_deadline)
      : instance(for_instance),
        settings(with_settings),
        reserved(around_reserved),
        deadline(until_deadline),
        table(for_instance.graph().size()),
        low_level(for_instance, with_settings, table, around_reserved.table(), until_deadline),
        paths(for_instance.robots()) {}

  const Instance& instance;
  const EcbsSettings& settings;
  const ReservedPaths& reserved;
  const Deadline& deadline;
  PathTable table;  ///< holds `paths`
  LowLevel low_level;
  bool joint = false;       ///< whether a search over joint states has settled a group
  std::vector<Path> paths;  ///< robot -> path in the plan under construction; empty: none yet
};

}  // namespace split_mapf
