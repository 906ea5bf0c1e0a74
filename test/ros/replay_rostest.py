#!/usr/bin/env python3
"""planner.launch as a user starts it: the replay's markers, latched topics, a path a robot."""

import os
import shutil
import tempfile
import time
import unittest

import rospy
import rosunit
from nav_msgs.msg import OccupancyGrid, Path
from visualization_msgs.msg import Marker, MarkerArray

from ros_processes import (Program, Recorder, SentGoal, action_client, robots_of, wait_until,
                           warehouse_goal, write_instance)
from split_mapf.msg import MultiRobotPlan, PlanOutcome
from split_mapf.srv import ReplayControl, ReplayControlRequest


class Replay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("replay_rostest")
        cls.directory = tempfile.mkdtemp()
        map_path, _ = write_instance(cls.directory)
        parameters = os.path.join(cls.directory, "parameters.yaml")
        with open(parameters, "w", encoding="ascii") as file:
            file.write("publish_paths: true\nsplit: none\nstep_duration: 0.5\n")
        cls.launch = Program("roslaunch", "split_mapf", "planner.launch", "rviz:=false",
                             "map_file:=" + map_path, "params_file:=" + parameters,
                             "replay_speed:=2.5", "replay_loop:=false")
        cls.client = action_client()
        rospy.wait_for_service("replay/control", 20)
        cls.control = rospy.ServiceProxy("replay/control", ReplayControl)
        rospy.wait_for_message("map", OccupancyGrid, timeout=20)
        cls.plan = cls.send(4)

    @classmethod
    def tearDownClass(cls):
        cls.launch.end()
        shutil.rmtree(cls.directory)

    @classmethod
    def send(cls, robots):
        """Plans on the map of the topic `map`, and waits until the replay has the plan."""
        goal = warehouse_goal(with_map=False)
        del goal.robots[robots:]
        markers = Recorder("replay/markers", MarkerArray)
        sent = SentGoal(cls.client, goal)
        assert sent.wait_for_end(30), cls.launch.output()
        assert sent.result().outcome == PlanOutcome.SUCCEEDED, sent.result().message
        assert wait_until(
            lambda: markers.messages and len(robots_of(markers.messages[-1])) == robots)
        markers.close()
        return sent.result().plan

    def command(self, command, value=0.0):
        answer = self.control(command=command, value=value)
        self.assertTrue(answer.ok, answer.message)
        return answer.message

    def latest_markers(self):
        """Markers that were published after this call."""
        markers = Recorder("replay/markers", MarkerArray)
        self.assertTrue(markers.wait_for(1))
        time.sleep(0.3)
        markers.close()
        return markers.messages[-1]

    def cells_at(self, step):
        """Centres of the cells that the plan has the robots in."""
        cells = [path.cells[min(step, len(path.cells) - 1)] for path in self.plan.paths]
        return [(cell % 24 + 0.5, cell // 24 + 0.5) for cell in cells]

    def assert_robots_at(self, step):
        for found, expected in zip(robots_of(self.latest_markers()), self.cells_at(step)):
            self.assertAlmostEqual(found[0], expected[0], places=3)
            self.assertAlmostEqual(found[1], expected[1], places=3)

    def test_moves_every_robot_from_start_to_goal(self):
        self.command(ReplayControlRequest.SEEK, 0)
        markers = Recorder("replay/markers", MarkerArray)
        self.command(ReplayControlRequest.PLAY)
        arrived = self.cells_at(10 ** 6)

        def is_home():
            return markers.messages and all(
                abs(x - goal_x) < 1e-3 and abs(y - goal_y) < 1e-3 for (x, y), (goal_x, goal_y)
                in zip(robots_of(markers.messages[-1]), arrived))
        begin = time.monotonic()
        self.assertTrue(wait_until(is_home, 30))
        # 0.5 s a step, 2.5 times as fast.
        self.assertAlmostEqual(time.monotonic() - begin, self.plan.makespan * 0.2, delta=1.5)
        ways = [robots_of(array) for array in markers.messages]
        self.assertGreater(len(ways), 30)
        for robot in range(4):
            self.assertGreater(len({way[robot] for way in ways}), 20, "robot %d stands" % robot)
            # Smoothly: never further in one message than a robot can go in half a second.
            for before, after in zip(ways, ways[1:]):
                jump = abs(before[robot][0] - after[robot][0]) + abs(
                    before[robot][1] - after[robot][1])
                self.assertLess(jump, 2.5)
        markers.close()

    def test_uses_few_markers_with_fixed_names(self):
        self.command(ReplayControlRequest.SEEK, 5)
        array = self.latest_markers()
        names = sorted((marker.ns, marker.id) for marker in array.markers)
        self.assertEqual(names, [("goals", 0), ("robots", 0), ("trails", 0)])
        for marker in array.markers:
            self.assertEqual(marker.action, Marker.ADD)
            self.assertEqual(marker.header.frame_id, "map")
            self.assertEqual(len(marker.points), len(marker.colors))

    def test_obeys_the_control_service(self):
        self.command(ReplayControlRequest.PAUSE)
        self.command(ReplayControlRequest.SEEK, 3)
        self.assert_robots_at(3)
        self.command(ReplayControlRequest.STEP)
        self.assert_robots_at(4)
        self.command(ReplayControlRequest.STEP, -2)
        self.assert_robots_at(2)
        self.command(ReplayControlRequest.SEEK, self.plan.makespan)
        self.command(ReplayControlRequest.LOOP, 1)
        self.command(ReplayControlRequest.SPEED, 2.5)
        self.command(ReplayControlRequest.LOOP, 0)

    def test_refuses_commands_that_make_no_sense(self):
        for command, value, part in ((ReplayControlRequest.SPEED, 0, "> 0"),
                                     (ReplayControlRequest.SPEED, float("nan"), "finite"),
                                     (ReplayControlRequest.SEEK, -1, "step from 0"),
                                     (ReplayControlRequest.SEEK, 1e6, "step from 0"),
                                     (77, 0, "none of PLAY")):
            answer = self.control(command=command, value=value)
            self.assertFalse(answer.ok)
            self.assertIn(part, answer.message)

    def test_serves_late_subscribers(self):
        time.sleep(1)
        plan = rospy.wait_for_message("split_mapf/plan", MultiRobotPlan, timeout=10)
        self.assertEqual([path.robot_id for path in plan.paths],
                         ["robot_%d" % i for i in range(4)])
        self.assertEqual(plan.grid.width, 24)
        grid = rospy.wait_for_message("split_mapf/planning_grid", OccupancyGrid, timeout=10)
        self.assertEqual(list(grid.data), list(warehouse_goal().map.data))
        self.assertEqual(grid.header.frame_id, "map")
        published = rospy.wait_for_message("map", OccupancyGrid, timeout=10)
        self.assertEqual(list(published.data), list(grid.data))
        self.latest_markers()

    def test_publishes_a_path_a_robot(self):
        for robot, path_of_plan in enumerate(self.plan.paths):
            path = rospy.wait_for_message("robot_%d/path" % robot, Path, timeout=10)
            self.assertEqual(len(path.poses), len(path_of_plan.cells))
            self.assertEqual(path.header.frame_id, "map")
            last = path.poses[-1]
            self.assertAlmostEqual(
                (last.header.stamp - path.header.stamp).to_sec(), 0.5 * (len(path.poses) - 1))
            x, y = self.cells_at(10 ** 6)[robot]
            self.assertAlmostEqual(last.pose.position.x, x)
            self.assertAlmostEqual(last.pose.position.y, y)

    def test_withdraws_paths_of_robots_that_are_gone(self):
        def paths():
            return sorted(name for name, _ in rospy.get_published_topics() if "/path" in name)
        type(self).plan = self.send(2)
        self.assertTrue(wait_until(lambda: paths() == ["/robot_0/path", "/robot_1/path"], 5),
                        paths())
        type(self).plan = self.send(4)
        self.assertEqual(len(paths()), 4)

    def test_refuses_names_that_collide(self):
        goal = warehouse_goal(with_map=False)
        goal.robots[1].robot_id = "robot-0"
        sent = SentGoal(self.client, goal)
        self.assertTrue(sent.wait_for_end())
        self.assertEqual(sent.result().outcome, PlanOutcome.INVALID_OPTION)
        self.assertIn("robot_0/path", sent.result().message)

    def test_survives_plans_that_cannot_be_shown(self):
        publisher = rospy.Publisher("split_mapf/plan", MultiRobotPlan, queue_size=5)
        self.assertTrue(wait_until(lambda: publisher.get_num_connections() > 0))
        broken = rospy.wait_for_message("split_mapf/plan", MultiRobotPlan, timeout=10)
        broken.paths[0].cells = [10 ** 6]
        publisher.publish(broken)
        publisher.publish(MultiRobotPlan())
        time.sleep(0.5)
        publisher.unregister()
        self.command(ReplayControlRequest.SEEK, 2)
        self.assertEqual(len(robots_of(self.latest_markers())), 4)


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "replay_rostest", Replay)
