#include "tool/stop_signals.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstring>

#include "tool/exit_code.h"

namespace split_mapf::tool {
namespace {

// Files that are read within this time are read to the end, so that the result can be written.
constexpr double kGraceSec = 0.5;
// A longer limit than this is none; the timer could not hold it.
constexpr double kLongestTimerSec = 1e8;

// Signal handlers reach nothing but globals. The flag is never destroyed before them.
std::shared_ptr<StopFlag> g_stop;  // NOLINT(readability-identifier-naming)
std::atomic<bool> g_reading{false};

void startTimer(double seconds) {
  const double whole = std::floor(seconds);
  itimerval timer = {};
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - whole) * 1e6);
  setitimer(ITIMER_REAL, &timer, nullptr);
}

void onStopSignal(int /*signal*/) {
  g_stop->request();
  if (g_reading.load()) startTimer(kGraceSec);
}

void onTimer(int /*signal*/) {
  if (!g_reading.load()) return;
  const bool stopped = g_stop->requested();
  const char* message = stopped ? "split_mapf: cancelled while reading files\n"
                                : "split_mapf: the time limit passed while reading files\n";
  // A message that cannot be written changes nothing: the exit code says it too.
  if (::write(STDERR_FILENO, message, std::strlen(message)) < 0) {
  }
  _exit(static_cast<int>(stopped ? ExitCode::kCancelled : ExitCode::kTimeout));
}

void install(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

std::shared_ptr<const StopFlag> catchStopSignals() {
  g_stop = std::make_shared<StopFlag>();
  install(SIGINT, onStopSignal);
  install(SIGTERM, onStopSignal);
  install(SIGALRM, onTimer);
  return g_stop;
}

ReadingGuard::ReadingGuard(double limit_sec) {
  g_reading = true;
  if (limit_sec < kLongestTimerSec) startTimer(limit_sec + kGraceSec);
  if (g_stop->requested()) startTimer(kGraceSec);
}

ReadingGuard::~ReadingGuard() {
  g_reading = false;
  startTimer(0);
}

}  // namespace split_mapf::tool
