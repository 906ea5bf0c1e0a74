#include "parallel/thread_team.h"

#include <utility>

namespace split_mapf {

ThreadTeam::ThreadTeam(const LentThreads& lent) : lent_(lent) {
  if (lent_.most() > 1) lent_.budget()->enrol(*this, lent_.most() - 1);
}

ThreadTeam::~ThreadTeam() {
  if (lent_.most() > 1) lent_.budget()->dismiss(*this);
}

void ThreadTeam::forEach(std::uint32_t count, const Body& body) {
  if (lent_.most() == 1 || count < 2) {
    for (std::uint32_t i = 0; i < count; ++i) body(i, 0);
    return;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  body_ = &body;
  next_ = 0;
  count_ = count;
  begun_.notify_all();
  work(0, lock);
  ended_.wait(lock, [this] { return busy_ == 0; });
  body_ = nullptr;
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void ThreadTeam::serve(std::uint32_t member) {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    begun_.wait(lock, [this] { return mayLeave() || (body_ != nullptr && next_ < count_); });
    if (mayLeave()) break;
    work(member, lock);
    if (busy_ == 0) ended_.notify_one();
  }
  if (recalled_ > 0) --recalled_;
}

void ThreadTeam::recall() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++recalled_;
  begun_.notify_one();
}

void ThreadTeam::dismiss() {
  const std::lock_guard<std::mutex> lock(mutex_);
  leaving_ = true;
  begun_.notify_all();
}

void ThreadTeam::work(std::uint32_t member, std::unique_lock<std::mutex>& lock) {
  ++busy_;
  while (next_ < count_ && (member == 0 || recalled_ == 0)) {
    const std::uint32_t item = next_++;
    const Body& body = *body_;
    lock.unlock();
    std::exception_ptr error;
    try {
      body(item, member);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    if (!error) continue;
    if (!error_) error_ = error;
    next_ = count_;  // the rest is void
  }
  --busy_;
}

}  // namespace split_mapf
