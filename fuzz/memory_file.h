#pragma once

#include <string>

namespace split_mapf::fuzz {

/// A file in memory: readers that want a path get one, and nothing touches a disk.
class MemoryFile {
 public:
  /// @throws std::runtime_error when the system gives none.
  explicit MemoryFile(const std::string& bytes);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  /// Where it can be opened as long as this object lives.
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace split_mapf::fuzz
