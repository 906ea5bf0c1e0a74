#include <cstdint>

#include "io/layout_json.h"

namespace split_mapf {
namespace {

std::string cellText(Cell cell) {
  return "[" + std::to_string(cell.x) + "," + std::to_string(cell.y) + "]";
}

std::string cellsText(const Grid& grid, const std::vector<Vertex>& vertices) {
  std::string text = "[";
  for (const Vertex v : vertices) {
    if (text.size() > 1) text += ',';
    text += cellText(grid.cellOf(v));
  }
  return text + "]";
}

std::string runsText(const Grid& grid, const Ownership& ownership) {
  std::string text = "[";
  const auto add = [&text](std::int64_t region, std::uint64_t cells) {
    if (cells == 0) return;
    if (text.size() > 1) text += ',';
    text += "[" + std::to_string(region) + "," + std::to_string(cells) + "]";
  };
  std::int64_t region = 0;
  std::uint64_t cells = 0;
  for (std::uint32_t y = 0; y < grid.height(); ++y) {
    for (std::uint32_t x = 0; x < grid.width(); ++x) {
      const Vertex v = grid.vertexAt({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)});
      const bool owned = v != kNoVertex && ownership[v] != kNoRegion;
      const std::int64_t here = owned ? std::int64_t{ownership[v]} : -1;
      if (here != region) {
        add(region, cells);
        cells = 0;
        region = here;
      }
      ++cells;
    }
  }
  add(region, cells);
  return text + "]";
}

}  // namespace

std::string layoutJson(const Grid& grid, const Layout& layout, const std::string& indent) {
  const std::string deeper = indent + "  ";
  std::string text = "{\n" + deeper + R"("partition": ")" + layout.partition + "\",\n" + deeper +
                     R"("ownerships": [)";
  const char* separator = "\n";
  for (const Ownership& ownership : layout.ownerships) {
    text += separator + deeper + "  " + runsText(grid, ownership);
    separator = ",\n";
  }
  text += "\n" + deeper + "],\n" + deeper + R"("buffers": )" +
          cellsText(grid, bufferVertices(layout)) + ",\n" + deeper + R"("phases": [)";
  separator = "\n";
  for (const Layout::Phase& phase : layout.phases) {
    text += separator + deeper + R"(  {"ownership": )" + std::to_string(phase.ownership) +
            R"(, "states": )" + cellsText(grid, phase.states) + "}";
    separator = ",\n";
  }
  return text + "\n" + deeper + "]\n" + indent + "}";
}

}  // namespace split_mapf
