#include "split_mapf/io/task_file.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "io/temporary_files.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

class TaskFileTest : public test::FileTest {
 protected:
  std::string errorOfLists(const std::string& text,
                           std::optional<std::uint32_t> agents = std::nullopt) const {
    const std::string path = file("t.yaml", text);
    return errorOf([&] { readGoalLists(path, *grid_, agents); });
  }
  std::string errorOfAgents(const std::string& text,
                            std::optional<std::uint32_t> agents = std::nullopt) const {
    const std::string path = file("t.agents", text);
    return errorOf([&] { readLeagueAgents(path, *grid_, agents); });
  }
  std::string errorOfTasks(const std::string& text) const {
    const std::string path = file("t.tasks", text);
    return errorOf([&] { readLeagueTasks(path, *grid_); });
  }

  std::shared_ptr<const Grid> grid_ = test::gridFromAscii({"...#.", "...#."});
};

TEST_F(TaskFileTest, ReadsListsOfGoals) {
  const std::string path = file("t.yaml",
                                "robots:\n"
                                "- {start: [0, 1], goals: [[2, 0], [2, 0], [0, 1]]}\n"
                                "- start: [4, 0]\n");
  const GoalLists lists = readGoalLists(path, *grid_);
  EXPECT_EQ(lists.starts, (std::vector<Cell>{{0, 1}, {4, 0}}));
  EXPECT_EQ(lists.goals, (std::vector<std::vector<Cell>>{{{2, 0}, {2, 0}, {0, 1}}, {}}));
  EXPECT_EQ(readGoalLists(path, *grid_, 1).starts.size(), 1U);
}

TEST_F(TaskFileTest, NamesRobotCellAndLineOfABadList) {
  const std::string one = "robots:\n- {start: [0, 0]}\n";
  EXPECT_EQ(errorOfLists(one + "- {start: [1, 1], goals: [[0, 1], [3, 0]]}\n"),
            "t.yaml:3: robot 1: goal 1: read (3,0), which is blocked, expected a free cell");
  EXPECT_EQ(errorOfLists(one + "- {start: [1, 1],\n   goals: [[0, 9]]}\n"),
            "t.yaml:4: robot 1: goal 0: read (0,9), which is outside the map, expected x below 5 "
            "and y below 2");
  EXPECT_EQ(errorOfLists(one + "- {start: [1, 1], goals: [[4, 1]]}\n"),
            "t.yaml:3: robot 1: goal 0: read (4,1), which is cut off from its start (1,1), "
            "expected a cell that it can reach");
  EXPECT_EQ(
      errorOfLists(one + "- {start: [0, 0]}\n"),
      "t.yaml:3: robot 1: start: read (0,0), where robot 0 starts, expected a cell of its own");
  EXPECT_EQ(errorOfLists(one + "- {goals: []}\n"),
            "t.yaml:3: robot 1: start is missing, expected [x, y]");
  EXPECT_EQ(errorOfLists(one + "- {start: [1, 1], goal: [0, 0]}\n"),
            "t.yaml:3: robot 1: read the key 'goal', expected start or goals");
  EXPECT_EQ(errorOfLists(one + "- {start: [1.5, 1]}\n"),
            "t.yaml:3: robot 1: start: read no cell, expected two whole numbers [x, y]");
  EXPECT_EQ(errorOfLists(one, 2), "t.yaml:2: robots: read 1 robot, expected 2 robots");
  EXPECT_NE(errorOfLists("robots: [").find("t.yaml:1: read malformed YAML"), std::string::npos);
  EXPECT_NE(errorOfLists("[]").find("t.yaml:1: read something else"), std::string::npos);
  EXPECT_NE(errorOfLists("robots: []").find("read no robots"), std::string::npos);
}

TEST_F(TaskFileTest, ReadsTheLeaguesFiles) {
  const std::string agents = file("t.agents", "# version for LoRR 2024\n3\n0\n5\n4\n");
  EXPECT_EQ(readLeagueAgents(agents, *grid_), (std::vector<Cell>{{0, 0}, {0, 1}, {4, 0}}));
  EXPECT_EQ(readLeagueAgents(agents, *grid_, 2).size(), 2U);
  const std::string tasks = file("t.tasks", "# version for LoRR 2024\n2\n1,7\n6\n");
  EXPECT_EQ(readLeagueTasks(tasks, *grid_),
            (std::vector<std::vector<Cell>>{{{1, 0}, {2, 1}}, {{1, 1}}}));
}

TEST_F(TaskFileTest, NamesTheLineOfABadFileOfTheLeague) {
  EXPECT_EQ(errorOfAgents("2\n0\n3\n"),
            "t.agents:3: read '3', the blocked cell (3,0), expected a free cell");
  EXPECT_EQ(errorOfAgents("2\n0\n0\n"),
            "t.agents:3: read (0,0), where robot 0 starts, expected a cell of its own for robot 1");
  EXPECT_EQ(errorOfAgents("1\n0,1\n"), "t.agents:2: read 2 cells, expected the cell of a robot");
  EXPECT_EQ(errorOfAgents("1\n0\n", 2), "t.agents:1: read 1 robot, expected 2 robots");
  EXPECT_EQ(errorOfTasks("x\n"), "t.tasks:1: read 'x', expected the number of tasks");
  EXPECT_EQ(errorOfTasks("1\n10\n"), "t.tasks:2: read '10', expected a cell of the map, below 10");
  EXPECT_EQ(errorOfTasks("1\n1,,2\n"), "t.tasks:2: read '', expected the cells of a task");
  EXPECT_NE(errorOfTasks("2\n1\n").find("t.tasks:3:"), std::string::npos);
  EXPECT_EQ(errorOfTasks("1\n1\n\n# more\n2\n"),
            "t.tasks:5: read '2', expected the end of the file: its first row announces 1 task");
  EXPECT_EQ(errorOfAgents("1\n0\n1\n"),
            "t.agents:3: read '1', expected the end of the file: its first row announces 1 robot");
}

}  // namespace
}  // namespace split_mapf
