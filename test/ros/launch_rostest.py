#!/usr/bin/env python3
"""Starting what the package has the way a user does: without a display, and by rosrun."""

import importlib.util
import os
import unittest

import roslib.packages
import rospy
import rosunit
import yaml
from nav_msgs.msg import MapMetaData

from ros_processes import Program, wait_until


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

    def test_the_view_of_rviz_fits_a_map_of_any_size(self):
        package = roslib.packages.get_pkg_dir("split_mapf")
        source = importlib.util.spec_from_file_location(
            "start_rviz", os.path.join(package, "scripts", "start_rviz.py"))
        start_rviz = importlib.util.module_from_spec(source)
        source.loader.exec_module(start_rviz)
        info = MapMetaData(width=40, height=20, resolution=0.5)
        info.origin.position.x = 100
        with open(os.path.join(package, "rviz", "split_mapf.rviz"), encoding="utf-8") as file:
            before = yaml.safe_load(file)
            file.seek(0)
            after = yaml.safe_load(start_rviz.fitted(file.read(), info))
        view = after["Visualization Manager"]["Views"]["Current"]
        self.assertEqual((view["X"], view["Y"]), (110, 5))
        self.assertGreater(view["Scale"] * 20, 600)
        self.assertLess(view["Scale"] * 20, 700)
        self.assertEqual(after["Window Geometry"], before["Window Geometry"])

    def test_a_warehouse_of_either_language_brings_its_orders_home(self):
        for manager, radius in (("warehouse_manager.py", 0.0), ("warehouse_manager", 0.3)):
            demo = Program("roslaunch", "split_mapf", "warehouse_demo.launch", "robots:=6",
                           "columns:=1", "rows:=2", "orders:=6", "speed:=8.0", "rviz:=false",
                           "robot_radius:=%g" % radius, "manager:=" + manager)
            self.addCleanup(demo.end)
            for name, expected in (("/fleet/robot_radius", radius),
                                   ("/fake_robots/diameter", 2 * radius)):
                self.assertTrue(wait_until(lambda of=name, it=expected: rospy.get_param(
                    of, None) == it), "%s: %s" % (name, demo.output()))
            self.assertTrue(demo.wait_for_output(" 6 orders done"), demo.output())
            self.assertIn("0 moves failed", demo.output())
            demo.wait()
            self.assertNotIn("Traceback", demo.output())

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
