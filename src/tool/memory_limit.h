#pragma once

#include <cstdint>

namespace split_mapf::tool {

/// Limits the private writable memory of the process (its heap, and the stacks of threads started
/// later); beyond it allocations fail with std::bad_alloc. Call it when all threads stand.
/// @throws InputError when the system refuses.
void limitMemory(std::uint64_t mib);
/// Takes the limit back, so that what failed for lack of memory can be reported.
void liftMemoryLimit();

}  // namespace split_mapf::tool
