#include "pipeline/piece_race.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "split_mapf/core/validate.h"

namespace split_mapf {
namespace {

/// Whether an answer from elsewhere is one that the piece can have. That its plan is the one that
/// would have been found here follows from the version, which is the same.
bool isSound(const Piece& piece, const SolveResult& result) {
  // Without a limit nobody gives up; and all other ends speak of the worker, not of the piece.
  if (result.termination == Termination::kNoPlanFound) return piece.shares > 0;
  return result.termination == Termination::kSolved &&
         validate(*piece.instance, *result.plan).empty();
}

}  // namespace

PieceRace::PieceRace(std::vector<Entry> entries, const std::shared_ptr<const StopFlag>& stop,
                     std::function<void(const SolveResult&)> done)
    : entries_(std::move(entries)),
      done_(std::move(done)),
      order_(entries_.size()),
      questions_(entries_.size()),
      states_(entries_.size(), State::kOpen),
      outcomes_(entries_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(), [this](std::size_t a, std::size_t b) {
    return entries_[a].expected_effort > entries_[b].expected_effort;
  });
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    stops_.push_back(std::make_shared<StopFlag>(stop));
  }
}

void PieceRace::ask(PieceWorkers& workers, const std::vector<std::size_t>& asked,
                    const std::vector<PieceQuestion>& questions,
                    std::vector<SubproblemReport> rows) {
  for (std::size_t i = 0; i < asked.size(); ++i) questions_[asked[i]] = i;
  PieceWorkers::Listener listener;
  listener.begun = [this, asked](std::size_t i) { return begunAway(asked[i]); };
  listener.answered = [this, asked, rows = std::move(rows)](std::size_t i, PieceAnswer answer) {
    return takeAnswer(asked[i], rows[i], std::move(answer));
  };
  auto batch = workers.ask(questions, std::move(listener));
  const std::lock_guard<std::mutex> lock(batch_mutex_);
  batch_ = std::move(batch);
}

std::optional<PieceRace::Draw> PieceRace::draw() {
  std::optional<std::size_t> drawn;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto is = [this](State state) {
      return [this, state](std::size_t i) { return states_[i] == state; };
    };
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first_open_);
    const auto open = std::find_if(begin, order_.end(), is(State::kOpen));
    first_open_ = static_cast<std::size_t>(open - order_.begin());
    if (open != order_.end()) {
      drawn = *open;
      states_[*drawn] = State::kHere;
    } else {
      const auto away = std::find_if(order_.begin(), order_.end(), is(State::kAway));
      if (away == order_.end()) return std::nullopt;
      states_[*away] = State::kBoth;
      return Draw{*away, stops_[*away]};
    }
  }
  // No worker need begin it any more; one that has, in this moment, stops.
  withdraw(*drawn);
  return Draw{*drawn, stops_[*drawn]};
}

bool PieceRace::begunAway(std::size_t entry) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (states_[entry] == State::kOpen) states_[entry] = State::kAway;
  return states_[entry] == State::kAway || states_[entry] == State::kBoth;
}

void PieceRace::finish(std::size_t entry, Outcome outcome) {
  bool away = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    away = states_[entry] == State::kBoth;
  }
  if (settle(entry, std::move(outcome)) && away) withdraw(entry);
}

bool PieceRace::takeAnswer(std::size_t entry, const SubproblemReport& row, PieceAnswer answer) {
  if (!isSound(*entries_[entry].piece, answer.result)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (states_[entry] != State::kAway) return false;
    states_[entry] = State::kOpen;
    first_open_ = 0;
    return false;
  }
  Outcome outcome{std::move(answer.result), row};
  outcome.row.horizon = answer.horizon;
  outcome.row.seconds = answer.seconds;
  outcome.row.status = toString(outcome.result.termination);
  if (!settle(entry, std::move(outcome))) return false;
  stops_[entry]->request();
  return true;
}

bool PieceRace::settle(std::size_t entry, Outcome outcome) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (states_[entry] == State::kDone) return false;
    states_[entry] = State::kDone;
    outcomes_[entry] = std::move(outcome);
  }
  done_(outcomes_[entry].result);
  return true;
}

void PieceRace::withdraw(std::size_t entry) {
  if (!questions_[entry]) return;
  const std::lock_guard<std::mutex> lock(batch_mutex_);
  if (batch_) batch_->withdraw(*questions_[entry]);
}

std::vector<PieceRace::Outcome> PieceRace::take() {
  batch_.reset();
  return std::move(outcomes_);
}

}  // namespace split_mapf
