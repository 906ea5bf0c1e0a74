#include "io/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
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
/// be written and has no second name. Pipes, devices, links to nowhere and files whose name is gone
/// are written as they are.
bool isReplaceable(const std::string& path) {
  std::error_code fault;
  const auto link = std::filesystem::symlink_status(path, fault);
  if (link.type() == std::filesystem::file_type::not_found) return true;
  if (!std::filesystem::is_regular_file(path, fault) || ::access(path.c_str(), W_OK) != 0) {
    return false;
  }
  if (std::filesystem::hard_link_count(path, fault) != 1 || fault) return false;
  return !std::filesystem::canonical(path, fault).empty();
}

/// A file of its own beside another. What still bears its name at the end is removed.
class FreshFile {
 public:
  /// @param old  what it is to replace, whose owner and mode it has; null: nothing.
  FreshFile(const std::string& path, const struct stat* old) {
    static std::atomic<unsigned> count{0};
    // A file that nobody else may read is readable for nobody else from the beginning.
    const mode_t mode = old != nullptr ? S_IRUSR | S_IWUSR : 0666;
    do {
      name_ = path + "." + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".part";
      file_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    } while (file_ < 0 && errno == EEXIST);
    if (file_ < 0 || (old != nullptr && (::fchown(file_, old->st_uid, old->st_gid) != 0 ||
                                         ::fchmod(file_, old->st_mode & 07777U) != 0))) {
      error_ = errno;
    }
  }
  FreshFile(const FreshFile&) = delete;
  FreshFile& operator=(const FreshFile&) = delete;
  ~FreshFile() {
    if (file_ < 0) return;
    ::close(file_);
    if (!is_moved_) ::unlink(name_.c_str());
  }

  /// Writes them and takes the place of the target; returns the system's error, 0 for none.
  int errorOfBecoming(const std::string& target, const std::string& bytes) {
    if (error_ != 0) return error_;
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t written = ::write(file_, bytes.data() + done, bytes.size() - done);
      if (written < 0 && errno != EINTR) return errno;
      if (written > 0) done += static_cast<std::size_t>(written);
    }
    if (std::rename(name_.c_str(), target.c_str()) != 0) return errno;
    is_moved_ = true;
    return 0;
  }

 private:
  std::string name_;
  int file_ = -1;
  int error_ = 0;
  bool is_moved_ = false;
};

/// Whether no other file can be made there or take its place (EBUSY: it is mounted by itself),
/// though one that is there may be written.
bool isNoPlaceForAnother(int error) {
  return error == EACCES || error == EPERM || error == EROFS || error == ENAMETOOLONG ||
         error == EBUSY;
}

/// Puts a whole new file in the place of an old one; returns the system's error, 0 for none.
int errorOfReplacing(const std::string& path, const std::string& bytes) {
  struct stat old = {};
  if (::stat(path.c_str(), &old) != 0) {
    if (errno != ENOENT) return errno;
    return FreshFile(path, nullptr).errorOfBecoming(path, bytes);
  }
  // What a link names is replaced, not the link.
  std::error_code fault;
  const std::string target = std::filesystem::canonical(path, fault).string();
  if (fault) return fault.value();
  return FreshFile(target, &old).errorOfBecoming(target, bytes);
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
