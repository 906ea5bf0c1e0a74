#include "split_mapf/fleet/fleet_execution.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "fleet/drawn_ground.h"
#include "fleet/fleet_world.h"
#include "split_mapf/core/error.h"
#include "split_mapf/roadmap/leg_order.h"
#include "support/ascii_grid.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

/// A fleet on a corridor map, and its first promises.
struct Small {
  explicit Small(const std::vector<std::string>& rows, const std::vector<Path>& paths)
      : grid(test::gridFromAscii(rows)) {
    options.progress_timeout_sec = 2;
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < paths.size(); ++i) ids.push_back("r" + std::to_string(i));
    fleet = std::make_unique<FleetExecution>(grid, ids, Plan{paths}, options, 0);
    fleet->advance(0);
  }
  void answer(double now) {
    const auto question = fleet->ask(now);
    ASSERT_TRUE(question);
    PlanRequest request;
    request.split = "none";
    fleet->take(answerFleet(*question, planner, request, {}), now);
  }
  std::shared_ptr<const Grid> grid;
  FleetOptions options;
  Executor executor{1};
  Planner planner{builtinSolvers(), executor};
  std::unique_ptr<FleetExecution> fleet;
};

TEST(FleetExecution, RefusesReportsThatCannotBe) {
  // r1 follows r0 to the right.
  Small small({"......"}, {{1, 2, 3, 4, 5}, {0, 1, 2, 3, 4}});
  FleetExecution& fleet = *small.fleet;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fleet.report(0, {0, nan, DriveStatus::kOk, {}}, 1), ReportFate::kNotANumber);
  EXPECT_EQ(fleet.report(0, {0, 1.5, DriveStatus::kOk, {}}, 1), ReportFate::kNotANumber);
  EXPECT_EQ(fleet.report(0, {0, 0, static_cast<DriveStatus>(9), {}}, 1), ReportFate::kNotANumber);
  EXPECT_EQ(fleet.report(0, {77, 0, DriveStatus::kOk, {}}, 1), ReportFate::kNoSuchVisit);
  EXPECT_EQ(fleet.report(0, {3, 0, DriveStatus::kOk, {}}, 1), ReportFate::kNotReleased);
  EXPECT_EQ(fleet.report(1, {0, 0.1, DriveStatus::kOk, {}}, 1), ReportFate::kNotReleased);
  EXPECT_EQ(fleet.report(0, {1, 0.3, DriveStatus::kOk, {}}, 1), ReportFate::kTaken);
  EXPECT_EQ(fleet.report(0, {1, 0.3, DriveStatus::kOk, {}}, 1), ReportFate::kTaken) << "twice";
  EXPECT_EQ(fleet.report(0, {1, 0.1, DriveStatus::kOk, {}}, 1), ReportFate::kBackwards);
  EXPECT_EQ(fleet.report(0, {0, 0, DriveStatus::kOk, {}}, 1), ReportFate::kBackwards);
  EXPECT_EQ(fleet.status(1)[0].absence, Absence::kNone);
}

TEST(FleetExecution, TakesARobotThatStraysForAnObstacleWhereItIs) {
  Small small({".....", ".....", "....."}, {{10, 11, 12, 13, 14}, {0, 1, 2, 3, 4}});
  EXPECT_EQ(small.fleet->report(0, {0, 0, DriveStatus::kOk, Cell{3, 0}}, 1), ReportFate::kAstray);
  EXPECT_EQ(small.fleet->status(1)[0].absence, Absence::kAstray);
  small.answer(1);
  for (const RouteStep& step : small.fleet->route(1, 100)) EXPECT_NE(step.vertex, 3U);
  EXPECT_EQ(small.fleet->status(1)[1].fault, GoalFault::kNone);
  // It comes back by itself, but not by a report that does not tell where it is.
  EXPECT_EQ(small.fleet->report(0, {0, 0, DriveStatus::kOk, {}}, 2), ReportFate::kAstray);
  EXPECT_EQ(small.fleet->status(2)[0].absence, Absence::kAstray);
  EXPECT_EQ(small.fleet->report(0, {0, 0, DriveStatus::kOk, Cell{0, 2}}, 2), ReportFate::kTaken);
  EXPECT_EQ(small.fleet->status(2)[0].absence, Absence::kNone);
}

