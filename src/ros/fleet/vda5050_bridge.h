#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include <XmlRpcValue.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <split_mapf/RobotRoute.h>

#include "split_mapf/fleet/vda5050_vehicle.h"

namespace split_mapf {

/// Parameters of the bridge.
struct Vda5050BridgeOptions {
  std::string host = "localhost";
  std::uint16_t port = 1883;
  std::string user;  ///< empty: the broker asks nobody
  std::string password;
  std::string interface_name = "uagv";
  std::string version = "v2";  ///< of topics
  std::string frame = "map";   ///< of the robots' places, until a route says another one
  double rate_hz = 10;         ///< of progress
  Vda5050Options vehicle;      ///< of every robot; without serial number. Empty map_id: the frame
  /// Robots by serial number; empty: all that report, each named by its serial number.
  std::map<std::string, std::string> robots;
};
/// @throws OptionError naming the parameter.
Vda5050BridgeOptions readVda5050BridgeOptions(const XmlRpc::XmlRpcValue& parameters);

/// Between the fleet and robots that speak VDA 5050. Topics: `routes` (in, the fleet's ~routes),
/// `progress` (out), /diagnostics. Of MQTT it knows topics and texts only; who has the connection
/// calls connected(), lost() and receive(). Without a broker robots are silent, by which the fleet
/// counts them as lost after its ~progress_timeout. Thread-safe.
class Vda5050Bridge {
 public:
  /// Sends a text on a topic; false: it was not sent.
  using Send = std::function<bool(const std::string& topic, const std::string& text)>;

  Vda5050Bridge(ros::NodeHandle node, const ros::NodeHandle& private_node,
                const Vda5050BridgeOptions& options, Send send);

  /// What has to be subscribed whenever a connection has been made.
  std::vector<std::string> topics() const;
  void connected();
  void lost(const std::string& why);
  void receive(const std::string& topic, const std::string& text);

 private:
  struct Robot {
    Vda5050Vehicle vehicle;
    std::string topic;    ///< up to its serial number
    std::string refused;  ///< why its last message was
    std::uint64_t refusals = 0;
  };
  using Lock = std::lock_guard<std::mutex>;

  Robot* robotOf(const std::string& serial);
  Robot& add(const std::string& id, const std::string& serial);
  void takeRoute(const RobotRoute& route);
  void serve(const std::string& id, Robot& robot);
  void tell(const std::string& id, const Robot& robot, double now);
  void tick();
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status);

  const Vda5050BridgeOptions options_;
  const Send send_;
  std::mutex mutex_;
  std::string frame_;
  std::map<std::string, Robot> robots_;  ///< by id
  std::map<std::string, std::string> by_serial_;
  std::map<std::string, RobotRoute> routes_;  ///< of robots that have not reported yet
  bool connected_ = false;
  std::string why_;  ///< there is no connection
  std::uint64_t losses_ = 0;

  ros::Publisher progress_;
  ros::Subscriber route_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace split_mapf
