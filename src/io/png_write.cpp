#include <sstream>

#include "io/file_bytes.h"
#include "io/png_gil.h"
#include "split_mapf/io/picture.h"

namespace split_mapf {

void writePng(const std::string& path, const Picture& picture) {
  static_assert(sizeof(Colour) == 3, "GIL reads colours as packed RGB");
  const auto view = boost::gil::interleaved_view(
      picture.width_px, picture.height_px,
      reinterpret_cast<const boost::gil::rgb8_pixel_t*>(picture.pixels.data()),
      static_cast<std::ptrdiff_t>(picture.width_px) * 3);
  // Into memory first: a full disk is then ours to report, not libpng's.
  std::ostringstream out(std::ios::binary);
  boost::gil::write_view(out, view, boost::gil::png_tag());
  writeFile(path, wholeText(out));
}

}  // namespace split_mapf
