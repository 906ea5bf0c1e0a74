#include "split_mapf/core/delays.h"

#include <algorithm>
#include <cmath>

#include "split_mapf/core/error.h"

namespace split_mapf {

DelayProcess parseDelayProcess(const std::string& name) {
  if (name == "bernoulli") return DelayProcess::kBernoulli;
  if (name == "poisson") return DelayProcess::kPoisson;
  throw OptionError("delay process '" + name + "' is unknown; bernoulli or poisson is expected");
}

DelayDistribution parseDelayDistribution(const std::string& name) {
  if (name == "uniform") return DelayDistribution::kUniform;
  if (name == "gaussian") return DelayDistribution::kGaussian;
  throw OptionError("delay distribution '" + name +
                    "' is unknown; uniform or gaussian is expected");
}

std::string toString(DelayProcess process) {
  return process == DelayProcess::kBernoulli ? "bernoulli" : "poisson";
}

std::string toString(DelayDistribution distribution) {
  return distribution == DelayDistribution::kUniform ? "uniform" : "gaussian";
}

void requireValid(const DelayModel& model) {
  if (!(model.probability >= 0 && model.probability <= 1)) {
    throw OptionError("delay probability " + std::to_string(model.probability) +
                      " is out of range: 0 to 1 is expected");
  }
  if (model.min_delay == 0) {
    throw OptionError("a least delay of 0 steps is none: 1 step or more is expected");
  }
  if (model.max_delay < model.min_delay) {
    throw OptionError("the greatest delay, " + std::to_string(model.max_delay) +
                      " steps, is below the least, " + std::to_string(model.min_delay));
  }
}

Delays::Delays(const DelayModel& model, std::uint32_t robots)
    : model_(model), engine_(model.seed), left_(robots, 0) {
  requireValid(model);
}

/// In [0, 1).
double Delays::drawUnit() {
  constexpr int kBits = 53;
  return std::ldexp(static_cast<double>(engine_() >> (64 - kBits)), -kBits);
}

std::uint32_t Delays::drawLength() {
  const std::uint32_t span = model_.max_delay - model_.min_delay;
  if (model_.distribution == DelayDistribution::kUniform) {
    return model_.min_delay + static_cast<std::uint32_t>(drawBelow(engine_, span + 1ULL));
  }
  // A sum of twelve is as good as normal within three deviations, and the same everywhere.
  double deviations = -6;
  for (int i = 0; i < 12; ++i) deviations += drawUnit();
  const double length = model_.min_delay + span / 2.0 + deviations * span / 6.0;
  const auto rounded = static_cast<std::int64_t>(std::floor(length + 0.5));
  return static_cast<std::uint32_t>(
      std::clamp<std::int64_t>(rounded, model_.min_delay, model_.max_delay));
}

/// Of a Poisson distribution, by Knuth's product; in parts, as its start must not vanish.
std::uint32_t Delays::drawCount(double mean) {
  constexpr double kPart = 30;
  std::uint32_t count = 0;
  while (mean > 0) {
    const double limit = std::exp(-std::min(mean, kPart));
    double product = drawUnit();
    while (product > limit) {
      ++count;
      product *= drawUnit();
    }
    mean -= kPart;
  }
  return count;
}

void Delays::nextStep() {
  available_.clear();
  for (std::uint32_t robot = 0; robot < left_.size(); ++robot) {
    if (left_[robot] > 0) --left_[robot];
    if (left_[robot] == 0) available_.push_back(robot);
  }
  if (model_.probability <= 0) return;
  if (model_.process == DelayProcess::kBernoulli) {
    for (const std::uint32_t robot : available_) {
      if (drawUnit() < model_.probability) left_[robot] = drawLength();
    }
    return;
  }
  const auto count = std::min<std::size_t>(
      drawCount(model_.probability * static_cast<double>(available_.size())), available_.size());
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(available_[i], available_[i + drawBelow(engine_, available_.size() - i)]);
    left_[available_[i]] = drawLength();
  }
}

}  // namespace split_mapf
