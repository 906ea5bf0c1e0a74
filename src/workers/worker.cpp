#include "workers/worker.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/pipeline/piece_messages.h"

namespace split_mapf {
namespace {

constexpr double kConnectSec = 2;
constexpr std::chrono::milliseconds kTryAgain(500);
constexpr double kPollSec = 0.5;
constexpr double kWatchSec = 0.1;
// The server's lease is four times as long.
constexpr std::chrono::milliseconds kRenewal(500);
// A client says each second that it is alive, and before it asks; that may come a little after the
// piece, as it comes another way.
constexpr std::chrono::seconds kClientGone(5);
constexpr std::chrono::milliseconds kSignOnItsWay(300);

}  // namespace

/// A piece stands among the jobs as long as this lives, however its solver ends.
class Worker::OpenJob {
 public:
  OpenJob(Worker& worker, Job job) : worker_(worker) {
    const std::lock_guard<std::mutex> lock(worker_.mutex_);
    job_ = worker_.jobs_.insert(worker_.jobs_.end(), std::move(job));
  }
  ~OpenJob() {
    const std::lock_guard<std::mutex> lock(worker_.mutex_);
    worker_.jobs_.erase(job_);
  }
  OpenJob(const OpenJob&) = delete;
  OpenJob& operator=(const OpenJob&) = delete;

 private:
  Worker& worker_;
  std::list<Job>::iterator job_;
};

Worker::Worker(std::string url, const SolverRegistry& solvers, std::shared_ptr<const StopFlag> stop,
               const WorkerLog& log)
    : url_(std::move(url)), solvers_(solvers), stop_(std::move(stop)), log_(log) {}

void Worker::say(const std::string& line) {
  const std::lock_guard<std::mutex> lock(log_mutex_);
  log_(line);
}

void Worker::serve(std::uint32_t threads) {
  std::string last_trouble;
  while (!stop_->requested()) {
    try {
      serveOnce(threads);
    } catch (const LinkError& error) {
      if (error.isRefusal()) throw;
      if (error.what() != last_trouble) say(std::string("waiting for the server: ") + error.what());
      last_trouble = error.what();
    } catch (const std::bad_alloc&) {
      // The pieces go to others, or are solved at home.
      last_trouble.clear();
    }
    for (auto begin = Clock::now(); Clock::now() - begin < kTryAgain && !stop_->requested();) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
}

void Worker::serveOnce(std::uint32_t threads) {
  NatsLink link(url_, kConnectSec);
  link.makeQueue();
  const auto leave = std::make_shared<StopFlag>(stop_);
  std::mutex error_mutex;
  std::exception_ptr error;
  const auto guarded = [&](const auto& body) {
    try {
      body();
    } catch (...) {
      const std::lock_guard<std::mutex> lock(error_mutex);
      if (!error) error = std::current_exception();
      leave->request();
    }
  };
  std::vector<std::thread> running;
  guarded([&] {
    while (running.size() < threads) {
      running.emplace_back([&] { guarded([&] { takePieces(link, leave); }); });
    }
  });
  guarded([&] { watch(link, *leave); });
  for (std::thread& thread : running) thread.join();
  if (error) std::rethrow_exception(error);
}

void Worker::takePieces(NatsLink& link, const std::shared_ptr<const StopFlag>& leave) {
  const std::unique_ptr<LinkReader> queue =
      link.readQueue(piecesOfThisBuild(), readersOfThisBuild());
  say("ready");
  while (!leave->requested()) {
    const std::shared_ptr<LinkMessage> message = queue->nextOfQueue(kPollSec);
    if (message) work(link, message, leave);
  }
}

void Worker::work(NatsLink& link, const std::shared_ptr<LinkMessage>& message,
                  const std::shared_ptr<const StopFlag>& leave) {
  const std::optional<PieceAddress> address = addressOf(message->subject());
  if (!address) return message->settle();
  if (!hearsOf(address->client)) return message->settle();
  const auto stop = std::make_shared<StopFlag>(leave);
  const std::string bytes = message->bytes();
  std::string answer;
  {
    const OpenJob job(*this, Job{*address, message, stop});
    link.say(address->answer(), "");  // begun
    answer = solve(bytes, stop, address->name());
  }
  if (leave->requested()) return message->giveBack();
  if (!answer.empty() && !stop->requested() && answer.size() <= link.mostBytes()) {
    link.say(address->answer(), answer);
  }
  message->settle();
}

std::string Worker::solve(const std::string& bytes, const std::shared_ptr<StopFlag>& stop,
                          const std::string& name) {
  try {
    const auto begin = Clock::now();
    const PieceQuestion question = questionFromBytes(bytes);
    const Instance& piece = *question.piece->instance;
    say("piece " + name + " begun: " + counted(piece.robots(), "robot") + ", " +
        shown(question.solver));
    const auto solver = solvers_.create(question.solver, question.options);
    PieceAnswer answer;
    answer.result = solver->solve(SolveRequest(piece, Deadline(question.limit_sec, stop)));
    answer.horizon = makespanLowerBound(piece);
    answer.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    say("piece " + name + " ended: " + toString(answer.result.termination) + " in " +
        numeral(answer.seconds) + " s");
    return toBytes(answer);
  } catch (const Interrupted&) {
    say("piece " + name + " ended: stopped");
  } catch (const std::bad_alloc&) {
    say("piece " + name + " ended: memory ran out");
  } catch (const std::exception& error) {
    say("piece " + name + " ended: refused: " + error.what());
  }
  return {};
}

void Worker::watch(NatsLink& link, const StopFlag& leave) {
  const std::unique_ptr<LinkReader> signs = link.listen(signsOf("*"));
  Clock::time_point last = Clock::now();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    listening_since_ = last;
    last_signs_.clear();
  }
  while (!leave.requested() || hasJobs()) {
    if (const auto message = signs->next(kWatchSec)) heed(*message);
    if (Clock::now() - last < kRenewal) continue;
    last = Clock::now();
    renewLeases();
  }
}

void Worker::heed(const LinkMessage& message) {
  const std::string subject = message.subject();
  const std::string client = subject.substr(subject.rfind('.') + 1);
  const std::string words = message.bytes();
  const std::lock_guard<std::mutex> lock(mutex_);
  last_signs_[client] = Clock::now();
  for (Job& job : jobs_) {
    if (job.address.client != client) continue;
    if (words == "stop " + job.address.name() ||
        words == "stop " + std::to_string(job.address.batch) + ".>") {
      job.stop->request();
    }
  }
}

bool Worker::hasJobs() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !jobs_.empty();
}

void Worker::renewLeases() {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Job& job : jobs_) {
    if (isGone(job.address.client)) job.stop->request();
    job.message->renewLease();
  }
  forgetGone();
}

bool Worker::hearsOf(const std::string& client) {
  const Clock::time_point begin = Clock::now();
  for (;;) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!isGone(client)) return true;
    }
    if (Clock::now() - begin > kSignOnItsWay) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

bool Worker::isGone(const std::string& client) const {
  const Clock::time_point now = Clock::now();
  const auto sign = last_signs_.find(client);
  const Clock::time_point last = sign == last_signs_.end() ? listening_since_ : sign->second;
  return now - last > kClientGone;
}

void Worker::forgetGone() {
  for (auto sign = last_signs_.begin(); sign != last_signs_.end();) {
    // Of unknown clients it is known how long nothing was heard.
    sign = isGone(sign->first) ? last_signs_.erase(sign) : std::next(sign);
  }
}

}  // namespace split_mapf
