#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "workers/nats_link.h"
#include "workers/piece_address.h"
#include "workers/workers.h"

namespace split_mapf {

/// Asks workers over NATS. Questions wait in the server's queue; answers come back on a subject of
/// this client. A thread of its own listens, and tells workers that the client is alive.
class WorkerClient : public RemoteWorkers {
 public:
  WorkerClient(std::string url, const SolverRegistry& solvers);
  ~WorkerClient() override;
  WorkerClient(const WorkerClient&) = delete;
  WorkerClient& operator=(const WorkerClient&) = delete;

  bool know(const std::string& solver) const override;
  std::unique_ptr<Batch> ask(const std::vector<PieceQuestion>& questions,
                             Listener listener) override;
  Tally tally() const override;
  std::string trouble() const override;

 private:
  class OpenBatch;
  /// Of a question in the server's queue.
  struct Place {
    std::optional<std::uint64_t> number;  ///< as soon as the server has said it
    bool wanted = true;
  };
  /// What the listening thread knows of a batch. Its mutex is held while the listener is told, so
  /// that a batch that has ended tells nothing.
  struct Told {
    std::mutex mutex;
    bool ended = false;
    Listener listener;
    std::mutex places_mutex;  // guards what follows
    std::vector<Place> places;
  };

  void run();
  /// Null while there is no server. Tries again until this object ends.
  std::shared_ptr<NatsLink> connect();
  /// Until this object ends. @throws LinkError when the server goes.
  void listen(const std::shared_ptr<NatsLink>& link);
  void take(NatsLink& link, const LinkMessage& message);
  /// Takes the question out of the queue, as soon as it is known where it is.
  static void leaveQueue(NatsLink& link, Told& told, std::size_t question);
  static void takePlace(NatsLink& link, Told* told, std::size_t question, const std::string& bytes);
  /// The link, after a moment where it is just being made; null: there is none.
  std::shared_ptr<NatsLink> link();
  void end(std::uint64_t batch);

  const std::string url_;
  const SolverRegistry& solvers_;
  const std::string client_;
  std::atomic<std::uint64_t> asked_{0};
  std::atomic<std::uint64_t> answered_{0};
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  bool closing_ = false;
  bool tried_ = false;  ///< to reach the server, once at least
  std::string trouble_;
  std::shared_ptr<NatsLink> link_;
  std::uint64_t last_batch_ = 0;
  std::map<std::uint64_t, std::shared_ptr<Told>> batches_;
  std::thread thread_;  // last: it uses all of this
};

}  // namespace split_mapf
