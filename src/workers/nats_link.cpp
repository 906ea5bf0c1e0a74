#include "workers/nats_link.h"

#include <nats/nats.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

namespace split_mapf {
namespace {

constexpr const char* kQueue = "SPLIT_MAPF_PIECES";
constexpr const char* kQueueSubjects = "split_mapf.pieces.>";
// One by one: after a purge by subject, servers as old as 2.9 give the readers nothing any more of
// what waited then.
constexpr const char* kTakeOut = "$JS.API.STREAM.MSG.DELETE.SPLIT_MAPF_PIECES";
constexpr std::int64_t kSecond = 1000000000;
// A worker that is silent for so long has lost its piece to another.
constexpr std::int64_t kLease = 2 * kSecond;
// A piece that kills whoever takes it kills so many.
constexpr std::int64_t kMostDeliveries = 3;
// What nobody wants any more goes by itself.
constexpr std::int64_t kOldest = 3600 * kSecond;
constexpr std::int64_t kReconnectWaitMs = 500;
// A server that is frozen is noticed after three of these.
constexpr std::int64_t kPingMs = 2000;
constexpr int kPingsOut = 2;
// One that takes nothing for so long, once the connection's buffers are full, is left.
constexpr std::int64_t kWriteMs = 500;
constexpr std::int64_t kAnswerMs = 1000;  // of the server to requests about the queue

std::int64_t inMs(double seconds) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(seconds * 1000));
}

struct OptionsDeleter {
  void operator()(natsOptions* options) const { natsOptions_Destroy(options); }
};
using Options = std::unique_ptr<natsOptions, OptionsDeleter>;

Options optionsFor(const std::string& url, double connect_sec) {
  natsOptions* made = nullptr;
  natsStatus status = natsOptions_Create(&made);
  Options options(made);
  if (status == NATS_OK) status = natsOptions_SetURL(made, url.c_str());
  if (status == NATS_OK) status = natsOptions_SetTimeout(made, inMs(connect_sec));
  if (status == NATS_OK) status = natsOptions_SetMaxReconnect(made, -1);
  if (status == NATS_OK) status = natsOptions_SetReconnectWait(made, kReconnectWaitMs);
  if (status == NATS_OK) status = natsOptions_SetName(made, "split_mapf");
  if (status == NATS_OK) status = natsOptions_SetPingInterval(made, kPingMs);
  if (status == NATS_OK) status = natsOptions_SetMaxPingsOut(made, kPingsOut);
  if (status == NATS_OK) status = natsOptions_SetWriteDeadline(made, kWriteMs);
  // What was said to a server that has gone is of no use to the next.
  if (status == NATS_OK) status = natsOptions_SetReconnectBufSize(made, 0);
  // The default writes to standard error.
  const auto silent = [](natsConnection*, natsSubscription*, natsStatus, void*) {};
  if (status == NATS_OK) status = natsOptions_SetErrorHandler(made, silent, nullptr);
  if (status != NATS_OK) {
    throw LinkError(withoutPassword(url) + ": " + natsStatus_GetText(status), true);
  }
  return options;
}

/// What the library says of its last error on this thread.
std::string lastError(natsStatus status) {
  const char* const text = nats_GetLastError(nullptr);
  return text != nullptr && *text != '\0' ? text : natsStatus_GetText(status);
}

bool isRefusal(natsStatus status) {
  return status == NATS_CONNECTION_AUTH_FAILED || status == NATS_NOT_PERMITTED ||
         status == NATS_SSL_ERROR || status == NATS_SECURE_CONNECTION_REQUIRED ||
         status == NATS_SECURE_CONNECTION_WANTED || status == NATS_INVALID_ARG;
}

}  // namespace

std::string withoutPassword(const std::string& url) {
  const std::size_t scheme = url.find("://");
  const std::size_t begin = scheme == std::string::npos ? 0 : scheme + 3;
  const std::size_t at = url.rfind('@');
  if (at == std::string::npos || at < begin) return url;
  return url.substr(0, begin) + url.substr(at + 1);
}

LinkMessage::LinkMessage(natsMsg* message) : message_(message) {}

LinkMessage::~LinkMessage() { natsMsg_Destroy(message_); }

std::string LinkMessage::subject() const { return natsMsg_GetSubject(message_); }

std::string LinkMessage::bytes() const {
  return {natsMsg_GetData(message_), static_cast<std::size_t>(natsMsg_GetDataLength(message_))};
}

void LinkMessage::renewLease() { natsMsg_InProgress(message_, nullptr); }
void LinkMessage::settle() { natsMsg_Ack(message_, nullptr); }
void LinkMessage::giveBack() { natsMsg_Nak(message_, nullptr); }

LinkReader::~LinkReader() { natsSubscription_Destroy(subscription_); }

std::unique_ptr<LinkMessage> LinkReader::next(double seconds) {
  natsMsg* message = nullptr;
  const natsStatus status = natsSubscription_NextMsg(&message, subscription_, inMs(seconds));
  if (status == NATS_OK) return std::make_unique<LinkMessage>(message);
  if (status == NATS_TIMEOUT || status == NATS_SLOW_CONSUMER) return nullptr;
  throw LinkError(natsStatus_GetText(status), false);
}

