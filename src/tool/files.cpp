#include "tool/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "io/file_bytes.h"
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

void requireReplaceable(const std::string& path) {
  std::error_code ignored;
  const bool exists = std::filesystem::exists(path, ignored);
  if (exists && !std::filesystem::is_regular_file(path, ignored)) {
    throw InputError(path + ": is no plain file; one that can be replaced is expected");
  }
}

void writeTextFile(const std::string& path, const std::string& text) { writeFile(path, text); }

void writeText(const std::string& path, const std::string& text) {
  if (path == "-") {
    std::cout << text;
  } else {
    writeTextFile(path, text);
  }
}

}  // namespace split_mapf::tool
