// What a user does in rviz with a plan from a bag, without a planner: buttons of the panel, the
// tool, the mouse; and plans that are nonsense. rviz finds and loads the plug-in by itself.

#include <gtest/gtest.h>

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rviz/properties/property.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanPathsActionResult.h>
#include <split_mapf/ReplayControl.h>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>

#include "rviz/rviz_window.h"

namespace split_mapf::test {
namespace {

constexpr const char* kDisplay = "SplitMapf/Plan";
constexpr const char* kPlanTopic = "/split_mapf/plan";
QString configuration;
std::string planner_node;

/// 20x10 cells of 1 m: r1 goes along the lowest row, r2 stands in the highest but one.
MultiRobotPlan smallPlan() {
  MultiRobotPlan plan;
  plan.header.frame_id = "map";
  plan.grid.resolution = 1;
  plan.grid.width = 20;
  plan.grid.height = 10;
  plan.grid.origin.orientation.w = 1;
  plan.step_duration = 1;
  plan.paths.resize(2);
  plan.paths[0].robot_id = "r1";
  for (std::uint32_t cell = 0; cell < 20; ++cell) plan.paths[0].cells.push_back(cell);
  plan.paths[1].robot_id = "r2";
  plan.paths[1].cells = {165};
  plan.makespan = 19;
  plan.sum_of_costs = 19;
  return plan;
}

/// A program that runs for as long as this object lives.
class Program {
 public:
  explicit Program(std::vector<std::string> words) {
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    child_ = ::fork();
    if (child_ == 0) {
      ::execvp(arguments[0], arguments.data());
      ::_exit(127);
    }
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    ::kill(child_, SIGINT);
    ::waitpid(child_, nullptr, 0);
  }

 private:
  pid_t child_ = -1;
};

/// A folder that is gone with this object.
class Folder {
 public:
  Folder() {
    char name[] = "/tmp/split_mapf_player_XXXXXX";
    name_ = ::mkdtemp(name);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    for (const std::string& file : files_) std::remove(file.c_str());
    ::rmdir(name_.c_str());
  }
  std::string file(const std::string& name) {
    files_.push_back(name_ + "/" + name);
    return files_.back();
  }

 private:
  std::string name_;
  std::vector<std::string> files_;
};

/// A header of a bag's connection has to have all of these once it is given.
boost::shared_ptr<ros::M_string> latchedHeader() {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["topic"] = kPlanTopic;
  (*header)["type"] = ros::message_traits::datatype<MultiRobotPlan>();
  (*header)["md5sum"] = ros::message_traits::md5sum<MultiRobotPlan>();
  (*header)["message_definition"] = ros::message_traits::definition<MultiRobotPlan>();
  (*header)["latching"] = "1";
  return header;
}

void writeBag(const std::string& file) {
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  bag.write(kPlanTopic, ros::Time(100), smallPlan(), latchedHeader());
  PlanPathsActionResult result;
  result.result.message = "valid plan";
  // Later, so that who subscribes at the begin hears it.
  bag.write("/split_mapf/plan_paths/result", ros::Time(104), result);
}

class Player : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    window = std::make_unique<RvizWindow>(configuration).release();
    folder = std::make_unique<Folder>().release();
    const std::string file = folder->file("plan.bag");
    writeBag(file);
    // What is sent once is heard by who has subscribed, and a display does so with its first frame.
    ASSERT_TRUE(window->drawFrames(1));
    const Program bag({"rosbag", "play", "-q", "--keep-alive", file});
    ASSERT_TRUE(window->waitForText("costs", "2 robots, makespan 19, sum of costs 19"))
        << window->textOf("costs");
    // Sent once, from the bag.
    outcome_came = window->waitForText("outcome", "SUCCEEDED: valid plan");
  }
  static void TearDownTestSuite() {
    std::unique_ptr<Folder>(folder).reset();
    std::unique_ptr<RvizWindow>(window).reset();
  }
  void SetUp() override {
    ASSERT_NE(window->display(kDisplay), nullptr);
    if (window->widget<QPushButton>("play")->text() == "Pause") click("play");
    click("start");
    ASSERT_TRUE(window->waitForText("now", "step 0.0 of 19"));
  }
  static void click(const char* button) {
    auto* found = window->widget<QPushButton>(button);
    ASSERT_NE(found, nullptr) << button;
    found->click();
  }
  /// Where the middle of r2's cell (5,8) is seen, 4.5 m left of the map's middle and 3.5 m above
  /// it.
  static QPoint placeOfR2() {
    const double scale =
        window->manager().getViewManager()->getCurrent()->subProp("Scale")->getValue().toDouble();
    return {static_cast<int>(window->view().width() / 2.0 - 4.5 * scale),
            static_cast<int>(window->view().height() / 2.0 - 3.5 * scale)};
  }
  /// The step that the panel tells.
  static double stepNow() { return std::stod(window->textOf("now").substr(5)); }
  /// Where the view's middle is.
  static double viewX() {
    return window->manager().getViewManager()->getCurrent()->subProp("X")->getValue().toDouble();
  }

