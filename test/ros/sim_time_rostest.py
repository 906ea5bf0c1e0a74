#!/usr/bin/env python3
"""Simulated time that begins late, jumps back, stands, or ends: the replay and the client."""

import shutil
import tempfile
import threading
import time
import unittest

import rospy
import rosunit
from rosgraph_msgs.msg import Clock
from visualization_msgs.msg import MarkerArray

from ros_processes import PATIENCE, Recorder, robots_of, start_program, wait_until, write_instance
from split_mapf.msg import MultiRobotPlan, RobotPath
from split_mapf.srv import ReplayControl, ReplayControlRequest

STEPS = 40


def corridor_plan():
    """One robot goes a corridor of 41 cells."""
    plan = MultiRobotPlan(step_duration=1.0, makespan=STEPS, objective="makespan")
    plan.header.frame_id = "map"
    plan.grid.width, plan.grid.height, plan.grid.resolution = STEPS + 1, 1, 1.0
    plan.grid.origin.orientation.w = 1.0
    plan.paths = [RobotPath(robot_id="robot", cells=list(range(STEPS + 1)))]
    return plan


class ClockPublisher:
    """Tells the time from `begin` on, `rate` times as fast as it passes."""

    def __init__(self, begin, rate=1.0):
        self.publisher = rospy.Publisher("/clock", Clock, queue_size=1)
        self.ends = threading.Event()
        self.thread = threading.Thread(target=self.run, args=(begin, rate), daemon=True)
        self.thread.start()

    def run(self, begin, rate):
        start = time.monotonic()
        while not self.ends.wait(0.02):
            now = begin + (time.monotonic() - start) * rate
            self.publisher.publish(Clock(rospy.Time.from_sec(now)))

    def close(self):
        """Ends the clock and, unlike a pause, its publisher."""
        if self.thread.is_alive():
            self.ends.set()
            self.thread.join()
            self.publisher.unregister()


class SimulatedTime(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("sim_time_rostest")

    def start_replay(self, *arguments):
        """The replay of a plan that came first; nobody has told the time yet."""
        replay = start_program("replay_node", *arguments)
        self.addCleanup(replay.end)
        self.markers = Recorder("replay/markers", MarkerArray)
        self.addCleanup(self.markers.close)
        publisher = rospy.Publisher("plan", MultiRobotPlan, queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        publisher.publish(corridor_plan())
        self.assertTrue(self.markers.wait_for(1), replay.output())

    def start_clock(self, begin, rate=1.0):
        clock = ClockPublisher(begin, rate)
        self.addCleanup(clock.close)
        return clock

    def step(self):
        return robots_of(self.markers.messages[-1])[0][0] - 0.5

    def steps(self):
        return [robots_of(array)[0][0] - 0.5 for array in list(self.markers.messages)]

    def test_a_clock_that_begins_after_the_plan_starts_the_replay(self):
        self.start_replay()
        self.start_clock(1.7e9)
        self.assertTrue(wait_until(lambda: 2 < self.step() < 10), self.steps())
        self.assertLess(max(self.steps()), 10)

    def test_a_clock_that_jumps_back_starts_the_replay_anew(self):
        self.start_replay()
        clock = self.start_clock(5000, rate=8)
        self.assertTrue(wait_until(lambda: self.step() > 20))
        clock.close()
        seen = len(self.markers.messages)
        self.start_clock(100)
        self.assertTrue(wait_until(
            lambda: min(self.steps()[seen:] or [STEPS]) < 1), self.steps()[seen:])
        self.assertTrue(wait_until(lambda: 1 < self.step() < 10), self.steps()[seen:])

    def test_a_clock_that_ends_leaves_the_rest_to_wall_time(self):
        self.start_replay("_speed:=5")
        clock = self.start_clock(5000)
        self.assertTrue(wait_until(lambda: self.step() > 5))
        clock.close()
        left = self.step()
        self.assertTrue(wait_until(lambda: self.step() == STEPS), self.step())
        # It goes on instead of leaping to its end.
        between = {step for step in self.steps() if left < step < STEPS}
        self.assertGreater(len(between), 5, between)

    def test_a_paused_clock_pauses_the_replay(self):
        self.start_replay()
        clock = self.start_clock(5000)
        self.assertTrue(wait_until(lambda: self.step() > 1))
        clock.ends.set()
        clock.thread.join()
        self.addCleanup(clock.publisher.unregister)
        # What the clock told at last arrives.
        time.sleep(1)
        stopped = self.step()
        time.sleep(4)
        self.assertEqual(self.step(), stopped)

    def test_the_replay_obeys_without_any_clock(self):
        self.start_replay()
        rospy.wait_for_service("replay/control", PATIENCE)
        control = rospy.ServiceProxy("replay/control", ReplayControl)
        self.assertTrue(control(ReplayControlRequest.PAUSE, 0).ok)
        self.assertTrue(control(ReplayControlRequest.SEEK, 30).ok)
        self.assertTrue(wait_until(lambda: self.step() == 30), self.steps())

    def test_waits_for_a_viewer_when_asked(self):
        self.start_clock(5000)
        replay = start_program("replay_node", "_wait_for_viewer:=true", "_speed:=10")
        self.addCleanup(replay.end)
        publisher = rospy.Publisher("plan", MultiRobotPlan, queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        publisher.publish(corridor_plan())
        self.assertTrue(replay.wait_for_output("replaying"), replay.output())
        time.sleep(3)
        self.markers = Recorder("replay/markers", MarkerArray)
        self.addCleanup(self.markers.close)
        self.assertTrue(self.markers.wait_for(1))
        self.assertEqual(self.steps()[0], 0)
        self.assertTrue(wait_until(lambda: self.step() == STEPS, 15), self.step())

    def start_client(self, *arguments):
        directory = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, directory)
        map_path, scen_path = write_instance(directory)
        client = start_program("plan_client.py", "--map", map_path, "--scen", scen_path,
                               *arguments)
        self.addCleanup(client.end)
        return client

    def test_a_client_waits_for_the_planner_though_time_leaps(self):
        client = self.start_client()
        time.sleep(2)
        # From 0 to here is more than any patience in ROS time.
        self.start_clock(1.7e9, rate=100)
        time.sleep(1)
        self.assertIsNone(client.process.poll(), client.output())
        planner = start_program("planner_node")
        self.addCleanup(planner.end)
        self.assertEqual(client.wait(), 0, client.output() + planner.output())

    def test_a_client_loses_patience_though_time_stands(self):
        client = self.start_client("--wait", "2", "--server", "nowhere")
        self.assertEqual(client.wait(), 5, client.output())
        self.assertIn("within 2 s", client.output())


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "sim_time_rostest", SimulatedTime)
