#include "tool/memory_limit.h"

#include <sys/resource.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "split_mapf/core/error.h"

namespace split_mapf::tool {

// RLIMIT_DATA, which counts every private writable mapping since Linux 4.7. RLIMIT_AS would count
// address space that allocators reserve for each thread and never touch.
void limitMemory(std::uint64_t mib) {
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  const rlim_t bytes = static_cast<rlim_t>(mib) << 20U;
  if (limit.rlim_max != RLIM_INFINITY && bytes >= limit.rlim_max) return;  // the system is stricter
  limit.rlim_cur = bytes;
  if (setrlimit(RLIMIT_DATA, &limit) != 0) {
    throw InputError("the system refuses a memory limit of " + std::to_string(mib) +
                     " MiB: " + std::strerror(errno));
  }
}

void liftMemoryLimit() {
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace split_mapf::tool
