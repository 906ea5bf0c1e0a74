#include "workers/worker_client.h"

#include <chrono>
#include <exception>
#include <new>
#include <random>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/pipeline/piece_messages.h"

namespace split_mapf {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kConnectSec = 0.5;
constexpr std::chrono::milliseconds kTryAgain(1000);
// Who has just started waits so long for the server before its first pieces are given out.
constexpr std::chrono::milliseconds kFirstWait(200);
constexpr double kPollSec = 0.2;
constexpr std::chrono::milliseconds kSignOfLife(1000);

/// A name that no other client has; plans do not depend on it.
std::string drawName() {
  std::random_device device;
  std::string name;
  for (int i = 0; i < 4; ++i) name += std::to_string(device()) + (i < 3 ? "-" : "");
  return name;
}

}  // namespace

/// Questions that are open.
class WorkerClient::OpenBatch : public PieceWorkers::Batch {
 public:
  OpenBatch(WorkerClient& client, std::shared_ptr<NatsLink> link, std::shared_ptr<Told> told,
            std::uint64_t batch)
      : client_(client), link_(std::move(link)), told_(std::move(told)), batch_(batch) {}
  ~OpenBatch() override {
    client_.end(batch_);
    for (std::size_t i = 0; i < told_->places.size(); ++i) leaveQueue(*link_, *told_, i);
    link_->say(signsOf(client_.client_), "stop " + std::to_string(batch_) + ".>");
  }
  OpenBatch(const OpenBatch&) = delete;
  OpenBatch& operator=(const OpenBatch&) = delete;

  void withdraw(std::size_t question) override {
    leaveQueue(*link_, *told_, question);
    const PieceAddress address{client_.client_, batch_, question};
    link_->say(signsOf(client_.client_), "stop " + address.name());
  }

 private:
  WorkerClient& client_;
  const std::shared_ptr<NatsLink> link_;
  const std::shared_ptr<Told> told_;
  const std::uint64_t batch_;
};

WorkerClient::WorkerClient(std::string url, const SolverRegistry& solvers)
    : url_(std::move(url)), solvers_(solvers), client_(drawName()), thread_([this] { run(); }) {}

WorkerClient::~WorkerClient() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closing_ = true;
    if (link_) link_->close();
  }
  changed_.notify_all();
  thread_.join();
}

bool WorkerClient::know(const std::string& solver) const {
  return solvers_.traits().count(solver) > 0;
}

RemoteWorkers::Tally WorkerClient::tally() const { return {asked_, answered_}; }

std::string WorkerClient::trouble() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return link_ ? link_->trouble() : trouble_;
}

std::unique_ptr<PieceWorkers::Batch> WorkerClient::ask(const std::vector<PieceQuestion>& questions,
                                                       Listener listener) {
  const std::shared_ptr<NatsLink> link = this->link();
  if (!link) return nullptr;
  const auto told = std::make_shared<Told>();
  told->places.resize(questions.size());
  told->listener = std::move(listener);
  PieceAddress address{client_, 0, 0};
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    address.batch = ++last_batch_;
    batches_[address.batch] = told;
  }
  auto batch = std::make_unique<OpenBatch>(*this, link, told, address.batch);
  link->say(signsOf(client_), "alive");
  for (; address.question < questions.size(); ++address.question) {
    const std::string bytes = toBytes(questions[address.question]);
    if (bytes.size() > link->mostBytes()) continue;
    // Else it would not take the next, either.
    if (!link->putIntoQueue(address.piece(), bytes, address.queued())) break;
    ++asked_;
  }
  return batch;
}

void WorkerClient::end(std::uint64_t batch) {
  std::shared_ptr<Told> told;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    told = std::move(batches_[batch]);
    batches_.erase(batch);
  }
  const std::lock_guard<std::mutex> lock(told->mutex);
  told->ended = true;
}

std::shared_ptr<NatsLink> WorkerClient::link() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, kFirstWait, [this] { return tried_; });
  return link_;
}

