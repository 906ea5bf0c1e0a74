#pragma once

#include <string>

namespace split_mapf {

/// Where a replay stands: a position in time steps that follows a clock. The clock may stand still
/// or jump; a jump back moves nothing. Not thread-safe.
class ReplayTimeline {
 public:
  /// Starts again at step 0 with a plan of `steps` time steps of `step_duration_sec` each.
  /// @pre step_duration_sec > 0.
  void load(double steps, double step_duration_sec);
  /// Moves on to `now_sec`, a reading of the clock.
  void advance(double now_sec);
  /// Lets the time up to the next reading pass without moving.
  void hold() { has_clock_ = false; }
  /// Goes back to step 0 for a clock that starts anew, unless paused there where it stands.
  void startAnew();

  void play();
  void pause() { playing_ = false; }
  /// Moves by a number of steps (negative: back) and pauses.
  void step(double steps);
  /// Goes to a step.
  void seek(double step);
  /// Plays at `speed` times the plan's own pace; 0: at that pace, or as much faster as lets the
  /// whole plan last a minute. @pre speed >= 0.
  void setSpeed(double speed) { speed_ = speed; }
  /// Whether to start again at the end.
  void setLoop(bool loop) { loop_ = loop; }

  /// [steps], 0 .. steps()
  double position() const { return position_; }
  double steps() const { return steps_; }
  bool playing() const { return playing_; }
  /// Times the plan's own pace, > 0.
  double speed() const;
  bool loop() const { return loop_; }

 private:
  /// Seconds of the clock that the end is shown before a loop starts again.
  static constexpr double kRestSec = 2;
  /// Seconds of the clock that a plan lasts at most where nobody chose a speed.
  static constexpr double kWholePlanSec = 60;

  double steps_ = 0;
  double step_duration_sec_ = 1;
  double speed_ = 0;
  bool loop_ = false;
  bool playing_ = true;
  double position_ = 0;
  double rest_sec_ = 0;
  bool has_clock_ = false;
  double clock_sec_ = 0;
};

}  // namespace split_mapf
