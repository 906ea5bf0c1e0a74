#include "split_mapf/core/error.h"
#include "split_mapf/io/gif.h"

#ifdef SPLIT_MAPF_HAS_GIF

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <new>
#include <utility>

#include "io/file_bytes.h"
#include "io/frame_palette.h"

namespace split_mapf {
namespace {

constexpr std::size_t kColours = 255;
constexpr std::uint8_t kUnchanged = 255;  // transparent: what the frame before shows stays
constexpr std::uint32_t kMaxSide = 65535;

int append(GifFileType* gif, const GifByteType* bytes, int count) {
  try {
    static_cast<std::string*>(gif->UserData)
        ->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    return count;
  } catch (const std::bad_alloc&) {
    return 0;  // nothing may be thrown through giflib; it reports this
  }
}

void require(int answer, GifFileType* gif) {
  if (answer == GIF_OK) return;
  const char* why = GifErrorString(gif->Error);
  throw InputError(std::string("the animation cannot be encoded: ") +
                   (why == nullptr ? "unknown error of giflib" : why));
}

}  // namespace

/// The file as far as it goes, in memory: a file appears whole or not at all.
class GifWriter::Stream {
 public:
  Stream(const std::vector<Picture>& samples, std::uint32_t delay_cs)
      : width_(samples.at(0).width_px),
        height_(samples.at(0).height_px),
        delay_cs_(delay_cs),
        palette_(samples, kColours) {
    int error = 0;
    gif_.reset(EGifOpen(&bytes_, append, &error));
    if (gif_ == nullptr) throw InputError("the animation cannot be encoded: no memory for giflib");
    EGifSetGifVersion(gif_.get(), true);
    std::array<GifColorType, kColours + 1> table{};
    const std::vector<Colour>& colours = palette_.colours();
    for (std::size_t i = 0; i < colours.size(); ++i) {
      table[i] = {colours[i].red, colours[i].green, colours[i].blue};
    }
    ColorMapObject* map = GifMakeMapObject(static_cast<int>(table.size()), table.data());
    const int answer = EGifPutScreenDesc(gif_.get(), static_cast<int>(width_),
                                         static_cast<int>(height_), 8, 0, map);
    GifFreeMapObject(map);
    require(answer, gif_.get());
    repeatForEver();
  }

  void add(const Picture& picture) {
    if (gif_ == nullptr) throw InputError("the animation is written already");
    if (picture.width_px != width_ || picture.height_px != height_) {
      throw InputError("a frame of another size than the first");
    }
    std::vector<std::uint8_t> frame;
    frame.reserve(picture.pixels.size());
    for (const Colour colour : picture.pixels) frame.push_back(palette_.nearest(colour));
    const auto [top, bottom] = rowsThatDiffer(frame);
    putFrame(frame, top, bottom);
    shown_ = std::move(frame);
  }

  std::string take() {
    if (gif_ == nullptr) throw InputError("the animation is written already");
    int error = 0;
    const int answer = EGifCloseFile(gif_.release(), &error);
    if (answer != GIF_OK) throw InputError("the animation cannot be encoded");
    return std::move(bytes_);
  }

 private:
  struct Close {
    void operator()(GifFileType* gif) const {
      int error = 0;
      EGifCloseFile(gif, &error);
    }
  };

  void repeatForEver() {
    const std::array<GifByteType, 3> loop = {1, 0, 0};
    require(EGifPutExtensionLeader(gif_.get(), APPLICATION_EXT_FUNC_CODE), gif_.get());
    require(EGifPutExtensionBlock(gif_.get(), 11, "NETSCAPE2.0"), gif_.get());
    require(EGifPutExtensionBlock(gif_.get(), static_cast<int>(loop.size()), loop.data()),
            gif_.get());
    require(EGifPutExtensionTrailer(gif_.get()), gif_.get());
  }

