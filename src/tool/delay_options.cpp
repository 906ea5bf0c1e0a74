#include "tool/delay_options.h"

#include <cstdint>
#include <limits>

namespace split_mapf::tool {

void declareDelays(CommandLine& line) {
  const DelayModel defaults;
  line.offer("delay-probability", "P", "of a robot that is not delayed, a step, 0 to 1 (0)");
  line.offer("min-delay", "STEPS", "least length of a delay (1)");
  line.offer("max-delay", "STEPS", "greatest length of a delay (the least)");
  line.offer("delay-process", "NAME",
             "bernoulli (each robot by itself) or poisson (a number of the team) (" +
                 toString(defaults.process) + ")");
  line.offer("delay-distribution", "NAME",
             "uniform or gaussian lengths (" + toString(defaults.distribution) + ")");
}

DelayModel readDelays(const CommandLine& line, std::uint64_t seed) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max() / 2;
  DelayModel delays;
  delays.probability = line.number("delay-probability", 0, 0);
  delays.min_delay = static_cast<std::uint32_t>(line.wholeNumber("min-delay", 1, 1, kMost));
  delays.max_delay =
      static_cast<std::uint32_t>(line.wholeNumber("max-delay", delays.min_delay, 1, kMost));
  if (line.has("delay-process")) delays.process = parseDelayProcess(line.text("delay-process"));
  if (line.has("delay-distribution")) {
    delays.distribution = parseDelayDistribution(line.text("delay-distribution"));
  }
  delays.seed = seed;
  requireValid(delays);
  return delays;
}

}  // namespace split_mapf::tool
