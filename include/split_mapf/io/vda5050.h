#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace split_mapf {

/// Messages of VDA 5050, version 2: how a fleet's control talks with robots of many makers. JSON
/// texts only; who carries them (MQTT, as the standard has it) is none of this room's business. All
/// functions are thread-safe.

/// What every message begins with.
struct Vda5050Header {
  std::uint32_t header_id = 0;  ///< counts the messages of one topic
  double unix_sec = 0;          ///< when it was sent, in UTC
  std::string version = "2.0.0";
  std::string manufacturer;
  std::string serial_number;
};

/// A place on the way. Released ones are the base, the others the horizon.
struct Vda5050Node {
  std::string id;
  std::string description;
  double x_m = 0;
  double y_m = 0;
  double theta_rad = 0;  ///< a hint: every heading is allowed on the node
  bool released = false;
};

/// The way of a robot: nodes, and an edge between each two. Nodes have the sequence ids
/// `first_sequence_id`, + 2, ..., edges the odd numbers between.
struct Vda5050Order {
  Vda5050Header header;
  std::string order_id;
  std::uint32_t update_id = 0;
  std::uint32_t first_sequence_id = 0;  ///< even; 0 but in an update
  std::string map_id;
  double allowed_deviation_m = 0;  ///< from a node, to count as having come to it
  std::vector<Vda5050Node> nodes;  ///< none released behind one that is not
};
/// An edge is released where the node at its end is; its id names its nodes, "A-B". ASCII on one
/// line. Cost: O(nodes).
/// @pre there is a node, and the first is released.
std::string toJson(const Vda5050Order& order);
/// The orders as one array, an order a line.
std::string toJson(const std::vector<Vda5050Order>& orders);

/// Instant actions with one action: the robot drops its order, stops as soon as it can, and empties
/// its nodeStates.
std::string cancelOrderJson(const Vda5050Header& header, const std::string& action_id);

/// "2026-11-29T08:05:03.250Z". @pre 0 <= unix_sec < 2.5e11.
std::string vda5050Time(double unix_sec);

enum class Vda5050ErrorLevel {
  kWarning,   ///< it goes on by itself
  kCritical,  ///< URGENT and CRITICAL of version 3: it goes on when somebody or something else
              ///< moves
  kFatal,     ///< it needs somebody
};
struct Vda5050Error {
  std::string type;
  std::string description;
  Vda5050ErrorLevel level = Vda5050ErrorLevel::kWarning;
};
struct Vda5050NodeState {
  std::string id;
  std::uint32_t sequence_id = 0;
  bool released = false;
};
struct Vda5050Position {
  double x_m = 0;
  double y_m = 0;
  double theta_rad = 0;
  std::string map_id;
};

/// What a robot says of itself; fields that nobody here needs are left out.
struct Vda5050State {
  std::string order_id;  ///< empty: it had none yet
  std::uint32_t update_id = 0;
  std::string last_node_id;
  std::uint32_t last_sequence_id = 0;
  std::vector<Vda5050NodeState> nodes;  ///< still ahead
  bool driving = false;
  bool paused = false;    ///< or held by a safety field or an emergency stop
  bool automatic = true;  ///< it obeys orders; false: somebody else moves it
  std::optional<double> since_last_node_m;
  std::optional<Vda5050Position> position;  ///< nothing: it does not know where it is
  std::vector<Vda5050Error> errors;
};
/// Fields that are unknown are left alone; agvPosition, distanceSinceLastNode, paused, actionStates
/// and safetyState may be missing.
/// @throws InputError naming the field, what it holds and what is expected.
Vda5050State parseVda5050State(const std::string& text);

enum class Vda5050Connection { kOnline, kOffline, kBroken };
/// @throws InputError as parseVda5050State().
Vda5050Connection parseVda5050Connection(const std::string& text);

}  // namespace split_mapf
