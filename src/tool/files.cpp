#include "tool/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "split_mapf/core/error.h"

namespace split_mapf::tool {

void requireWritable(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw InputError(path + ": is a directory; a file to write is expected");
  }
  const fs::path parent = fs::path(path).parent_path();
  const std::string place = fs::exists(path, ignored) ? path
                            : parent.empty()          ? "."
                                                      : parent.string();
  if (access(place.c_str(), W_OK) != 0) {
    throw InputError(path + ": cannot be written: " + place + ": " + std::strerror(errno));
  }
}

}  // namespace split_mapf::tool
