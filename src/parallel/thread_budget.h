#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

namespace split_mapf {

/// All worker threads that an executor and the teams of its callers have together. A worker does
/// jobs in order of arrival; while there is none it helps a team, and leaves it, between two items,
/// for the next job. Thread-safe.
class ThreadBudget {
 public:
  /// Work in which idle workers may take part.
  class Host {
   public:
    virtual ~Host() = default;
    /// Takes part as that member until recalled or dismissed.
    virtual void serve(std::uint32_t member) = 0;
    /// One member shall leave soon. Called with the budget's lock: never call the budget from it.
    virtual void recall() = 0;
    /// All members shall leave. The same holds.
    virtual void dismiss() = 0;
  };

  /// @throws std::system_error when a thread cannot be started; none is left over then.
  explicit ThreadBudget(std::uint32_t workers);
  /// Does what is posted first. @pre no team is enrolled.
  ~ThreadBudget();
  ThreadBudget(const ThreadBudget&) = delete;
  ThreadBudget& operator=(const ThreadBudget&) = delete;

  std::uint32_t workers() const { return static_cast<std::uint32_t>(threads_.size()); }

  /// @param job  throws nothing. @pre there is a worker. @throws std::bad_alloc: it is not posted.
  void post(std::function<void()> job);
  /// Opens places 1 .. `places` of a team to workers.
  void enrol(Host& host, std::uint32_t places);
  /// Returns when no worker is in the team. @pre it is enrolled.
  void dismiss(Host& host);

 private:
  struct Team {
    Host* host;
    std::vector<std::uint32_t> vacant;  // places, the lowest at the end
    std::uint32_t present = 0;          // workers
    std::uint32_t recalled = 0;         // of these
    bool closed = false;

    std::uint32_t staying() const { return present - recalled; }
  };

  void work();
  void doJob(std::unique_lock<std::mutex>& lock);
  void help(Team& team, std::unique_lock<std::mutex>& lock);
  Team* teamWithFewest();
  Team* teamWithMost();
  static void recallOne(Team& team);
  void close();

  std::mutex mutex_;
  std::condition_variable changed_;  // for idle workers
  std::condition_variable left_;     // a team
  std::deque<std::function<void()>> jobs_;
  std::list<Team> teams_;
  std::uint32_t idle_ = 0;
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace split_mapf
