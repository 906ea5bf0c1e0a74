#!/usr/bin/env python3
"""Starting what the package has the way a user does: without a display, and by rosrun."""

import os
import unittest

import roslib.packages
import rospy
import rosunit

from ros_processes import Program


class Launch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("launch_rostest")

    def assert_starts_without_rviz(self, fault, **environment):
        planner = Program("roslaunch", "split_mapf", "planner.launch",
                          env=dict(environment, QT_QPA_PLATFORM=""))
        self.addCleanup(planner.end)
        self.assertTrue(planner.wait_for_output("rviz is not started: " + fault),
                        planner.output())
        self.assertTrue(planner.wait_for_output("ready:"), planner.output())
        self.assertTrue(planner.wait_for_output("waiting for a plan"), planner.output())
        self.assertTrue(planner.wait_for_output("finished cleanly"), planner.output())
        for trouble in ("Qt", "qt.qpa", "has died", "ERROR", "Traceback"):
            self.assertNotIn(trouble, planner.output())
        self.assertIsNone(planner.process.poll())
        planner.end()

    def test_a_launch_without_a_display_says_a_sentence(self):
        self.assert_starts_without_rviz("there is no display", DISPLAY="")

    def test_a_launch_with_a_display_that_is_gone_says_a_sentence(self):
        self.assert_starts_without_rviz("the display :4711 (DISPLAY) cannot be opened",
                                        DISPLAY=":4711")

    def test_rosrun_finds_the_nodes_after_scripts_build(self):
        node = roslib.packages.find_node("split_mapf", "planner_node")[0]
        link = os.path.join(roslib.packages.get_pkg_dir("split_mapf"), "bin", "planner_node")
        if not os.path.islink(link) or not os.path.samefile(node, link):
            self.skipTest("this build is not one of scripts/build")
        for name, part in (("planner_node", "ready:"), ("replay_node", "waiting for a plan")):
            program = Program("rosrun", "split_mapf", name)
            self.addCleanup(program.end)
            self.assertTrue(program.wait_for_output(part), program.output())
            self.assertNotIn("[rosrun]", program.output())
            program.end()


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "launch_rostest", Launch)
