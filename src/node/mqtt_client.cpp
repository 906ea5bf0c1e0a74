#include "node/mqtt_client.h"

#include <mosquitto.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace split_mapf {
namespace {

constexpr int kKeepAliveSec = 5;
constexpr int kLoopMs = 100;
constexpr double kFirstWaitSec = 0.25;
constexpr double kLongestWaitSec = 10;
constexpr std::chrono::seconds kConnectPatience(10);

mosquitto* created(void* self) {
  mosquitto_lib_init();
  // No name: the broker gives one, so two bridges never take each other's.
  mosquitto* const client = mosquitto_new(nullptr, true, self);
  if (client == nullptr) throw std::runtime_error("libmosquitto cannot be used: out of memory");
  return client;
}

}  // namespace

MqttClient::MqttClient(MqttSetup setup)
    : setup_(std::move(setup)), client_(created(this), mosquitto_destroy) {
  mosquitto_threaded_set(client_.get(), true);
  mosquitto_connect_callback_set(client_.get(), onConnect);
  mosquitto_message_callback_set(client_.get(), onMessage);
  if (setup_.user.empty()) return;
  const int code =
      mosquitto_username_pw_set(client_.get(), setup_.user.c_str(), setup_.password.c_str());
  if (code != MOSQ_ERR_SUCCESS) {
    throw std::runtime_error(std::string("the user's name cannot be used: ") +
                             mosquitto_strerror(code));
  }
}

MqttClient::~MqttClient() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  ends_.notify_all();
  if (thread_.joinable()) thread_.join();
  client_.reset();
  mosquitto_lib_cleanup();
}

void MqttClient::start() {
  thread_ = std::thread([this] { run(); });
}

bool MqttClient::send(const std::string& topic, const std::string& text) {
  return mosquitto_publish(client_.get(), nullptr, topic.c_str(), static_cast<int>(text.size()),
                           text.data(), 0, false) == MOSQ_ERR_SUCCESS;
}

bool MqttClient::isStopping() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return stopping_;
}

/// @return whether to go on.
bool MqttClient::waits(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  return !ends_.wait_for(lock, std::chrono::duration<double>(seconds),
                         [this] { return stopping_; });
}

void MqttClient::run() {
  double wait_sec = kFirstWaitSec;
  do {
    is_up_ = false;
    refused_.clear();
    const std::string why = serveConnection();
    if (is_up_) wait_sec = kFirstWaitSec;
    if (isStopping()) break;
    setup_.lost(refused_.empty() ? why : refused_);
    const double pause = wait_sec;
    wait_sec = std::min(2 * wait_sec, kLongestWaitSec);
    if (!waits(pause)) break;
  } while (true);
  mosquitto_disconnect(client_.get());
}

/// Until it ends. @return why it did.
std::string MqttClient::serveConnection() {
  int code =
      mosquitto_connect_async(client_.get(), setup_.host.c_str(), setup_.port, kKeepAliveSec);
  const auto patience = std::chrono::steady_clock::now() + kConnectPatience;
  while (code == MOSQ_ERR_SUCCESS && !isStopping()) {
    code = mosquitto_loop(client_.get(), kLoopMs, 1);
    if (!is_up_ && std::chrono::steady_clock::now() > patience) return "it does not answer";
  }
  return code == MOSQ_ERR_ERRNO ? "it cannot be connected" : mosquitto_strerror(code);
}

void MqttClient::onConnect(mosquitto* client, void* self, int code) {
  auto& me = *static_cast<MqttClient*>(self);
  if (code != 0) {
    me.refused_ = mosquitto_connack_string(code);
    return;
  }
  me.is_up_ = true;
  for (const std::string& topic : me.setup_.topics) {
    mosquitto_subscribe(client, nullptr, topic.c_str(), 0);
  }
  me.setup_.connected();
}

void MqttClient::onMessage(mosquitto* /*client*/, void* self, const mosquitto_message* message) {
  const auto* const bytes = static_cast<const char*>(message->payload);
  const auto size = static_cast<std::size_t>(std::max(message->payloadlen, 0));
  static_cast<MqttClient*>(self)->setup_.receive(message->topic,
                                                 size == 0 ? "" : std::string(bytes, size));
}

}  // namespace split_mapf