/// On a planning graph cells say little: a robot may be in any on its way. Its pose does.
TEST(FleetExecution, TakesARobotThatLeavesItsWayOnAPlanningGraphForAnObstacleWhereItIs) {
  const test::Ground ground = test::drawGround(1);
  RandomEngine engine(1);
  const Plan plan = test::randomValidPlan(*ground.grid, 4, 30, engine);
  FleetOptions options;
  options.moves = ground.moves;
  options.distance_m = test::distanceOn(ground);
  FleetExecution fleet(ground.grid, {"r0", "r1", "r2", "r3"}, plan, options, 0);
  fleet.advance(0);
  const auto say = [&](PlanePoint at, double now) {
    RobotReport report;
    report.point = at;
    return fleet.report(0, report, now);
  };
  const PlanePoint start = ground.moves->place(plan.paths[0].front());
  const double off = 0.4 * options.distance_m;
  EXPECT_EQ(say({start.x + off, start.y}, 1), ReportFate::kTaken) << "robots are not exact";
  // Onto the way of another robot, the end of which is farthest from its own.
  Vertex there = kNoVertex;
  double farthest = 0;
  for (std::uint32_t robot = 1; robot < 4; ++robot) {
    const PlanePoint goal = ground.moves->place(plan.paths[robot].back());
    const double far = std::hypot(goal.x - start.x, goal.y - start.y);
    if (far > farthest) there = plan.paths[robot].back();
    farthest = std::max(farthest, far);
  }
  ASSERT_GT(farthest, 4 * options.distance_m);
  const PlanePoint strayed = ground.moves->place(there);
  EXPECT_FALSE(fleet.closed()[there]);
  EXPECT_EQ(say(strayed, 1), ReportFate::kAstray);
  EXPECT_EQ(fleet.status(1)[0].absence, Absence::kAstray);
  ASSERT_TRUE(fleet.strayedTo(0));
  EXPECT_EQ(fleet.strayedTo(0)->x, strayed.x);
  EXPECT_TRUE(fleet.closed()[there]);
  // Whom that keeps from its goal is not led there.
  Executor executor(1);
  const Planner planner(builtinSolvers(), executor);
  PlanRequest request;
  request.split = "none";
  const auto question = fleet.ask(1);
  ASSERT_TRUE(question);
  EXPECT_TRUE(question->anew);
  fleet.take(answerFleet(*question, planner, request, {}), 1);
  for (std::uint32_t robot = 1; robot < 4; ++robot) {
    for (const RouteStep& step : fleet.route(robot, 100)) {
      EXPECT_TRUE(step.released || !fleet.closed()[step.vertex]) << "robot " << robot;
    }
  }
  // It shakes: that is no news.
  EXPECT_EQ(say({strayed.x + off, strayed.y}, 1.1), ReportFate::kAstray);
  EXPECT_EQ(fleet.strayedTo(0)->x, strayed.x);
  EXPECT_EQ(say({strayed.x, strayed.y + 2 * off}, 1.2), ReportFate::kAstray);
  EXPECT_GT(fleet.strayedTo(0)->y, strayed.y) << "it strays on";
  RobotReport blind;
  EXPECT_EQ(fleet.report(0, blind, 1.3), ReportFate::kAstray);
  EXPECT_TRUE(fleet.strayedTo(0)) << "nobody saw it on its way";
  EXPECT_EQ(say(start, 2), ReportFate::kTaken);
  EXPECT_EQ(fleet.status(2)[0].absence, Absence::kNone);
  EXPECT_FALSE(fleet.strayedTo(0));
  EXPECT_FALSE(fleet.closed()[there]);
}

