#include "split_mapf/io/execution_file.h"

#include <gtest/gtest.h>

#include "io/temporary_files.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

class ExecutionFile : public test::FileTest {};

TEST_F(ExecutionFile, GivesBackWhatWasWritten) {
  const std::string path = pathOf("fleet.json");
  EXPECT_FALSE(readExecution(path));
  FleetSnapshot snapshot;
  snapshot.plan_id = "fleet \"1\"";
  snapshot.width = 4;
  snapshot.height = 2;
  snapshot.elapsed_sec = 12.25;
  snapshot.step_sec = 0.5;
  snapshot.release = 0.7;
  snapshot.release_ahead = 3;
  snapshot.blocked = {{3, 1}};
  snapshot.all_paused = snapshot.cancelled = true;
  snapshot.robots.push_back({"r0", {2, 0}, 3.5, true, 9, {{4, {0, 0}, 0}, {7, {1, 0}, 2}}, 7});
  snapshot.robots.push_back({"r1", {2, 1}, 0, false, 1, {{0, {2, 1}, 0}}});
  writeExecution(path, snapshot);
  const auto read = readExecution(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->plan_id, snapshot.plan_id);
  EXPECT_EQ(read->width, 4U);
  EXPECT_EQ(read->height, 2U);
  EXPECT_EQ(read->elapsed_sec, 12.25);
  EXPECT_EQ(read->step_sec, 0.5);
  EXPECT_EQ(read->release, 0.7);
  EXPECT_EQ(read->release_ahead, 3U);
  ASSERT_EQ(read->blocked.size(), 1U);
  EXPECT_EQ(read->blocked[0], (Cell{3, 1}));
  EXPECT_TRUE(read->all_paused);
  EXPECT_TRUE(read->cancelled);
  ASSERT_EQ(read->robots.size(), 2U);
  EXPECT_FALSE(read->robots[1].held_at);
  const FleetSnapshot::Robot& robot = read->robots[0];
  EXPECT_EQ(robot.id, "r0");
  EXPECT_EQ(robot.goal, (Cell{2, 0}));
  EXPECT_EQ(robot.planned_sec, 3.5);
  EXPECT_TRUE(robot.paused);
  EXPECT_EQ(robot.next_sequence, 9U);
  EXPECT_EQ(robot.held_at, 7U);
  ASSERT_EQ(robot.visits.size(), 2U);
  EXPECT_EQ(robot.visits[1].sequence, 7U);
  EXPECT_EQ(robot.visits[1].cell, (Cell{1, 0}));
  EXPECT_EQ(robot.visits[1].step, 2U);
  removeExecution(path);
  EXPECT_FALSE(readExecution(path));
}

TEST_F(ExecutionFile, KeepsThePartOfAPlanOfRobotsThatHaveSize) {
  const std::string path = pathOf("fleet.json");
  FleetSnapshot snapshot;
  FleetSnapshot::Part part;
  for (int byte = 0; byte < 256; ++byte) part.plan.push_back(static_cast<char>(byte));
  part.number = 2;
  part.elapsed_sec = 7.5;
  part.planned_sec = 9;
  part.ids = {"a", "b"};
  part.left_behind = {{"c", {{0.25, -1}, {3, 4}}, true}};
  part.faults = {{"c", 31, "stands"}};
  part.joined = {{"d", {0.75, 2}, false}, {"e", {1, 0.1}, true, PlanePoint{2.5, -1}}};
  snapshot.part = part;
  writeExecution(path, snapshot);
  const auto read = readExecution(path);
  ASSERT_TRUE(read && read->part);
  EXPECT_EQ(read->part->plan, part.plan);
  EXPECT_EQ(read->part->number, 2U);
  EXPECT_EQ(read->part->elapsed_sec, 7.5);
  EXPECT_EQ(read->part->planned_sec, 9);
  EXPECT_EQ(read->part->ids, part.ids);
  ASSERT_EQ(read->part->left_behind.size(), 1U);
  EXPECT_EQ(read->part->left_behind[0].id, "c");
  ASSERT_EQ(read->part->left_behind[0].way.size(), 2U);
  EXPECT_EQ(read->part->left_behind[0].way[0].x, 0.25);
  EXPECT_EQ(read->part->left_behind[0].way[1].y, 4);
  EXPECT_TRUE(read->part->left_behind[0].removed);
  ASSERT_EQ(read->part->faults.size(), 1U);
  EXPECT_EQ(read->part->faults[0].code, 31);
  EXPECT_EQ(read->part->faults[0].message, "stands");
  ASSERT_EQ(read->part->joined.size(), 2U);
  EXPECT_EQ(read->part->joined[0].id, "d");
  EXPECT_EQ(read->part->joined[0].place.x, 0.75);
  EXPECT_FALSE(read->part->joined[0].waits);
  EXPECT_EQ(read->part->joined[1].place.y, 0.1);
  EXPECT_TRUE(read->part->joined[1].waits);
  EXPECT_FALSE(read->part->joined[0].start);
  ASSERT_TRUE(read->part->joined[1].start);
  EXPECT_EQ(read->part->joined[1].start->x, 2.5);
  EXPECT_EQ(read->part->joined[1].start->y, -1);

  // The same file, its plan cut in the middle of a byte.
  std::string text = contentOf(path);
  const std::string key = "\"plan\":\"";
  text.erase(text.find(key) + key.size(), 1);
  EXPECT_EQ(errorOf([&] { readExecution(file("cut.json", text)); }),
            "its plan is not written in pairs of hexadecimal digits");
}

