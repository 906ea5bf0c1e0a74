// Of a robot that speaks VDA 5050: what is sent to it.

#include <algorithm>

#include "fleet/vda5050_ids.h"
#include "split_mapf/fleet/vda5050_vehicle.h"

namespace split_mapf {
namespace {

Vda5050Node nodeOf(const std::string& plan, const PlacedVisit& visit, bool released) {
  return {idOf(plan, visit.sequence),
          "cell " + std::to_string(visit.cell),
          visit.x_m,
          visit.y_m,
          visit.theta_rad,
          released};
}

Vda5050Order emptyOrder(const Vda5050Options& options) {
  Vda5050Order order;
  order.header.version = options.version;
  order.header.manufacturer = options.manufacturer;
  order.header.serial_number = options.serial_number;
  order.map_id = options.map_id;
  order.allowed_deviation_m = options.allowed_deviation_m;
  return order;
}

void append(Vda5050Order& order, const PlacedRoute& route, std::size_t from, std::size_t released) {
  for (std::size_t i = from; i < route.visits.size(); ++i) {
    order.nodes.push_back(nodeOf(route.plan_id, route.visits[i], i < released));
  }
}

bool sameWays(const std::vector<Vda5050Node>& one, const std::vector<Vda5050Node>& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const Vda5050Node& a, const Vda5050Node& b) {
                      return a.id == b.id && a.released == b.released;
                    });
}

}  // namespace

Vda5050Order firstOrder(const PlacedRoute& route, const Vda5050Options& options) {
  Vda5050Order order = emptyOrder(options);
  order.order_id = idOf(route.plan_id, 0);
  std::size_t released = 1;
  while (released < route.visits.size() && route.visits[released].released) ++released;
  append(order, route, 0, released);
  return order;
}

std::optional<Vda5050Vehicle::Message> Vda5050Vehicle::due(double now, double unix_sec) {
  if (isSilent(now) || route_.visits.empty()) return std::nullopt;
  if (isBusyElsewhere()) {
    if (!isOurs()) return std::nullopt;
    // One that it was sent meanwhile it has refused; it may be elsewhere when it has stopped.
    if (order_) forgetOrder();
    return sendCancel(now, unix_sec);
  }
  if (drops_) return isAcknowledged() ? sendCancel(now, unix_sec) : std::nullopt;
  cancelled_at_.reset();
  if (given_up_as_ != DriveStatus::kOk || !state_->automatic) return std::nullopt;
  if (order_ && !isAcknowledged()) {
    if (sent_at_ && now - *sent_at_ < options_.resend_sec) return std::nullopt;
    return sendOrder(now, unix_sec);
  }
  const bool is_new = order_ ? makeUpdate() : makeOrder();
  if (!is_new) return std::nullopt;
  first_sent_at_ = now;
  return sendOrder(now, unix_sec);
}

/// Where the visits behind `from` begin that are not released. A robot that gave up its visits goes
/// on only to those with new numbers, but ends the move that it has begun.
std::size_t Vda5050Vehicle::releasedEnd(std::size_t from) const {
  std::size_t end = from + 1;
  for (; end < route_.visits.size() && route_.visits[end].released; ++end) {
    const bool begun =
        at_plan_ == route_.plan_id && fraction_ > 0 && route_.visits[end - 1].sequence == at_;
    if (route_.visits[end].sequence < given_up_ && !begun) break;
  }
  return end;
}

bool Vda5050Vehicle::makeUpdate() {
  const std::optional<std::size_t> from = indexOf(base_end_.sequence);
  if (!from) {
    drops_ = true;
    return false;
  }
  const std::size_t end = releasedEnd(*from);
  Vda5050Order next = emptyOrder(options_);
  next.order_id = order_->order_id;
  next.update_id = order_->update_id + 1;
  next.first_sequence_id = base_end_id_;
  next.nodes.push_back(nodeOf(route_.plan_id, base_end_, true));
  append(next, route_, *from + 1, end);
  const auto held = std::find_if(order_->nodes.begin(), order_->nodes.end(),
                                 [&](const Vda5050Node& n) { return n.id == next.nodes[0].id; });
  if (sameWays({held, order_->nodes.end()}, next.nodes)) return false;
  base_end_id_ += 2 * static_cast<std::uint32_t>(end - 1 - *from);
  if (end - 1 > *from) base_end_ = route_.visits[end - 1];
  order_ = std::move(next);
  return true;
}

/// Nothing: the route has no visit there; it is an old one.
std::optional<std::size_t> Vda5050Vehicle::whereToBegin() const {
  return at_plan_ == route_.plan_id ? indexOf(at_) : 0;
}

/// It stands between two nodes, and would refuse an order that begins elsewhere. The node has a
/// name of its own, as the robot counts its way from there.
void Vda5050Vehicle::beginUnderWay(Vda5050Order& order, std::size_t from) const {
  const PlacedVisit& left = route_.visits[from];
  const PlacedVisit& next = route_.visits[from + 1];
  const bool is_known = state_->position && state_->position->map_id == options_.map_id;
  order.nodes[0].id = nodeIdOf({route_.plan_id, left.sequence, fraction_});
  order.nodes[0].x_m =
      is_known ? state_->position->x_m : left.x_m + fraction_ * (next.x_m - left.x_m);
  order.nodes[0].y_m =
      is_known ? state_->position->y_m : left.y_m + fraction_ * (next.y_m - left.y_m);
}

/// An order that lets the robot do nothing is not made.
bool Vda5050Vehicle::makeOrder() {
  const std::optional<std::size_t> from = whereToBegin();
  if (!from || !isIdle()) return false;
  const std::size_t end = releasedEnd(*from);
  if (end == *from + 1) return false;
  Vda5050Order order = emptyOrder(options_);
  order.order_id = idOf(route_.plan_id, next_number_++);
  append(order, route_, *from, end);
  order.nodes[0].released = true;
  if (fraction_ > 0 && at_plan_ == route_.plan_id) beginUnderWay(order, *from);
  base_begin_ = route_.visits[*from];
  base_end_ = route_.visits[end - 1];
  base_end_id_ = 2 * static_cast<std::uint32_t>(end - 1 - *from);
  order_ = std::move(order);
  return true;
}

Vda5050Vehicle::Message Vda5050Vehicle::sendOrder(double now, double unix_sec) {
  sent_at_ = now;
  order_->header.header_id = order_headers_++;
  order_->header.unix_sec = unix_sec;
  return {"order", toJson(*order_)};
}

std::optional<Vda5050Vehicle::Message> Vda5050Vehicle::sendCancel(double now, double unix_sec) {
  if (cancelled_at_ && now - *cancelled_at_ < options_.resend_sec) return std::nullopt;
  cancelled_at_ = now;
  Vda5050Header header = emptyOrder(options_).header;
  header.header_id = action_headers_++;
  header.unix_sec = unix_sec;
  const std::string id = "cancel/" + state_->order_id + "/" + vda5050Time(unix_sec);
  return Message{"instantActions", cancelOrderJson(header, id)};
}

}  // namespace split_mapf
