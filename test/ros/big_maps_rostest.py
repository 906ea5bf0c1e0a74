#!/usr/bin/env python3
"""Large maps in the node: cancels and limits are heard, services do not hold up goals, and memory
that goals took is given back."""

import sys
import time
import unittest

import actionlib
import rospy
import rosunit

from ros_processes import (Program, SentGoal, action_client, free_map, hard_goal, start_program,
                           wait_until, warehouse_goal)
from split_mapf.msg import PlanOutcome, PlanPathsGoal, RobotTask
from split_mapf.srv import CheckSolvable, CheckSolvableRequest


def crossing_robots(side, count):
    robots = []
    for i in range(count):
        task = RobotTask()
        for pose, x, y in ((task.start, i, 0), (task.goal, side - 1 - i, side - 1)):
            pose.pose.position.x, pose.pose.position.y = x + 0.5, y + 0.5
            pose.pose.orientation.w = 1.0
        robots.append(task)
    return robots


def hall_goal(side, count, **options):
    goal = PlanPathsGoal(map=free_map(side), robots=crossing_robots(side, count))
    for name, value in options.items():
        setattr(goal.options, name, value)
    return goal


class BigMaps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("big_maps_rostest")

    def setUp(self):
        if rospy.has_param("/split_mapf"):
            rospy.delete_param("/split_mapf")
        self.planner = start_program("planner_node", "_threads:=2")
        self.addCleanup(self.planner.end)
        self.assertTrue(self.planner.wait_for_output("ready:"), self.planner.output())
        self.client = action_client()

    def memory_mib(self, field):
        with open("/proc/%d/status" % self.planner.process.pid) as file:
            for line in file:
                if line.startswith(field + ":"):
                    return int(line.split()[1]) / 1024
        return None

    def test_a_map_of_64_million_cells_takes_a_small_multiple_of_its_bytes(self):
        goal = SentGoal(self.client, hall_goal(8000, 3, time_limit=60))
        self.assertTrue(goal.wait_for_end(), self.planner.output())
        self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED)
        self.assertLess(self.memory_mib("VmHWM"), 600)

    def test_a_cancel_is_heard_in_every_stage(self):
        for wait in (0.02, 0.1, 0.2, 0.4, 0.8):
            goal = SentGoal(self.client, hall_goal(3000, 50, time_limit=30))
            time.sleep(wait)
            begin = time.monotonic()
            # A cancel of a goal that has its end makes actionlib's client wait for another.
            if goal.handle.get_comm_state() != actionlib.CommState.DONE:
                goal.handle.cancel()
            self.assertTrue(goal.wait_for_end(10), self.planner.output())
            # 200 ms, and what this client takes to send the map and to hear of the end.
            self.assertLess(time.monotonic() - begin, 1.5)

    def test_the_reason_of_a_short_limit_is_true(self):
        goal = SentGoal(self.client, hall_goal(3000, 50, time_limit=0.02))
        self.assertTrue(goal.wait_for_end(10), self.planner.output())
        self.assertEqual(goal.result().outcome, PlanOutcome.TIMEOUT)
        self.assertNotIn("other goals", goal.result().message)
        self.assertIn("while the map was being read", goal.result().message)

    def test_services_do_not_hold_up_a_cancelled_goal(self):
        # In processes of their own, so that it is not this client that they hold up.
        callers = [Program(sys.executable, __file__, "--call") for _ in range(6)]
        for caller in callers:
            self.addCleanup(caller.end)
        for caller in callers:
            self.assertTrue(caller.wait_for_output("solvable"), caller.output())
        goal = SentGoal(self.client, hard_goal())
        self.assertTrue(wait_until(goal.is_active), self.planner.output())
        time.sleep(1)
        begin = time.monotonic()
        goal.handle.cancel()
        self.assertTrue(goal.wait_for_end(10), self.planner.output())
        self.assertLess(time.monotonic() - begin, 2)
        self.assertTrue(all(caller.process.poll() is None for caller in callers))

    def run_goals(self, make, count):
        """Two at a time."""
        running = []
        for i in range(count):
            running.append(SentGoal(self.client, make(i)))
            if len(running) == 2:
                self.assertTrue(running.pop(0).wait_for_end(20), self.planner.output())
        for goal in running:
            self.assertTrue(goal.wait_for_end(20), self.planner.output())

    def test_memory_is_flat(self):
        def bad(i):
            goal = warehouse_goal()
            if i % 2:
                goal.robots[0].start.pose.position.x = float("nan")
            else:
                goal.map.data = goal.map.data[:-1]
            return goal

        def good(_):
            return hall_goal(200, 50)

        self.run_goals(good, 10)
        time.sleep(2)
        before = self.memory_mib("VmRSS")
        self.run_goals(good, 40)
        self.run_goals(bad, 100)
        self.assertTrue(wait_until(lambda: self.memory_mib("VmRSS") < before + 20, 10),
                        "%d MiB, then %d" % (before, self.memory_mib("VmRSS")))


def call_for_ever():
    """One of many who ask whether a plan exists on a large map."""
    rospy.init_node("caller", anonymous=True)
    request = CheckSolvableRequest(map=free_map(2500), robots=crossing_robots(2500, 50))
    check = rospy.ServiceProxy("split_mapf/check_solvable", CheckSolvable)
    while not rospy.is_shutdown():
        print("solvable" if check(request).solvable else "not proved", flush=True)


if __name__ == "__main__":
    if "--call" in sys.argv:
        call_for_ever()
        sys.exit()
    rosunit.unitrun("split_mapf", "big_maps_rostest", BigMaps)
