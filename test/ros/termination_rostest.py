#!/usr/bin/env python3
"""The planner node obeys SIGTERM within 2 s, whatever it is busy with and however large that is."""

import os
import random
import signal
import threading
import time
import unittest

import rospy
import rosunit

from ros_processes import free_map, hard_goal, start_program, wait_until, warehouse_goal
from split_mapf.msg import PlanPathsActionGoal, PlanPathsGoal
from split_mapf.srv import CheckSolvable

PATIENCE = 2.0
LONGEST_WAIT = 2.0


def large_map_goal(side=4000):
    goal = warehouse_goal()
    goal.map = free_map(side)
    return goal


def largest_map_goal():
    return large_map_goal(8000)


def repeated_text_goal():
    """Twenty thousand robots on a map with a frame of 1 MB."""
    goal = PlanPathsGoal()
    goal.map = free_map(20)
    goal.map.header.frame_id = "f" * 2 ** 20
    goal.robots = [warehouse_goal().robots[0]] * 20000
    return goal


def crowd_goal():
    goal = PlanPathsGoal()
    goal.map = free_map(300)
    goal.robots = [warehouse_goal().robots[0]] * 50000
    return goal


def refining_goal():
    goal = hard_goal()
    goal.options.solver = ""
    goal.options.refine_time = 30
    return goal


GOALS = (hard_goal, large_map_goal, largest_map_goal, repeated_text_goal, crowd_goal,
         refining_goal)


class Termination(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("termination_rostest")
        cls.rounds = 16 if os.environ.get("SPLIT_MAPF_LONG") == "1" else 6
        cls.random = random.Random(rospy.get_param("~seed"))

    def seconds_to_the_end(self, goals, wait):
        """Starts a node, sends the goals, waits, and asks it to end."""
        planner = start_program("planner_node", "_threads:=2")
        self.addCleanup(planner.end)
        self.assertTrue(planner.wait_for_output("ready:"), planner.output())
        publisher = rospy.Publisher("/split_mapf/plan_paths/goal", PlanPathsActionGoal,
                                    queue_size=10)
        self.assertTrue(wait_until(lambda: publisher.get_num_connections() > 0))
        for make in goals:
            publisher.publish(PlanPathsActionGoal(goal=make()))
        time.sleep(wait)
        begin = time.monotonic()
        planner.signal(signal.SIGTERM)
        code = planner.wait(10)
        took = time.monotonic() - begin
        publisher.unregister()
        self.assertEqual(code, 0, planner.output())
        return took

    def test_obeys_sigterm_at_any_moment(self):
        worst = 0
        for index in range(self.rounds):
            goals = [GOALS[index % len(GOALS)]]
            goals += self.random.choices(GOALS, k=self.random.randrange(3))
            wait = self.random.uniform(0, LONGEST_WAIT)
            took = self.seconds_to_the_end(goals, wait)
            worst = max(worst, took)
            self.assertLess(took, PATIENCE, "%s, asked %.2f s after them" %
                            ([make.__name__ for make in goals], wait))
        print("%d rounds: at most %.2f s" % (self.rounds, worst))

    def test_obeys_sigterm_while_services_are_asked(self):
        planner = start_program("planner_node", "_threads:=2")
        self.addCleanup(planner.end)
        self.assertTrue(planner.wait_for_output("ready:"), planner.output())
        request = large_map_goal()

        def ask():
            try:
                rospy.ServiceProxy("/split_mapf/check_solvable", CheckSolvable)(
                    request.map, request.robots, request.options)
            except rospy.ServiceException:
                pass
        threads = [threading.Thread(target=ask, daemon=True) for _ in range(4)]
        for thread in threads:
            thread.start()
        time.sleep(0.7)
        begin = time.monotonic()
        planner.signal(signal.SIGTERM)
        self.assertEqual(planner.wait(10), 0, planner.output())
        self.assertLess(time.monotonic() - begin, PATIENCE)


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "termination_rostest", Termination)