  static RvizWindow* window;
  static Folder* folder;
  static bool outcome_came;
};
RvizWindow* Player::window = nullptr;
Folder* Player::folder = nullptr;
bool Player::outcome_came = false;

TEST_F(Player, ShowsTheOutcomeOfTheGoalInTheBag) { EXPECT_TRUE(outcome_came); }

TEST_F(Player, StepsForwardAndBack) {
  click("forward");
  click("forward");
  EXPECT_TRUE(window->waitForText("now", "step 2.0 of 19"));
  click("back");
  EXPECT_TRUE(window->waitForText("now", "step 1.0 of 19"));
  EXPECT_EQ(window->widget<QPushButton>("play")->text(), "Play");
}

TEST_F(Player, PlaysToTheEndAndAgainWhereItLoops) {
  window->widget<QDoubleSpinBox>("speed")->setValue(40);
  click("play");
  EXPECT_TRUE(window->waitForText("now", "step 19.0 of 19"));
  EXPECT_TRUE(
      window->waitFor([] { return window->widget<QPushButton>("play")->text() == "Play"; }));
  window->widget<QCheckBox>("loop")->setChecked(true);
  EXPECT_TRUE(
      window->waitFor([] { return window->textOf("now").find("step 19.0") == std::string::npos; }));
  window->widget<QCheckBox>("loop")->setChecked(false);
  window->widget<QDoubleSpinBox>("speed")->setValue(0);
}

TEST_F(Player, StandsStillWhileItsDisplayIsDisabled) {
  window->widget<QDoubleSpinBox>("speed")->setValue(1);
  click("play");
  ASSERT_TRUE(window->waitFor([] { return stepNow() > 0; }));
  window->display(kDisplay)->setEnabled(false);
  const double before = stepNow();
  QElapsedTimer clock;
  clock.start();
  ASSERT_TRUE(window->waitFor([&] { return clock.elapsed() > 6000; }));
  window->display(kDisplay)->setEnabled(true);
  ASSERT_TRUE(window->waitFor([&] { return stepNow() > before + 0.3; }));
  EXPECT_LT(stepNow(), before + 5);
  click("play");
  window->widget<QDoubleSpinBox>("speed")->setValue(0);
}

TEST_F(Player, GoesWhereTheSliderIs) {
  window->widget<QSlider>("time")->setValue(75);
  EXPECT_TRUE(window->waitForText("now", "step 7.5 of 19"));
}

TEST_F(Player, FindsAndFollowsARobot) {
  window->widget<QLineEdit>("search")->setText("r1");
  click("follow");
  EXPECT_TRUE(window->waitForText("robot", "r1, moving\nstep 0.0 of 19"));
  window->widget<QSlider>("time")->setValue(100);
  EXPECT_TRUE(window->waitFor([] { return std::abs(viewX() - 10.5) < 0.01; })) << viewX();
  EXPECT_EQ(window->widget<QPushButton>("follow")->text(), "Leave");
  click("fit");
  EXPECT_TRUE(window->waitFor([] { return std::abs(viewX() - 10) < 0.01; })) << viewX();
  EXPECT_EQ(window->widget<QPushButton>("follow")->text(), "Follow");
  window->widget<QLineEdit>("search")->setText("nobody");
  click("follow");
  EXPECT_TRUE(window->waitForText("robot", "no robot 'nobody'"));
}

