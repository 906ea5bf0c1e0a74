#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/temporary_files.h"
#include "split_mapf/io/plan_json.h"

namespace split_mapf {
namespace {

using Json = nlohmann::json;

const Grid small_grid(3, 2, {true, true, false, true, true, true});

PlanReport solvedReport() {
  PlanReport report;
  report.solver = "ecbs";
  report.split = "2t";
  report.objective = Objective::kSumOfCosts;
  report.seed = 18446744073709551615U;
  report.threads = 4;
  report.robots = 2;
  report.termination = Termination::kSolved;
  report.message = "a valid plan";
  report.plan = Plan{{{0, 2, 3}, {1, 0}}};
  report.makespan = 2;
  report.sum_of_costs = 3;
  report.makespan_lower_bound = 2;
  report.sum_of_costs_lower_bound = 2;
  report.proved_lower_bound = 2;
  report.optimal = true;
  report.certified_by = "ecbs";
  report.runtime_sec = 0.25;
  report.first_plan_sec = 0.125;
  report.trace = {{0.125, 3, 5, 1.5}, {0.25, 2, 3, 2}};
  report.stages = {{"split", 0.5}, {"solve", 1}};
  report.subproblems = {{0, 1, 2, 3, "ecbs", "solved", 0.75}};
  return report;
}

std::string written(const PlanReport& report) {
  std::ostringstream out;
  writePlanJson(out, small_grid, report);
  return out.str();
}

TEST(PlanJsonWriteTest, WritesEveryField) {
  EXPECT_EQ(written(solvedReport()),
            R"({
  "status": "solved",
  "message": "a valid plan",
  "solver": "ecbs",
  "split": "2t",
  "objective": "sum_of_costs",
  "seed": 18446744073709551615,
  "threads": 4,
  "agents": 2,
  "makespan": 2,
  "sum_of_costs": 3,
  "makespan_lower_bound": 2,
  "sum_of_costs_lower_bound": 2,
  "proved_lower_bound": 2.0,
  "gap": 0.5,
  "optimal": true,
  "certified_by": "ecbs",
  "runtime_s": 0.25,
  "first_plan_s": 0.125,
  "trace": [
    [0.125,3,5,1.5],
    [0.25,2,3,2.0]
  ],
  "stages": {"split": 0.5, "solve": 1.0},
  "subproblems": [
    {"agents":2,"horizon":3,"phase":0,"region":1,"seconds":0.75,"solver":"ecbs","status":"solved"}
  ],
  "layout": null,
  "paths": [
    [[0,0],[0,1],[1,1]],
    [[1,0],[0,0]]
  ]
}
)");
}

TEST(PlanJsonWriteTest, IsCompleteWithoutAPlan) {
  PlanReport report = solvedReport();
  report.termination = Termination::kTimeout;
  report.plan.reset();
  const Json json = Json::parse(written(report));
  EXPECT_EQ(json.size(), Json::parse(written(solvedReport())).size());
  EXPECT_EQ(json.at("status"), "timeout");
  EXPECT_EQ(json.at("paths"), Json::array());
  for (const char* name : {"makespan", "sum_of_costs", "gap", "first_plan_s", "layout"}) {
    EXPECT_TRUE(json.at(name).is_null()) << name;
  }
  EXPECT_EQ(json.at("makespan_lower_bound"), 2);
  EXPECT_EQ(json.at("proved_lower_bound"), 2);
}

TEST(PlanJsonWriteTest, HasNoBoundsWhereARobotIsCutOff) {
  PlanReport report;
  report.termination = Termination::kUnsolvable;
  report.cut_off_robot = 0;
  const Json json = Json::parse(written(report));
  EXPECT_EQ(json.at("status"), "unsolvable");
  for (const char* name :
       {"makespan_lower_bound", "sum_of_costs_lower_bound", "proved_lower_bound"}) {
    EXPECT_TRUE(json.at(name).is_null()) << name;
  }
  EXPECT_EQ(json.at("trace"), Json::array());
  EXPECT_EQ(json.at("stages"), Json::object());
  EXPECT_EQ(json.at("subproblems"), Json::array());
}

TEST(PlanJsonWriteTest, ComputesTheGapOfTheObjective) {
  PlanReport report = solvedReport();
  report.objective = Objective::kMakespan;
  EXPECT_EQ(Json::parse(written(report)).at("gap"), 0.0);
  report.proved_lower_bound = 0;
  EXPECT_TRUE(Json::parse(written(report)).at("gap").is_null());
  report.plan = Plan{{{0}, {1}}};
  EXPECT_EQ(Json::parse(written(report)).at("gap"), 0.0);
}

TEST(PlanJsonWriteTest, WritesNoInfinities) {
  PlanReport report = solvedReport();
  report.proved_lower_bound = std::numeric_limits<double>::infinity();
  report.runtime_sec = std::numeric_limits<double>::quiet_NaN();
  report.trace[0].proved_lower_bound = -std::numeric_limits<double>::infinity();
  const Json json = Json::parse(written(report));
  EXPECT_TRUE(json.at("proved_lower_bound").is_null());
  EXPECT_TRUE(json.at("runtime_s").is_null());
  EXPECT_TRUE(json.at("trace").at(0).at(3).is_null());
}

TEST(PlanJsonWriteTest, EscapesText) {
  PlanReport report = solvedReport();
  report.message = "a \"quoted\"\nline, \xc3\xa9 and a bad byte \xff";
  report.stages = {{"st\"age", 1}};
  const Json json = Json::parse(written(report));
  EXPECT_EQ(json.at("message"), "a \"quoted\"\nline, \xc3\xa9 and a bad byte \xef\xbf\xbd");
  EXPECT_EQ(json.at("stages").at("st\"age"), 1);
}

class PlanJsonFileTest : public test::FileTest {};

TEST_F(PlanJsonFileTest, WritesAFile) {
  writePlanJson(pathOf("a.json"), small_grid, solvedReport());
  EXPECT_EQ(contentOf(pathOf("a.json")), written(solvedReport()));
  EXPECT_EQ(errorOf([&] { writePlanJson(pathOf("no/a.json"), small_grid, solvedReport()); }),
            "cannot write no/a.json: No such file or directory");
}

TEST_F(PlanJsonFileTest, ReadsWhatItWrites) {
  const PlanReport report = solvedReport();
  writePlanJson(pathOf("a.json"), small_grid, report);
  EXPECT_EQ(readPlanJson(pathOf("a.json")), cellPathsOf(small_grid, *report.plan));
}

TEST_F(PlanJsonFileTest, ReadsCompactPathsThatItWrites) {
  PlanReport report = solvedReport();
  report.plan = Plan{{{0, 1, 3, 4, 4, 3, 1, 0}, {2, 2, 2}, {4}}};
  std::ostringstream out;
  writePlanJson(out, small_grid, report, PathForm::kCompact);
  EXPECT_EQ(Json::parse(out.str()).at("paths"), (Json{"0,0 RDRWLUL", "0,1 2W", "2,1"}));
  EXPECT_EQ(readPlanJson(file("a.json", out.str())), cellPathsOf(small_grid, *report.plan));
}

TEST_F(PlanJsonFileTest, SaysWhenTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  EXPECT_EQ(errorOf([] { writePlanJson("/dev/full", small_grid, solvedReport()); }),
            "cannot write /dev/full: No space left on device");
}

}  // namespace
}  // namespace split_mapf
