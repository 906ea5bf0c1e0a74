#!/usr/bin/env python3
"""planner.launch as a user starts it: the replay's markers, latched topics, a path a robot."""

import os
import shutil
import tempfile
import unittest

import rospy
import rosunit
from nav_msgs.msg import OccupancyGrid, Path
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import Marker, MarkerArray

from ros_processes import (PATIENCE, Program, Recorder, SentGoal, action_client, robots_of, wait_until,
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
        rospy.wait_for_service("replay/control", PATIENCE)
        cls.control = rospy.ServiceProxy("replay/control", ReplayControl)
        rospy.wait_for_message("map", OccupancyGrid, timeout=PATIENCE)
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
        assert sent.wait_for_end(), cls.launch.output()
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
        """The latched ones, or later ones."""
        return rospy.wait_for_message("replay/markers", MarkerArray, timeout=PATIENCE)

    def cells_at(self, step):
        """Centres of the cells that the plan has the robots in."""
        cells = [path.cells[min(step, len(path.cells) - 1)] for path in self.plan.paths]
        return [(cell % 24 + 0.5, cell // 24 + 0.5) for cell in cells]

    def are_at(self, array, step):
        return all(abs(x - cell_x) < 1e-3 and abs(y - cell_y) < 1e-3 for (x, y), (cell_x, cell_y)
                   in zip(robots_of(array), self.cells_at(step)))

    def assert_robots_at(self, step):
        self.assertTrue(wait_until(lambda: self.are_at(self.latest_markers(), step)),
                        robots_of(self.latest_markers()))

    def test_moves_every_robot_from_start_to_goal(self):
        self.command(ReplayControlRequest.PAUSE)
        self.command(ReplayControlRequest.SEEK, 0)
        self.assert_robots_at(0)
        markers = Recorder("replay/markers", MarkerArray)
        self.assertTrue(markers.wait_for(1))
        self.command(ReplayControlRequest.PLAY)
        self.assertTrue(wait_until(lambda: self.are_at(markers.messages[-1], 10 ** 6)))
        markers.close()
        ways = [robots_of(array) for array in markers.messages]
        stamps = [array.markers[0].header.stamp.to_sec() for array in markers.messages]
        # 0.5 s a step, 2.5 times as fast; between two messages anything may have ended.
        home = next(i for i, array in enumerate(markers.messages) if self.are_at(array, 10 ** 6))
        begin = next(i for i, array in enumerate(markers.messages) if not self.are_at(array, 0))
        self.assertGreater(stamps[home] - stamps[begin - 1], self.plan.makespan * 0.2 - 0.05)
        self.assertLess(stamps[home - 1] - stamps[begin], self.plan.makespan * 0.2 + 0.05)
        for robot in range(4):
            self.assertGreater(len({way[robot] for way in ways}), 10, "robot %d stands" % robot)
            # Smoothly: never further between two messages than a robot can go in their time.
            for i in range(begin, home):
                jump = abs(ways[i][robot][0] - ways[i + 1][robot][0]) + abs(
                    ways[i][robot][1] - ways[i + 1][robot][1])
                self.assertLess(jump, 5 * (stamps[i + 1] - stamps[i]) + 0.1)

    def test_sends_goals_once_and_again_to_who_comes_later(self):
        self.command(ReplayControlRequest.PAUSE)
        self.command(ReplayControlRequest.SEEK, 0)
        markers = Recorder("replay/markers", MarkerArray)
        self.assertTrue(wait_until(lambda: any(self.goals_of(array) for array in markers.messages)))
        seen = len(markers.messages)
        self.command(ReplayControlRequest.PLAY)
        self.assertTrue(markers.wait_for(seen + 12))
        # The command itself has all sent anew; what follows moves.
        moving = markers.messages[seen + 1:seen + 12]
        self.assertLess(len([array for array in moving if self.goals_of(array)]), 3)
        later = Recorder("replay/markers", MarkerArray)
        self.assertTrue(wait_until(lambda: any(self.goals_of(array) for array in later.messages)))
        # Where the motion ends, the last message has all, for who comes later yet.
        self.assertTrue(wait_until(lambda: self.are_at(self.latest_markers(), 10 ** 6)))
        self.assertTrue(wait_until(lambda: self.goals_of(self.latest_markers())))
        for recorder in (markers, later):
            recorder.close()

    @staticmethod
    def goals_of(array):
        return [marker for marker in array.markers if marker.ns == "goals"]

    def test_tells_tf_of_the_plans_frame(self):
        static = rospy.wait_for_message("tf_static", TFMessage, timeout=PATIENCE)
        self.assertIn(("map", "split_mapf_grid"),
                      [(one.header.frame_id, one.child_frame_id) for one in static.transforms])

    def test_uses_few_markers_with_fixed_names(self):
        self.command(ReplayControlRequest.PAUSE)
        self.command(ReplayControlRequest.SEEK, 5)
        self.assertTrue(wait_until(lambda: self.goals_of(self.latest_markers())))
        array = self.latest_markers()
        names = sorted((marker.ns, marker.id) for marker in array.markers)
        self.assertEqual(names, [("goals", 0), ("robots", 0), ("trails", 0)])
        for marker in array.markers:
            self.assertEqual(marker.action, Marker.ADD)
            self.assertEqual(marker.header.frame_id, "map")
            self.assertEqual(len(marker.points), len(marker.colors))

    def test_obeys_the_control_service(self):
        self.command(ReplayControlRequest.PAUSE)
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
                                     (ReplayControlRequest.SEEK, float("nan"), "finite"),
                                     (ReplayControlRequest.SEEK, -1, "step from 0"),
                                     (ReplayControlRequest.SEEK, 1e6, "step from 0"),
                                     (77, 0, "none of PLAY")):
            answer = self.control(command=command, value=value)
            self.assertFalse(answer.ok)
            self.assertIn(part, answer.message)

    def test_serves_late_subscribers(self):
        plan = rospy.wait_for_message("split_mapf/plan", MultiRobotPlan, timeout=PATIENCE)
        self.assertEqual([path.robot_id for path in plan.paths],
                         ["robot_%d" % i for i in range(4)])
        self.assertEqual(plan.grid.width, 24)
        grid = rospy.wait_for_message("split_mapf/planning_grid", OccupancyGrid, timeout=PATIENCE)
        self.assertEqual(list(grid.data), list(warehouse_goal().map.data))
        self.assertEqual(grid.header.frame_id, "map")
        published = rospy.wait_for_message("map", OccupancyGrid, timeout=PATIENCE)
        self.assertEqual(list(published.data), list(grid.data))
        self.latest_markers()

    def test_publishes_a_path_a_robot(self):
        for robot, path_of_plan in enumerate(self.plan.paths):
            path = rospy.wait_for_message("robot_%d/path" % robot, Path, timeout=PATIENCE)
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
        self.assertTrue(wait_until(lambda: paths() == ["/robot_0/path", "/robot_1/path"]),
                        paths())
        type(self).plan = self.send(4)
        self.assertTrue(wait_until(lambda: len(paths()) == 4), paths())

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
        broken = rospy.wait_for_message("split_mapf/plan", MultiRobotPlan, timeout=PATIENCE)
        broken.paths[0].cells = [10 ** 6]
        for count, plan in enumerate((broken, MultiRobotPlan()), 1):
            publisher.publish(plan)
            self.assertTrue(wait_until(
                lambda least=count: self.launch.output().count("cannot be shown") >= least),
                self.launch.output())
        publisher.unregister()
        self.command(ReplayControlRequest.SEEK, 2)
        self.assertEqual(len(robots_of(self.latest_markers())), 4)


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "replay_rostest", Replay)
