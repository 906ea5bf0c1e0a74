// The bridge to robots that speak VDA 5050 over MQTT: wiring only.

#include <string>

#include <ros/ros.h>

#include "node/mqtt_client.h"
#include "node/run_node.h"
#include "ros/fleet/vda5050_bridge.h"

namespace {

void run(split_mapf::NodeContext& context) {
  const split_mapf::Vda5050BridgeOptions options =
      split_mapf::readVda5050BridgeOptions(context.parameters);
  split_mapf::MqttClient* sender = nullptr;
  split_mapf::Vda5050Bridge bridge(context.node, context.private_node, options,
                                   [&sender](const std::string& topic, const std::string& text) {
                                     return sender != nullptr && sender->send(topic, text);
                                   });
  split_mapf::MqttSetup setup;
  setup.host = options.host;
  setup.port = options.port;
  setup.user = options.user;
  setup.password = options.password;
  setup.topics = bridge.topics();
  setup.connected = [&bridge] { bridge.connected(); };
  setup.lost = [&bridge](const std::string& why) { bridge.lost(why); };
  setup.receive = [&bridge](const std::string& topic, const std::string& text) {
    bridge.receive(topic, text);
  };
  // It goes before the bridge that it calls, and only after its thread has ended.
  split_mapf::MqttClient client(setup);
  sender = &client;
  client.start();
  split_mapf::serve(1, "ready: broker " + options.host + ":" + std::to_string(options.port));
}

}  // namespace

int main(int argc, char** argv) { return split_mapf::runNode(argc, argv, "vda5050_bridge", run); }