TEST(FleetExecution, LeadsABlockedRobotElsewhereByVisitsWithNewNumbers) {
  Small small({"....", "...."}, {{0, 1, 2, 3}});
  EXPECT_EQ(small.fleet->report(0, {0, 0, DriveStatus::kBlocked, {}}, 1), ReportFate::kTaken);
  EXPECT_EQ(small.fleet->route(0, 0).size(), 1U) << "nothing is released to it";
  small.answer(1);
  const std::vector<RouteStep> route = small.fleet->route(0, 100);
  ASSERT_EQ(route.size(), 6U);
  EXPECT_EQ(route[1].vertex, 4U);
  EXPECT_GT(route[1].sequence, 3U);
  EXPECT_EQ(route.back().vertex, 3U);
}

TEST(FleetExecution, NamesGoalsThatCannotBeReached) {
  Small small({"....."}, {{0, 1, 2, 3}, {4}});
  std::vector<bool> blocked(5, false);
  blocked[3] = true;
  small.fleet->setBlocked(blocked);
  small.answer(0);
  EXPECT_EQ(small.fleet->status(0)[0].fault, GoalFault::kBlocked);
  blocked[3] = false;
  small.fleet->setBlocked(blocked);
  small.answer(1);
  EXPECT_EQ(small.fleet->status(1)[0].fault, GoalFault::kNone);
}

TEST(FleetExecution, SeesCellsThatOpenWhileAPlanIsMade) {
  Small small({"....."}, {{0, 1, 2, 3}, {4}});
  std::vector<bool> blocked(5, false);
  blocked[3] = true;
  small.fleet->setBlocked(blocked);
  const auto question = small.fleet->ask(0);
  ASSERT_TRUE(question);
  blocked[3] = false;
  small.fleet->setBlocked(blocked);
  small.fleet->take(answerFleet(*question, small.planner, {}, {}), 0);
  EXPECT_FALSE(small.fleet->isFinished());
  small.answer(1);
  EXPECT_EQ(small.fleet->status(1)[0].fault, GoalFault::kNone);
}

TEST(FleetExecution, LetsRobotsGoAndJoin) {
  Small small({"....", "...."}, {{0, 1, 2, 3}, {6}});
  small.fleet->remove(1);
  EXPECT_EQ(small.fleet->robots(), 1U);
  EXPECT_NE(small.fleet->add("r0", 6, 7), "");
  EXPECT_NE(small.fleet->add("new", 1, 7), "") << "promised to r0";
  EXPECT_NE(small.fleet->add("new", 7, 3), "") << "the goal of r0";
  EXPECT_EQ(small.fleet->add("new", 7, 4), "");
  small.answer(1);
  ASSERT_EQ(small.fleet->robots(), 2U);
  EXPECT_EQ(small.fleet->id(1), "new");
  EXPECT_EQ(small.fleet->route(1, 100).front().vertex, 7U);
  EXPECT_EQ(small.fleet->route(1, 100).back().vertex, 4U);
}

TEST(FleetExecution, ARobotThatWasToJoinCouldNotLeave) {
  Small small({"....", "...."}, {{0, 1, 2, 3}});
  EXPECT_FALSE(small.fleet->removeJoiner("new"));
  EXPECT_EQ(small.fleet->add("new", 7, 4), "");
  EXPECT_EQ(small.fleet->add("other", 6, 5), "");
  EXPECT_TRUE(small.fleet->closed()[7]);
  const auto question = small.fleet->ask(1);
  ASSERT_TRUE(question && question->anew);
  const std::uint64_t kept = small.fleet->snapshotVersion();
  EXPECT_TRUE(small.fleet->removeJoiner("new"));
  EXPECT_NE(small.fleet->snapshotVersion(), kept);
  EXPECT_FALSE(small.fleet->isJoining("new"));
  EXPECT_FALSE(small.fleet->closed()[7]);
  EXPECT_TRUE(small.fleet->isUrgent()) << "what is asked counts on it";
  small.fleet->take(answerFleet(*question, small.planner, {}, {}), 1);
  EXPECT_EQ(small.fleet->robots(), 1U);
  small.answer(2);
  ASSERT_EQ(small.fleet->robots(), 2U);
  EXPECT_EQ(small.fleet->id(1), "other");
  EXPECT_EQ(small.fleet->route(1, 100).back().vertex, 5U);
  EXPECT_EQ(small.fleet->add("new", 7, 4), "") << "it may come again";
}

