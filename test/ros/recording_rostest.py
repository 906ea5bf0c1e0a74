#!/usr/bin/env python3
"""Records a goal and its plan into a bag, ends the planner, plays the bag, and solves it again."""

import os
import shutil
import tempfile
import unittest
import xmlrpc.client

import rosbag
import rospy
import rosunit
from diagnostic_msgs.msg import DiagnosticArray
from rosgraph_msgs.msg import Clock
from visualization_msgs.msg import MarkerArray

from ros_processes import (Program, Recorder, SentGoal, action_client, start_program, wait_until,
                           warehouse_goal, write_instance)
from split_mapf.msg import PlanOutcome, PlanPathsActionGoal
from split_mapf.srv import ReplayControl, ReplayControlRequest

ACTION = "/split_mapf/plan_paths/"
LATCHED_TOPICS = ("/map", "/split_mapf/plan", "/split_mapf/planning_grid", "/split_mapf/layout")


def first_robot(array):
    point = next(marker for marker in array.markers if marker.ns == "robots").points[0]
    return point.x, point.y


def topics_received_by(node):
    """Topics of whose publishers the node has a connection."""
    try:
        address = rospy.get_master().lookupNode(node)[2]
        links = xmlrpc.client.ServerProxy(address).getBusInfo("/recording_rostest")[2]
    except (OSError, TypeError, xmlrpc.client.Error):
        return set()  # it is not there yet
    return {link[4] for link in links if link[2] == "i" and link[5]}


def count_of(found, topic):
    return found[topic].message_count if topic in found else 0


