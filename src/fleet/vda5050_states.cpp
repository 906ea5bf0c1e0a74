// Of a robot that speaks VDA 5050: what it says.

#include <algorithm>
#include <cmath>

#include "fleet/vda5050_ids.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/fleet/vda5050_vehicle.h"

namespace split_mapf {
namespace {

// For so long a robot's need is told at least, so that a message that is lost does no harm.
constexpr double kTellSec = 2;
// Nobody is told of an order that is slow to be acknowledged before.
constexpr double kPatienceSec = 10;
// What is done of a move that is not known to have ended.
constexpr double kMostOfAMove = 0.999;

}  // namespace

void Vda5050Vehicle::take(PlacedRoute route) {
  if (route.plan_id != route_.plan_id) {
    forgetOrder();
    next_number_ = given_up_ = known_ = 0;
    given_up_as_ = DriveStatus::kOk;
  }
  route_ = std::move(route);
  for (const PlacedVisit& visit : route_.visits) known_ = std::max(known_, visit.sequence + 1);
  if (!state_) return;
  locate();
  adopt();
}

void Vda5050Vehicle::take(Vda5050State state, double now) {
  state_ = std::move(state);
  heard_ = now;
  if (order_ && isAcknowledged() && !isAsSent()) forgetOrder();
  locate();
  adopt();
  judge(now);
}

/// Whether a state that shows the order shows the base that was sent. Another process may have sent
/// an update under the same number before.
bool Vda5050Vehicle::isAsSent() const {
  const std::string end = idOf(route_.plan_id, base_end_.sequence);
  if (state_->update_id > order_->update_id) return false;
  return isIdle() || state_->last_node_id == end ||
         std::any_of(state_->nodes.begin(), state_->nodes.end(),
                     [&](const Vda5050NodeState& node) { return node.released && node.id == end; });
}

std::optional<std::size_t> Vda5050Vehicle::indexOf(std::uint32_t sequence) const {
  const auto found =
      std::find_if(route_.visits.begin(), route_.visits.end(),
                   [sequence](const PlacedVisit& visit) { return visit.sequence == sequence; });
  if (found == route_.visits.end()) return std::nullopt;
  return static_cast<std::size_t>(found - route_.visits.begin());
}

bool Vda5050Vehicle::isAcknowledged() const {
  return order_ && state_->order_id == order_->order_id && state_->update_id >= order_->update_id;
}

/// Whether it carries out another order than the one that it was sent last.
bool Vda5050Vehicle::isBusyElsewhere() const {
  return !isIdle() && !(order_ && state_->order_id == order_->order_id);
}

/// Whether its order was made here, or by a process that was here before.
bool Vda5050Vehicle::isOurs() const {
  const auto order = partsOf(state_->order_id);
  const auto node = placeOf(state_->nodes.empty() ? state_->last_node_id : state_->nodes[0].id);
  return order && node && order->first == node->plan;
}

bool Vda5050Vehicle::hasError(Vda5050ErrorLevel level) const {
  return std::any_of(state_->errors.begin(), state_->errors.end(),
                     [level](const Vda5050Error& error) { return error.level == level; });
}

bool Vda5050Vehicle::isInNeed() const {
  return hasError(Vda5050ErrorLevel::kFatal) || hasError(Vda5050ErrorLevel::kCritical);
}

/// [m] of the move that it has done, of which `before_m` before its last node. A little is the
/// tolerance of a node.
double Vda5050Vehicle::wayDone(const PlacedVisit& from, const PlacedVisit& to,
                               double before_m) const {
  double way = before_m + state_->since_last_node_m.value_or(0);
  if (state_->position && state_->position->map_id == options_.map_id) {
    const double length = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
    way = ((state_->position->x_m - from.x_m) * (to.x_m - from.x_m) +
           (state_->position->y_m - from.y_m) * (to.y_m - from.y_m)) /
          length;
  }
  return way <= options_.allowed_deviation_m ? 0 : way;
}

/// Its visit, and what it has done of the move out of it: never less than before.
void Vda5050Vehicle::locate() {
  auto node = placeOf(state_->last_node_id);
  const bool on_order = order_ && state_->order_id == order_->order_id;
  if (on_order && (!node || node->plan != route_.plan_id)) {
    // It took the order up, and names the node where it began only when it has left it.
    node = NodePlace{route_.plan_id, base_begin_.sequence, 0};
  }
  const std::string plan = node ? node->plan : "";
  const std::uint32_t at = node ? node->sequence : 0;
  if (plan != at_plan_ || at != at_) fraction_ = 0;
  at_plan_ = plan;
  at_ = at;
  if (!node || plan != route_.plan_id) return;
  const std::optional<std::size_t> index = indexOf(at);
  if (!index || *index + 1 >= route_.visits.size()) return;
  const PlacedVisit& from = route_.visits[*index];
  const PlacedVisit& to = route_.visits[*index + 1];
  const double length = std::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
  if (!to.released || !(length > 0)) return;
  const double way = wayDone(from, to, node->fraction * length);
  fraction_ = std::max(fraction_, std::min(way / length, kMostOfAMove));
}

/// Takes over an order under way that another process sent, if all of its base is on the route.
void Vda5050Vehicle::adopt() {
  const auto id = partsOf(state_->order_id);
  if (order_ || !id || id->first != route_.plan_id) return;
  next_number_ = std::max(next_number_, id->second + 1);
  const std::optional<std::size_t> here = indexOf(at_);
  if (isIdle() || at_plan_ != route_.plan_id || !here) return;
  std::size_t end = *here;
  std::uint32_t end_id = state_->last_sequence_id;
  for (const Vda5050NodeState& node : state_->nodes) {
    if (!node.released) break;
    const auto parts = partsOf(node.id);
    const bool fits = parts && end + 1 < route_.visits.size() &&
                      idOf(route_.plan_id, route_.visits[end + 1].sequence) == node.id;
    if (!fits) return;
    ++end;
    end_id = node.sequence_id;
  }
  order_.emplace();
  order_->order_id = state_->order_id;
  order_->update_id = state_->update_id;
  base_begin_ = route_.visits[*here];
  base_end_ = route_.visits[end];
  base_end_id_ = end_id;
}

void Vda5050Vehicle::forgetOrder() {
  order_.reset();
  sent_at_.reset();
  cancelled_at_.reset();
  idle_since_.reset();
  drops_ = false;
}

void Vda5050Vehicle::giveUp(double now) {
  given_up_as_ = hasError(Vda5050ErrorLevel::kFatal) ? DriveStatus::kFault : DriveStatus::kBlocked;
  given_up_at_ = now;
  given_up_ = known_;
}

void Vda5050Vehicle::judge(double now) {
  const bool need = isInNeed();
  if (given_up_as_ != DriveStatus::kOk) {
    if (hasError(Vda5050ErrorLevel::kFatal)) given_up_as_ = DriveStatus::kFault;
    if (!need && now - given_up_at_ >= kTellSec) given_up_as_ = DriveStatus::kOk;
    return;
  }
  if (need && order_) drops_ = true;
  // It is well again, and was not told yet.
  if (!need && drops_ && !cancelled_at_ && !isAcknowledged()) drops_ = false;
  if (drops_ && isAcknowledged() && isIdle()) forgetOrder();
  if (need && !order_ && isIdle()) giveUp(now);
  watchForLostOrder(now);
}

/// A robot that was switched off, or driven by hand, may have forgotten what it was to do.
void Vda5050Vehicle::watchForLostOrder(double now) {
  const bool lost = order_ && isAcknowledged() && isIdle() &&
                    !(at_plan_ == route_.plan_id && at_ == base_end_.sequence);
  if (!lost) return idle_since_.reset();
  if (!idle_since_) idle_since_ = now;
  if (now - *idle_since_ >= options_.resend_sec) forgetOrder();
}

DriveStatus Vda5050Vehicle::driveStatus() const {
  if (given_up_as_ != DriveStatus::kOk) return given_up_as_;
  if (hasError(Vda5050ErrorLevel::kFatal) || !state_->automatic) return DriveStatus::kLost;
  if (hasError(Vda5050ErrorLevel::kCritical) || drops_ || state_->paused) {
    return DriveStatus::kPaused;
  }
  return DriveStatus::kOk;
}

std::optional<VehicleProgress> Vda5050Vehicle::progress(double now) const {
  if (isSilent(now)) return std::nullopt;
  VehicleProgress progress;
  progress.plan_id = at_plan_;
  progress.sequence = at_;
  progress.fraction = fraction_;
  if (at_plan_ != route_.plan_id && !route_.visits.empty() && isIdle()) {
    // It stands where its route begins; its need has to be told though it has no order yet.
    progress.plan_id = route_.plan_id;
    progress.sequence = route_.visits.front().sequence;
    progress.fraction = 0;
  }
  progress.status = driveStatus();
  if (state_->position && state_->position->map_id == options_.map_id) {
    progress.position = state_->position;
  }
  return progress;
}

std::string Vda5050Vehicle::trouble(double now) const {
  if (!state_) return "has sent no state";
  if (!online_) return "is not connected to the broker";
  if (isSilent(now)) return "has sent no state for " + numeral(now - heard_) + " s";
  if (!state_->errors.empty()) {
    const Vda5050Error& error = state_->errors.front();
    return "says " + shown(error.type) +
           (error.description.empty() ? "" : ": " + shown(error.description));
  }
  if (!state_->automatic) return "is driven by hand";
  if (isBusyElsewhere() && !isOurs()) {
    return "carries out the order " + quote(state_->order_id) + " of somebody else";
  }
  if (state_->position && state_->position->map_id != options_.map_id) {
    return "is on the map " + quote(state_->position->map_id) + ", not on " +
           quote(options_.map_id);
  }
  if (order_ && !isAcknowledged() && now - first_sent_at_ > kPatienceSec) {
    return "does not take the order " + quote(order_->order_id) + ", update " +
           std::to_string(order_->update_id);
  }
  return "";
}

}  // namespace split_mapf
