#include "tool/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf::tool {
namespace {

constexpr std::size_t kMostErrorBytes = 200;

/// Starts a program whose input and errors are these; returns 0 or the reason (errno).
int spawn(const std::vector<std::string>& words, int input, int errors, pid_t& process) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  const int fault =
      ::posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return fault;
}

std::string sizeText(std::uint32_t width_px, std::uint32_t height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

}  // namespace

bool isVideo(const std::string& file) {
  const std::string end = ".mp4";
  return file.size() > end.size() && file.compare(file.size() - end.size(), end.size(), end) == 0;
}

Video::Video(const std::string& file, std::uint32_t width_px, std::uint32_t height_px,
             int frames_per_sec)
    : file_(file), part_(file + ".part"), errors_(std::tmpfile(), &std::fclose) {
  int ends[2];
  if (!errors_ || ::pipe2(ends, O_CLOEXEC) != 0) {
    throw InputError(file + ": " + std::strerror(errno));
  }
  // Sides are made even, as the usual encoding has half of the colours.
  const std::vector<std::string> words = {"ffmpeg",       "-loglevel",
                                          "error",        "-y",
                                          "-f",           "rawvideo",
                                          "-pix_fmt",     "rgb24",
                                          "-s",           sizeText(width_px, height_px),
                                          "-r",           std::to_string(frames_per_sec),
                                          "-i",           "pipe:0",
                                          "-vf",          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                          "-pix_fmt",     "yuv420p",
                                          "-movflags",    "+faststart",
                                          "-f",           "mp4",
                                          "file:" + part_};
  const int fault = spawn(words, ends[0], ::fileno(errors_.get()), process_);
  ::close(ends[0]);
  pipe_ = ends[1];
  if (fault == 0) return;
  closePipe();
  throw InputError("option --animate: " + quote(file) +
                   " needs the program ffmpeg, which cannot be " + "started (" +
                   std::strerror(fault) + "); a .gif needs none");
}

Video::~Video() {
  closePipe();
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  ::unlink(part_.c_str());
}

void Video::add(const Picture& picture) {
  bytes_.clear();
  for (const Colour colour : picture.pixels) {
    for (const std::uint8_t part : {colour.red, colour.green, colour.blue}) {
      bytes_.push_back(static_cast<char>(part));
    }
  }
  // Where ffmpeg ends early the write fails; its signal would end this program without a word.
  void (*const before)(int) = std::signal(SIGPIPE, SIG_IGN);
  std::size_t done = 0;
  while (done < bytes_.size()) {
    const ssize_t written = ::write(pipe_, bytes_.data() + done, bytes_.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) break;
    done += static_cast<std::size_t>(written);
  }
  std::signal(SIGPIPE, before);
  if (done < bytes_.size()) fail("takes no more frames");
}

void Video::finish() {
  closePipe();
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  // It says 0 where the disk is full, but not without a word.
  const bool is_well = WIFEXITED(status) && WEXITSTATUS(status) == 0 && errorText().empty();
  process_ = -1;
  if (!is_well) {
    ::unlink(part_.c_str());
    fail("did not end well");
  }
  if (std::rename(part_.c_str(), file_.c_str()) != 0) {
    throw InputError(file_ + ": cannot be written: " + std::strerror(errno));
  }
}

void Video::closePipe() {
  if (pipe_ >= 0) ::close(pipe_);
  pipe_ = -1;
}

std::string Video::errorText() const {
  std::string said(kMostErrorBytes, '\0');
  std::rewind(errors_.get());
  said.resize(std::fread(said.data(), 1, said.size(), errors_.get()));
  return said;
}

void Video::fail(const std::string& why) const {
  const std::string said = errorText();
  throw InputError(file_ + ": ffmpeg " + why + (said.empty() ? "" : ": " + shown(said)));
}

}  // namespace split_mapf::tool
