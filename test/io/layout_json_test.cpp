#include "io/layout_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/temporary_files.h"
#include "split_mapf/io/plan_json.h"

namespace split_mapf {
namespace {

const Grid small_grid(3, 2, {true, true, false, true, true, true});

Layout smallLayout() {
  Layout layout;
  layout.partition = "rectangles";
  layout.ownerships = {{0, 0, 0, 1, 1}, {0, 1, 0, 0, 1}};
  layout.phases.push_back({0, {1, 3}});
  layout.phases.push_back({1, {4, 2}});
  return layout;
}

TEST(LayoutJson, WritesRunsBuffersAndStates) {
  const auto json = nlohmann::json::parse(layoutJson(small_grid, smallLayout(), "  "));
  EXPECT_EQ(json["partition"], "rectangles");
  EXPECT_EQ(json["ownerships"][0].dump(), "[[0,2],[-1,1],[0,1],[1,2]]");
  EXPECT_EQ(json["buffers"].dump(), "[[1,0],[1,1]]");
  EXPECT_EQ(json["phases"][1]["ownership"], 1);
  EXPECT_EQ(json["phases"][1]["states"].dump(), "[[2,1],[0,1]]");
}

class LayoutJsonFile : public test::FileTest {};

TEST_F(LayoutJsonFile, ReadsWhatItWrote) {
  PlanReport report;
  report.layout = smallLayout();
  writePlanJson(pathOf("plan.json"), small_grid, report);
  const auto read = readPlanLayout(pathOf("plan.json"), small_grid);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->partition, "rectangles");
  EXPECT_EQ(read->ownerships, report.layout->ownerships);
  ASSERT_EQ(read->phases.size(), 2U);
  EXPECT_EQ(read->phases[1].states, report.layout->phases[1].states);
  report.layout.reset();
  writePlanJson(pathOf("none.json"), small_grid, report);
  EXPECT_FALSE(readPlanLayout(pathOf("none.json"), small_grid));
}

TEST_F(LayoutJsonFile, RefusesALayoutOfAnotherMap) {
  const auto refusal = [this](const std::string& layout) {
    const std::string path = file("plan.json", R"({"layout": )" + layout + "}");
    return errorOf([&] { readPlanLayout(path, small_grid); });
  };
  const auto with = [](const std::string& runs, const std::string& phases) {
    return R"({"ownerships": [)" + runs + R"(], "phases": [)" + phases + "]}";
  };
  const std::string good = "[[0,2],[-1,1],[0,3]]";
  EXPECT_EQ(refusal(with(good, "")), "");
  EXPECT_NE(refusal("3").find("is no object"), std::string::npos);
  EXPECT_NE(refusal("{}").find("'ownerships'"), std::string::npos);
  EXPECT_NE(refusal(R"({"partition":3})").find("'partition' that is no text"), std::string::npos);
  EXPECT_NE(refusal(with("[[0,5]]", "")).find("blocked cell"), std::string::npos);
  EXPECT_NE(refusal(with("[[0,2]]", "")).find("of 2 cells"), std::string::npos);
  EXPECT_NE(refusal(with("[[0,2],[-1,9]]", "")).find("6 cells"), std::string::npos);
  EXPECT_NE(refusal(with(R"(["x"])", "")).find("runs"), std::string::npos);
  EXPECT_NE(refusal(with(good, R"({"ownership":1,"states":[]})")).find("none of its 1"),
            std::string::npos);
  EXPECT_NE(refusal(with(good, R"({"ownership":0,"states":[[2,0]]})")).find("no free cell"),
            std::string::npos);
  EXPECT_NE(refusal(with(good, R"({"ownership":0,"states":[[4294967296,0]]})")).find("no free"),
            std::string::npos);
}

}  // namespace
}  // namespace split_mapf