  /// From the first row that differs from what is shown to behind the last; at least one row.
  std::pair<std::uint32_t, std::uint32_t> rowsThatDiffer(
      const std::vector<std::uint8_t>& frame) const {
    if (shown_.empty()) return {0, height_};
    const auto first = std::mismatch(frame.begin(), frame.end(), shown_.begin()).first;
    if (first == frame.end()) return {0, 1};
    const auto last = std::mismatch(frame.rbegin(), frame.rend(), shown_.rbegin()).first;
    const auto row = [this](std::ptrdiff_t pixel) {
      return static_cast<std::uint32_t>(static_cast<std::size_t>(pixel) / width_);
    };
    return {row(first - frame.begin()), row(frame.rend() - last - 1) + 1};
  }

  void putFrame(const std::vector<std::uint8_t>& frame, std::uint32_t top, std::uint32_t bottom) {
    GraphicsControlBlock control{};
    control.DisposalMode = DISPOSE_DO_NOT;
    control.DelayTime = static_cast<int>(delay_cs_);
    control.TransparentColor = shown_.empty() ? NO_TRANSPARENT_COLOR : kUnchanged;
    std::array<GifByteType, 4> bytes{};
    EGifGCBToExtension(&control, bytes.data());
    require(EGifPutExtension(gif_.get(), GRAPHICS_EXT_FUNC_CODE, 4, bytes.data()), gif_.get());
    require(EGifPutImageDesc(gif_.get(), 0, static_cast<int>(top), static_cast<int>(width_),
                             static_cast<int>(bottom - top), false, nullptr),
            gif_.get());
    std::vector<GifPixelType> row(width_);
    for (std::uint32_t y = top; y < bottom; ++y) {
      for (std::uint32_t x = 0; x < width_; ++x) {
        const std::size_t pixel = std::size_t{y} * width_ + x;
        const bool same = !shown_.empty() && shown_[pixel] == frame[pixel];
        row[x] = same ? kUnchanged : frame[pixel];
      }
      require(EGifPutLine(gif_.get(), row.data(), static_cast<int>(width_)), gif_.get());
    }
  }

  const std::uint32_t width_;
  const std::uint32_t height_;
  const std::uint32_t delay_cs_;
  FramePalette palette_;
  std::string bytes_;
  std::unique_ptr<GifFileType, Close> gif_;
  std::vector<std::uint8_t> shown_;  ///< an index a pixel; empty before the first frame
};

GifWriter::GifWriter(const std::vector<Picture>& samples, std::uint32_t delay_cs) {
  if (samples.empty()) throw InputError("an animation needs a picture");
  if (std::max(samples[0].width_px, samples[0].height_px) > kMaxSide) {
    throw InputError("an animation of " + std::to_string(samples[0].width_px) + "x" +
                     std::to_string(samples[0].height_px) +
                     " pixels is too large, expected at most " + std::to_string(kMaxSide) +
                     " a side");
  }
  if (delay_cs < 2 || delay_cs > kMaxSide) {
    throw InputError("a frame cannot be shown for " + std::to_string(delay_cs) +
                     " hundredths of a second, expected 2 to " + std::to_string(kMaxSide));
  }
  stream_ = std::make_unique<Stream>(samples, delay_cs);
}

GifWriter::~GifWriter() = default;

void GifWriter::add(const Picture& picture) { stream_->add(picture); }

void GifWriter::write(const std::string& path) { writeFile(path, stream_->take()); }

}  // namespace split_mapf

#else

namespace split_mapf {

class GifWriter::Stream {};

GifWriter::GifWriter(const std::vector<Picture>& /*samples*/, std::uint32_t /*delay_cs*/) {
  throw InputError("animations need giflib, with which this was not built");
}
GifWriter::~GifWriter() = default;
void GifWriter::add(const Picture& /*picture*/) {}
void GifWriter::write(const std::string& /*path*/) {}

}  // namespace split_mapf

#endif
