#include "io/file_bytes.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

[[noreturn]] void failOfSystem(const std::string& verb, const std::string& path, int error) {
  std::string text = "cannot " + verb + " " + path;
  if (error != 0) text += std::string(": ") + std::strerror(error);
  throw InputError(text);
}

}  // namespace

std::string readFile(const std::string& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) failOfSystem("open", path, errno);
  std::string bytes;
  std::array<char, 1U << 16> block{};
  while (in) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    bytes.append(block.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) failOfSystem("read", path, errno);
  return bytes;
}

void writeFile(const std::string& path, const std::string& bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  if (!out) failOfSystem("write", path, errno);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) failOfSystem("write", path, errno);
}

void failAtLine(const std::string& path, std::size_t line, const std::string& message) {
  throw InputError(path + ":" + std::to_string(line) + ": " + message);
}

void failAtByte(const std::string& path, std::size_t byte, const std::string& message) {
  throw InputError(path + ": byte " + std::to_string(byte) + ": " + message);
}

}  // namespace split_mapf
