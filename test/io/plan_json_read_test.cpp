#include <gtest/gtest.h>

#include "io/temporary_files.h"
#include "split_mapf/io/plan_json.h"

namespace split_mapf {
namespace {

class PlanJsonReadTest : public test::FileTest {
 protected:
  CellPaths pathsOf(const std::string& json) const { return readPlanJson(file("a.json", json)); }
  std::string errorOfJson(const std::string& json) const {
    return errorOf([&] { pathsOf(json); });
  }
};

TEST_F(PlanJsonReadTest, ReadsPaths) {
  EXPECT_EQ(pathsOf(R"({"status": "solved", "paths": [[[0,1],[2,3]], [[4,5]]]})"),
            (CellPaths{{{0, 1}, {2, 3}}, {{4, 5}}}));
}

TEST_F(PlanJsonReadTest, ReadsCompactPaths) {
  EXPECT_EQ(pathsOf(R"({"paths": ["1,2 2RDW", "", "5,6", [[0,1]], "3,3 LU"]})"),
            (CellPaths{{{1, 2}, {2, 2}, {3, 2}, {3, 3}, {3, 3}},
                       {},
                       {{5, 6}},
                       {{0, 1}},
                       {{3, 3}, {2, 3}, {2, 2}}}));
}

TEST_F(PlanJsonReadTest, RefusesCompactPathsThatAreNone) {
  for (const char* text : {"1", "1,", ",2", "1,2R", "1,2 ", "1,2 2", "1,2 0R", "1,2 X", "1,2 R R",
                           "-1,2 R", "99999999999,2", "1,2 99999999999W", "1,2 16777216W", "x"}) {
    const std::string error = errorOfJson(R"({"paths": ["1,2", ")" + std::string(text) + "\"]}");
    const std::string begin =
        "a.json: paths, robot 1: read '" + std::string(text) + "', expected a path like";
    EXPECT_EQ(error.substr(0, begin.size()), begin);
  }
}

TEST_F(PlanJsonReadTest, AShortFileDoesNotAskForAllMemory) {
  std::string list = R"("0,0 999999W")";
  for (int i = 0; i < 20; ++i) list += R"(, "0,0 999999W")";
  EXPECT_EQ(errorOfJson(R"({"paths": [)" + list + "]}"),
            "a.json: paths, robot 1: read '0,0 999999W', expected fewer steps, in so short a file");
}

TEST_F(PlanJsonReadTest, LeavesTheJudgementToTheValidator) {
  EXPECT_EQ(pathsOf(R"({"paths": []})"), CellPaths{});
  EXPECT_EQ(pathsOf(R"({"paths": [[], [[-1, 2147483647]]]})"), (CellPaths{{}, {{-1, 2147483647}}}));
}

TEST_F(PlanJsonReadTest, LooksAtTheTopLevelAlone) {
  EXPECT_EQ(pathsOf(R"({"layout": {"paths": 3}, "trace": [{"paths": 4}], "paths": [[[1,1]]]})"),
            (CellPaths{{{1, 1}}}));
  EXPECT_EQ(errorOfJson(R"({"layout": {"paths": []}})"),
            "a.json: read no 'paths', expected a list of paths, one a robot");
}

TEST_F(PlanJsonReadTest, NamesTheLineOfMalformedJson) {
  const auto start = [&](const std::string& json) { return errorOfJson(json).substr(0, 46); };
  EXPECT_EQ(start(""), "a.json:1: read malformed JSON, expected a plan");
  EXPECT_EQ(start("{\n\"paths\": [[[1,2],\n"), "a.json:3: read malformed JSON, expected a plan");
  EXPECT_EQ(start("{\n\"paths\": [\n[[1,2] [3,4]]\n]}"),
            "a.json:3: read malformed JSON, expected a plan");
  EXPECT_EQ(start("{\"paths\": []}\n\nmore"), "a.json:3: read malformed JSON, expected a plan");
  EXPECT_EQ(start("{\"paths\": [],\n \"message\": \"\xff\"}"),
            "a.json:2: read malformed JSON, expected a plan");
  EXPECT_NE(errorOfJson("{\n\"paths\": ]").find(']'), std::string::npos);
}

TEST_F(PlanJsonReadTest, NamesTheLineOfANumberThatNoMachineHolds) {
  EXPECT_EQ(errorOfJson("{\n\"paths\": [[[0,1],\n[444e44444444444444444444,2]]]}"),
            "a.json:3: read '444e44444444444444444444', expected a number below 1.8e308");
  EXPECT_EQ(errorOfJson("{\"paths\": [],\n \"gap\": -1e400}"),
            "a.json:2: read '-1e400', expected a number below 1.8e308");
}

TEST_F(PlanJsonReadTest, NamesMissingOrRepeatedPaths) {
  EXPECT_EQ(errorOfJson("{}"), "a.json: read no 'paths', expected a list of paths, one a robot");
  EXPECT_EQ(errorOfJson("[1]"), "a.json: read '[1]', expected a JSON object");
  EXPECT_EQ(errorOfJson(R"({"paths": [], "paths": [[[1,2]]]})"),
            "a.json: read 'paths' a second time, expected it once");
  EXPECT_EQ(errorOfJson(R"({"paths": null})"),
            "a.json: paths: read 'null', expected a list of paths");
}

TEST_F(PlanJsonReadTest, NamesRobotAndStep) {
  EXPECT_EQ(errorOfJson(R"({"paths": [[[1,2]], 7]})"),
            "a.json: paths, robot 1: read '7', expected a list of cells");
  EXPECT_EQ(errorOfJson(R"({"paths": [[[1,2]], [[1,2],[3]]]})"),
            "a.json: paths, robot 1, step 1: read '[3]', expected [x,y]");
  EXPECT_EQ(errorOfJson(R"({"paths": [[[1,2,3]]]})"),
            "a.json: paths, robot 0, step 0: read '[1,2,3]', expected [x,y]");
  EXPECT_EQ(errorOfJson(R"({"paths": [[5]]})"),
            "a.json: paths, robot 0, step 0: read '5', expected [x,y]");
  EXPECT_EQ(errorOfJson(R"({"paths": [[{"x":1,"y":2}]]})"),
            "a.json: paths, robot 0, step 0: read '{\"x\":1,\"y\":2}', expected [x,y]");
  EXPECT_EQ(errorOfJson(R"({"paths": [[[1,2],[1,2.0]]]})"),
            "a.json: paths, robot 0, step 1: read y = '2.0', expected a 32-bit integer");
  EXPECT_EQ(errorOfJson(R"({"paths": [[["1",2]]]})"),
            "a.json: paths, robot 0, step 0: read x = '\"1\"', expected a 32-bit integer");
  EXPECT_EQ(errorOfJson(R"({"paths": [[[2147483648,2]]]})"),
            "a.json: paths, robot 0, step 0: read x = '2147483648', expected a 32-bit integer");
  EXPECT_EQ(errorOfJson(R"({"paths": [[[0,-2147483649]]]})"),
            "a.json: paths, robot 0, step 0: read y = '-2147483649', expected a 32-bit integer");
  EXPECT_EQ(errorOfJson(R"({"paths": [[[0,true]]]})"),
            "a.json: paths, robot 0, step 0: read y = 'true', expected a 32-bit integer");
}

TEST_F(PlanJsonReadTest, TellsFirstWhatIsWrongWithTheWhole) {
  EXPECT_EQ(errorOfJson("{\"paths\": [7],\n \"x\": }").substr(0, 30),
            "a.json:2: read malformed JSON,");
  EXPECT_EQ(errorOfJson(R"({"paths": [7], "paths": []})"),
            "a.json: read 'paths' a second time, expected it once");
  EXPECT_EQ(errorOfJson(R"({"paths": {"a": [1]}})"),
            "a.json: paths: read '{\"a\":[1]}', expected a list of paths");
  EXPECT_EQ(errorOfJson(R"({"paths": [7, "x"]})"),
            "a.json: paths, robot 0: read '7', expected a list of cells");
  const std::string sized = "a.json: read a plan of robots that have size";
  EXPECT_EQ(errorOfJson(R"({"paths": [7], "poses": [[[1, 2]]]})").substr(0, sized.size()), sized);
  EXPECT_EQ(errorOfJson(R"({"poses": 3, "paths": []})").substr(0, sized.size()), sized);
  EXPECT_EQ(pathsOf(R"({"paths": [[[1,2]]], "poses": []})"), (CellPaths{{{1, 2}}}));
}

TEST_F(PlanJsonReadTest, ReadsPosesBesidePaths) {
  const auto read = [&](const std::string& json) { return readDiscPlanJson(file("d.json", json)); };
  const DiscClaims claims = read(
      R"({"paths": [[[1,2]], "3,4"], "robot_radius": 0.5, "x": {"poses": 1}, "radii": [0.5, 0.25],
          "poses": [[[1, 2.5], [2, 3]], []]})");
  EXPECT_EQ(claims.robot_radius_m, 0.5);
  EXPECT_EQ(claims.radius_m, (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(claims.paths, (CellPaths{{{1, 2}}, {{3, 4}}}));
  ASSERT_EQ(claims.poses.size(), 2U);
  ASSERT_EQ(claims.poses[0].size(), 2U);
  EXPECT_EQ(claims.poses[0][1].y, 3);
  const auto error = [&](const std::string& json) { return errorOf([&] { read(json); }); };
  EXPECT_EQ(error(R"({"paths": [7], "poses": [[[1, 2]], [[1, 2], [true, 2]]]})"),
            "d.json: poses, robot 1, step 1: read '[true,2]', expected [x, y]");
  EXPECT_EQ(error(R"({"paths": [7], "poses": [[[1, 2]], 4]})"),
            "d.json: poses, robot 1: read '4', expected a list of points");
  EXPECT_EQ(error(R"({"paths": [7], "poses": [[[1, 2]]]})"),
            "d.json: paths, robot 0: read '7', expected a list of cells");
  EXPECT_EQ(error(R"({"paths": [], "poses": [], "poses": []})"),
            "d.json: read 'poses' a second time, expected it once");
  EXPECT_EQ(error(R"({"paths": []})"),
            "d.json: read no list 'poses', expected the plan of robots that have size");
}

TEST_F(PlanJsonReadTest, NamesAFileThatCannotBeRead) {
  EXPECT_EQ(errorOf([&] { readPlanJson(pathOf("none.json")); }),
            "cannot open none.json: No such file or directory");
}

}  // namespace
}  // namespace split_mapf
