#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/json_text.h"
#include "split_mapf/io/vda5050.h"

namespace split_mapf {
namespace {

using Json = nlohmann::json;

Json headerOf(const Vda5050Header& header) {
  return {{"headerId", header.header_id},
          {"timestamp", vda5050Time(header.unix_sec)},
          {"version", header.version},
          {"manufacturer", header.manufacturer},
          {"serialNumber", header.serial_number}};
}

/// Headings within a turn, as the standard wants them.
double withinATurn(double angle) { return std::remainder(angle, 2 * M_PI); }

Json nodeOf(const Vda5050Order& order, std::size_t index) {
  const Vda5050Node& node = order.nodes[index];
  Json json = {{"nodeId", node.id}, {"sequenceId", order.first_sequence_id + 2 * index}};
  if (!node.description.empty()) json["nodeDescription"] = node.description;
  json["released"] = node.released;
  json["nodePosition"] = {{"x", node.x_m},
                          {"y", node.y_m},
                          {"theta", withinATurn(node.theta_rad)},
                          {"allowedDeviationXY", order.allowed_deviation_m},
                          {"allowedDeviationTheta", M_PI},
                          {"mapId", order.map_id}};
  json["actions"] = Json::array();
  return json;
}

/// The edge that ends at a node.
Json edgeOf(const Vda5050Order& order, std::size_t index) {
  const Vda5050Node& from = order.nodes[index - 1];
  const Vda5050Node& to = order.nodes[index];
  return {{"edgeId", from.id + "-" + to.id},
          {"sequenceId", order.first_sequence_id + 2 * index - 1},
          {"released", to.released},
          {"startNodeId", from.id},
          {"endNodeId", to.id},
          {"length", std::hypot(to.x_m - from.x_m, to.y_m - from.y_m)},
          {"actions", Json::array()}};
}

Json jsonOf(const Vda5050Order& order) {
  Json json = headerOf(order.header);
  json["orderId"] = order.order_id;
  json["orderUpdateId"] = order.update_id;
  json["nodes"] = Json::array();
  json["edges"] = Json::array();
  for (std::size_t i = 0; i < order.nodes.size(); ++i) {
    json["nodes"].push_back(nodeOf(order, i));
    if (i > 0) json["edges"].push_back(edgeOf(order, i));
  }
  return json;
}

}  // namespace

std::string toJson(const Vda5050Order& order) { return asciiJson(jsonOf(order)); }

std::string toJson(const std::vector<Vda5050Order>& orders) {
  std::string text = "[";
  for (const Vda5050Order& order : orders) text += (text == "[" ? "\n" : ",\n") + toJson(order);
  return text + "\n]\n";
}

std::string cancelOrderJson(const Vda5050Header& header, const std::string& action_id) {
  Json json = headerOf(header);
  const Json action = {{"actionId", action_id},
                       {"actionType", "cancelOrder"},
                       {"blockingType", "HARD"},
                       {"actionParameters", Json::array()}};
  json["actions"] = Json::array({action});
  return asciiJson(json);
}

std::string vda5050Time(double unix_sec) {
  const auto ms = static_cast<std::int64_t>(std::llround(unix_sec * 1000));
  const auto seconds = static_cast<std::time_t>(ms / 1000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 64> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  std::snprintf(text.data() + length, text.size() - length, ".%03dZ", static_cast<int>(ms % 1000));
  return text.data();
}

}  // namespace split_mapf
