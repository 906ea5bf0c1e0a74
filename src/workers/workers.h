#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "split_mapf/core/deadline.h"
#include "split_mapf/pipeline/piece_workers.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// Workers behind a server, as programs see them.
class RemoteWorkers : public PieceWorkers {
 public:
  /// Since the beginning.
  struct Tally {
    std::uint64_t asked = 0;     ///< questions
    std::uint64_t answered = 0;  ///< sound, and before this process had its own
  };
  virtual Tally tally() const = 0;
  /// Why nobody can be asked now, in words; empty: somebody can.
  virtual std::string trouble() const = 0;
};

/// Goes to the server, in the background and as often as it is away. Never fails for that.
/// @param url  see NatsLink. @param solvers  that the workers know as this process does; outlives
/// the object. @throws OptionError in a build without workers, where libnats was not there; and for
/// a URL that is none.
std::unique_ptr<RemoteWorkers> connectWorkers(const std::string& url,
                                              const SolverRegistry& solvers);

/// What a worker does, for who watches it.
using WorkerLog = std::function<void(const std::string& line)>;

/// Solves pieces that clients ask for, on so many threads, until the flag is raised; comes back
/// whenever the server was away. @throws OptionError as connectWorkers(); InputError when the
/// server refuses.
void serveWorkers(const std::string& url, const SolverRegistry& solvers, std::uint32_t threads,
                  const std::shared_ptr<const StopFlag>& stop, const WorkerLog& log);

}  // namespace split_mapf
