#pragma once

#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// How much worse a refinement's plan may become for the moment, so that it gets out of where no
/// neighbourhood gains any more. A first share of the time is for gains alone, as a first plan has
/// plenty, and whoever looks soon shall see them; then the temperature falls from its height to
/// nothing as the time runs out. Without a limit of time it is always 0. Source: Kirkpatrick et
/// al., Science 1983; within large-neighbourhood search: Schrimpf et al., J. Comput. Phys. 2000.
/// Immutable, hence thread-safe.
class Annealing {
 public:
  /// Begins now. @param deadline  when the temperature reaches 0; outlives this object.
  explicit Annealing(const Deadline& deadline);
  /// The mean number of steps by which the sum of costs may rise, now.
  double temperature() const;
  /// The same at a share of the time, from 0 (the beginning) to 1.
  static double temperatureAt(double share);

 private:
  const Deadline& deadline_;
  double seconds_;
};

}  // namespace split_mapf
