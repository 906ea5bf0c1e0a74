#pragma once

#include <memory>

#include "split_mapf/core/deadline.h"

namespace split_mapf::tool {

/// Turns SIGINT and SIGTERM into a raised stop flag, for the rest of the process.
/// @return the flag. Call it once, before other threads start.
std::shared_ptr<const StopFlag> catchStopSignals();

/// While this object lives, files are being read. Reading polls no deadline (a map may lie behind a
/// pipe or a slow network), so the process itself ends: half a second after `limit_sec` is over
/// with exit code 3, half a second after a signal with 4.
class ReadingGuard {
 public:
  /// @param limit_sec  seconds from now, >= 0.
  explicit ReadingGuard(double limit_sec);
  ~ReadingGuard();
  ReadingGuard(const ReadingGuard&) = delete;
  ReadingGuard& operator=(const ReadingGuard&) = delete;
};

}  // namespace split_mapf::tool