TEST_F(Player, TellsOfTheRobotUnderTheMouse) {
  click("fit");
  ASSERT_TRUE(window->drawFrames(3));
  window->moveMouse(placeOfR2().x(), placeOfR2().y());
  EXPECT_TRUE(window->waitForText("robot", "r2, arrived")) << window->textOf("robot");
  window->takeMouseAway();
  window->widget<QLineEdit>("search")->setText("r1");
  click("follow");
  EXPECT_TRUE(window->waitForText("robot", "r1, moving")) << window->textOf("robot");
  click("fit");
}

TEST_F(Player, PlacesMovesAndTakesAwayRobotsAndSaysThatNobodyPlans) {
  click("fit");
  click("clear");
  ASSERT_TRUE(window->chooseTool("SplitMapf/PlaceRobots"));
  ASSERT_TRUE(window->drawFrames(3));
  window->clickAt(200, 300);
  window->clickAt(300, 300);
  window->clickAt(200, 400);
  EXPECT_TRUE(window->waitForText("placed", "2 robots placed, 1 of them with a goal"));
  window->drag({300, 300}, {300, 350});
  window->clickAt(300, 350, Qt::RightButton);
  EXPECT_TRUE(window->waitForText("placed", "1 robots placed, 0 of them with a goal"));
  click("take_over");
  EXPECT_TRUE(window->waitForText("placed", "2 robots placed, 2 of them with a goal"));
  click("ask");
  EXPECT_TRUE(window->waitForText("said", "no planner answers on /split_mapf/plan_paths"));
  click("clear");
  EXPECT_TRUE(window->waitForText("placed", "place starts and goals"));
  ASSERT_TRUE(window->chooseTool("rviz/Interact"));
}

TEST_F(Player, IsNotHeldUpByAReplayThatIsNotThere) {
  window->widget<QLineEdit>("service")->setText("/nowhere/control");
  window->widget<QCheckBox>("linked")->setChecked(true);
  click("forward");
  EXPECT_TRUE(window->waitForText("link_fault", "no replay_node answers on /nowhere/control"));
  window->widget<QCheckBox>("linked")->setChecked(false);
  EXPECT_EQ(window->textOf("link_fault"), "");
}

TEST_F(Player, HandsOnWhatItDoesToALinkedReplay) {
  std::vector<int> commands;
  std::mutex mutex;
  ros::NodeHandle node;
  ros::CallbackQueue queue;
  node.setCallbackQueue(&queue);
  const boost::function<bool(ReplayControl::Request&, ReplayControl::Response&)> obey =
      [&](ReplayControl::Request& request, ReplayControl::Response& response) {
        const std::lock_guard<std::mutex> lock(mutex);
        commands.push_back(request.command);
        response.ok = true;
        return true;
      };
  const ros::ServiceServer server = node.advertiseService("/other_replay/control", obey);
  ros::AsyncSpinner spinner(1, &queue);
  spinner.start();
  window->widget<QLineEdit>("service")->setText("/other_replay/control");
  window->widget<QCheckBox>("linked")->setChecked(true);
  click("forward");
  click("play");
  EXPECT_TRUE(window->waitFor([&] {
    const std::lock_guard<std::mutex> lock(mutex);
    return commands == std::vector<int>{ReplayControl::Request::STEP, ReplayControl::Request::PLAY};
  }));
  window->widget<QCheckBox>("linked")->setChecked(false);
}

