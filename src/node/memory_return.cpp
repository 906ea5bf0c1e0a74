#include "node/memory_return.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace split_mapf {
namespace {

constexpr double kPeriodSec = 0.5;
// To give memory back holds up who allocates, for milliseconds: while goals run, every so many
// looks are enough.
constexpr std::uint32_t kLooksWhileRunning = 20;
#ifdef __GLIBC__
constexpr int kKeptBytes = 2 << 20;
#endif

}  // namespace

void limitArenas(std::uint32_t arenas) {
#ifdef M_ARENA_MAX
  mallopt(M_ARENA_MAX, static_cast<int>(arenas));
#else
  static_cast<void>(arenas);
#endif
#ifdef __GLIBC__
  // Left alone, glibc lets both grow to 32 and 64 MiB after the first large goal, and keeps as much
  // at the top of each arena, where malloc_trim() does not reach.
  mallopt(M_MMAP_THRESHOLD, kKeptBytes);
  mallopt(M_TRIM_THRESHOLD, kKeptBytes);
#endif
}

MemoryReturn::MemoryReturn(const ros::NodeHandle& node, const PlanServer& server)
    : server_(server) {
  timer_ = node.createWallTimer(ros::WallDuration(kPeriodSec),
                                [this](const ros::WallTimerEvent& /*event*/) { look(); });
}

void MemoryReturn::look() {
  const PlanServerStatus status = server_.status();
  if (status.finished == seen_) return;
  const bool is_idle = status.running == 0 && status.queued == 0;
  if (!is_idle && ++looks_ < kLooksWhileRunning) return;
  looks_ = 0;
  seen_ = status.finished;
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace split_mapf
