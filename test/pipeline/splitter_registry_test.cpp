#include "split_mapf/split/splitter_registry.h"

#include <gtest/gtest.h>

#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

std::string faultOf(const SplitterRegistry& splitters, const std::string& split,
                    const std::map<std::string, std::string>& values) {
  try {
    splitters.read(split, values, Objective::kMakespan);
  } catch (const OptionError& error) {
    return error.what();
  }
  return "none";
}

TEST(SplitterRegistry, FindsSplittersByTheNotation) {
  const SplitterRegistry& splitters = builtinSplitters();
  const auto name_of = [&](const std::string& split) {
    const SplitterInfo* const found =
        splitters.find(splitters.read(split, {}, Objective::kMakespan));
    return found != nullptr ? found->name : "";
  };
  EXPECT_EQ(name_of("none"), "");
  EXPECT_EQ(name_of("auto"), "");
  EXPECT_EQ(name_of("4t"), "time");
  EXPECT_EQ(name_of("2x2s"), "space");
  EXPECT_EQ(name_of("4s8t"), "space");
  // Those of the notation have to be told how many pieces: by name they would know nothing of it.
  for (const char* name : {"quarters", "time", "space"}) {
    EXPECT_THROW(splitters.read(name, {}, Objective::kMakespan), SplitSpecError) << name;
  }
}

TEST(SplitterRegistry, EveryListedDefaultThatIsAValueIsAccepted) {
  for (const std::string& name : builtinSplitters().names()) {
    const std::string split = name == "time" ? "4t" : "2x2s4t";
    for (const OptionInfo& option : builtinSplitters().info(name).options) {
      if (option.default_value.find(' ') != std::string::npos) continue;
      EXPECT_EQ(faultOf(builtinSplitters(), split, {{option.name, option.default_value}}), "none");
    }
  }
}

TEST(SplitterRegistry, RefusesOptionsThatASplitDoesNotHave) {
  EXPECT_EQ(faultOf(builtinSplitters(), "4t", {{"buffer", "4x2"}}),
            "split option 'buffer' is for splits made by space, but split '4t' is made by time");
  EXPECT_EQ(faultOf(builtinSplitters(), "auto", {{"replan", "1"}}),
            "split options need a split, but split 'auto' makes none");
  EXPECT_NE(faultOf(builtinSplitters(), "4t", {{"colour", "red"}}).find("'colour' is unknown"),
            std::string::npos);
}

/// Half of the robots, then the other half: each half is a piece on the whole map as long as the
/// others stand still.
class OddAndEven : public WholeWhereItFails {
 public:
  using WholeWhereItFails::WholeWhereItFails;
  bool split(const Deadline& /*deadline*/) override {
    std::vector<Vertex> between(instance().starts());
    for (std::uint32_t robot = 0; robot < instance().robots(); robot += 2) {
      between[robot] = instance().goal(robot);
    }
    std::vector<PieceHandle> pieces;
    for (const auto& [from, to] :
         {std::pair(instance().starts(), between), std::pair(between, instance().goals())}) {
      const Instance half = Instance::fromVertices(instance().sharedGrid(), from, to);
      Piece piece = *wholePiece(half, nextId());
      piece.shares = 1;
      pieces.push_back(std::make_shared<const Piece>(std::move(piece)));
    }
    setTree(PieceTree::sequence(pieces));
    return true;
  }
};

SplitterInfo oddAndEven() {
  SplitterInfo info;
  info.name = "odd_and_even";
  info.description = "every other robot first";
  info.options = {{"twice", "false", "no matter"}};
  info.check = [](const SplitRequest& request) {
    if (request.values.count("twice") > 0) throw OptionError("twice is too often");
  };
  info.make = [](const SplitRequest&, const SplitQuestion& question) {
    return std::make_unique<OddAndEven>(question.instance);
  };
  return info;
}

TEST(SplitterRegistry, ANewSplitterIsAskedForByItsName) {
  SplitterRegistry splitters = builtinSplitters();
  splitters.add(oddAndEven());
  Executor executor(2);
  const Planner planner(builtinSolvers(), executor, splitters);
  const Instance instance = test::instanceFromAscii({"abcd....", "........"},  //
                                                    {"........", "....dcba"});
  PlanRequest request;
  request.solver = "conflict_optimizer";
  request.split = "odd_and_even";
  const PlanReport report = planner.plan(instance, request, Deadline());
  ASSERT_TRUE(report.plan) << report.message;
  EXPECT_TRUE(validate(instance, *report.plan).empty());
  EXPECT_EQ(report.subproblems.size(), 2U);
  request.split_options = {"twice=true"};
  EXPECT_THROW(planner.requireValid(request), OptionError);
  request.split = "4t";
  EXPECT_EQ(
      faultOf(splitters, "4t", {{"twice", "true"}}),
      "split option 'twice' is for splits made by odd_and_even, but split '4t' is made by time");
  EXPECT_THROW(splitters.add(oddAndEven()), std::invalid_argument);
  SplitterInfo taken = oddAndEven();
  taken.name = "4t";
  EXPECT_THROW(splitters.add(taken), std::invalid_argument);
}

}  // namespace
}  // namespace split_mapf
