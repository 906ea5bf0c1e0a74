#include "memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <stdexcept>

namespace split_mapf::fuzz {

MemoryFile::MemoryFile(const std::string& bytes) : descriptor_(::memfd_create("fuzz", 0)) {
  if (descriptor_ < 0) throw std::runtime_error("the system gives no file in memory");
  for (std::size_t written = 0; written < bytes.size();) {
    const ssize_t more = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
    if (more <= 0) {
      ::close(descriptor_);
      throw std::runtime_error("a file in memory cannot be written");
    }
    written += static_cast<std::size_t>(more);
  }
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

}  // namespace split_mapf::fuzz
