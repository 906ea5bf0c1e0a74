#include "plugin/watched_call.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "split_mapf/plugin/methods.h"

namespace split_mapf {
namespace {

// A stop flag cannot wake a sleeper, so that the caller looks at its deadline this often.
constexpr std::chrono::milliseconds kPollInterval(10);

std::atomic<int> abandoned_calls{0};

/// What the two threads of a call share.
struct Call {
  std::function<void()> body;
  std::mutex mutex;
  std::condition_variable changed;
  bool has_ended = false;
  bool is_abandoned = false;
  std::exception_ptr error;
};

void run(Call& call, std::atomic<int>& abandoned) {
  std::exception_ptr error;
  try {
    call.body();
  } catch (...) {
    error = std::current_exception();
  }
  call.body = nullptr;  // before the end is told: what it owns may be large
  const std::lock_guard<std::mutex> lock(call.mutex);
  call.has_ended = true;
  // The error is of the plug-in's making: whoever waits lets go of it, or this thread does before
  // it is told that it has ended.
  if (call.is_abandoned) {
    error = nullptr;
    --abandoned;
    --abandoned_calls;
  }
  call.error = std::move(error);
  call.changed.notify_all();
}

}  // namespace

bool CallWatch::call(std::function<void()> body, const Deadline& deadline) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::duration<double> kGrace(kGraceSec);
  const auto call = std::make_shared<Call>();
  call->body = std::move(body);
  try {
    std::thread([call, abandoned = abandoned_] { run(*call, *abandoned); }).detach();
  } catch (const std::system_error&) {
    throw std::bad_alloc();  // that no thread can be started is not the plug-in's fault
  }
  std::unique_lock<std::mutex> lock(call->mutex);
  std::optional<Clock::time_point> overdue;
  while (!call->has_ended) {
    call->changed.wait_for(lock, kPollInterval);
    if (!overdue && deadline.expired()) overdue = Clock::now();
    if (call->has_ended || !overdue || Clock::now() - *overdue < kGrace) continue;
    call->is_abandoned = true;
    ++*abandoned_;
    ++abandoned_calls;
    return false;
  }
  if (call->error) std::rethrow_exception(std::exchange(call->error, nullptr));
  return true;
}

int abandonedCalls() { return abandoned_calls; }

}  // namespace split_mapf
