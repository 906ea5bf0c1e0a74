#pragma once

#include <chrono>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "split_mapf/core/deadline.h"
#include "split_mapf/solver/registry.h"
#include "workers/nats_link.h"
#include "workers/piece_address.h"
#include "workers/workers.h"

namespace split_mapf {

/// A process that solves pieces of others. Each thread takes one piece at a time out of the queue;
/// another renews the leases, and stops what nobody wants any more, because the client says so or
/// has gone.
class Worker {
 public:
  Worker(std::string url, const SolverRegistry& solvers, std::shared_ptr<const StopFlag> stop,
         const WorkerLog& log);
  /// Until the flag is raised. @throws LinkError when the server refuses.
  void serve(std::uint32_t threads);

 private:
  using Clock = std::chrono::steady_clock;
  /// A piece that is being solved.
  struct Job {
    PieceAddress address;
    std::shared_ptr<LinkMessage> message;
    std::shared_ptr<StopFlag> stop;
  };
  class OpenJob;

  /// With one connection, until it ends.
  void serveOnce(std::uint32_t threads);
  void takePieces(NatsLink& link, const std::shared_ptr<const StopFlag>& leave);
  void work(NatsLink& link, const std::shared_ptr<LinkMessage>& message,
            const std::shared_ptr<const StopFlag>& leave);
  /// The answer as bytes; empty: there is none.
  std::string solve(const std::string& bytes, const std::shared_ptr<StopFlag>& stop,
                    const std::string& name);
  /// Until the threads have left.
  void watch(NatsLink& link, const StopFlag& leave);
  bool hasJobs();
  void heed(const LinkMessage& message);
  /// Whether a client has said nothing for so long that nobody waits for it. @pre mutex_ is held.
  bool isGone(const std::string& client) const;
  void forgetGone();
  /// Whether somebody waits for the client's pieces.
  bool hearsOf(const std::string& client);
  void renewLeases();
  void say(const std::string& line);

  const std::string url_;
  const SolverRegistry& solvers_;
  const std::shared_ptr<const StopFlag> stop_;
  const WorkerLog& log_;
  std::mutex log_mutex_;
  std::mutex mutex_;  // guards what follows
  std::list<Job> jobs_;
  Clock::time_point listening_since_;
  std::map<std::string, Clock::time_point> last_signs_;  ///< of clients
};

}  // namespace split_mapf
