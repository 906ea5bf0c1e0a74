#include "differential/drawn_case.h"

#include <array>
#include <cstddef>
#include <map>

#include "split_mapf/core/random.h"
#include "split_mapf/split/split_options.h"
#include "support/small_instances.h"

namespace split_mapf::fuzz {
namespace {

using Words = std::vector<std::string>;

const std::string& drawWord(RandomEngine& engine, const Words& words) {
  return words[drawBelow(engine, words.size())];
}

/// Values of options whose default does not tell what others there are.
const std::map<std::string, Words>& namedValues() {
  static const std::map<std::string, Words> values = {
      {"order", {"shortest_first", "longest_first", "random", "given"}},
      {"engine", {"column_generation", "arc_flow"}},
      {"memory_mb", {"16", "256"}},
      {"assignment", {"greedy", "matching"}},
      {"check", {"auto", "always", "never"}},
      {"variant", {"ahead", "makespan", "sum_of_costs", "bisection"}},
      {"buffer", {"2x1", "2x2", "4x2", "6x3"}},
      {"partition", {"auto", "rectangles", "dynamic"}},
      {"replan", {"0", "1", "5"}},
  };
  return values;
}

/// A value for the option; empty: it keeps its default.
std::string drawValue(RandomEngine& engine, const OptionInfo& option) {
  if (drawBelow(engine, 3) != 0) return "";
  const auto named = namedValues().find(option.name);
  if (named != namedValues().end()) return drawWord(engine, named->second);
  const std::string& usual = option.default_value;
  if (usual == "true" || usual == "false") return drawWord(engine, {"true", "false"});
  if (usual.find_first_not_of("0123456789") != std::string::npos) return "";
  return drawWord(engine, {"0", "1", "2", "3", "7", "100"});
}

std::vector<std::string> drawOptions(RandomEngine& engine, const std::vector<OptionInfo>& offered) {
  std::vector<std::string> options;
  for (const OptionInfo& option : offered) {
    const std::string value = drawValue(engine, option);
    if (!value.empty()) options.push_back(option.name + "=" + value);
  }
  return options;
}

void drawSplit(RandomEngine& engine, PlanRequest& request) {
  static const Words time_splits = {"2t", "3t", "4t", "t(0.3,0.7)", "t(0.2,0.5,0.3)", "t(0.9,0.1)"};
  static const Words space_splits = {"1x2s", "2x1s", "2x2s", "2s", "3s", "2x1s2t", "1x3s3t"};
  const std::uint64_t kind = drawBelow(engine, 4);
  if (kind == 0) request.split = "none";
  if (kind == 1) return;  // auto
  const bool by_time = kind == 2;
  if (kind >= 2) {
    request.split = drawWord(engine, by_time ? time_splits : space_splits);
    request.split_options = drawOptions(engine, by_time ? timeSplitOptions() : spaceSplitOptions());
    const auto more = drawOptions(engine, splitOptions());
    request.split_options.insert(request.split_options.end(), more.begin(), more.end());
  }
}

Instance drawMedium(RandomEngine& engine, std::uint64_t seed) {
  GeneratorOptions options;
  const std::uint64_t kind = drawBelow(engine, 4);
  if (kind == 0) options.kind = MapKind::kRooms;
  if (kind == 1) options.kind = MapKind::kWarehouse;
  const std::uint32_t least = options.kind == MapKind::kWarehouse ? 24 : 6;
  options.width = least + static_cast<std::uint32_t>(drawBelow(engine, 10));
  options.height = 8 + static_cast<std::uint32_t>(drawBelow(engine, 8));
  if (kind >= 2) options.density = static_cast<double>(drawBelow(engine, 4)) / 10;
  options.robots = 2 + static_cast<std::uint32_t>(drawBelow(engine, 20));
  options.seed = seed;
  return test::generatedInstance(options);
}

}  // namespace

DrawnInstance drawInstance(std::uint64_t seed) {
  RandomEngine engine(seed);
  switch (drawBelow(engine, 4)) {
    case 0:
      return {test::crowdedInstance(seed), true};
    case 1:
      return {drawMedium(engine, seed), false};
    default:
      return {test::smallInstance(seed), true};
  }
}

PlanRequest drawRequest(const SolverRegistry& solvers, std::uint64_t seed) {
  RandomEngine engine(seed);
  PlanRequest request;
  Words names = solvers.names();
  names.emplace_back("auto");
  request.solver = drawWord(engine, names);
  if (request.solver != "auto") {
    request.solver_options = drawOptions(engine, solvers.info(request.solver).options);
  }
  drawSplit(engine, request);
  request.objective = kObjectives[drawBelow(engine, kObjectives.size())];
  constexpr std::array<double, 5> kBounds = {1, 1.05, 1.2, 1.5, 3};
  request.suboptimality = kBounds[drawBelow(engine, kBounds.size())];
  if (drawBelow(engine, 8) == 0) request.refine_sec = 0.01;
  request.straighten = drawBelow(engine, 4) == 0;
  if (drawBelow(engine, 4) == 0) request.table_bytes = 1 + drawBelow(engine, 4096);
  request.seed = drawBelow(engine, 1000);
  request.threads = 1 + static_cast<std::uint32_t>(drawBelow(engine, 2));
  return request;
}

std::string toString(const PlanRequest& request) {
  std::string words =
      "--solver " + request.solver + " --split " + request.split + " --objective " +
      toString(request.objective) + " --suboptimality " + std::to_string(request.suboptimality) +
      " --seed " + std::to_string(request.seed) + " --threads " + std::to_string(request.threads);
  for (const std::string& option : request.solver_options) words += " --solver-option " + option;
  for (const std::string& option : request.split_options) words += " --split-option " + option;
  if (request.refine_sec > 0) words += " --refine " + std::to_string(request.refine_sec);
  if (request.straighten) words += " --straighten";
  if (request.table_bytes > 0)
    words += " (tables: " + std::to_string(request.table_bytes) + " bytes)";
  return words;
}

}  // namespace split_mapf::fuzz
