#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

struct __natsConnection;
struct __natsMsg;
struct __natsSubscription;
struct __jsCtx;

namespace split_mapf {

/// A server that cannot be reached or refuses. The message tells where, without any password.
class LinkError : public std::runtime_error {
 public:
  LinkError(const std::string& message, bool is_refusal)
      : std::runtime_error(message), is_refusal_(is_refusal) {}
  /// Whether trying again is pointless.
  bool isRefusal() const { return is_refusal_; }

 private:
  bool is_refusal_;
};

/// What came over the link. Destroying it without more leaves a piece of the queue to the
/// server, which gives it to another when the lease is over.
class LinkMessage {
 public:
  explicit LinkMessage(__natsMsg* message);
  ~LinkMessage();
  LinkMessage(const LinkMessage&) = delete;
  LinkMessage& operator=(const LinkMessage&) = delete;

  std::string subject() const;
  std::string bytes() const;
  // Of the queue's messages; without effect where the connection is gone.
  void renewLease();
  /// It is done with, by an answer or without.
  void settle();
  /// Others may have it at once.
  void giveBack();

 private:
  __natsMsg* message_;
};

/// What is said on a subject, or waits in the queue. Of one thread at a time.
class LinkReader {
 public:
  explicit LinkReader(__natsSubscription* subscription) : subscription_(subscription) {}
  ~LinkReader();
  LinkReader(const LinkReader&) = delete;
  LinkReader& operator=(const LinkReader&) = delete;

  /// The next message; null where none comes within the time. @throws LinkError where none can come
  /// any more.
  std::unique_ptr<LinkMessage> next(double seconds);
  /// The same from the queue. @throws LinkError where the queue is no more.
  std::unique_ptr<LinkMessage> nextOfQueue(double seconds);

 private:
  __natsSubscription* subscription_;
};

/// The only room that knows NATS: a connection that comes back by itself after a server was away,
/// and the queue of pieces on it, a stream of JetStream. Thread-safe, but for its readers.
class NatsLink {
 public:
  /// @param url  nats://[USER:PASSWORD@]HOST[:PORT], or tls:// for an encrypted connection.
  /// @throws LinkError.
  NatsLink(const std::string& url, double connect_sec);
  ~NatsLink();
  NatsLink(const NatsLink&) = delete;
  NatsLink& operator=(const NatsLink&) = delete;

  /// Wakes readers, which read nothing more.
  void close();
  /// Why nobody hears what is said now; empty: nothing is known against it.
  std::string trouble() const;
  /// Bytes that the server takes in a message.
  std::size_t mostBytes() const;
  /// Says something to who listens. False where it is lost already. Waits for half a second at
  /// most; a server that takes nothing for so long is left: the link is closed.
  bool say(const std::string& subject, const std::string& bytes);
  std::unique_ptr<LinkReader> listen(const std::string& subject);

  /// Makes the queue where it is not. @throws LinkError.
  void makeQueue();
  /// Puts something into the queue, whose place the server then says on another subject. False
  /// where it is lost already; waits as say().
  bool putIntoQueue(const std::string& subject, const std::string& bytes,
                    const std::string& place_to);
  /// The place in the queue that the server said; nothing where it took nothing.
  static std::optional<std::uint64_t> placeIn(const std::string& bytes);
  /// Takes out of it what waits for somebody, or is with somebody who has not settled it.
  void takeOutOfQueue(std::uint64_t place);
  /// Reads of it what matches the subject, together with others of the same name.
  /// @throws LinkError.
  std::unique_ptr<LinkReader> readQueue(const std::string& subject, const std::string& name);

 private:
  /// Of something that was published: whether it is on its way.
  bool isSaid(int status);

  std::string place_;  ///< of the server, for messages
  __natsConnection* connection_ = nullptr;
  __jsCtx* queue_ = nullptr;
};

/// A URL without user and password.
std::string withoutPassword(const std::string& url);

}  // namespace split_mapf
