#include "split_mapf/roadmap/execution_moves.h"

#include <utility>
#include <vector>

namespace split_mapf {

std::shared_ptr<const CloseMoves> closeMovesOf(const Roadmap& roadmap) {
  std::vector<PlanePoint> places;
  places.reserve(roadmap.cells.size());
  for (Vertex v = 0; v < roadmap.cells.size(); ++v) {
    const MapPoint place = placeOf(roadmap, v);
    places.push_back({place.x, place.y});
  }
  const Graph graph(static_cast<std::uint32_t>(places.size()), roadmap.edges);
  const double distance_m = 2 * roadmap.robot_radius_m + roadmap.clearance_m;
  return std::make_shared<const CloseMoves>(graph, std::move(places), distance_m);
}

}  // namespace split_mapf