TEST(FleetExecution, WaitsForNoImprovementWhereARobotDropsOut) {
  Small small({"....", "...."}, {{0, 1, 2, 3}, {4, 5, 6, 7}});
  EXPECT_FALSE(small.fleet->isUrgent());
  auto question = small.fleet->ask(0);
  ASSERT_TRUE(question && !question->anew);
  EXPECT_FALSE(small.fleet->isUrgent());
  small.fleet->report(0, {0, 0, DriveStatus::kFault, {}}, 1);
  EXPECT_TRUE(small.fleet->isUrgent());
  // An answer in haste is as good as any.
  PlanRequest request;
  small.fleet->take(answerFleet(*question, small.planner, request, Deadline(0)), 1);
  question = small.fleet->ask(1);
  ASSERT_TRUE(question && question->anew);
  EXPECT_FALSE(small.fleet->isUrgent()) << "a plan is being made";
  small.fleet->remove(0);
  EXPECT_TRUE(small.fleet->isUrgent()) << "it will not be taken";
}

TEST(FleetExecution, TakesInARobotThatWasAnObstacleUntilThen) {
  Small small({"....", "...."}, {{0, 1, 2, 3}});
  std::vector<bool> strangers(8, false);
  strangers[7] = true;
  small.fleet->setStrangers(strangers);
  EXPECT_EQ(small.fleet->add("new", 7, 4), "");
  small.answer(1);
  ASSERT_EQ(small.fleet->robots(), 2U);
  EXPECT_EQ(small.fleet->status(1)[1].fault, GoalFault::kNone);
  EXPECT_EQ(small.fleet->route(1, 100).back().vertex, 4U);
}

TEST(FleetExecution, IsNotKeptAnewForRobotsThatPassBy) {
  Small small({"....", "...."}, {{0, 1, 2, 3}});
  const std::uint64_t before = small.fleet->snapshotVersion();
  std::vector<bool> cells(8, false);
  cells[7] = true;
  small.fleet->setStrangers(cells);
  EXPECT_EQ(small.fleet->snapshotVersion(), before);
  EXPECT_TRUE(small.fleet->snapshot(0).blocked.empty());
  small.fleet->setBlocked(cells);
  EXPECT_NE(small.fleet->snapshotVersion(), before);
}

TEST(FleetExecution, ForgetsTheCutOfAQuestionWhenARobotLeaves) {
  Small small({"......", "......"}, {{6}, {0, 1, 2, 3, 4, 5}, {7}});
  ASSERT_TRUE(small.fleet->ask(0));
  small.fleet->remove(0);
  EXPECT_EQ(small.fleet->add("new", 6, 11), "") << "where the robot that left stood";
  EXPECT_EQ(small.fleet->report(0, {2, 0, DriveStatus::kOk, {}}, 1), ReportFate::kTaken);
  small.fleet->advance(1);
  EXPECT_EQ(small.fleet->status(1)[0].released_until, 4U) << "its question is out of date";
}

TEST(FleetExecution, EndsWhenItsLastRobotLeaves) {
  Small small({"....", "...."}, {{0, 1, 2, 3}});
  small.fleet->report(0, {0, 0, DriveStatus::kFault, {}}, 1);
  small.fleet->remove(0);
  EXPECT_FALSE(small.fleet->ask(1));
  EXPECT_TRUE(small.fleet->isFinished());
}

