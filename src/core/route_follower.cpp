#include "split_mapf/core/route_follower.h"

#include <algorithm>
#include <cmath>

namespace split_mapf {
namespace {

constexpr double kTiny = 1e-9;
constexpr double kStraight = 1e-3;  // [rad]

double distance(PlanePoint a, PlanePoint b) { return std::hypot(b.x - a.x, b.y - a.y); }
double direction(PlanePoint a, PlanePoint b) { return std::atan2(b.y - a.y, b.x - a.x); }
double angleBetween(double a, double b) { return std::remainder(b - a, 2 * M_PI); }

}  // namespace

bool RouteFollower::take(const std::vector<RouteLeg>& route, bool fresh) {
  if (route.empty()) return false;
  if (fresh) {
    given_up_ = known_ = 0;
    sequence_ = route.front().sequence;
    done_ = speed_ = 0;
    ahead_.clear();
    has_route_ = true;
  }
  const auto here = std::find_if(route.begin(), route.end(),
                                 [this](const RouteLeg& leg) { return leg.sequence == sequence_; });
  if (here == route.end()) return false;
  std::vector<RouteLeg> ahead;
  if (done_ > 0) {
    // What has begun is ended, whatever a late route says.
    const bool same = here + 1 != route.end() && (here + 1)->sequence == ahead_.front().sequence;
    if (!same) return false;
  }
  for (auto leg = here + 1; leg != route.end(); ++leg) {
    const bool begun = done_ > 0 && leg == here + 1;
    known_ = std::max(known_, leg->sequence + 1);
    ahead.push_back(*leg);
    if (begun) ahead.back().released = true;
    if (!begun && leg->sequence < given_up_) ahead.back().released = false;
  }
  ahead_ = std::move(ahead);
  return true;
}

void RouteFollower::giveUp() {
  given_up_ = known_;
  for (std::size_t i = done_ > 0 ? 1 : 0; i < ahead_.size(); ++i) ahead_[i].released = false;
}

double RouteFollower::legLength() const { return distance(at_, ahead_.front().point); }

double RouteFollower::fraction() const {
  if (ahead_.empty() || done_ <= 0) return 0;
  return std::min(done_ / legLength(), 1 - kTiny);
}

PlanePoint RouteFollower::position() const {
  const double part = fraction();
  if (part <= 0) return at_;
  const PlanePoint to = ahead_.front().point;
  return {at_.x + part * (to.x - at_.x), at_.y + part * (to.y - at_.y)};
}

/// Uses up time for a turn in place. @return whether it faces the next visit.
bool RouteFollower::turnsToNext(double& seconds) {
  const double wanted = direction(at_, ahead_.front().point);
  const double left = angleBetween(heading_, wanted);
  if (motion_.turn_rate <= 0 || std::abs(left) < kStraight) {
    heading_ = wanted;
    return true;
  }
  const double step = std::min(std::abs(left), motion_.turn_rate * seconds);
  heading_ += left > 0 ? step : -step;
  seconds -= step / motion_.turn_rate;
  return seconds > kTiny;
}

/// [m] that it may go straight on before it has to have stopped.
double RouteFollower::roomAhead() const {
  double room = legLength() - done_;
  const double course = direction(at_, ahead_.front().point);
  for (std::size_t i = 1; i < ahead_.size() && ahead_[i].released; ++i) {
    const double next = direction(ahead_[i - 1].point, ahead_[i].point);
    if (std::abs(angleBetween(course, next)) > kStraight) break;
    room += distance(ahead_[i - 1].point, ahead_[i].point);
  }
  return room;
}

void RouteFollower::go(double seconds) {
  const double room = roomAhead();
  if (motion_.acceleration <= 0) {
    speed_ = motion_.speed;
  } else {
    speed_ = std::min({motion_.speed, speed_ + motion_.acceleration * seconds,
                       std::sqrt(2 * motion_.acceleration * room)});
  }
  double way = std::min(speed_ * seconds, room);
  // The last bit of braking would never end.
  if (room < 1e-4) way = room;
  while (way > 0 && !ahead_.empty()) {
    const double left = legLength() - done_;
    if (way < left - kTiny) {
      done_ += way;
      return;
    }
    way -= left;
    at_ = ahead_.front().point;
    sequence_ = ahead_.front().sequence;
    done_ = 0;
    ahead_.erase(ahead_.begin());
    if (way <= kTiny || !mayMove()) break;
  }
  if (!mayMove() ||
      std::abs(angleBetween(heading_, direction(at_, ahead_.front().point))) > kStraight) {
    speed_ = 0;
  }
}

void RouteFollower::advance(double seconds, bool holds) {
  if (holds) {
    speed_ = 0;
    return;
  }
  if (!mayMove()) {
    speed_ = 0;
    return;
  }
  if (done_ <= 0 && !turnsToNext(seconds)) return;
  go(seconds);
}

}  // namespace split_mapf
