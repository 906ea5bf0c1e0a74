#include "improve/annealing.h"

#include <algorithm>
#include <cmath>

namespace split_mapf {
namespace {

// Measured on the cells of docs/algorithms.md: half of it gains less in rooms, the double costs
// more than it gains where robots have much space.
constexpr double kHighest = 12.0;
constexpr double kGainsAlone = 0.1;

}  // namespace

Annealing::Annealing(const Deadline& deadline)
    : deadline_(deadline), seconds_(deadline.remainingSec()) {}

double Annealing::temperatureAt(double share) {
  if (share < kGainsAlone) return 0;
  const double left = std::max(0.0, 1 - share) / (1 - kGainsAlone);
  return kHighest * left * left;
}

double Annealing::temperature() const {
  if (!std::isfinite(seconds_) || seconds_ <= 0) return 0;
  return temperatureAt(1 - deadline_.remainingSec() / seconds_);
}

}  // namespace split_mapf
