#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/random.h"

namespace split_mapf {

/// Whom a delay befalls.
enum class DelayProcess {
  kBernoulli,  ///< each available robot by itself, with the probability
  kPoisson,  ///< so many of the team's available robots as a Poisson distribution of that mean says
};
/// How long a delay lasts.
enum class DelayDistribution {
  kUniform,   ///< any whole number of steps between the bounds alike
  kGaussian,  ///< mean in the middle, the bounds three standard deviations away, cut there
};
/// @throws OptionError for another name, naming those that there are.
DelayProcess parseDelayProcess(const std::string& name);
DelayDistribution parseDelayDistribution(const std::string& name);
std::string toString(DelayProcess process);
std::string toString(DelayDistribution distribution);

/// A model of robots that are late. Names and meanings are those of the League of Robot Runners
/// 3.1 (`pDelay`, `minDelay`, `maxDelay`), with a step in place of a tick.
struct DelayModel {
  double probability = 0;       ///< of an available robot, a step, 0 to 1
  std::uint32_t min_delay = 1;  ///< [steps] >= 1
  std::uint32_t max_delay = 1;  ///< [steps] >= min_delay
  DelayProcess process = DelayProcess::kBernoulli;
  DelayDistribution distribution = DelayDistribution::kUniform;
  std::uint64_t seed = 0;
};
/// @throws OptionError naming what is out of range.
void requireValid(const DelayModel& model);

/// The delays of a team, step by step. They depend on the model and the number of robots only, not
/// on what the robots do, so that ways to execute a plan meet the same ones. The same on every
/// platform. Not thread-safe. Cost: O(robots) a step.
class Delays {
 public:
  /// @throws OptionError as requireValid().
  Delays(const DelayModel& model, std::uint32_t robots);
  /// Goes on to the next step; the first call leads to step 0.
  void nextStep();
  bool isDelayed(std::uint32_t robot) const { return left_[robot] > 0; }

 private:
  std::uint32_t drawLength();
  std::uint32_t drawCount(double mean);
  double drawUnit();

  DelayModel model_;
  RandomEngine engine_;
  std::vector<std::uint32_t> left_;  // by robot: steps of its delay to come, this one included
  std::vector<std::uint32_t> available_;
};

}  // namespace split_mapf
