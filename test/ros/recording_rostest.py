#!/usr/bin/env python3
"""Records a plan and its replay into a bag, ends the planner, and plays the bag."""

import os
import shutil
import tempfile
import time
import unittest

import rosbag
import rospy
import rosunit
from rosgraph_msgs.msg import Clock
from visualization_msgs.msg import MarkerArray

from ros_processes import (Program, Recorder, SentGoal, action_client, wait_until, warehouse_goal,
                           write_instance)
from split_mapf.msg import PlanOutcome


def first_robot(array):
    point = next(marker for marker in array.markers if marker.ns == "robots").points[0]
    return point.x, point.y


class Recording(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("recording_rostest")
        cls.directory = tempfile.mkdtemp()
        cls.bag = os.path.join(cls.directory, "plan.bag")
        map_path, _ = write_instance(cls.directory)
        planner = Program("roslaunch", "split_mapf", "planner.launch", "rviz:=false",
                          "map_file:=" + map_path)
        record = Program("roslaunch", "split_mapf", "record.launch", "bag:=" + cls.bag[:-4])
        try:
            cls.record(planner, record)
        finally:
            record.end()
            planner.end()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.directory)

    @classmethod
    def record(cls, planner, record):
        client = action_client()
        assert wait_until(lambda: os.path.exists(cls.bag + ".active")), record.output()
        # The recorder subscribes to what it finds; the goal comes after that.
        time.sleep(2)
        sent = SentGoal(client, warehouse_goal())
        assert sent.wait_for_end(), planner.output()
        assert sent.result().outcome == PlanOutcome.SUCCEEDED, sent.result().message
        cls.makespan = sent.result().plan.makespan
        time.sleep(5)

    def play(self, *arguments):
        program = Program("roslaunch", "split_mapf", "playback.launch", "rviz:=false",
                          "bag:=" + self.bag, *arguments)
        self.addCleanup(program.end)
        return program

    def test_keeps_map_plan_and_markers(self):
        with rosbag.Bag(self.bag) as bag:
            found = bag.get_type_and_topic_info().topics
            self.assertGreaterEqual(found["/map"].message_count, 1)
            self.assertGreaterEqual(found["/split_mapf/plan"].message_count, 1)
            self.assertGreaterEqual(found["/split_mapf/planning_grid"].message_count, 1)
            self.assertGreater(found["/replay/markers"].message_count, 40)
            plan = next(message for _, message, _ in bag.read_messages("/split_mapf/plan"))
            self.assertEqual(plan.makespan, self.makespan)

    def test_replays_the_plan_on_the_bags_clock(self):
        markers = Recorder("replay/markers", MarkerArray)
        clock = Recorder("clock", Clock)
        self.addCleanup(markers.close)
        self.addCleanup(clock.close)
        # Twice as fast: the clock, and with it the robots.
        playback = self.play("rate:=2")
        self.assertTrue(markers.wait_for(20), playback.output())
        self.assertIsNotNone(playback.wait(30), playback.output())
        with rosbag.Bag(self.bag) as bag:
            recorded = (bag.get_start_time(), bag.get_end_time())
        positions = [first_robot(array) for array in markers.messages]
        self.assertGreater(len(set(positions)), 10)
        self.assertEqual(positions[0], (1.5, 10.5))
        for array in markers.messages[1:]:
            stamp = array.markers[0].header.stamp.to_sec()
            self.assertTrue(recorded[0] - 1 <= stamp <= recorded[1] + 1, stamp)
        # One step a second of the bag's time.
        travelled = max(x for x, _ in positions) - 1.5
        played = clock.messages[-1].clock.to_sec() - recorded[0]
        self.assertAlmostEqual(travelled, played - 2, delta=2.5)

    def test_goes_on_when_a_looped_bag_turns_time_back(self):
        markers = Recorder("replay/markers", MarkerArray)
        clock = Recorder("clock", Clock)
        self.addCleanup(markers.close)
        self.addCleanup(clock.close)
        playback = self.play("rate:=4", "loop:=true")

        def turned_back():
            times = [message.clock for message in list(clock.messages)]
            return any(after < before for before, after in zip(times, times[1:]))
        self.assertTrue(wait_until(turned_back, 30), playback.output())
        count = len(markers.messages)
        self.assertTrue(wait_until(
            lambda: len({first_robot(array) for array in list(markers.messages)[count:]}) > 5, 20),
            playback.output())
        self.assertIsNone(playback.process.poll())

    def test_shows_the_recorded_markers_when_asked(self):
        markers = Recorder("replay/markers", MarkerArray)
        self.addCleanup(markers.close)
        playback = self.play("recorded_markers:=true", "rate:=4")
        self.assertTrue(markers.wait_for(40), playback.output())
        self.assertNotIn("process[replay", playback.output())


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "recording_rostest", Recording)
