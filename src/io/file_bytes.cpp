#include "io/file_bytes.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

[[noreturn]] void failOfSystem(const std::string& verb, const std::string& path, int error) {
  std::string text = "cannot " + verb + " " + path;
  if (error != 0) text += std::string(": ") + std::strerror(error);
  throw InputError(text);
}

/// Opens, writes and closes a file; returns the system's error, 0 for none.
int errorOfWriting(const std::string& path, const std::string& bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  if (!out) return errno != 0 ? errno : EIO;
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out) return 0;
  return errno != 0 ? errno : EIO;
}

/// Whether other bytes may take the place of what stands there: nothing, or a plain file that may
/// be written. Pipes, devices and links to nowhere are written as they are.
bool isReplaceable(const std::string& path) {
  std::error_code ignored;
  const auto link = std::filesystem::symlink_status(path, ignored);
  if (link.type() == std::filesystem::file_type::not_found) return true;
  return std::filesystem::is_regular_file(path, ignored) && ::access(path.c_str(), W_OK) == 0;
}

unsigned nextNumber() {
  static std::atomic<unsigned> count{0};
  return count++;
}

/// A name beside the file that no other thread or process uses. What still bears it at the end is
/// removed.
class FreshName {
 public:
  explicit FreshName(const std::string& path)
      : name_(path + "." + std::to_string(::getpid()) + "-" + std::to_string(nextNumber()) +
              ".part") {}
  FreshName(const FreshName&) = delete;
  FreshName& operator=(const FreshName&) = delete;
  ~FreshName() { ::unlink(name_.c_str()); }

  const std::string& text() const { return name_; }

 private:
  std::string name_;
};

/// Whether no other file can be made there or take its place (EBUSY: it is mounted by itself),
/// though one that is there may be written.
bool isNoPlaceForAnother(int error) {
  return error == EACCES || error == EPERM || error == EROFS || error == ENAMETOOLONG ||
         error == EBUSY;
}

/// Puts a whole new file in the place of an old one; returns the system's error, 0 for none.
int errorOfReplacing(const std::string& path, const std::string& bytes) {
  std::error_code fault;
  const auto old = std::filesystem::status(path, fault);
  // What a link names is replaced, not the link.
  const std::string target =
      std::filesystem::exists(old) ? std::filesystem::canonical(path, fault).string() : path;
  if (fault && std::filesystem::exists(old)) return fault.value();
  const FreshName fresh(target);
  if (const int error = errorOfWriting(fresh.text(), bytes)) return error;
  if (std::filesystem::exists(old)) {
    std::filesystem::permissions(fresh.text(), old.permissions(), fault);
  }
  return std::rename(fresh.text().c_str(), target.c_str()) == 0 ? 0 : errno;
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

std::string wholeText(const std::ostringstream& out) {
  if (!out) throw std::bad_alloc();
  return out.str();
}

void writeFile(const std::string& path, const std::string& bytes) {
  int error = isReplaceable(path) ? errorOfReplacing(path, bytes) : errorOfWriting(path, bytes);
  if (isNoPlaceForAnother(error)) error = errorOfWriting(path, bytes);
  if (error != 0) failOfSystem("write", path, error);
}

void failAtLine(const std::string& path, std::size_t line, const std::string& message) {
  throw InputError(path + ":" + std::to_string(line) + ": " + message);
}

void failAtByte(const std::string& path, std::size_t byte, const std::string& message) {
  throw InputError(path + ": byte " + std::to_string(byte) + ": " + message);
}

}  // namespace split_mapf