std::unique_ptr<LinkMessage> LinkReader::nextOfQueue(double seconds) {
  natsMsgList list = {};
  jsErrCode code = static_cast<jsErrCode>(0);
  const natsStatus status = natsSubscription_Fetch(&list, subscription_, 1, inMs(seconds), &code);
  if (status == NATS_OK && list.Count > 0) {
    auto message = std::make_unique<LinkMessage>(std::exchange(list.Msgs[0], nullptr));
    natsMsgList_Destroy(&list);
    return message;
  }
  natsMsgList_Destroy(&list);
  if (status == NATS_TIMEOUT) {
    // Silence may mean that the server began anew, without the queue.
    jsConsumerInfo* info = nullptr;
    const natsStatus there = natsSubscription_GetConsumerInfo(&info, subscription_, nullptr, &code);
    jsConsumerInfo_Destroy(info);
    if (there == NATS_OK) return nullptr;
  }
  throw LinkError(std::string("the queue: ") + natsStatus_GetText(status), false);
}

NatsLink::NatsLink(const std::string& url, double connect_sec) : place_(withoutPassword(url)) {
  const Options options = optionsFor(url, connect_sec);
  natsStatus status = natsConnection_Connect(&connection_, options.get());
  jsOptions queue_options;
  jsOptions_Init(&queue_options);
  queue_options.Wait = kAnswerMs;
  if (status == NATS_OK) status = natsConnection_JetStream(&queue_, connection_, &queue_options);
  if (status == NATS_OK) return;
  natsConnection_Destroy(connection_);
  throw LinkError(place_ + ": " + natsStatus_GetText(status), isRefusal(status));
}

NatsLink::~NatsLink() {
  jsCtx_Destroy(queue_);
  natsConnection_Destroy(connection_);
}

void NatsLink::close() { natsConnection_Close(connection_); }

std::string NatsLink::trouble() const {
  if (natsConnection_Status(connection_) == NATS_CONN_STATUS_CONNECTED) return "";
  return place_ + ": the connection is lost";
}

std::size_t NatsLink::mostBytes() const {
  return static_cast<std::size_t>(
      std::max<std::int64_t>(0, natsConnection_GetMaxPayload(connection_)));
}

bool NatsLink::say(const std::string& subject, const std::string& bytes) {
  const natsStatus status = natsConnection_Publish(connection_, subject.c_str(), bytes.data(),
                                                   static_cast<int>(bytes.size()));
  return isSaid(status);
}

bool NatsLink::isSaid(int status) {
  // Half a message may have gone out; and who speaks next would wait as long.
  if (status == NATS_TIMEOUT) close();
  return status == NATS_OK;
}

std::unique_ptr<LinkReader> NatsLink::listen(const std::string& subject) {
  natsSubscription* subscription = nullptr;
  const natsStatus status =
      natsConnection_SubscribeSync(&subscription, connection_, subject.c_str());
  if (status != NATS_OK) throw LinkError(place_ + ": " + natsStatus_GetText(status), false);
  return std::make_unique<LinkReader>(subscription);
}

void NatsLink::makeQueue() {
  jsStreamConfig config;
  jsStreamConfig_Init(&config);
  const char* subjects[] = {kQueueSubjects};  // NOLINT(modernize-avoid-c-arrays): the library's
  config.Name = kQueue;
  config.Subjects = subjects;
  config.SubjectsLen = 1;
  config.Retention = js_WorkQueuePolicy;
  config.Storage = js_MemoryStorage;
  config.MaxAge = kOldest;
  jsErrCode code = static_cast<jsErrCode>(0);
  const natsStatus status = js_AddStream(nullptr, queue_, &config, nullptr, &code);
  if (status == NATS_OK) return;
  throw LinkError(place_ + ": no queue can be made, which needs JetStream: " + lastError(status),
                  false);
}

bool NatsLink::putIntoQueue(const std::string& subject, const std::string& bytes,
                            const std::string& place_to) {
  return isSaid(natsConnection_PublishRequest(connection_, subject.c_str(), place_to.c_str(),
                                              bytes.data(), static_cast<int>(bytes.size())));
}

std::optional<std::uint64_t> NatsLink::placeIn(const std::string& bytes) {
  const nlohmann::json answer = nlohmann::json::parse(bytes, nullptr, false);
  if (!answer.is_object()) return std::nullopt;
  const auto place = answer.find("seq");
  if (place == answer.end() || !place->is_number_unsigned()) return std::nullopt;
  return place->get<std::uint64_t>();
}

void NatsLink::takeOutOfQueue(std::uint64_t place) {
  say(kTakeOut, R"({"no_erase":true,"seq":)" + std::to_string(place) + "}");
}

std::unique_ptr<LinkReader> NatsLink::readQueue(const std::string& subject,
                                                const std::string& name) {
  jsSubOptions options;
  jsSubOptions_Init(&options);
  options.Stream = kQueue;
  options.Config.AckPolicy = js_AckExplicit;
  options.Config.AckWait = kLease;
  options.Config.MaxDeliver = kMostDeliveries;
  options.Config.MaxAckPending = -1;
  jsErrCode code = static_cast<jsErrCode>(0);
  natsSubscription* subscription = nullptr;
  const natsStatus status = js_PullSubscribe(&subscription, queue_, subject.c_str(), name.c_str(),
                                             nullptr, &options, &code);
  if (status != NATS_OK) {
    throw LinkError(place_ + ": the queue cannot be read: " + lastError(status), false);
  }
  return std::make_unique<LinkReader>(subscription);
}

}  // namespace split_mapf
