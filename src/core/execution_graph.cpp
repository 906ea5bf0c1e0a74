#include "split_mapf/core/execution_graph.h"

#include <algorithm>
#include <utility>

#include "core/close_waits.h"

namespace split_mapf {
namespace {

// Fractions are counted in parts of a move by whoever reports them.
constexpr double kRounding = 1e-6;

}  // namespace

ExecutionGraph::ExecutionGraph(Precedence precedence, double release)
    : ExecutionGraph(std::move(precedence), release, nullptr) {}

ExecutionGraph::ExecutionGraph(Precedence precedence, double release,
                               std::shared_ptr<const CloseMoves> moves)
    : precedence_(moves ? inOneOrder(precedence) : std::move(precedence)),
      release_(moves ? 1 : release),
      moves_(std::move(moves)),
      places_(precedence_.robots()),
      rings_(findRings(precedence_)) {
  for (std::uint32_t robot = 0; robot < places_.size(); ++robot) {
    places_[robot].at = precedence_.first(robot);
  }
  for (std::uint32_t i = 0; i < rings_.size(); ++i) {
    for (const VisitId event : rings_[i]) ring_of_.emplace(event, i);
  }
  if (moves_) waits_ = findCloseWaits(precedence_, *moves_);
}

bool ExecutionGraph::hasDone(VisitId event, double fraction) const {
  const Place& place = places_[precedence_[event].robot];
  if (place.at >= event) return true;
  const bool moves = place.at + 1 == event && place.progress > 0;
  return moves && place.progress >= fraction - kRounding;
}

bool ExecutionGraph::waitsAreOver(VisitId event) const {
  bool over = true;
  forEachAwaited(
      event, [&](VisitId awaited, double fraction) { over = over && hasDone(awaited, fraction); });
  return over;
}

const Ring* ExecutionGraph::ringOf(VisitId event) const {
  if (rings_.empty()) return nullptr;
  const auto ring = ring_of_.find(event);
  return ring == ring_of_.end() ? nullptr : &rings_[ring->second];
}

bool ExecutionGraph::hasLeft(VisitId event) const { return hasDone(event, release_); }

bool ExecutionGraph::isReleased(VisitId event) const {
  if (const Ring* const ring = ringOf(event)) {
    return std::all_of(ring->begin(), ring->end(), [this](VisitId member) {
      return places_[precedence_[member].robot].at + 1 >= member &&
             (!moves_ || waitsAreOver(member));
    });
  }
  return waitsAreOver(event);
}

ReportOutcome ExecutionGraph::report(std::uint32_t robot, VisitId visit, double fraction,
                                     std::vector<VisitId>* freed) {
  if (visit < precedence_.first(robot) || visit > precedence_.last(robot)) {
    return ReportOutcome::kNoSuchVisit;
  }
  Place& place = places_[robot];
  const Place before = place;
  const bool arrives = fraction >= 1;
  const auto progress = static_cast<float>(fraction);
  if (visit == place.at && arrives) return ReportOutcome::kTaken;
  if (visit <= place.at || (visit == place.at + 1 && !arrives && progress < place.progress)) {
    return ReportOutcome::kBackwards;
  }
  for (VisitId event = before.at + 1; event <= visit; ++event) {
    if (!isReleased(event)) {
      place = before;
      return ReportOutcome::kNotReleased;
    }
    const bool ends = event < visit || arrives;
    place.at = ends ? event : event - 1;
    place.progress = ends ? 0 : progress;
  }
  if (freed == nullptr) return ReportOutcome::kTaken;
  for (VisitId event = before.at + 1; event <= visit; ++event) {
    const VisitId follower = precedence_.awaitedBy(event);
    const bool left_before =
        event == before.at + 1 && before.progress > 0 && before.progress >= release_ - kRounding;
    if (follower == kNoVisit || left_before || !hasLeft(event)) continue;
    if (ringOf(follower) == nullptr) freed->push_back(follower);
  }
  return ReportOutcome::kTaken;
}

}  // namespace split_mapf
