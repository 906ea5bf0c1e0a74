#pragma once

namespace split_mapf {

/// What a replay sees of the clocks, at one moment.
struct ClockReading {
  double ros_sec = 0;   ///< ROS time; 0: simulated time that nobody has told yet
  double wall_sec = 0;  ///< a clock that only goes forward
  bool driven = true;   ///< false: simulated time, and nobody publishes the clock
};

/// The time that a replay follows. Not thread-safe.
///
/// It is ROS time as long as somebody tells that. Simulated time that nobody tells (a bag has
/// ended, or none has been started) would stand for ever: after a moment of patience wall time
/// takes over.
class ReplayClock {
 public:
  struct Time {
    double sec = 0;
    bool anew = false;  ///< the clock has begun, or jumped back: what came before counts no more
  };

  /// The time now. Call it often: what passes between two calls is not told apart.
  Time read(const ClockReading& now);

 private:
  /// [s] Whoever tells the time may be gone for as long as this, between two bags for instance.
  static constexpr double kPatienceSec = 2;
  /// [s] Corrections of a wall clock are no jump.
  static constexpr double kJitterSec = 0.5;

  double sec_ = 0;
  double ros_sec_ = 0;
  double wall_sec_ = 0;
  double undriven_sec_ = 0;
  bool has_wall_ = false;
  bool follows_ros_ = false;
};

}  // namespace split_mapf
