// What a request may ask for at most, and how little of it a refusal repeats.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/pipeline/planner.h"

namespace split_mapf {
namespace {

constexpr std::size_t kMillion = 1000000;
constexpr std::size_t kLongestMessage = 600;

/// The message of the refusal; empty when the request is accepted.
std::string refusalOf(const PlanRequest& request) {
  Executor executor(1);
  try {
    Planner(builtinSolvers(), executor).requireValid(request);
  } catch (const OptionError& error) {
    return error.what();
  }
  return "";
}

using Spoil = std::function<void(PlanRequest&)>;

TEST(RequestLimits, NoMessageRepeatsAMegabyteOfText) {
  const std::string huge(kMillion, 'x');
  const std::vector<Spoil> texts = {
      [&](PlanRequest& r) { r.solver = huge; },
      [&](PlanRequest& r) { r.split = huge; },
      [&](PlanRequest& r) { r.split = "4" + huge; },
      [&](PlanRequest& r) { r.split = std::string(kMillion, '4') + "t"; },
      [&](PlanRequest& r) { r.split = "t(" + std::string(60000, '1') + ")"; },
      [&](PlanRequest& r) { r.solver = "ecbs", r.solver_options = {huge}; },
      [&](PlanRequest& r) { r.solver = "ecbs", r.solver_options = {huge + "=1"}; },
      [&](PlanRequest& r) { r.solver = "ecbs", r.solver_options = {"order=" + huge}; },
      [&](PlanRequest& r) { r.split = "2t", r.split_options = {"variant=" + huge}; },
      [&](PlanRequest& r) {
        r.split = "2s", r.split_options = {"buffer=" + std::string(200, '1')};
      },
  };
  for (std::size_t i = 0; i < texts.size(); ++i) {
    PlanRequest request;
    texts[i](request);
    const std::string message = refusalOf(request);
    EXPECT_FALSE(message.empty()) << i;
    EXPECT_LT(message.size(), kLongestMessage) << i;
  }
}

TEST(RequestLimits, AMillionOptionsAreRefusedByTheirNumber) {
  PlanRequest request;
  request.solver = "ecbs";
  for (std::size_t i = 0; i < kMillion; ++i) {
    request.solver_options.push_back("option" + std::to_string(i) + "=1");
  }
  EXPECT_EQ(refusalOf(request), "solver options: there are 1000000; at most 100 are possible");
}

TEST(RequestLimits, ASplitHasAsManyRatiosAsPieces) {
  PlanRequest request;
  request.split = "t(0.5";
  for (int i = 0; i < 5000; ++i) request.split += ",0.0001";
  request.split += ")";
  EXPECT_NE(refusalOf(request).find("more than 4096 ratios"), std::string::npos)
      << refusalOf(request);
}

TEST(RequestLimits, EveryNumberHasARange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<std::string, Spoil>> numbers = {
      {"suboptimality 0.5 ", [](PlanRequest& r) { r.suboptimality = 0.5; }},
      {"suboptimality 1e+300 ", [](PlanRequest& r) { r.suboptimality = 1e300; }},
      {"suboptimality inf ", [&](PlanRequest& r) { r.suboptimality = infinity; }},
      {"suboptimality nan ", [&](PlanRequest& r) { r.suboptimality = nan; }},
      {"threads 4000000000 ", [](PlanRequest& r) { r.threads = 4000000000U; }},
      {"refinement of 1e+300 s", [&](PlanRequest& r) { r.refine_sec = 1e300; }},
      {"polish=1000000001",
       [](PlanRequest& r) { r.solver = "ecbs", r.solver_options = {"polish=1000000001"}; }},
  };
  for (const auto& [expected, spoil] : numbers) {
    PlanRequest request;
    spoil(request);
    EXPECT_NE(refusalOf(request).find(expected), std::string::npos)
        << expected << ": " << refusalOf(request);
  }
}

}  // namespace
}  // namespace split_mapf
