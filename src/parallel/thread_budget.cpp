#include "parallel/thread_budget.h"

#include <algorithm>
#include <utility>

#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

LentThreads::LentThreads(std::uint32_t most, ThreadBudget& budget)
    : most_(std::max(1U, std::min(most, budget.workers() + 1))), budget_(&budget) {}

LentThreads LentThreads::atMost(std::uint32_t most) const {
  LentThreads fewer = *this;
  fewer.most_ = std::min(most_, most);
  return fewer;
}

ThreadBudget::ThreadBudget(std::uint32_t workers) {
  threads_.reserve(workers);
  try {
    while (threads_.size() < workers) {
      threads_.emplace_back([this] { work(); });
    }
  } catch (...) {
    close();
    throw;
  }
}

ThreadBudget::~ThreadBudget() { close(); }

void ThreadBudget::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadBudget::post(std::function<void()> job) {
  const std::lock_guard<std::mutex> lock(mutex_);
  jobs_.push_back(std::move(job));
  changed_.notify_one();
  if (jobs_.size() <= idle_) return;
  if (Team* const team = teamWithMost()) recallOne(*team);
}

void ThreadBudget::enrol(Host& host, std::uint32_t places) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Team team{&host, std::vector<std::uint32_t>(places)};
  for (std::uint32_t i = 0; i < places; ++i) team.vacant[i] = places - i;
  teams_.push_back(std::move(team));
  changed_.notify_all();
  // Where too few are idle, teams that have more give theirs until they have one more.
  for (std::uint32_t come = idle_; come < places; ++come) {
    Team* const most = teamWithMost();
    if (most == nullptr || most->staying() <= come + 1) return;
    recallOne(*most);
  }
}

void ThreadBudget::dismiss(Host& host) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto team = std::find_if(teams_.begin(), teams_.end(),
                                 [&](const Team& each) { return each.host == &host; });
  team->closed = true;
  host.dismiss();
  left_.wait(lock, [&] { return team->present == 0; });
  teams_.erase(team);
}

void ThreadBudget::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    if (!jobs_.empty()) {
      doJob(lock);
    } else if (Team* const team = teamWithFewest()) {
      help(*team, lock);
    } else if (closing_) {
      return;
    } else {
      ++idle_;
      changed_.wait(lock);
      --idle_;
    }
  }
}

void ThreadBudget::doJob(std::unique_lock<std::mutex>& lock) {
  std::function<void()> job = std::move(jobs_.front());
  jobs_.pop_front();
  lock.unlock();
  job();
  job = nullptr;  // what it holds may be large
  lock.lock();
}

void ThreadBudget::help(Team& team, std::unique_lock<std::mutex>& lock) {
  const std::uint32_t member = team.vacant.back();
  team.vacant.pop_back();
  ++team.present;
  lock.unlock();
  team.host->serve(member);
  lock.lock();
  team.vacant.push_back(member);
  --team.present;
  if (team.recalled > 0) --team.recalled;
  if (team.present == 0) left_.notify_all();
}

ThreadBudget::Team* ThreadBudget::teamWithFewest() {
  Team* fewest = nullptr;
  for (Team& team : teams_) {
    if (team.closed || team.vacant.empty()) continue;
    if (fewest == nullptr || team.present < fewest->present) fewest = &team;
  }
  return fewest;
}

ThreadBudget::Team* ThreadBudget::teamWithMost() {
  Team* most = nullptr;
  for (Team& team : teams_) {
    if (team.closed || team.staying() == 0) continue;
    if (most == nullptr || team.staying() > most->staying()) most = &team;
  }
  return most;
}

void ThreadBudget::recallOne(Team& team) {
  ++team.recalled;
  team.host->recall();
}

}  // namespace split_mapf
