// What planning graphs serve of ten maps of real and simulated buildings. With SPLIT_MAPF_LONG=1 it
// prints the table of docs/robot_size.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "roadmap/clear_space.h"
#include "roadmap/lattice.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/roadmap/reach.h"
#include "split_mapf/roadmap/roadmap.h"
#include "support/benchmarks.h"
#include "support/long_run.h"

namespace split_mapf {
namespace {

/// Sums over the maps.
struct Served {
  double shares = 0;
  std::uint32_t rooms = 0;
  std::uint32_t lost = 0;
  double cpu_sec = 0;
  double most_cpu_sec = 0;

  void add(const ObstacleRaster& raster, const Roadmap& roadmap) {
    const std::optional<Reach> reach = measureReach(raster, roadmap);
    ASSERT_TRUE(reach.has_value());
    shares += reach->share();
    rooms += reach->rooms;
    lost += reach->rooms_lost;
  }
};

std::optional<std::vector<ObstacleRaster>> readTenMaps() {
  std::vector<ObstacleRaster> maps;
  for (const char* name : {"aws_warehouse", "cave", "fetch_lab", "house", "ipa_apartment",
                           "nav2_warehouse", "servicesim", "stata", "warehouse008", "willow"}) {
    const auto file = test::benchmarkFile("map_server/" + std::string(name) + "/map.yaml");
    if (!file) return std::nullopt;
    const OccupancyMap map = readMapServerMap(*file);
    maps.push_back(rasterOf(map.grid->width(), map.grid->height(), freeCells(map.occupancy, {}),
                            map.resolution_m));
  }
  return maps;
}

Served serve(const std::vector<ObstacleRaster>& maps, const RoadmapOptions& options) {
  Served served;
  for (const ObstacleRaster& raster : maps) {
    const std::clock_t begin = std::clock();
    const std::optional<Roadmap> roadmap = buildRoadmap(raster, options);
    const double cpu_sec = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    served.cpu_sec += cpu_sec;
    served.most_cpu_sec = std::max(served.most_cpu_sec, cpu_sec);
    served.add(raster, *roadmap);
  }
  return served;
}

/// By the lattice that begins in the map's first cell, as who knows no better takes it.
Served serveNaively(const std::vector<ObstacleRaster>& maps, const RoadmapOptions& options) {
  Served served;
  for (const ObstacleRaster& raster : maps) {
    Roadmap roadmap;
    roadmap.width = raster.width;
    roadmap.height = raster.height;
    roadmap.resolution_m = raster.resolution_m;
    roadmap.robot_radius_m = options.robot_radius_m;
    roadmap.spacing_cells = leastSpacingCells(options, raster.resolution_m);
    const roadmap::ClearSpace space(raster, options.robot_radius_m / raster.resolution_m, {});
    const roadmap::CellGraph lattice = roadmap::latticeAt(space, roadmap.spacing_cells, {});
    roadmap.cells = lattice.cells;
    roadmap.edges = {lattice.edges.begin(), lattice.edges.end()};
    served.add(raster, roadmap);
  }
  return served;
}

void printRow(const std::vector<ObstacleRaster>& maps, const RoadmapOptions& options,
              const Served& with_passages) {
  const auto count = static_cast<double>(maps.size());
  RoadmapOptions lattice_alone = options;
  lattice_alone.passages = false;
  std::printf("| %.2f m | %u |", options.robot_radius_m, with_passages.rooms);
  for (const Served& served :
       {serveNaively(maps, options), serve(maps, lattice_alone), with_passages}) {
    std::printf(" %.1f %%, %u |", 100 * served.shares / count, served.lost);
  }
  std::printf(" %.2f (%.1f) |\n", with_passages.cpu_sec / count, with_passages.most_cpu_sec);
}

TEST(TenMaps, AreServedForRobotsOfEverySize) {
  struct Aim {
    double radius_m;
    double mean_share;
    std::uint32_t most_lost;
  };
  const auto maps = readTenMaps();
  if (!maps) GTEST_SKIP() << test::benchmarkMissing("map_server/willow/map.yaml");
  for (const Aim& aim :
       {Aim{0.15, 0.995, 0}, Aim{0.25, 0.99, 0}, Aim{0.35, 0.97, 0}, Aim{0.5, 0.94, 6}}) {
    // The smallest make the largest graphs, and are the easiest to serve.
    if (aim.radius_m < 0.2 && !test::isLongRun()) continue;
    RoadmapOptions options;
    options.robot_radius_m = aim.radius_m;
    const Served served = serve(*maps, options);
    EXPECT_GE(served.shares / static_cast<double>(maps->size()), aim.mean_share) << aim.radius_m;
    EXPECT_LE(served.lost, aim.most_lost) << aim.radius_m;
    if (test::isLongRun()) printRow(*maps, options, served);
  }
}

}  // namespace
}  // namespace split_mapf
