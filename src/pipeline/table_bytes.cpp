#include "pipeline/table_bytes.h"

#include <unistd.h>

namespace split_mapf {
namespace {

// Where the system does not tell how much memory there is.
constexpr std::size_t kUsualBytes = std::size_t{1} << 30U;
constexpr std::size_t kShareOfMemory = 4;

}  // namespace

std::size_t tableBytes(const PlanRequest& request) {
  if (request.table_bytes > 0) return static_cast<std::size_t>(request.table_bytes);
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page_bytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_bytes <= 0) return kUsualBytes;
  return static_cast<std::size_t>(pages) * static_cast<std::size_t>(page_bytes) / kShareOfMemory;
}

}  // namespace split_mapf
