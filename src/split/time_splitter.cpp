#include "split_mapf/split/time_splitter.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "split/piece_sequence.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {

namespace {

void checkBisection(const SplitRequest& request) {
  if (request.options.variant != TimeSplitVariant::kBisection) return;
  const std::vector<double>& ratios = request.spec.time_ratios;
  const bool power = (ratios.size() & (ratios.size() - 1)) == 0;
  const bool equal =
      std::adjacent_find(ratios.begin(), ratios.end(), std::not_equal_to<>()) == ratios.end();
  if (power && equal) return;
  throw OptionError("variant=bisection halves again and again: split " + quote(request.text) +
                    " should be Kt with K a power of two");
}

}  // namespace

TimeSplitOptions timeOptionsOf(const SplitRequest& request, const Instance& instance,
                               std::uint64_t seed, const SolvabilityChecker* checker) {
  TimeSplitOptions options;
  options.ratios = request.spec.time_ratios;
  options.variant = request.options.variant;
  options.assignment = request.options.assignment.value_or(StateAssignment::kGreedy);
  options.seed = seed;
  using Check = SplitOptions::Check;
  const Check check = request.options.check;
  const bool crowded = instance.robots() > instance.graph().size() / 4;
  if (check == Check::kAlways || (check == Check::kAuto && crowded)) options.checker = checker;
  return options;
}

SplitterInfo TimeSplitter::info() {
  SplitterInfo info;
  info.name = "time";
  info.description = "Kt, t(r1,...,rK): pieces of all robots, one after another";
  info.options = timeSplitOptions();
  info.makes = [](const SplitSpec& spec) { return !spec.space && !spec.time_ratios.empty(); };
  info.check = checkBisection;
  info.uses_ways = [](const SplitRequest& request, const Instance& instance) {
    if (request.spec.time_ratios.size() < 2) return false;
    return followsShortestWays(instance, timeOptionsOf(request, instance, 0, nullptr));
  };
  info.make = [](const SplitRequest& request, SplitQuestion question) -> std::unique_ptr<Splitter> {
    if (request.spec.time_ratios.size() == 1) {
      return std::make_unique<WholeWhereItFails>(question.instance);
    }
    return std::make_unique<TimeSplitter>(
        question.instance,
        timeOptionsOf(request, question.instance, question.seed, &question.checker),
        std::move(question.ways));
  };
  return info;
}

TimeSplitter::TimeSplitter(const Instance& instance, TimeSplitOptions options,
                           std::vector<Path> ways)
    : instance_(instance), options_(std::move(options)), ways_(std::move(ways)) {}

TimeSplitter::~TimeSplitter() = default;

bool TimeSplitter::split(const Deadline& deadline) {
  std::optional<std::vector<Piece>> pieces =
      splitTime(instance_, options_, deadline, std::move(ways_));
  if (!pieces) return false;
  sequence_ = std::make_unique<PieceSequence>(std::move(*pieces),
                                              PieceSequence::Options{options_, 0, true}, next_id_);
  return true;
}

PieceTree TimeSplitter::tree() const { return PieceTree::sequence(sequence_->pieces()); }

std::size_t TimeSplitter::indexOf(PieceId piece) const {
  const std::vector<PieceHandle>& pieces = sequence_->pieces();
  const auto found = std::find_if(pieces.begin(), pieces.end(),
                                  [piece](const PieceHandle& p) { return p->id == piece; });
  return static_cast<std::size_t>(found - pieces.begin());
}

bool TimeSplitter::cutAnew(PieceId piece, const std::unordered_set<PieceId>& failed,
                           const Deadline& deadline) {
  return sequence_->cutAnew(indexOf(piece), failed, deadline);
}

bool TimeSplitter::merge(PieceId piece, const Deadline& /*deadline*/) {
  return sequence_->merge(indexOf(piece));
}

}  // namespace split_mapf
