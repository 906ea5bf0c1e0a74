#include <iostream>

#include "solver/available/available_solvers.h"
#include "split_mapf/parallel/executor.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/memory_limit.h"
#include "tool/stop_signals.h"
#include "workers/workers.h"

namespace split_mapf::tool {

ExitCode runWorker(const Call& call) {
  constexpr std::uint64_t kMostThreads = 1024;
  constexpr std::uint64_t kMostMib = 1ULL << 40U;
  CommandLine line(
      "worker",
      "Solves pieces of splits for calls of plan --workers, on this machine or others,\n"
      "until it gets SIGINT or SIGTERM.");
  line.require("server", "URL",
               "the NATS server with JetStream: nats://[USER:PASSWORD@]HOST[:PORT], or tls://...");
  line.offer("threads", "N", "pieces at a time (one a processor)");
  line.offer("memory-limit", "MIB", "memory that the process may use (no limit)");
  line.offerFlag("quiet", "print nothing but errors");
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const auto threads = static_cast<std::uint32_t>(
      line.wholeNumber("threads", Executor::machineThreads(), 1, kMostThreads));
  if (line.has("memory-limit")) limitMemory(line.wholeNumber("memory-limit", 0, 1, kMostMib));
  const bool quiet = line.has("quiet");
  serveWorkers(line.text("server"), availableSolvers(), threads, catchStopSignals(),
               [quiet](const std::string& text) {
                 if (!quiet) std::cout << text << std::endl;  // whoever watches a pipe sees it now
               });
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
