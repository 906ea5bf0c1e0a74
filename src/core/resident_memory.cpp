#include "core/resident_memory.h"

#include <fstream>
#include <string>

namespace split_mapf {

double residentMemoryMib() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    double kibibytes = 0;
    if (word == "VmRSS:" && status >> kibibytes) return kibibytes / 1024;
  }
  return 0;
}

}  // namespace split_mapf
