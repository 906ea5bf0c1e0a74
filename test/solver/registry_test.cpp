#include "split_mapf/solver/registry.h"

#include <gtest/gtest.h>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

template <typename Error, typename Call>
std::string messageOf(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

TEST(Registry, NamesWhatItKnowsWhenAskedForAnUnknownSolver) {
  const std::string message = messageOf<UnknownSolverError>([] { builtinSolvers().info("magic"); });
  EXPECT_NE(message.find("'magic'"), std::string::npos);
  EXPECT_NE(message.find("ecbs"), std::string::npos);
  EXPECT_NE(message.find("prioritized"), std::string::npos);
}

TEST(Registry, RefusesOptionsThatASolverDoesNotHave) {
  SolverOptions options;
  options.values["colour"] = "red";
  const std::string message =
      messageOf<OptionError>([&] { builtinSolvers().create("prioritized", options); });
  EXPECT_NE(message.find("'colour'"), std::string::npos);
  EXPECT_NE(message.find("order"), std::string::npos);
}

TEST(Registry, RefusesOptionValuesOutOfRange) {
  SolverOptions options;
  options.values["order"] = "upside_down";
  EXPECT_THROW(builtinSolvers().create("prioritized", options), OptionError);
  options.values = {{"demotions", "-1"}};
  const std::string message =
      messageOf<OptionError>([&] { builtinSolvers().create("prioritized", options); });
  EXPECT_NE(message.find("-1"), std::string::npos) << message;
}

TEST(Registry, RefusesAnObjectiveThatASolverDoesNotPlanFor) {
  SolverInfo info = builtinSolvers().info("ecbs");
  info.name = "sums";
  info.traits.makespan = false;
  SolverRegistry registry;
  registry.add(info);
  SolverOptions options;
  options.objective = Objective::kSumOfCosts;
  EXPECT_NO_THROW(registry.create("sums", options));
  options.objective = Objective::kMakespan;
  const std::string message = messageOf<OptionError>([&] { registry.create("sums", options); });
  EXPECT_EQ(message, "solver 'sums' does not plan for makespan");
}

TEST(Registry, EveryListedDefaultIsAccepted) {
  for (const std::string& name : builtinSolvers().names()) {
    SolverOptions options;
    for (const OptionInfo& option : builtinSolvers().info(name).options) {
      options.values[option.name] = option.default_value;
    }
    EXPECT_NO_THROW(builtinSolvers().create(name, options)) << name;
  }
}

TEST(Registry, RefusesASecondSolverOfTheSameName) {
  SolverRegistry registry;
  registry.add(builtinSolvers().info("ecbs"));
  EXPECT_THROW(registry.add(builtinSolvers().info("ecbs")), std::invalid_argument);
}

}  // namespace
}  // namespace split_mapf
