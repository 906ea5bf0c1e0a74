#!/usr/bin/env python3
"""The client module split_mapf.ros against planner nodes, and the examples as a user runs them."""

import math
import os
import runpy
import signal
import sys
import threading
import time
import unittest
from unittest import mock

import rospy
import rosunit
from actionlib_msgs.msg import GoalStatus, GoalStatusArray
from nav_msgs.msg import OccupancyGrid

import split_mapf.ros as mapf

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))

# pylint: disable=wrong-import-position
from documents import read_blocks
from ros_processes import PATIENCE, free_map, hard_goal, start_program, wait_until
from split_mapf.errors import InputError, OptionError
from split_mapf.msg import PlanOptions, PlanOutcome

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..")
EXAMPLES = os.path.join(ROOT, "examples")
TUTORIAL = os.path.join(ROOT, "docs", "tutorial.md")


def turned_map():
    """12 x 8 cells of half a metre, a third of a turn round a corner off the origin."""
    grid = free_map(12, 8)
    grid.info.resolution = 0.5
    grid.info.origin.position.x, grid.info.origin.position.y = -3.0, 7.0
    grid.info.origin.orientation.z, grid.info.origin.orientation.w = math.sin(1), math.cos(1)
    return grid


class FleetModule(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.fleet = mapf.Fleet(wait=PATIENCE)

    def test_plans_between_cells_and_tells_cells_and_metres(self):
        grid = turned_map()
        robots = mapf.robots_at_cells(grid, [(0, 0), (11, 7)], [(11, 7), (0, 0)], ids=["a", "b"])
        stages = []
        answer = self.fleet.plan(robots, grid, lambda feedback: stages.append(feedback.stage),
                                 objective="sum_of_costs", seed=3)
        self.assertTrue(answer, answer)
        self.assertEqual((answer.outcome_name, answer.state_name), ("SUCCEEDED", "SUCCEEDED"))
        self.assertEqual(answer.plan.objective, "sum_of_costs")
        self.assertEqual([list(cell) for cell in answer.paths["a"]][::18], [[0, 0], [11, 7]])
        place = mapf.Place(answer.plan)
        for cell, point in zip(answer.paths["b"], answer.metres["b"]):
            self.assertEqual(place.cell(*point), tuple(cell))
        # The node took the poses to the same cells, so it turns the map as we do.
        for found, wanted in zip(answer.metres["a"][0], (robots[0].start.pose.position.x,
                                                         robots[0].start.pose.position.y)):
            self.assertAlmostEqual(found, wanted)

    def test_plans_from_pose_to_pose(self):
        grid = turned_map()
        starts = [mapf.Place(grid).metres((2, 2))]
        goals = [mapf.Place(grid).metres((9, 5)) + (0.5,)]
        answer = self.fleet.plan(mapf.robots_at_poses(starts, goals, radii=[0.1]), grid,
                                 fill_poses=True)
        self.assertTrue(answer, answer)
        for found, wanted in ((answer.metres["r0"][0], starts[0]),
                              (answer.metres["r0"][-1], goals[0])):
            for one, other in zip(found, wanted):
                self.assertAlmostEqual(one, other)
        document = mapf.document_of(answer)
        self.assertEqual((document["status"], document["robots"]), ("solved", ["r0"]))

    def test_tells_outcomes_without_a_plan(self):
        answer = self.fleet.plan([], free_map(3))
        self.assertFalse(answer)
        self.assertEqual((answer.outcome, answer.paths), (PlanOutcome.NO_ROBOTS, {}))
        grid = free_map(3, 1)
        answer = self.fleet.plan(mapf.robots_at_cells(grid, [(0, 0), (2, 0)], [(2, 0), (0, 0)]),
                                 grid)
        self.assertEqual(answer.outcome_name, "UNSOLVABLE")
        for state in (GoalStatus.RECALLED, GoalStatus.LOST):
            answer = mapf.Answer(state, None, 0)
            self.assertEqual(answer.outcome, PlanOutcome.CANCELLED)
            self.assertTrue(answer.message)

    def test_refuses_bad_robots_and_options(self):
        grid = free_map(4)
        for call, text in (
                (lambda: mapf.robots_at_cells(grid, [(4, 0)], [(0, 0)], ["x"]),
                 r"robot 'x': its start \(4,0\) lies outside the map of 4x4 cells"),
                (lambda: mapf.robots_at_cells(grid, [(0, 0.5)], [(0, 0)]), "robot 'r0': its start"),
                (lambda: mapf.robots_at_cells(grid, [(0, 0)], []), "1 starts but 0 goals"),
                (lambda: mapf.robots_at_poses([(0, 0, 0, 0)], [(0, 0)]), "robot 'r0': its start"),
                (lambda: mapf.Place(grid).cell(-1, 0), r"\(-1, 0\) m lies outside"),
                (lambda: mapf.make_options(colour="red"), "'colour' is no option of a goal"),
                (lambda: mapf.make_options(time_limit="1"), "time_limit: '1' was given"),
                (lambda: mapf.make_options(seed=-1), "seed: -1 was given, a whole number from 0"),
                (lambda: mapf.make_options(passages=3), "passages: 3 was given"),
                (lambda: mapf.make_options(fill_poses=1), "fill_poses: 1 was given"),
                (lambda: mapf.read_map("nowhere.map"), "nowhere.map")):
            with self.subTest(text=text), self.assertRaisesRegex(InputError, text):
                call()
        self.assertTrue(issubclass(OptionError, ValueError))
        options = mapf.make_options(refine_time=0, ignore_specks=0, passages=False, seed=None,
                                    unknown_space="free", solver_options={"a": 1, "b": True})
        self.assertEqual((options.refine_time, options.ignore_specks, options.passages,
                          options.unknown_space, options.solver_options, options.seed),
                         (-1.0, -1, PlanOptions.PASSAGES_OFF, PlanOptions.UNKNOWN_SPACE_FREE,
                          ["a=1", "b=true"], 0))

    def test_says_who_is_not_there(self):
        with self.assertRaisesRegex(mapf.NoAnswer, "no planner answers on /nowhere within 0.3 s"):
            mapf.Fleet("nowhere", wait=0.3)
        with self.assertRaisesRegex(mapf.NoAnswer, "no map on the topic /no_map within 0.3 s"):
            self.fleet.map("no_map", wait=0.3)

    def test_ctrl_c_cancels_the_goal(self):
        ended = []
        subscriber = rospy.Subscriber(
            "split_mapf/plan_paths/status", GoalStatusArray,
            lambda array: ended.extend(one.status for one in array.status_list))
        self.addCleanup(subscriber.unregister)
        goal = hard_goal()
        sent = threading.Event()

        def interrupt(_):
            if not sent.is_set():
                sent.set()
                os.kill(os.getpid(), signal.SIGINT)

        with self.assertRaises(KeyboardInterrupt):
            self.fleet.plan(goal.robots, goal.map, interrupt, solver="ecbs", split="none",
                            objective="sum_of_costs", suboptimality=1.0, time_limit=600)
        self.assertTrue(wait_until(lambda: GoalStatus.PREEMPTED in ended), ended)

    def test_ctrl_c_while_a_goal_is_being_sent_cancels_it(self):
        ended = []
        subscriber = rospy.Subscriber(
            "split_mapf/plan_paths/status", GoalStatusArray,
            lambda array: ended.extend(one.status for one in array.status_list
                                       if one.goal_id.id in sent))
        self.addCleanup(subscriber.unregister)
        goal = hard_goal()
        sent = []
        client = self.fleet._client
        send = client.send_goal

        def send_and_interrupt(*words, **more):
            handle = send(*words, **more)
            sent.append(handle.comm_state_machine.action_goal.goal_id.id)
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(0.1)
            return handle

        with mock.patch.object(client, "send_goal", send_and_interrupt):
            with self.assertRaises(KeyboardInterrupt):
                self.fleet.plan(goal.robots, goal.map, solver="ecbs", split="none",
                                objective="sum_of_costs", suboptimality=1.0, time_limit=600)
        over = (GoalStatus.PREEMPTED, GoalStatus.RECALLED)
        self.assertTrue(wait_until(lambda: any(one in over for one in ended)), ended)

    def start_planner(self, name):
        planner = start_program("planner_node", "__name:=" + name)
        self.addCleanup(planner.end)
        return planner

    def test_outlives_the_planner(self):
        planner = self.start_planner("mortal")
        fleet = mapf.Fleet("mortal/plan_paths", wait=PATIENCE)
        message = hard_goal()
        message.options.time_limit = 600
        heard = threading.Event()
        goal = fleet.send_goal(message, lambda _: heard.set())
        self.assertTrue(heard.wait(PATIENCE))
        self.assertIsNone(goal.wait(0.1))
        fleet.resend = 0
        last = fleet.send_goal(message)
        planner.signal(signal.SIGKILL)
        # A goal that may not be sent again is lost; its sender is told at once.
        answer = last.wait(PATIENCE)
        self.assertEqual((answer.outcome, answer.state, bool(answer)),
                         (PlanOutcome.CANCELLED, GoalStatus.LOST, False))
        self.assertIn("the planner node has gone", answer.message)
        # The other is sent to the one that comes, and ends there.
        heard.clear()
        answers = []
        waiting = threading.Thread(target=lambda: answers.append(goal.wait()))
        waiting.start()
        self.start_planner("mortal")
        self.assertTrue(heard.wait(PATIENCE))
        goal.cancel()
        waiting.join(PATIENCE)
        self.assertEqual([answer.state for answer in answers], [GoalStatus.PREEMPTED])
        self.assertTrue(fleet.plan(mapf.robots_at_cells(free_map(4), [(0, 0)], [(3, 3)]),
                                   free_map(4)))

    def test_runs_the_examples(self):
        publisher = rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        publisher.publish(free_map(7, 3))
        values = runpy.run_path(os.path.join(EXAMPLES, "plan_two_robots.py"))
        self.assertGreaterEqual(values["answer"].plan.makespan, 4)
        program = start_program("plan_two_robots")
        self.addCleanup(program.end)
        self.assertEqual(program.wait(), 0, program.output())
        self.assertIn(values["answer"].message[:20], program.output())

    def test_runs_the_tutorial(self):
        """Its clients stand in the order in which they are typed."""
        publisher = rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        publisher.publish(free_map(7, 3))
        names = {}
        blocks = read_blocks(TUTORIAL, "python client")
        for block in blocks:
            exec(block, names)  # pylint: disable=exec-used
        self.assertEqual(len(blocks[0].splitlines()), 5)
        with open(os.path.join(EXAMPLES, "plan_two_robots.py"), encoding="utf-8") as file:
            self.assertTrue(file.read().endswith(blocks[0]))
        cpp = read_blocks(TUTORIAL, "examples/plan_two_robots.cpp")[0]
        self.assertEqual(len(cpp.splitlines()), 10)
        with open(os.path.join(EXAMPLES, "plan_two_robots.cpp"), encoding="utf-8") as file:
            self.assertTrue(file.read().endswith(cpp))


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "fleet_module_rostest", FleetModule)