class Recording(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("recording_rostest")
        cls.directory = tempfile.mkdtemp()
        cls.bag = os.path.join(cls.directory, "plan.bag")
        cls.marker_bag = os.path.join(cls.directory, "markers.bag")
        map_path, _ = write_instance(cls.directory)
        cls.planner_command = ("roslaunch", "split_mapf", "planner.launch", "rviz:=false",
                               "map_file:=" + map_path)
        planner = Program(*cls.planner_command)
        try:
            cls.record(planner, cls.bag, cls.ask_for_a_plan)
            # The plan is latched, and its replay goes on.
            cls.record(planner, cls.marker_bag, cls.wait_for_markers, "markers:=true")
        finally:
            planner.end()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.directory)

    @classmethod
    def record(cls, planner, bag, act, *arguments):
        record = Program("roslaunch", "split_mapf", "record.launch", "bag:=" + bag[:-4],
                         *arguments)
        try:
            assert wait_until(lambda: os.path.exists(bag + ".active")), record.output()
            act(planner)
            # What comes later shows that the recorder has what came before.
            diagnostics = Recorder("/diagnostics", DiagnosticArray)
            assert diagnostics.wait_for(4), planner.output()
            diagnostics.close()
        finally:
            record.end()

    @classmethod
    def ask_for_a_plan(cls, planner):
        client = action_client()
        topics = {ACTION + name for name in ("goal", "feedback", "result")}
        topics.add("/diagnostics")
        assert wait_until(lambda: topics <= topics_received_by("/record")), planner.output()
        # The recorder says so before its connection is accepted here.
        goals = client.pub_goal
        assert wait_until(lambda: goals.get_num_connections() >= 2), planner.output()
        sent = SentGoal(client, warehouse_goal())
        assert sent.wait_for_end(), planner.output()
        assert sent.result().outcome == PlanOutcome.SUCCEEDED, sent.result().message
        cls.makespan = sent.result().plan.makespan

    @classmethod
    def wait_for_markers(cls, planner):
        assert wait_until(lambda: "/replay/markers" in topics_received_by("/record"))
        markers = Recorder("replay/markers", MarkerArray)
        assert markers.wait_for(60), planner.output()
        markers.close()

    def play(self, *arguments, bag=None, env=None):
        program = Program("roslaunch", "split_mapf", "playback.launch", "rviz:=false",
                          "bag:=" + (bag or self.bag), *arguments, env=env)
        self.addCleanup(program.end)
        return program

    def record_markers(self):
        markers = Recorder("replay/markers", MarkerArray)
        self.addCleanup(markers.close)
        return markers

    def assert_shows_the_whole_plan(self, markers, playback):
        """From the first robot's start to its goal, of the warehouse of 24 columns."""
        self.assertTrue(markers.wait_for(1), playback.output())
        self.assertEqual(first_robot(markers.messages[0]), (1.5, 10.5))
        self.assertTrue(wait_until(lambda: first_robot(markers.messages[-1]) == (22.5, 10.5)),
                        first_robot(markers.messages[-1]))
        self.assertIsNone(playback.process.poll(), playback.output())

    def test_keeps_what_was_asked_and_what_was_answered(self):
        with rosbag.Bag(self.bag) as bag:
            found = bag.get_type_and_topic_info().topics
            for topic in LATCHED_TOPICS:
                self.assertGreaterEqual(count_of(found, topic), 1, topic)
            for name in ("goal", "result"):
                self.assertEqual(count_of(found, ACTION + name), 1, name)
            self.assertGreaterEqual(count_of(found, ACTION + "feedback"), 1)
            self.assertGreaterEqual(count_of(found, "/diagnostics"), 1)
            self.assertEqual(count_of(found, "/replay/markers"), 0)
            plan = next(message for _, message, _ in bag.read_messages("/split_mapf/plan"))
            self.assertEqual(plan.makespan, self.makespan)
            self.assertEqual(bag.get_compression_info().compression, "lz4")
        self.assertLess(os.path.getsize(self.bag), 200000)

    def test_keeps_markers_when_asked(self):
        with rosbag.Bag(self.marker_bag) as bag:
            found = bag.get_type_and_topic_info().topics
            self.assertGreater(count_of(found, "/replay/markers"), 40)

    def resolve(self, bag):
        program = start_program("resolve_bag.py", bag)
        self.addCleanup(program.end)
        return program.wait(), program.output()

    def write_changed(self, change):
        """The bag again, with its messages changed."""
        path = os.path.join(self.directory, "changed.bag")
        with rosbag.Bag(self.bag) as bag, rosbag.Bag(path, "w") as written:
            for topic, message, stamp in bag.read_messages():
                change(topic, message)
                written.write(topic, message, stamp)
        return path

    def test_a_recorded_goal_is_solved_again(self):
        planner = Program(*self.planner_command)
        self.addCleanup(planner.end)
        code, output = self.resolve(self.bag)
        self.assertEqual(code, 0, output + planner.output())
        self.assertIn("the same: SUCCEEDED, makespan %d" % self.makespan, output)

        def move_a_robot(topic, message):
            if topic == ACTION + "goal":
                message.goal.robots[2].goal.pose.position.x += 1
        code, output = self.resolve(self.write_changed(move_a_robot))
        self.assertEqual(code, 2, output)
        self.assertRegex(output, r"[1-4] of 4 robots take another way, the first is 'robot_\d'")
        self.assertNotIn("the clock had its say", output)

        def forget_a_robot(topic, message):
            if topic == ACTION + "goal":
                del message.goal.robots[3]
            # By the node's default: the goal itself says nothing.
            if topic == ACTION + "result":
                message.result.statistics.options.refine_time = 0.1
        code, output = self.resolve(self.write_changed(forget_a_robot))
        self.assertEqual(code, 2, output)
        self.assertIn("3 robots, recorded 4; of one only: robot_3", output)
        self.assertIn("the clock had its say", output)

        def change_a_cell(topic, message):
            if topic in ("/map", ACTION + "goal"):
                grid = message if topic == "/map" else message.goal.map
                grid.data = (100,) + tuple(grid.data[1:])
        code, output = self.resolve(self.write_changed(change_a_cell))
        self.assertEqual(code, 2, output)
        self.assertRegex(output, "planned on map [0-9a-f]{16}, recorded on [0-9a-f]{16}")

        def change_the_version(topic, message):
            if topic == ACTION + "result":
                message.result.statistics.version = "0.0.9"
        code, output = self.resolve(self.write_changed(change_the_version))
        self.assertEqual(code, 2, output)
        self.assertRegex(output, r"planned by version [0-9.]+, recorded by 0\.0\.9")
        planner.end()
        self.assertEqual(self.resolve("nowhere.bag")[0], 1)

    def test_a_goal_is_solved_again_by_a_node_with_other_parameters(self):
        parameters = os.path.join(self.directory, "other.yaml")
        with open(parameters, "w", encoding="ascii") as file:
            file.write("{objective: sum_of_costs, solver: ecbs, split: 2t, suboptimality: 3.0, "
                       "step_duration: 2.5}")
        planner = Program(*self.planner_command, "params_file:=" + parameters)
        self.addCleanup(planner.end)
        code, output = self.resolve(self.bag)
        self.assertEqual(code, 0, output + planner.output())

    def test_records_the_transforms_of_the_robots(self):
        record = Program("roslaunch", "split_mapf", "record.launch",
                         "bag:=" + os.path.join(self.directory, "unused"))
        self.addCleanup(record.end)

        def recorded_topics():
            _, subscribers, _ = rospy.get_master().getSystemState()[2]
            return {topic for topic, nodes in subscribers if "/record" in nodes}
        self.assertTrue(wait_until(lambda: {"/tf", "/tf_static"} <= recorded_topics()),
                        recorded_topics())
        record.end()

    def test_replays_the_plan_on_the_bags_clock_and_beyond_its_end(self):
        goals = Recorder("split_mapf/plan_paths/goal", PlanPathsActionGoal)
        clock = Recorder("clock", Clock)
        self.addCleanup(goals.close)
        self.addCleanup(clock.close)
        markers = self.record_markers()
        # Four times as fast: the clock, and with it the robots.
        playback = self.play("rate:=4")
        self.assert_shows_the_whole_plan(markers, playback)
        with rosbag.Bag(self.bag) as bag:
            begin, end = bag.get_start_time(), bag.get_end_time()
        for array in markers.messages:
            stamp = array.markers[0].header.stamp.to_sec()
            # Before the first message of the clock time is 0.
            self.assertTrue(stamp == 0 or stamp >= begin - 1, stamp)
        # One step a second of the bag's time.
        moving = [array for array in markers.messages
                  if 1.5 < first_robot(array)[0] < 22.5]
        passed = (moving[-1].markers[0].header.stamp - moving[0].markers[0].header.stamp).to_sec()
        way = first_robot(moving[-1])[0] - first_robot(moving[0])[0]
        self.assertLessEqual(way, passed + 1)
        self.assertGreater(clock.messages[-1].clock.to_sec(), end)
        # A goal of the bag does not reach a planner that runs.
        self.assertEqual(goals.messages, [])

    def test_shows_a_bag_of_latched_topics_from_where_it_lies(self):
        latched = os.path.join(self.directory, "latched topics.bag")
        with rosbag.Bag(self.bag) as bag, rosbag.Bag(latched, "w") as written:
            messages = list(bag.read_messages(LATCHED_TOPICS, return_connection_header=True))
            for topic, message, _, header in messages:
                written.write(topic, message, messages[0][2], connection_header=header)
        markers = self.record_markers()
        playback = self.play("replay_speed:=4", bag="latched topics.bag",
                             env={"PWD": self.directory})
        self.assert_shows_the_whole_plan(markers, playback)

    def test_obeys_the_control_service_after_the_end_of_the_bag(self):
        markers = self.record_markers()
        playback = self.play("replay_speed:=20", "rate:=4")
        self.assert_shows_the_whole_plan(markers, playback)
        control = rospy.ServiceProxy("replay/control", ReplayControl)
        seen = len(markers.messages)
        self.assertTrue(control(ReplayControlRequest.SEEK, 0).ok)
        self.assertTrue(control(ReplayControlRequest.PLAY, 0).ok)
        self.assertTrue(wait_until(
            lambda: any(first_robot(array)[0] < 20 for array in markers.messages[seen:])))
        self.assertTrue(wait_until(lambda: first_robot(markers.messages[-1]) == (22.5, 10.5)))
        self.assertTrue(control(ReplayControlRequest.STEP, -2).ok)
        self.assertTrue(wait_until(lambda: first_robot(markers.messages[-1]) != (22.5, 10.5)))

    def test_shows_the_plan_again_when_looped(self):
        markers = self.record_markers()
        playback = self.play("replay_speed:=8", "rate:=4", "loop:=true")
        self.assert_shows_the_whole_plan(markers, playback)
        seen = len(markers.messages)
        self.assertTrue(wait_until(
            lambda: min(first_robot(array)[0] for array in markers.messages[seen - 1:]) < 3),
            playback.output())

    def test_ends_with_an_error_without_its_bag(self):
        playback = self.play(bag="/nowhere.bag")
        self.assertIsNotNone(playback.wait(), playback.output())
        self.assertIn("/nowhere.bag", playback.output())

    def test_shows_the_recorded_markers_when_asked(self):
        markers = self.record_markers()
        playback = self.play("recorded_markers:=true", "rate:=4", bag=self.marker_bag)
        self.assertTrue(markers.wait_for(40), playback.output())
        self.assertNotIn("process[replay", playback.output())
        self.assertIsNotNone(playback.wait(), playback.output())


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "recording_rostest", Recording)