TEST_F(Player, SurvivesPlansThatAreNonsense) {
  ros::NodeHandle node;
  const ros::Publisher publisher = node.advertise<MultiRobotPlan>(kPlanTopic, 10);
  ASSERT_TRUE(window->waitFor([&] { return publisher.getNumSubscribers() > 0; }));
  const auto expect = [&](const MultiRobotPlan& plan, const std::string& fault) {
    publisher.publish(plan);
    EXPECT_TRUE(window->waitFor([&] {
      return window->statusOf(kDisplay, "Plan").find(fault) != std::string::npos;
    })) << fault
        << " is not " << window->statusOf(kDisplay, "Plan");
    EXPECT_TRUE(window->drawFrames(2));
  };
  MultiRobotPlan plan = smallPlan();
  plan.step_duration = std::numeric_limits<double>::quiet_NaN();
  expect(plan, "step_duration is nan");
  plan = smallPlan();
  plan.paths[1].radius = std::numeric_limits<double>::infinity();
  expect(plan, "'r2' has a radius of inf");
  plan = smallPlan();
  plan.paths[1].cells.clear();
  expect(plan, "path of robot 'r2' is empty");
  plan = smallPlan();
  plan.paths[1].cells.push_back(4000000000U);
  expect(plan, "enters cell 4000000000");
  plan = smallPlan();
  plan.grid.width = 0;
  expect(plan, "0x10 cells");
  plan = smallPlan();
  plan.grid.width = plan.grid.height = 4000000000U;
  expect(plan, "4000000000x4000000000 cells");
  plan = smallPlan();
  plan.grid.resolution = std::numeric_limits<float>::quiet_NaN();
  expect(plan, "resolution");
  plan = smallPlan();
  plan.longest_step = 1;
  plan.departure_steps = 4000000000U;
  expect(plan, "longer than a plan may be");
  plan = smallPlan();
  plan.header.frame_id = "nowhere";
  publisher.publish(plan);
  EXPECT_TRUE(window->waitFor([&] {
    return window->statusOf(kDisplay, "Frame").find("no transform from frame 'nowhere'") !=
           std::string::npos;
  }));
  // Another makespan than its paths have: shown, with a warning.
  plan = smallPlan();
  plan.makespan = 5;
  expect(plan, "claims makespan 5");
  publisher.publish(smallPlan());
  EXPECT_TRUE(window->waitFor([&] {
    return window->statusOf(kDisplay, "Plan") == "2 robots, makespan 19, sum of costs 19";
  }));
}

TEST_F(Player, HasRobotsThatItTookOverWhereAMapLiesElsewhere) {
  ros::NodeHandle node;
  const ros::Publisher publisher = node.advertise<MultiRobotPlan>(kPlanTopic, 10);
  ASSERT_TRUE(window->waitFor([&] { return publisher.getNumSubscribers() > 0; }));
  const auto seen = [](double x) {
    return window->waitFor([x] {
      click("fit");
      return std::abs(viewX() - x) < 0.01;
    });
  };
  MultiRobotPlan plan = smallPlan();
  plan.grid.origin.position.x = 100;
  publisher.publish(plan);
  ASSERT_TRUE(seen(110)) << viewX();
  click("take_over");
  ASSERT_TRUE(window->waitForText("placed", "2 robots placed, 2 of them with a goal"));
  ASSERT_TRUE(window->chooseTool("SplitMapf/PlaceRobots"));
  ASSERT_TRUE(window->drawFrames(3));
  window->clickAt(placeOfR2().x(), placeOfR2().y(), Qt::RightButton);
  EXPECT_TRUE(window->waitForText("placed", "1 robots placed")) << window->textOf("placed");
  click("clear");
  ASSERT_TRUE(window->chooseTool("rviz/Interact"));
  publisher.publish(smallPlan());
  EXPECT_TRUE(seen(10)) << viewX();
}

TEST_F(Player, HasAPlannerPlanForThePlansRobots) {
  const std::string map = folder->file("small.map");
  std::ofstream(map) << "type octile\nheight 10\nwidth 20\nmap\n" + []() {
    std::string rows;
    for (int row = 0; row < 10; ++row) rows += std::string(20, '.') + "\n";
    return rows;
  }();
  const Program planner({planner_node, "__name:=split_mapf", "_map_file:=" + map});
  click("take_over");
  ASSERT_TRUE(window->waitFor([] {
    window->widget<QPushButton>("ask")->click();
    QApplication::processEvents();
    return window->textOf("said").find("no planner answers") == std::string::npos;
  })) << window->textOf("said");
  EXPECT_TRUE(window->waitForText("said", "SUCCEEDED")) << window->textOf("said");
  EXPECT_TRUE(window->waitForText("costs", "2 robots, makespan 19, sum of costs 19"));
  click("clear");
}

}  // namespace
}  // namespace split_mapf::test

int main(int argc, char** argv) {
  ros::init(argc, argv, "player_rostest", ros::init_options::NoSigintHandler);
  QApplication application(argc, argv);
  ::testing::InitGoogleTest(&argc, argv);
  if (argc < 2) return 2;
  split_mapf::test::configuration = argv[1];
  const std::string program = argv[0];
  split_mapf::test::planner_node = program.substr(0, program.rfind('/') + 1) + "planner_node";
  const ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
