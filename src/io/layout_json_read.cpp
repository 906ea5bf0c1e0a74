#include <nlohmann/json.hpp>
#include <optional>

#include "io/file_bytes.h"
#include "io/json_text.h"
#include "io/streamed_json.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/plan_json.h"

namespace split_mapf {
namespace {

using Json = nlohmann::json;

/// Reads one layout, with the file's name for messages.
class LayoutReader {
 public:
  LayoutReader(const std::string& path, const Grid& grid) : path_(path), grid_(grid) {}

  Layout read(const Json& json) const {
    if (!json.is_object()) fail("is no object");
    Layout layout;
    if (json.contains("partition")) {
      if (!json["partition"].is_string()) fail("has a 'partition' that is no text");
      layout.partition = json["partition"].get<std::string>();
    }
    for (const Json& runs : listIn(json, "ownerships")) {
      layout.ownerships.push_back(readRuns(runs));
    }
    for (const Json& phase : listIn(json, "phases")) {
      Layout::Phase& read = layout.phases.emplace_back();
      read.ownership = readPlace(phase, layout.ownerships.size());
      for (const Json& cell : listIn(phase, "states")) read.states.push_back(readCell(cell));
    }
    return layout;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(path_ + ": its `layout` " + what);
  }

  const Json& listIn(const Json& json, const char* name) const {
    if (!json.is_object() || !json.contains(name) || !json[name].is_array()) {
      fail("lacks the list '" + std::string(name) + "'");
    }
    return json[name];
  }

  std::uint32_t readPlace(const Json& phase, std::size_t ownerships) const {
    if (!phase.contains("ownership") || !phase["ownership"].is_number_unsigned() ||
        phase["ownership"].get<std::uint64_t>() >= ownerships) {
      fail("has a phase whose 'ownership' is none of its " + std::to_string(ownerships));
    }
    return phase["ownership"].get<std::uint32_t>();
  }

  Ownership readRuns(const Json& runs) const {
    Ownership ownership(grid_.size(), kNoRegion);
    const std::uint64_t cells = std::uint64_t{grid_.width()} * grid_.height();
    std::uint64_t next = 0;
    if (!runs.is_array()) fail("has an ownership that is no list of [region,cells] runs");
    for (const Json& run : runs) {
      if (!run.is_array() || run.size() != 2 || !run[0].is_number_integer() ||
          !run[1].is_number_unsigned()) {
        fail("has an ownership with something else than [region,cells] runs");
      }
      const auto region = run[0].get<std::int64_t>();
      const auto length = run[1].get<std::uint64_t>();
      if (length > cells - next || region < -1 || region >= std::int64_t{kNoRegion}) {
        fail("has an ownership that does not fit the map's " + counted(cells, "cell"));
      }
      for (const std::uint64_t end = next + length; next < end; ++next)
        own(next, region, ownership);
    }
    if (next != cells) {
      fail("has an ownership of " + counted(next, "cell") + ", the map has " +
           std::to_string(cells));
    }
    return ownership;
  }

  void own(std::uint64_t cell, std::int64_t region, Ownership& ownership) const {
    if (region < 0) return;
    const Vertex v = grid_.vertexAt({static_cast<std::int32_t>(cell % grid_.width()),
                                     static_cast<std::int32_t>(cell / grid_.width())});
    if (v == kNoVertex) fail("gives a blocked cell to region " + std::to_string(region));
    ownership[v] = static_cast<std::uint32_t>(region);
  }

  Vertex readCell(const Json& json) const {
    const bool pair = json.is_array() && json.size() == 2 && json[0].is_number_integer() &&
                      json[1].is_number_integer();
    const auto inside = [](const Json& coordinate) {
      constexpr std::int64_t kMost = 1U << 30;
      return coordinate.get<std::int64_t>() >= 0 && coordinate.get<std::int64_t>() < kMost;
    };
    if (pair && inside(json[0]) && inside(json[1])) {
      const Vertex v = grid_.vertexAt({json[0].get<std::int32_t>(), json[1].get<std::int32_t>()});
      if (v != kNoVertex) return v;
    }
    fail("has a state that is no free cell of the map: " + quote(asciiJson(json)));
  }

  const std::string& path_;
  const Grid& grid_;
};

}  // namespace

std::optional<Layout> readPlanLayout(const std::string& path, const Grid& grid) {
  const Json document = StreamedObject({}, {"layout"}).parse(readFile(path), false);
  if (!document.is_object() || !document.contains("layout")) {
    throw InputError(path + ": read no 'layout', expected one or null");
  }
  if (document["layout"].is_null()) return std::nullopt;
  return LayoutReader(path, grid).read(document["layout"]);
}

}  // namespace split_mapf