TEST(FleetExecution, TakesRobotsInWhenAllOthersHaveLeft) {
  Small small({"....", "...."}, {{0, 1, 2, 3}});
  small.fleet->remove(0);
  EXPECT_EQ(small.fleet->add("new", 7, 4), "");
  EXPECT_FALSE(small.fleet->isFinished());
  small.answer(1);
  ASSERT_EQ(small.fleet->robots(), 1U);
  EXPECT_EQ(small.fleet->route(0, 100).back().vertex, 4U);
}

TEST(FleetExecution, IsTakenUpAgainWithTheStepOfItsPlan) {
  Small small({"...."}, {{0, 1, 2, 3}});
  FleetSnapshot kept = small.fleet->snapshot(0);
  FleetOptions slow = small.options;
  slow.turn_sec = 200;  // too much for steps of a second
  kept.step_sec = 10;
  EXPECT_NO_THROW(FleetExecution(small.grid, kept, slow, 0));
  kept.step_sec = 0;
  EXPECT_THROW(FleetExecution(small.grid, kept, small.options, 0), OptionError);
}

TEST(FleetExecution, StaysPausedOrCancelledWhenItIsTakenUpAgain) {
  for (const bool cancel : {true, false}) {
    SCOPED_TRACE(cancel ? "cancelled" : "paused");
    Small small({"......"}, {{0, 1, 2, 3, 4, 5}});
    const std::uint64_t before = small.fleet->snapshotVersion();
    if (cancel) small.fleet->cancel();
    if (!cancel) small.fleet->pauseAll(true);
    EXPECT_NE(small.fleet->snapshotVersion(), before) << "it has to be kept";
    const FleetSnapshot kept = small.fleet->snapshot(1);
    FleetExecution next(small.grid, kept, small.options, 2);
    // It may have gone as far as it was released, and is released no more.
    for (const std::uint32_t visit : {1U, 2U}) {
      next.report(0, {visit, 0, DriveStatus::kOk, {}}, 3);
      next.advance(3);
    }
    EXPECT_EQ(next.status(3)[0].released_until, 2U);
    EXPECT_EQ(next.isCancelled(), cancel);
    EXPECT_EQ(next.isFinished(), cancel);
  }
}

TEST(FleetExecution, LetsPausedRobotsGoOnWithAllOthers) {
  Small small({"....", "...."}, {{0, 1, 2, 3}, {4, 5, 6, 7}});
  small.fleet->pause(0, true);
  small.fleet->pauseAll(true);
  small.fleet->pauseAll(false);
  small.fleet->report(0, {2, 0, DriveStatus::kOk, {}}, 1);
  small.fleet->advance(1);
  EXPECT_EQ(small.fleet->status(1)[0].absence, Absence::kNone);
  EXPECT_EQ(small.fleet->status(1)[0].released_until, 3U);
}

TEST(FleetExecution, BelievesARobotThatHasNotBegunThatItCannot) {
  Small small({"....", "...."}, {{0, 1, 2, 3}, {4, 5, 6, 7}});
  small.fleet->hear(0, DriveStatus::kFault, std::nullopt, 1);
  small.fleet->hear(1, DriveStatus::kLost, std::nullopt, 1);
  EXPECT_EQ(small.fleet->status(1)[0].absence, Absence::kFault);
  EXPECT_EQ(small.fleet->status(1)[1].absence, Absence::kLost);
  small.fleet->hear(1, DriveStatus::kOk, std::nullopt, 2);
  EXPECT_EQ(small.fleet->status(2)[1].absence, Absence::kNone);
}

TEST(FleetExecution, FindsSilentRobotsAndTakesThemBack) {
  Small small({"....", "...."}, {{0, 1, 2, 3}, {4, 5, 6, 7}});
  small.fleet->report(1, {0, 0, DriveStatus::kOk, {}}, 3);
  small.fleet->advance(3);
  EXPECT_EQ(small.fleet->status(3)[0].absence, Absence::kSilent);
  EXPECT_EQ(small.fleet->status(3)[1].absence, Absence::kNone);
  small.answer(3);
  // What it was promised is still its own.
  EXPECT_EQ(small.fleet->report(0, {2, 0, DriveStatus::kOk, {}}, 4), ReportFate::kTaken);
  EXPECT_EQ(small.fleet->status(4)[0].absence, Absence::kNone);
  small.answer(4);
  EXPECT_EQ(small.fleet->route(0, 100).back().vertex, 3U);
}

