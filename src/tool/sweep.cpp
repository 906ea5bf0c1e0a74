#include "tool/sweep.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include "split_mapf/core/error.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/wording.h"

namespace split_mapf::tool {
namespace {

/// The words of a list with commas. @throws OptionError for an empty word.
std::vector<std::string> wordsOf(const std::string& option, const std::string& text) {
  std::vector<std::string> words;
  std::stringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  if (words.empty() || text.back() == ',') words.emplace_back();
  for (const std::string& word : words) {
    if (word.empty()) {
      throw OptionError("option --" + option + ": an empty name in the list " + quote(text));
    }
  }
  return words;
}

/// A whole number of at least 1 and at most nine digits; 0 for everything else.
std::uint32_t countOf(const std::string& word) {
  const bool digits = word.find_first_not_of("0123456789") == std::string::npos;
  return digits && !word.empty() && word.size() < 10 ? static_cast<std::uint32_t>(std::stoul(word))
                                                     : 0;
}

std::vector<std::uint32_t> countsOf(const std::string& option, const std::string& text) {
  std::vector<std::uint32_t> counts;
  for (const std::string& word : wordsOf(option, text)) {
    counts.push_back(countOf(word));
    if (counts.back() == 0) {
      throw OptionError("option --" + option + ": " + quote(word) +
                        " is no whole number of at least 1");
    }
  }
  return counts;
}

/// Split specifications hold commas inside their brackets.
std::vector<std::string> splitsOf(const std::string& text) {
  std::vector<std::string> splits;
  bool inside = false;
  for (const std::string& word : wordsOf("splits", text)) {
    if (inside) {
      splits.back() += "," + word;
    } else {
      splits.push_back(word);
    }
    if (word.find('(') != std::string::npos) inside = true;
    if (word.find(')') != std::string::npos) inside = false;
  }
  return splits;
}

void readFileNames(const CommandLine& line, Sweep& sweep) {
  sweep.maps = line.texts("map");
  sweep.scenarios = line.texts("scen");
  if (sweep.maps.empty() || sweep.scenarios.empty()) {
    throw OptionError("at least one --map and one --scen are needed");
  }
  if (sweep.maps.size() == 1) sweep.maps.resize(sweep.scenarios.size(), sweep.maps.front());
  if (sweep.maps.size() != sweep.scenarios.size()) {
    throw OptionError(counted(sweep.maps.size(), "map") + " for " +
                      counted(sweep.scenarios.size(), "scenario") +
                      ": one map, or one for each scenario, is expected");
  }
}

void readShard(const CommandLine& line, Sweep& sweep) {
  if (!line.has("shard")) return;
  const std::string text = line.text("shard");
  const std::size_t slash = std::min(text.find('/'), text.size());
  sweep.shard = countOf(text.substr(0, slash));
  sweep.shards = slash < text.size() ? countOf(text.substr(slash + 1)) : 0;
  if (sweep.shard >= 1 && sweep.shard <= sweep.shards) return;
  throw OptionError("option --shard: " + quote(text) +
                    " was given, I/N is expected: the shard I, from 1 to N, of N, such as 1/8");
}

}  // namespace

void declareSweep(CommandLine& line) {
  const PlanRequest defaults;
  line.offerRepeatable("map", "FILE", "MovingAI .map, or map_server .yaml; one, or one a scenario");
  line.offerRepeatable("scen", "FILE", "MovingAI .scen; repeatable");
  line.require("agents", "N,...", "numbers of robots");
  line.offer("solvers", "NAME,...", "solvers (auto)");
  line.offer("splits", "SPEC,...", "split specifications (none)");
  line.offer("objective", "NAME",
             "makespan or sum_of_costs (" + toString(defaults.objective) + ")");
  line.offer("suboptimality", "W", "bound w >= 1 of ECBS (1.5)");
  line.offer("time-limit", "SECONDS", "wall time for each plan (60)");
  line.offer("refine", "SECONDS", "share of it that goes into improving a found plan (0)");
  line.offer("threads", "N", "worker threads (1)");
  line.offer("seed", "N", "all randomness (0)");
  line.offer("shard", "I/N",
             "plan only the I-th of N equal shares, the same of each call (1/1: all)");
}

Sweep readSweep(const CommandLine& line) {
  Sweep sweep;
  readFileNames(line, sweep);
  sweep.agents = countsOf("agents", line.text("agents"));
  sweep.solvers = wordsOf("solvers", line.text("solvers", "auto"));
  sweep.splits = splitsOf(line.text("splits", "none"));
  readShard(line, sweep);
  PlanRequest& request = sweep.request;
  if (line.has("objective")) request.objective = parseObjective(line.text("objective"));
  request.suboptimality = line.number("suboptimality", request.suboptimality, 1);
  request.time_limit_sec = line.number("time-limit", request.time_limit_sec, 0);
  request.refine_sec = line.number("refine", request.refine_sec, 0);
  request.threads = static_cast<std::uint32_t>(line.wholeNumber("threads", 1, 1, 1024));
  request.seed = line.wholeNumber("seed", request.seed, 0, ~std::uint64_t{0});
  return sweep;
}

std::vector<SweepCell> cellsOf(const Sweep& sweep) {
  std::vector<SweepCell> cells;
  for (std::size_t i = 0; i < sweep.scenarios.size(); ++i) {
    for (const std::uint32_t agents : sweep.agents) {
      for (const std::string& solver : sweep.solvers) {
        for (const std::string& split : sweep.splits) cells.push_back({i, agents, solver, split});
      }
    }
  }
  return cells;
}

std::vector<std::size_t> shardOf(const Sweep& sweep, std::size_t cells) {
  std::vector<std::size_t> order(cells);
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Dealt out in turn, a shard of two would get all cells of one of two solvers.
  RandomEngine engine(0);
  if (sweep.shards > 1) shuffle(order, engine);
  std::vector<std::size_t> shard;
  for (std::size_t i = sweep.shard - 1; i < order.size(); i += sweep.shards) {
    shard.push_back(order[i]);
  }
  std::sort(shard.begin(), shard.end());
  return shard;
}

}  // namespace split_mapf::tool
