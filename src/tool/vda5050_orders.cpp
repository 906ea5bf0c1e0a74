#include "tool/vda5050_orders.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/fleet/fleet_execution.h"
#include "split_mapf/fleet/vda5050_vehicle.h"
#include "split_mapf/io/map_file.h"
#include "split_mapf/io/vda5050.h"
#include "split_mapf/roadmap/map_frame.h"
#include "tool/disc_task.h"
#include "tool/valid_plan.h"

namespace split_mapf::tool {
namespace {

constexpr std::uint64_t kMostAhead = 1000;
constexpr const char* kOrderOptions[] = {"plan",    "manufacturer",  "map-id",
                                         "plan-id", "release-ahead", "release"};

/// The routes' visits in metres.
class Placement {
 public:
  explicit Placement(const OccupancyMap& map)
      : cell_m_(map.resolution_m),
        width_(map.grid->width()),
        height_(map.grid->height()),
        frame_(frameOf(map)) {}

  PlacedRoute routeOf(const FleetExecution& fleet, const Grid& grid, std::uint32_t robot,
                      const std::string& plan_id) const {
    PlacedRoute route{plan_id, {}};
    for (const RouteStep& step : fleet.route(robot, std::numeric_limits<std::uint32_t>::max())) {
      const Cell cell = grid.cellOf(step.vertex);
      const MapPoint at = toFrame(frame_, {(cell.x + 0.5) * cell_m_, (cell.y + 0.5) * cell_m_});
      const std::uint32_t index = (height_ - 1 - static_cast<std::uint32_t>(cell.y)) * width_ +
                                  static_cast<std::uint32_t>(cell.x);
      route.visits.push_back({step.sequence, index, at.x, at.y, 0, step.released});
    }
    faceTheWay(route.visits);
    return route;
  }

 private:
  /// Headings are those of the moves into visits, at the start that of the first move.
  void faceTheWay(std::vector<PlacedVisit>& visits) const {
    visits[0].theta_rad = frame_.yaw_rad;
    for (std::size_t i = 1; i < visits.size(); ++i) {
      visits[i].theta_rad =
          std::atan2(visits[i].y_m - visits[i - 1].y_m, visits[i].x_m - visits[i - 1].x_m);
    }
    if (visits.size() > 1) visits[0].theta_rad = visits[1].theta_rad;
  }

  double cell_m_;
  std::uint32_t width_;
  std::uint32_t height_;
  MapFrame frame_;
};

std::vector<std::string> idsOf(std::size_t count) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < count; ++i) ids.push_back("r" + std::to_string(i));
  return ids;
}

}  // namespace

void offerOrderOptions(CommandLine& line) {
  line.offer("export", "FORMAT",
             "vda5050: with --map, --scen and --plan, the robots' orders as an array; what nobody "
             "has to be waited for is the base, all else the horizon");
  line.offer("plan", "FILE", "of orders: JSON with `paths`, as `plan --output` writes it");
  line.offer("manufacturer", "NAME", "of orders (split_mapf)");
  line.offer("map-id", "NAME", "of orders (map)");
  line.offer("plan-id", "NAME", "of orders: their names begin with it (plan)");
  line.offer("release-ahead", "VISITS", "of orders: in the base at most, the start left out (2)");
  line.offer("release", "FRACTION", "of orders, as in `simulate` (0.707, safe for any robot)");
}

bool asksForOrders(const CommandLine& line) {
  if (!line.has("export")) {
    for (const char* name : kOrderOptions) {
      if (line.has(name)) {
        throw OptionError(std::string("option --") + name + " needs --export vda5050");
      }
    }
    return false;
  }
  const std::string format = line.text("export");
  if (format != "vda5050") {
    throw OptionError("option --export: format '" + format + "' is unknown; vda5050 is expected");
  }
  for (const char* name : {"map", "scen", "plan"}) {
    if (!line.has(name)) throw OptionError(std::string("option --export needs --") + name);
  }
  if (line.has("agents")) {
    throw OptionError("option --agents: the plan says how many robots there are");
  }
  return true;
}

std::string ordersOf(const CommandLine& line, const OccupancyMap& map) {
  FleetOptions fleet_options;
  fleet_options.release = line.number("release", fleet_options.release, 0);
  fleet_options.release_ahead = static_cast<std::uint32_t>(
      line.wholeNumber("release-ahead", fleet_options.release_ahead, 1, kMostAhead));
  Vda5050Options options;
  options.manufacturer = line.text("manufacturer", "split_mapf");
  options.map_id = line.text("map-id", options.map_id);
  const ValidPlan task = readValidPlan(line.text("map"), line.text("scen"), line.text("plan"));
  FleetExecution fleet(map.grid, idsOf(task.plan.paths.size()), task.plan, fleet_options, 0);
  fleet.advance(0);
  const Placement placement(map);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  std::vector<Vda5050Order> orders;
  for (std::uint32_t robot = 0; robot < fleet.robots(); ++robot) {
    options.serial_number = fleet.id(robot);
    orders.push_back(firstOrder(
        placement.routeOf(fleet, *map.grid, robot, line.text("plan-id", "plan")), options));
    orders.back().header.unix_sec = std::chrono::duration<double>(now).count();
  }
  return toJson(orders);
}

}  // namespace split_mapf::tool
