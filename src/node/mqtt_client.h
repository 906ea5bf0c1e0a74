#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

struct mosquitto;
struct mosquitto_message;

namespace split_mapf {

/// Where a broker is, and what is done when something happens there. All are called by one thread.
struct MqttSetup {
  std::string host;
  std::uint16_t port = 1883;
  std::string user;  ///< empty: none
  std::string password;
  std::vector<std::string> topics;  ///< subscribed whenever a connection has been made
  std::function<void()> connected;
  std::function<void(const std::string& why)> lost;  ///< also of every try that failed
  std::function<void(const std::string& topic, const std::string& text)> receive;
};

/// A connection to an MQTT broker that comes back: after a loss, or a try that failed, it is tried
/// again after 0.25 s, then twice as long, up to 10 s. Quality of service 0, as VDA 5050 has it.
/// Thread-safe.
class MqttClient {
 public:
  /// @throws std::runtime_error when the library cannot be used.
  explicit MqttClient(MqttSetup setup);
  ~MqttClient();
  MqttClient(const MqttClient&) = delete;
  MqttClient& operator=(const MqttClient&) = delete;

  /// From now on callbacks come. @pre called once.
  void start();
  /// @return whether it was given to the connection; false: there is none.
  bool send(const std::string& topic, const std::string& text);

 private:
  void run();
  std::string serveConnection();
  bool waits(double seconds);
  bool isStopping();

  static void onConnect(mosquitto* client, void* self, int code);
  static void onMessage(mosquitto* client, void* self, const mosquitto_message* message);

  const MqttSetup setup_;
  std::unique_ptr<mosquitto, void (*)(mosquitto*)> client_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool stopping_ = false;
  bool is_up_ = false;   // of its thread only
  std::string refused_;  // likewise: why the broker did not let us in
  std::thread thread_;
};

}  // namespace split_mapf
