#include "split_mapf/pipeline/piece_bytes.h"

#include <memory>
#include <utility>
#include <vector>

#include "io/byte_stream.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/problem_bytes.h"

namespace split_mapf {
namespace {

// Changes with what follows it.
constexpr const char* kHead = "PIECE1";
constexpr std::uint32_t kAny = 0xffffffffU;

}  // namespace

std::string toBytes(const Piece& piece) {
  ByteWriter out;
  out.text(kHead);
  for (const std::uint32_t value : {piece.id, piece.phase, piece.region, piece.shares}) {
    out.number(value);
  }
  out.number(piece.cut_anew ? 1 : 0);
  out.numbers(piece.robots);
  out.number(piece.map ? 1 : 0);
  if (piece.map) out.numbers(*piece.map);
  out.text(toBytes(piece.instance->problem()));
  return out.take();
}

Piece pieceFromBytes(const std::string& bytes) {
  ByteReader in(bytes, "piece");
  in.expectText(kHead);
  Piece piece;
  piece.id = in.number("the piece's number");
  piece.phase = in.number("the phase");
  piece.region = in.number("the region");
  piece.shares = in.number("the shares");
  piece.cut_anew = in.number("whether it was cut anew", 1) == 1;
  piece.robots = in.numbers("robot", kAny);
  if (in.number("whether there is a map", 1) == 1) {
    piece.map = std::make_shared<const std::vector<Vertex>>(in.numbers("place", kAny));
  }
  Problem problem = problemFromBytes(in.rest());
  if (piece.robots.size() != problem.starts.size()) {
    in.fail("the piece names " + counted(piece.robots.size(), "robot") + ", its problem has " +
            std::to_string(problem.robots()));
  }
  if (piece.map && piece.map->size() != problem.grid->size()) {
    in.fail("the piece's map has " + counted(piece.map->size(), "vertex", "vertices") +
            ", its grid " + std::to_string(problem.grid->size()));
  }
  piece.instance = std::make_shared<const Instance>(std::move(problem), DistanceExtent::kOnDemand);
  return piece;
}

}  // namespace split_mapf