void WorkerClient::run() {
  for (;;) {
    try {
      const std::shared_ptr<NatsLink> link = connect();
      if (!link) return;
      listen(link);
    } catch (const std::exception& error) {  // memory may run out too, which ends nobody's plan
      std::unique_lock<std::mutex> lock(mutex_);
      link_.reset();
      try {
        trouble_ = error.what();
      } catch (const std::bad_alloc&) {
        trouble_.clear();
      }
      changed_.wait_for(lock, kTryAgain, [this] { return closing_; });
    }
  }
}

std::shared_ptr<NatsLink> WorkerClient::connect() {
  for (;;) {
    std::shared_ptr<NatsLink> made;
    std::string trouble;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closing_) return nullptr;
    }
    try {
      made = std::make_shared<NatsLink>(url_, kConnectSec);
      made->makeQueue();
    } catch (const LinkError& error) {
      made.reset();
      trouble = error.what();
    }
    std::unique_lock<std::mutex> lock(mutex_);
    trouble_ = trouble;
    if (made) return made;
    tried_ = true;
    changed_.notify_all();
    changed_.wait_for(lock, kTryAgain, [this] { return closing_; });
    if (closing_) return nullptr;
  }
}

void WorkerClient::listen(const std::shared_ptr<NatsLink>& link) {
  const std::unique_ptr<LinkReader> answers = link->listen(messagesTo(client_));
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    link_ = link;
    tried_ = true;
  }
  changed_.notify_all();
  Clock::time_point last_sign = Clock::now();
  for (;;) {
    if (const auto message = answers->next(kPollSec)) take(*link, *message);
    if (const std::string trouble = link->trouble(); !trouble.empty()) {
      throw LinkError(trouble, false);
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (closing_) return;
      if (batches_.empty() || Clock::now() - last_sign < kSignOfLife) continue;
    }
    last_sign = Clock::now();
    link->say(signsOf(client_), "alive");
  }
}

void WorkerClient::leaveQueue(NatsLink& link, Told& told, std::size_t question) {
  const std::lock_guard<std::mutex> lock(told.places_mutex);
  Place& place = told.places[question];
  if (place.wanted && place.number) link.takeOutOfQueue(*place.number);
  place.wanted = false;
}

/// @param told  of the batch; null where it has ended.
void WorkerClient::takePlace(NatsLink& link, Told* told, std::size_t question,
                             const std::string& bytes) {
  const std::optional<std::uint64_t> number = NatsLink::placeIn(bytes);
  if (!number) return;
  if (told == nullptr) return link.takeOutOfQueue(*number);
  const std::lock_guard<std::mutex> lock(told->places_mutex);
  if (question >= told->places.size()) return;
  Place& place = told->places[question];
  place.number = number;
  if (!place.wanted) link.takeOutOfQueue(*number);
}

void WorkerClient::take(NatsLink& link, const LinkMessage& message) {
  const std::optional<PieceAddress> address = addressOf(message.subject());
  if (!address) return;
  std::shared_ptr<Told> told;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = batches_.find(address->batch);
    if (found != batches_.end()) told = found->second;
  }
  if (saysPlace(message.subject())) {
    return takePlace(link, told.get(), address->question, message.bytes());
  }
  if (!told) return;
  const std::lock_guard<std::mutex> lock(told->mutex);
  if (told->ended || address->question >= told->places.size()) return;
  try {
    const std::string bytes = message.bytes();
    if (bytes.empty()) {
      // A worker may take it out of the queue right when a thread here begins it.
      const bool is_wanted = told->listener.begun(address->question);
      if (!is_wanted) link.say(signsOf(client_), "stop " + address->name());
      return;
    }
    if (told->listener.answered(address->question, answerFromBytes(bytes))) ++answered_;
  } catch (const InputError&) {
    // Worth no more than none: the piece is solved here.
    PieceAnswer broken;
    broken.result.termination = Termination::kCancelled;
    told->listener.answered(address->question, std::move(broken));
  } catch (const std::bad_alloc&) {
    // Threads take what workers are at when nothing else is left: this piece too.
  }
}

}  // namespace split_mapf
