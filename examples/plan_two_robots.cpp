// Two robots change sides on the map of the topic `map`.
#include <ros/ros.h>
#include <split_mapf/client.h>
int main(int argc, char** argv) {
  ros::init(argc, argv, "plan_two_robots");
  const split_mapf::Fleet fleet;
  split_mapf::PlanPathsGoal goal;
  goal.map = fleet.map();
  goal.robots = split_mapf::robotsAtCells(goal.map, {{1, 1}, {5, 1}}, {{5, 1}, {1, 1}});
  ROS_INFO_STREAM(fleet.plan(goal).message);
}
