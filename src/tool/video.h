#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "split_mapf/io/picture.h"

namespace split_mapf::tool {

/// Whether a film of this name is a video: it ends in .mp4.
bool isVideo(const std::string& file);

/// Writes pictures as an MP4 video by the program ffmpeg, which is found in PATH and called without
/// a shell. The file appears whole or not at all.
class Video {
 public:
  /// @throws InputError where ffmpeg is not there or cannot be started.
  Video(const std::string& file, std::uint32_t width_px, std::uint32_t height_px,
        int frames_per_sec);
  /// Ends ffmpeg and takes away what it has written where finish() was not called.
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// @pre the picture has the size that was said. @throws InputError with what ffmpeg says.
  void add(const Picture& picture);
  /// @throws the same, and where the file cannot be put in its place.
  void finish();

 private:
  void closePipe();
  /// The beginning of what ffmpeg has said.
  std::string errorText() const;
  [[noreturn]] void fail(const std::string& why) const;

  const std::string file_;
  const std::string part_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> errors_;
  int pipe_ = -1;
  int process_ = -1;
  std::string bytes_;  // of a frame
};

}  // namespace split_mapf::tool
