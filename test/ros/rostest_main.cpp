// The main() of the rostests in C++: their callbacks come in threads of their own.

#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rostest");
  ros::AsyncSpinner spinner(4);
  ros::NodeHandle node;  // keeps ROS started between two tests
  spinner.start();
  return RUN_ALL_TESTS();
}