/// Three legs: that of b crosses that of a, which goes first; c is far away.
FleetExecution fleetOnLegs() {
  const LegOrder legs =
      orderLegs({{{0, 0}, {2, 0}, 0.3, 0}, {{0, -2}, {0, 1}, 0.3, 1}, {{9, 9}, {9, 8}, 0.3, 0}}, 0,
                {"robot a", "robot b", "robot c"});
  FleetOptions options;
  options.moves = legs.moves;
  options.plans_anew = false;
  return FleetExecution(legs.grid, {"a", "b", "c"}, legs.plan, options, 0);
}

/// Legs are driven in an order that no other plan would know: it stays, whichever robot fails.
TEST(FleetExecution, EndsInItsOrderWhereNothingIsPlannedAnew) {
  FleetExecution fleet = fleetOnLegs();
  EXPECT_FALSE(fleet.isFinished()) << "nobody was promised anything yet";
  fleet.advance(0.1);
  EXPECT_TRUE(fleet.status(0.1)[0].moves);
  EXPECT_FALSE(fleet.status(0.1)[1].moves);
  EXPECT_EQ(fleet.status(0.1)[1].waits_for, std::optional<std::uint32_t>(0));
  fleet.report(0, {0, 0, DriveStatus::kFault, {}}, 0.2);
  fleet.advance(0.3);
  EXPECT_FALSE(fleet.isFinished()) << "c is under way";
  EXPECT_EQ(fleet.report(2, {1, 0, DriveStatus::kOk, {}}, 0.4), ReportFate::kTaken);
  fleet.advance(0.5);
  EXPECT_TRUE(fleet.isFinished());
  EXPECT_FALSE(fleet.ask(10));
  EXPECT_FALSE(fleet.status(0.5)[1].arrived);
  EXPECT_TRUE(fleet.status(0.5)[2].arrived);
  EXPECT_EQ(fleet.ground(0).size(), 1U);
}

/// It had lost its leg for ever: nobody plans it anew.
TEST(FleetExecution, LetsARobotWhoseFaultIsOverGoOnWithItsLeg) {
  FleetExecution fleet = fleetOnLegs();
  fleet.advance(0.1);
  fleet.report(0, {0, 0, DriveStatus::kFault, {}}, 0.2);
  fleet.advance(0.3);
  fleet.takeChanged();
  fleet.report(0, {0, 0, DriveStatus::kOk, {}}, 0.4);
  fleet.advance(0.5);
  EXPECT_TRUE(fleet.status(0.5)[0].moves);
  EXPECT_EQ(fleet.takeChanged(), std::vector<std::uint32_t>{0});
  const std::vector<RouteStep> route = fleet.route(0, 100);
  ASSERT_EQ(route.size(), 2U);
  EXPECT_TRUE(route[1].released);
  EXPECT_GT(route[1].sequence, 1U) << "it goes on to visits with new numbers only";
  fleet.report(0, {route[1].sequence, 0, DriveStatus::kOk, {}}, 0.6);
  fleet.advance(0.7);
  EXPECT_TRUE(fleet.status(0.7)[0].arrived);
  EXPECT_TRUE(fleet.status(0.7)[1].moves) << "b waits for a no more";
}

TEST(FleetExecution, RefusesJointRingsOnPlanningGraphs) {
  const LegOrder legs = orderLegs({{{0, 0}, {2, 0}, 0.3, 0}}, 0, {"robot a"});
  FleetOptions options;
  options.moves = legs.moves;
  options.joint_rings = true;
  EXPECT_THROW(requireValid(options), OptionError);
}

}  // namespace
}  // namespace split_mapf