TEST_F(ExecutionFile, NamesWhatIsWrong) {
  for (const char* text : {"", "{}", "[1]", "{\"format\": \"other\"}", "{\"format\""}) {
    try {
      readExecution(file("bad.json", text));
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("bad.json"), std::string::npos);
    }
  }
  EXPECT_THROW(writeExecution("/nowhere/fleet.json", {}), InputError);
}

TEST_F(ExecutionFile, DoesNotBelieveHowManyVisitsAFileSaysItHas) {
  const std::string path = pathOf("fleet.json");
  FleetSnapshot snapshot;
  snapshot.width = 4;
  snapshot.height = 2;
  snapshot.robots.push_back({"r0", {2, 0}, 3.5, false, 9, {{4, {0, 0}, 0}, {5, {1, 1}, 2}}});
  writeExecution(path, snapshot);
  const std::string text = contentOf(path);
  const auto with = [&](const std::string& part, const std::string& other) {
    std::string changed = text;
    EXPECT_NE(changed.find(part), std::string::npos) << text;
    return file("changed.json", changed.replace(changed.find(part), part.size(), other));
  };
  EXPECT_EQ(readExecution(with("[[4,2]]", "[[4,1],[5,1]]"))->robots[0].visits[1].cell,
            (Cell{1, 1}));
  EXPECT_THROW(readExecution(with("[[4,2]]", "[[4,4000000000]]")), InputError);
  EXPECT_THROW(readExecution(with("\"size\":[4,2]", "\"size\":[0,2]")), InputError);
  EXPECT_THROW(readExecution(with("\"cells\":[0,5]", "\"cells\":[0,\"5\"]")), InputError);
}

TEST_F(ExecutionFile, NamesAFileThatIsCutAnywhere) {
  const std::string path = pathOf("fleet.json");
  FleetSnapshot snapshot;
  snapshot.width = 4;
  snapshot.height = 2;
  snapshot.part = FleetSnapshot::Part();
  snapshot.robots.push_back({"r0", {2, 0}, 3.5, true, 9, {{4, {0, 0}, 0}, {7, {1, 0}, 2}}, 7});
  snapshot.robots.push_back({"r1", {2, 1}, 0, false, 1, {{0, {2, 1}, 0}}});
  writeExecution(path, snapshot);
  const std::string text = contentOf(path);
  // The last byte ends the line.
  for (std::size_t size = 0; size + 1 < text.size(); size += 7) {
    EXPECT_THROW(readExecution(file("cut.json", text.substr(0, size))), InputError) << size;
  }
}

TEST_F(ExecutionFile, RefusesToWriteAnIdThatIsNoUtf8) {
  const std::string path = pathOf("fleet.json");
  FleetSnapshot snapshot;
  snapshot.robots.push_back({"\xff", {0, 0}, 1, false, 1, {{0, {0, 0}, 0}}});
  EXPECT_THROW(writeExecution(path, snapshot), InputError);
  EXPECT_FALSE(readExecution(path)) << "nothing is left behind";
}

TEST_F(ExecutionFile, DoesNotTakeAFileThatItCannotOpenForNone) {
  EXPECT_THROW(readExecution(file("plain", "") + "/fleet.json"), InputError);
}

}  // namespace
}  // namespace split_mapf
