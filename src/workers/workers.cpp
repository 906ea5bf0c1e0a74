#include "workers/workers.h"

#include "split_mapf/core/error.h"

#ifdef SPLIT_MAPF_HAS_WORKERS
#include "split_mapf/core/wording.h"
#include "workers/nats_link.h"
#include "workers/worker.h"
#include "workers/worker_client.h"
#endif

namespace split_mapf {
namespace {

void requireServer(const std::string& url) {
#ifdef SPLIT_MAPF_HAS_WORKERS
  if (url.rfind("nats://", 0) == 0 || url.rfind("tls://", 0) == 0) return;
  throw OptionError("workers: " + quote(withoutPassword(url)) +
                    " was given, nats://[USER:PASSWORD@]HOST[:PORT] or tls://... is expected");
#else
  static_cast<void>(url);
  throw OptionError("workers: this build has none, as libnats was not there when it was made");
#endif
}

}  // namespace

std::unique_ptr<RemoteWorkers> connectWorkers(const std::string& url,
                                              const SolverRegistry& solvers) {
  requireServer(url);
#ifdef SPLIT_MAPF_HAS_WORKERS
  return std::make_unique<WorkerClient>(url, solvers);
#else
  static_cast<void>(solvers);
  return nullptr;
#endif
}

void serveWorkers(const std::string& url, const SolverRegistry& solvers, std::uint32_t threads,
                  const std::shared_ptr<const StopFlag>& stop, const WorkerLog& log) {
  requireServer(url);
#ifdef SPLIT_MAPF_HAS_WORKERS
  try {
    Worker(url, solvers, stop, log).serve(threads);
  } catch (const LinkError& error) {
    throw InputError(error.what());
  }
#else
  static_cast<void>(solvers);
  static_cast<void>(threads);
  static_cast<void>(stop);
  static_cast<void>(log);
#endif
}

}  // namespace split_mapf
