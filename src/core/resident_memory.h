#pragma once

namespace split_mapf {

/// Resident memory of this process [MiB]; 0 where the system does not tell.
double residentMemoryMib();

}  // namespace split_mapf
