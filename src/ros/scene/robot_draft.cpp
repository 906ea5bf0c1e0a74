#include "ros/scene/robot_draft.h"

#include <algorithm>
#include <cmath>

#include "split_mapf/ros/markers.h"

namespace split_mapf {
namespace {

constexpr float kLineWidth = 0.25F;  // of a robot's radius
constexpr float kGoalHalf = 0.8F;

float distance(ScenePoint a, ScenePoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

void RobotDraft::begin(const std::string& frame, const geometry_msgs::Point& origin) {
  robots_.clear();
  frame_ = frame;
  origin_ = origin;
}

void RobotDraft::takeOver(const SceneMoment& moment) {
  const PlanScene& scene = moment.scene;
  begin(scene.geometry().frame(), scene.geometry().info().origin.position);
  for (std::size_t robot = 0; robot < scene.robots(); ++robot) {
    robots_.push_back(
        {scene.id(robot), moment.fleet.place(scene, robot, moment.step), scene.goal(robot)});
  }
}

std::size_t RobotDraft::complete() const {
  return static_cast<std::size_t>(
      std::count_if(robots_.begin(), robots_.end(),
                    [](const DraftRobot& robot) { return robot.goal.has_value(); }));
}

std::string RobotDraft::freeId() const {
  for (std::size_t number = robots_.size();; ++number) {
    std::string id = "r" + std::to_string(number);
    if (std::none_of(robots_.begin(), robots_.end(),
                     [&](const DraftRobot& robot) { return robot.id == id; })) {
      return id;
    }
  }
}

RobotDraft::Grip RobotDraft::add(ScenePoint point) {
  for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
    if (robots_[robot].goal) continue;
    robots_[robot].goal = point;
    return {robot, End::kGoal};
  }
  robots_.push_back({freeId(), point, std::nullopt});
  return {robots_.size() - 1, End::kStart};
}

std::optional<RobotDraft::Grip> RobotDraft::near(ScenePoint point, float reach_m) const {
  std::optional<Grip> nearest;
  float least = reach_m;
  for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
    const float to_start = distance(robots_[robot].start, point);
    const float to_goal = robots_[robot].goal ? distance(*robots_[robot].goal, point) : to_start;
    if (std::min(to_start, to_goal) > least) continue;
    least = std::min(to_start, to_goal);
    const bool is_goal = robots_[robot].goal && to_goal <= to_start;
    nearest = Grip{robot, is_goal ? End::kGoal : End::kStart};
  }
  return nearest;
}

void RobotDraft::move(Grip grip, ScenePoint point) {
  if (grip.end == End::kGoal) {
    robots_[grip.robot].goal = point;
  } else {
    robots_[grip.robot].start = point;
  }
}

void RobotDraft::remove(std::size_t robot) {
  robots_.erase(robots_.begin() + static_cast<std::ptrdiff_t>(robot));
}

std::vector<RobotTask> RobotDraft::tasks() const {
  std::vector<RobotTask> tasks;
  const auto put = [this](ScenePoint point, geometry_msgs::PoseStamped& pose) {
    pose.header.frame_id = frame_;
    pose.pose.position.x = origin_.x + static_cast<double>(point.x);
    pose.pose.position.y = origin_.y + static_cast<double>(point.y);
    pose.pose.position.z = origin_.z;
  };
  for (const DraftRobot& robot : robots_) {
    if (!robot.goal) continue;
    RobotTask task;
    task.robot_id = robot.id;
    put(robot.start, task.start);
    put(*robot.goal, task.goal);
    tasks.push_back(task);
  }
  return tasks;
}

void RobotDraft::paint(float radius_m, QuadMesh& mesh) const {
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    const DraftRobot& robot = robots_[k];
    const std_msgs::ColorRGBA of_robot = colourOf(k);
    const PackedColour colour = packed(of_robot.r, of_robot.g, of_robot.b);
    mesh.addDisc(robot.start, 1.2F * radius_m, 0, packed(0, 0, 0));
    mesh.addDisc(robot.start, radius_m, 0, colour);
    if (!robot.goal) continue;
    const PackedColour pale = withAlpha(colour, 0.5F);
    mesh.addBar(robot.start, *robot.goal, kLineWidth * radius_m, 0, pale, pale);
    mesh.addSquare(*robot.goal, kGoalHalf * radius_m, 0, packed(0, 0, 0));
    mesh.addSquare(*robot.goal, 0.8F * kGoalHalf * radius_m, 0, colour);
  }
}

}  // namespace split_mapf
