#include "split_mapf/io/problem_bytes.h"

#include <memory>
#include <utility>
#include <vector>

#include "io/byte_stream.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

// Changes with what follows it.
constexpr const char* kHead = "MAPF1";
constexpr std::uint32_t kUnitMoves = 0;
constexpr std::uint32_t kPlanningGraph = 1;
constexpr std::uint32_t kMostSide = 1U << 15U;

std::vector<bool> freeCells(const Grid& grid) {
  std::vector<bool> free(std::size_t{grid.width()} * grid.height());
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = grid.numbering().isMarked(i);
  return free;
}

/// Each edge once, at its lesser end: how many, then the greater ends.
void writeEdges(const Graph& graph, ByteWriter& out) {
  for (Vertex v = 0; v < graph.size(); ++v) {
    std::vector<Vertex> greater;
    for (const Vertex u : graph.neighbours(v)) {
      if (u > v) greater.push_back(u);
    }
    out.numbers(greater);
  }
}

void writeGrid(const Grid& grid, ByteWriter& out) {
  out.number(grid.hasUnitMoves() ? kUnitMoves : kPlanningGraph);
  out.number(grid.width());
  out.number(grid.height());
  out.bits(freeCells(grid));
  if (!grid.hasUnitMoves()) writeEdges(grid.graph(), out);
}

std::uint32_t readSide(ByteReader& in, const char* name) {
  const std::uint32_t side = in.number(name, kMostSide);
  if (side == 0) in.fail(std::string(name) + " is 0, at least 1 is expected");
  return side;
}

std::shared_ptr<const Grid> readGrid(ByteReader& in) {
  const std::uint32_t kind = in.number("the kind of the grid", kPlanningGraph);
  const std::uint32_t width = readSide(in, "the width");
  const std::uint32_t height = readSide(in, "the height");
  const std::vector<bool> free = in.bits(std::size_t{width} * height);
  if (kind == kUnitMoves) return std::make_shared<const Grid>(width, height, free);
  std::vector<std::uint32_t> cells;
  for (std::uint32_t i = 0; i < free.size(); ++i) {
    if (free[i]) cells.push_back(i);
  }
  std::vector<std::pair<Vertex, Vertex>> edges;
  const auto vertices = static_cast<std::uint32_t>(cells.size());
  for (Vertex v = 0; v < vertices; ++v) {
    Vertex last = v;
    for (const Vertex u : in.numbers("edge", vertices - 1)) {
      if (u <= last) in.fail("the edges of a vertex are expected to go up, each once");
      edges.emplace_back(v, last = u);
    }
  }
  return std::make_shared<const Grid>(width, height, std::move(cells), edges);
}

std::vector<Vertex> readVertices(ByteReader& in, const char* name, const Grid& grid) {
  if (grid.size() == 0) in.fail("a free cell is expected in the grid");
  return in.numbers(name, grid.size() - 1);
}

}  // namespace

std::string toBytes(const Problem& problem) {
  ByteWriter out;
  out.text(kHead);
  writeGrid(*problem.grid, out);
  out.numbers(problem.starts);
  out.numbers(problem.goals);
  return out.take();
}

Problem problemFromBytes(const std::string& bytes) {
  ByteReader in(bytes, "problem");
  in.expectText(kHead);
  Problem problem;
  problem.grid = readGrid(in);
  problem.starts = readVertices(in, "start", *problem.grid);
  problem.goals = readVertices(in, "goal", *problem.grid);
  in.expectEnd();
  if (problem.starts.size() != problem.goals.size()) {
    in.fail(counted(problem.starts.size(), "start") + " but " +
            counted(problem.goals.size(), "goal") + ": one of each a robot is needed");
  }
  return problem;
}

}  // namespace split_mapf
