#include "split_mapf/ros/outcome.h"

#include <gtest/gtest.h>
#include <split_mapf/PlanOutcome.h>

#include <map>
#include <set>
#include <sstream>
#include <string>

#include <ros/message_traits.h>

namespace split_mapf {
namespace {

/// The constants of PlanOutcome.msg, read from the definition that the message carries.
std::map<std::string, int> constantsOfMessage() {
  std::map<std::string, int> constants;
  std::istringstream lines(ros::message_traits::definition<PlanOutcome>());
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    if (line.rfind("int32 ", 0) != 0 || equals == std::string::npos) continue;
    constants[line.substr(6, equals - 6)] = std::stoi(line.substr(equals + 1));
  }
  return constants;
}

const std::set<int> codes_of_the_interface = {0,  1,  2,  3,  4,  5,  10, 11, 12, 13, 20, 21, 22,
                                              23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 40, 50};

TEST(Outcome, IsTheSameAsTheMessage) {
  const std::map<std::string, int> constants = constantsOfMessage();
  std::set<int> codes;
  for (const auto& [name, code] : constants) {
    codes.insert(code);
    EXPECT_EQ(toString(static_cast<Outcome>(code)), name);
  }
  EXPECT_EQ(codes, codes_of_the_interface);
}

TEST(Outcome, KnowsNoOtherCode) {
  for (int code = -1; code < 100; ++code) {
    if (codes_of_the_interface.count(code) != 0) continue;
    EXPECT_THROW(toString(static_cast<Outcome>(code)), std::logic_error) << code;
  }
}

TEST(Outcome, FollowsFromEveryTermination) {
  EXPECT_EQ(outcomeOf(Termination::kSolved), Outcome::kSucceeded);
  EXPECT_EQ(outcomeOf(Termination::kUnsolvable), Outcome::kUnsolvable);
  EXPECT_EQ(outcomeOf(Termination::kNoPlanFound), Outcome::kNoPlanFound);
  EXPECT_EQ(outcomeOf(Termination::kTimeout), Outcome::kTimeout);
  EXPECT_EQ(outcomeOf(Termination::kCancelled), Outcome::kCancelled);
  EXPECT_EQ(outcomeOf(Termination::kMemoryLimit), Outcome::kMemoryLimit);
}

TEST(GoalError, TakesItsOutcomeFromTheFirstFault) {
  FaultList faults;
  faults.add(1, makeFault("b", Outcome::kOutsideMap, "second"));
  faults.add(0, makeFault("a", Outcome::kBlockedCell, "first"));
  const GoalError error(faults);
  EXPECT_EQ(error.outcome(), Outcome::kBlockedCell);
  EXPECT_STREQ(error.what(), "first (and 1 more fault)");
  ASSERT_EQ(error.faults().size(), 2U);
  EXPECT_EQ(error.faults()[1].code, codeOf(Outcome::kOutsideMap));
}

TEST(GoalError, ListsAThousandFaultsAndSaysHowManyThereAre) {
  FaultList faults;
  constexpr std::size_t kRobots = 20000;
  for (std::size_t i = kRobots; i-- > 0;) {
    faults.add(i,
               makeFault(std::to_string(i), Outcome::kBlockedCell, "fault " + std::to_string(i)));
  }
  const GoalError error(faults);
  ASSERT_EQ(error.faults().size(), 1000U);
  for (std::size_t i = 0; i < 1000; ++i) EXPECT_EQ(error.faults()[i].robot_id, std::to_string(i));
  EXPECT_STREQ(error.what(), "fault 0 (and 19999 more faults; the first 1000 are listed)");
}

}  // namespace
}  // namespace split_mapf
