#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/json_text.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/vda5050.h"

namespace split_mapf {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 32;  // levels; messages of the standard have five

/// A value of a message, and how its place is called.
class Field {
 public:
  Field(const Json* json, std::string name) : json_(json), name_(std::move(name)) {}

  /// A field of this object, which has to be there.
  Field operator[](const char* key) const {
    Field field = find(key);
    if (!field) fail("has no field " + quote(field.name_));
    return field;
  }
  /// One that may be missing or null: false then.
  Field find(const char* key) const {
    if (!json_->is_object()) expected("an object");
    const auto found = json_->find(key);
    const bool is_there = found != json_->end() && !found->is_null();
    return {is_there ? &*found : nullptr, name_.empty() ? key : name_ + "." + key};
  }
  explicit operator bool() const { return json_ != nullptr; }

  std::vector<Field> items() const {
    if (!json_->is_array()) expected("an array");
    std::vector<Field> fields;
    for (std::size_t i = 0; i < json_->size(); ++i) {
      fields.emplace_back(&(*json_)[i], name_ + "[" + std::to_string(i) + "]");
    }
    return fields;
  }
  std::string text() const {
    if (!json_->is_string()) expected("a text");
    return json_->get<std::string>();
  }
  bool truth() const {
    if (!json_->is_boolean()) expected("true or false");
    return json_->get<bool>();
  }
  double number() const {
    if (!json_->is_number() || !std::isfinite(json_->get<double>())) expected("a number");
    return json_->get<double>();
  }
  std::uint32_t count() const {
    const double value = json_->is_number() ? json_->get<double>() : -1;
    const bool whole = value >= 0 && value <= std::numeric_limits<std::uint32_t>::max() &&
                       value == std::floor(value);
    if (!whole) expected("a whole number of 0 or more");
    return static_cast<std::uint32_t>(value);
  }
  /// @throws InputError.
  [[noreturn]] void expected(const std::string& what) const {
    fail((name_.empty() ? "" : "field " + quote(name_) + " ") + std::string("is ") +
         quote(asciiJson(*json_)) + "; " + what + " is expected");
  }

 private:
  [[noreturn]] static void fail(const std::string& message) {
    throw InputError("the message " + message);
  }

  const Json* json_;
  std::string name_;
};

Json parse(const std::string& text) {
  // What is told of a value is written by recursion: it must not be deeper than any stack.
  const auto is_flat = [](int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
    if (depth > kDeepest) throw InputError("the message is nested too deeply");
    return true;
  };
  try {
    return Json::parse(text, is_flat);
  } catch (const Json::exception&) {
    throw InputError("the message is " + quote(text) + "; JSON is expected");
  }
}

Vda5050ErrorLevel levelOf(const Field& field) {
  const std::string level = field.text();
  if (level == "WARNING") return Vda5050ErrorLevel::kWarning;
  if (level == "URGENT" || level == "CRITICAL") return Vda5050ErrorLevel::kCritical;
  if (level == "FATAL") return Vda5050ErrorLevel::kFatal;
  field.expected("WARNING, URGENT, CRITICAL or FATAL");
}

Vda5050Error errorOf(const Field& field) {
  Vda5050Error error;
  error.type = field["errorType"].text();
  error.level = levelOf(field["errorLevel"]);
  if (const Field description = field.find("errorDescription")) {
    error.description = description.text();
  }
  return error;
}

/// Nothing where the robot says that it is not localised.
std::optional<Vda5050Position> positionOf(const Field& field) {
  if (const Field sure = field.find("positionInitialized")) {
    if (!sure.truth()) return std::nullopt;
  }
  return Vda5050Position{field["x"].number(), field["y"].number(), field["theta"].number(),
                         field["mapId"].text()};
}

bool isHeld(const Field& state) {
  bool held = false;
  if (const Field paused = state.find("paused")) held = paused.truth();
  if (const Field safety = state.find("safetyState")) {
    if (const Field field = safety.find("fieldViolation")) held = held || field.truth();
    // "NONE" in version 2; version 3 has another name for the field.
    if (const Field stop = safety.find("eStop")) held = held || stop.text() != "NONE";
  }
  return held;
}

bool isAutomatic(const Field& field) {
  const std::string mode = field.text();
  if (mode == "AUTOMATIC" || mode == "SEMIAUTOMATIC") return true;
  if (mode == "MANUAL" || mode == "SERVICE" || mode == "TEACHIN") return false;
  // Modes of later versions: STARTUP, INTERVENED.
  if (mode == "STARTUP" || mode == "INTERVENED") return false;
  field.expected("AUTOMATIC, SEMIAUTOMATIC, MANUAL, SERVICE or TEACHIN");
}

}  // namespace

Vda5050State parseVda5050State(const std::string& text) {
  const Json json = parse(text);
  const Field message(&json, "");
  Vda5050State state;
  state.order_id = message["orderId"].text();
  state.update_id = message["orderUpdateId"].count();
  state.last_node_id = message["lastNodeId"].text();
  state.last_sequence_id = message["lastNodeSequenceId"].count();
  for (const Field& node : message["nodeStates"].items()) {
    state.nodes.push_back(
        {node["nodeId"].text(), node["sequenceId"].count(), node["released"].truth()});
  }
  state.driving = message["driving"].truth();
  state.paused = isHeld(message);
  state.automatic = isAutomatic(message["operatingMode"]);
  if (const Field way = message.find("distanceSinceLastNode")) {
    state.since_last_node_m = way.number();
  }
  if (const Field position = message.find("agvPosition")) state.position = positionOf(position);
  for (const Field& error : message["errors"].items()) state.errors.push_back(errorOf(error));
  return state;
}

Vda5050Connection parseVda5050Connection(const std::string& text) {
  const Json json = parse(text);
  const Field field = Field(&json, "")["connectionState"];
  const std::string state = field.text();
  if (state == "ONLINE") return Vda5050Connection::kOnline;
  if (state == "OFFLINE") return Vda5050Connection::kOffline;
  if (state == "CONNECTIONBROKEN") return Vda5050Connection::kBroken;
  field.expected("ONLINE, OFFLINE or CONNECTIONBROKEN");
}

}  // namespace split_mapf
