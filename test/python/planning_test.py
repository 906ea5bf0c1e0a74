#!/usr/bin/env python3
"""The package split_mapf without ROS, as a notebook uses it."""

import inspect
import json
import os
import random
import signal
import subprocess
import tempfile
import threading
import time
import unittest

import numpy

import split_mapf
from split_mapf import planning

ROOM = numpy.zeros((6, 9), int)
ROOM[2, 2:7] = 1
STARTS = [(0, 0), (8, 5), (4, 0)]
GOALS = [(8, 5), (0, 0), (4, 5)]


def crowd():
    """A square full of robots, whose optimum nobody finds within minutes: map, starts, goals."""
    shuffle = random.Random(1)
    cells = [(x, y) for x in range(12) for y in range(12)]
    return numpy.zeros((12, 12)), shuffle.sample(cells, 110), shuffle.sample(cells, 110)


HARD = {"solver": "ecbs", "split": "none", "suboptimality": 1, "objective": "sum_of_costs"}


def write_files(directory, blocked=ROOM, starts=STARTS, goals=GOALS):
    map_path, scen_path = (os.path.join(directory, name) for name in ("room.map", "room.scen"))
    height, width = blocked.shape
    with open(map_path, "w", encoding="ascii") as file:
        file.write("type octile\nheight %d\nwidth %d\nmap\n" % (height, width))
        file.writelines("".join(".@"[cell] for cell in row) + "\n" for row in blocked)
    with open(scen_path, "w", encoding="ascii") as file:
        file.write("version 1\n")
        for start, goal in zip(starts, goals):
            file.write("0\troom.map\t%d\t%d\t%d\t%d\t%d\t%d\t0\n" % (width, height, *start, *goal))
    return map_path, scen_path


class Plan(unittest.TestCase):
    def test_plans_on_an_array(self):
        result = split_mapf.plan(ROOM, STARTS, GOALS)
        self.assertTrue(result, result)
        self.assertEqual((result.status, result.agents, result.seed), ("solved", 3, 0))
        self.assertEqual([path[0].tolist() for path in result.paths], [list(c) for c in STARTS])
        self.assertEqual([path[-1].tolist() for path in result.paths], [list(c) for c in GOALS])
        self.assertEqual(result.makespan, max(len(path) for path in result.paths) - 1)
        self.assertEqual(result.sum_of_costs, sum(len(path) - 1 for path in result.paths))
        self.assertEqual(result.positions().shape, (result.makespan + 1, 3, 2))
        self.assertEqual(result.positions()[-1].tolist(), [list(c) for c in GOALS])
        self.assertEqual(split_mapf.validate(ROOM, STARTS, GOALS, result), [])
        self.assertIn("3 robots, makespan %d" % result.makespan, repr(result))

    def test_takes_every_kind_of_array(self):
        wanted = split_mapf.plan(ROOM, STARTS, GOALS).positions().tolist()
        occupancy = ROOM.astype(numpy.int8) * -1  # unknown, as ROS says it
        for cells in (ROOM.tolist(), ROOM == 1, ROOM * 100, ROOM.astype(float), occupancy,
                      numpy.asfortranarray(ROOM)):
            for starts in (STARTS, numpy.array(STARTS), numpy.array(STARTS, numpy.uint8),
                           [list(start) for start in STARTS],
                           numpy.array(STARTS + STARTS)[:3][::1]):
                result = split_mapf.plan(cells, starts, GOALS)
                self.assertEqual(result.positions().tolist(), wanted)

    def test_gives_the_plan_of_the_command(self):
        with tempfile.TemporaryDirectory() as directory:
            map_path, scen_path = write_files(directory)
            starts, goals = split_mapf.read_scenario(scen_path, map_path)
            self.assertEqual((starts.tolist(), goals.tolist()),
                             ([list(c) for c in STARTS], [list(c) for c in GOALS]))
            self.assertEqual(split_mapf.read_scenario(scen_path, ROOM, agents=2)[0].shape, (2, 2))
            self.assertEqual(split_mapf.read_map(map_path).tolist(), (ROOM == 1).tolist())
            plan_path = os.path.join(directory, "plan.json")
            subprocess.run([os.environ["SPLIT_MAPF_COMMAND"], "plan", "--map", map_path, "--scen",
                            scen_path, "--output", plan_path, "--quiet", "--seed", "7"],
                           check=True)
            with open(plan_path, encoding="ascii") as file:
                of_command = json.load(file)
            result = split_mapf.plan(map_path, starts, goals, seed=7)
        said = json.loads(result.json())
        self.assertEqual(said["paths"], of_command["paths"])
        self.assertEqual(said.keys(), of_command.keys())
        for name in said.keys() - {"layout", "paths", "trace", "stages", "subproblems"}:
            self.assertEqual(getattr(result, name), said[name], name)
        self.assertEqual(result.subproblems, said["subproblems"])
        self.assertEqual(result.stages, said["stages"])

    def test_has_the_defaults_of_the_library(self):
        request = planning._core.Request()
        for name, parameter in inspect.signature(split_mapf.plan).parameters.items():
            if hasattr(request, name):
                wanted = getattr(request, name)
                default = parameter.default
                self.assertEqual(list(default) if isinstance(default, tuple) else default, wanted,
                                 name)

    def test_does_what_options_say(self):
        map_array, starts, goals = numpy.zeros((8, 8)), [(0, 0), (7, 0)], [(7, 0), (0, 0)]
        result = split_mapf.plan(map_array, starts, goals, solver="ecbs", split="2t",
                                 split_options={"compaction": False}, objective="sum_of_costs",
                                 solver_options=["bypass=false"], threads=1)
        self.assertTrue(result, result)
        self.assertEqual((result.solver, result.split, result.objective, result.threads),
                         ("ecbs", "2t", "sum_of_costs", 1))
        self.assertEqual(len(result.subproblems), 2)
        self.assertIn("ecbs", split_mapf.solvers())

    def test_says_why_there_is_no_plan(self):
        corridor = [[0, 0, 0, 0]]
        result = split_mapf.plan(corridor, [(0, 0), (3, 0)], [(3, 0), (0, 0)])
        self.assertFalse(result)
        self.assertEqual((result.status, result.paths, result.makespan, result.gap),
                         ("unsolvable", [], None, None))
        self.assertIn("robot", result.message)
        late = split_mapf.plan(*crowd(), time_limit=0.3, **HARD)
        self.assertEqual((late.status, bool(late)), ("timeout", False))
        self.assertEqual(split_mapf.plan(ROOM, STARTS, GOALS, time_limit=0).status, "timeout")


class Callback(unittest.TestCase):
    def test_is_called_with_better_and_better_plans_and_may_end_the_search(self):
        seen = []

        def look(result):
            self.assertIs(threading.current_thread(), threading.main_thread())
            seen.append(result.sum_of_costs)
            return len(seen) < 3

        map_array, starts, goals = crowd()
        result = split_mapf.plan(map_array, starts, goals, objective="sum_of_costs",
                                 refine=500, time_limit=500, callback=look)
        self.assertGreaterEqual(len(seen), 3)
        self.assertEqual(seen, sorted(seen, reverse=True))
        self.assertLessEqual(result.sum_of_costs, seen[-1])
        self.assertEqual(split_mapf.validate(map_array, starts, goals, result), [])

    def test_raises_out_of_the_call(self):
        def fail(result):
            raise LookupError("enough of %d" % result.agents)

        with self.assertRaisesRegex(LookupError, "enough of 110"):
            split_mapf.plan(*crowd(), refine=500, time_limit=500, callback=fail)


class Interrupt(unittest.TestCase):
    def setUp(self):
        # A shell has what it starts in the background ignore Ctrl-C.
        signal.signal(signal.SIGINT, signal.default_int_handler)

    def interrupted(self, call):
        """Seconds from Ctrl-C to the end of the call."""
        sent = []

        def send():
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(0.3, send)
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            call()
        return time.monotonic() - sent[0]

    def test_ctrl_c_ends_a_call(self):
        problem = crowd()
        paths = split_mapf.plan(*problem)
        for name, call in (
                ("plan", lambda: split_mapf.plan(*problem, time_limit=500, **HARD)),
                ("refine", lambda: split_mapf.refine(*problem, paths, 500))):
            seconds = self.interrupted(call)
            print("%s ended %.0f ms after Ctrl-C" % (name, 1000 * seconds))
            self.assertLess(seconds, 20, name)
        self.assertTrue(split_mapf.plan(ROOM, STARTS, GOALS), "the next call")

    def test_other_threads_run_meanwhile(self):
        turns = []
        end = threading.Event()

        def count():
            while not end.wait(0.002):
                turns.append(1)

        thread = threading.Thread(target=count)
        thread.start()
        split_mapf.plan(*crowd(), time_limit=0.5, **HARD)
        end.set()
        thread.join()
        self.assertGreater(len(turns), 10)

    def test_plans_in_several_threads(self):
        results = []
        threads = [threading.Thread(target=lambda: results.append(
            split_mapf.plan(ROOM, STARTS, GOALS).positions().tolist())) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(results, [results[0]] * 4)


class Refine(unittest.TestCase):
    def test_makes_a_given_plan_better(self):
        problem = crowd()
        first = split_mapf.plan(*problem, solver="lacam")
        seen = []
        result = split_mapf.refine(*problem, first.paths, 500, objective="sum_of_costs", threads=1,
                                   callback=lambda better: (seen.append(better.sum_of_costs),
                                                            len(seen) < 2)[1])
        self.assertLess(result.sum_of_costs, first.sum_of_costs)
        self.assertEqual(split_mapf.validate(*problem, result), [])
        self.assertIn("from sum_of_costs %d to %d" % (first.sum_of_costs, result.sum_of_costs),
                      result.message)

    def test_ends_when_nothing_can_be_better(self):
        result = split_mapf.refine(ROOM, [(0, 0)], [(2, 0)],
                                   [[(0, 0), (0, 1), (0, 0), (1, 0), (2, 0), (2, 0)]], 500)
        self.assertEqual(result.paths[0].tolist(), [[0, 0], [1, 0], [2, 0]])
        self.assertEqual((result.optimal, result.certified_by), (True, "shortest_paths"))

    def test_refuses_what_is_no_plan(self):
        for paths, text in (([[(0, 0), (2, 0)]], "1 violation; the first: robot 0"),
                            ([[(0, 0), (2, 2)]], r"robot 0 is in \(2,2\) at step 1; a free cell"),
                            ([[]], "the first: robot 0"), ([], "1 violation"),
                            (7, "a list of one array"), ([7], "robot 0: its path is 7"),
                            ([[(0, 0), (1.5, 0)]], r"robot 0: its path has \(1.5, 0\) at step 1")):
            with self.assertRaisesRegex(split_mapf.InputError, text):
                split_mapf.refine(ROOM, [(0, 0)], [(2, 0)], paths)


class Validate(unittest.TestCase):
    def test_names_every_violation(self):
        found = split_mapf.validate(
            numpy.zeros((1, 4)), [(0, 0), (1, 0)], [(1, 0), (0, 0)],
            [[(0, 0), (1, 0)], numpy.array([[1, 0], [0, 0]])])
        self.assertEqual([(v.kind, v.robot, v.other, v.step) for v in found],
                         [("swap_conflict", 0, 1, 1)])
        self.assertEqual(str(found[0]), found[0].message)
        kinds = [v.kind for v in split_mapf.validate(
            [[0, 1, 0]], [(0, 0)], [(2, 0)], [[(0, 0), (1, 0), (9, 9)], [(0, 0)]])]
        self.assertEqual(set(kinds), {"robot_count", "outside_grid", "wrong_goal", "jump",
                                      "vertex_conflict"} & set(kinds))
        self.assertIn("outside_grid", kinds)


class Check(unittest.TestCase):
    def test_tells_solvable_from_unsolvable(self):
        self.assertTrue(split_mapf.check(ROOM, STARTS, GOALS))
        verdict = split_mapf.check([[0, 0, 0]], [(0, 0), (2, 0)], [(2, 0), (0, 0)])
        self.assertFalse(verdict)
        self.assertEqual((verdict.status, sorted(verdict.robots)), ("unsolvable", [0, 1]))
        self.assertEqual(verdict.cells.shape[1], 2)
        self.assertIn("robot", verdict.reason)
        self.assertEqual(split_mapf.check(ROOM, STARTS, GOALS, time_limit=0).status, "undecided")


class BadInput(unittest.TestCase):
    def test_names_robot_cell_and_what_was_expected(self):
        with self.assertRaises(split_mapf.InstanceError) as caught:
            split_mapf.plan(ROOM, [(0, 0), (2, 2), (0, 0)], [(9, 0), (3, 2), (4, 4)])
        error = caught.exception
        self.assertIsInstance(error, ValueError)
        self.assertEqual([(fault.robot, fault.cell, fault.kind) for fault in error.faults],
                         [(0, (9, 0), "outside_map"), (1, (2, 2), "blocked_cell"),
                          (1, (3, 2), "blocked_cell"), (2, (0, 0), "duplicate_start")])
        self.assertEqual((error.robot, error.cell), (0, (9, 0)))
        self.assertIn("its goal (9,0) lies outside the map of 9x6 cells", str(error))
        with self.assertRaises(split_mapf.InstanceError) as caught:
            split_mapf.check(ROOM, [(0, 0), (1, 0)], [(4, 4), (4, 4)])
        self.assertEqual((caught.exception.robot, caught.exception.cell), (1, (4, 4)))

    def test_is_a_value_error_that_says_what_was_expected(self):
        start, goal = [(0, 0)], [(1, 0)]
        for arguments, options, text in (
                ((ROOM, [(0.5, 0)], goal), {}, r"robot 0: its start is \(0.5, 0\); two whole"),
                ((ROOM, start, [(0, 0, 0)]), {}, r"robot 0: its goal is \(0, 0, 0\); two whole"),
                ((ROOM, [(0, 0), 3], goal), {}, "robot 1: its start is 3; two whole"),
                ((ROOM, 3, goal), {}, "starts: 3 was given, a list of cells"),
                ((ROOM, [(2**40, 0)], goal), {}, "robot 0: its start is"),
                ((ROOM, numpy.array([[2**40, 0]]), goal), {}, "robot 0: its start is"),
                ((ROOM, [(True, 0)], goal), {}, "robot 0: its start is"),
                ((ROOM, [], []), {}, "at least one robot"),
                ((ROOM, start, goal * 2), {}, "1 start but 2 goals"),
                ((ROOM[0], start, goal), {}, r"map: an array of shape \(9,\)"),
                (([[0], [0, 1]], start, goal), {}, "map: "),
                (([["a"]], start, goal), {}, "map: an array of shape"),
                ((None, start, goal), {}, "map: an array of shape"),
                ((numpy.zeros((0, 3)), start, goal), {}, "0"),
                ((numpy.zeros((1, 40000)), start, goal), {}, "40000"),
                (("", start, goal), {}, "name of the file is empty"),
                (("/nowhere.map", start, goal), {}, "/nowhere.map"),
                (("map.txt", start, goal), {}, "map.txt"),
                ((ROOM, start, goal), {"solver": "cbs"}, "'cbs'"),
                ((ROOM, start, goal), {"solver": 3}, "solver: 3 was given, text"),
                ((ROOM, start, goal), {"split": "4q"}, "4q"),
                ((ROOM, start, goal), {"objective": "speed"}, "speed"),
                ((ROOM, start, goal), {"suboptimality": 0.5}, "0.5"),
                ((ROOM, start, goal), {"suboptimality": float("nan")}, "nan was given"),
                ((ROOM, start, goal), {"time_limit": -1}, "time_limit: -1 was given"),
                ((ROOM, start, goal), {"time_limit": "1"}, "time_limit: '1' was given"),
                ((ROOM, start, goal), {"refine": 1e30}, "1e"),
                ((ROOM, start, goal), {"seed": -1}, "seed: -1 was given, a whole number from 0"),
                ((ROOM, start, goal), {"threads": 5000}, "threads: 5000 was given"),
                ((ROOM, start, goal), {"solver": "ecbs", "solver_options": {"colour": "red"}},
                 "colour"),
                ((ROOM, start, goal), {"split_options": 3}, "split_options: 3 was given"),
                ((ROOM, start, goal), {"callback": 3}, "callback: 3 was given"),
                ((ROOM, start, goal), {"unknown_space": "maybe"}, "unknown_space: 'maybe'"),
                ((ROOM, start, goal), {"occupied_threshold": 0}, "occupied_threshold: 0")):
            with self.subTest(text=text), self.assertRaisesRegex(ValueError, text):
                split_mapf.plan(*arguments, **options)
        self.assertTrue(issubclass(split_mapf.UnknownSolverError, split_mapf.OptionError))
        with self.assertRaises(split_mapf.UnknownSolverError):
            split_mapf.plan(ROOM, start, goal, solver="cbs")
        with self.assertRaises(split_mapf.SplitSpecError):
            split_mapf.plan(ROOM, start, goal, split="4q")
        with self.assertRaises(TypeError):
            split_mapf.plan(ROOM, start, goal, colour="red")
        with self.assertRaises(AttributeError):
            print(split_mapf.colour)

    def test_never_ends_the_interpreter(self):
        things = [None, 0, -1, 2**70, 0.5, float("nan"), "", "x", b"\xff", "\udcff", [], [[]],
                  [[0]], [(0, 0)], {}, object(), numpy.zeros(()), numpy.zeros((2, 2, 2)), numpy.nan,
                  numpy.array([[-1, -1]]), numpy.array([[2**31 - 1, 0]]), numpy.zeros((0, 2), int),
                  ROOM, STARTS, lambda: 0]
        draw = random.Random(5)
        for _ in range(300):
            call = draw.choice((split_mapf.plan, split_mapf.check, split_mapf.validate,
                                split_mapf.refine))
            arguments = [draw.choice(things) if draw.random() < 0.5 else good
                         for good in (ROOM, STARTS, GOALS)]
            if call in (split_mapf.validate, split_mapf.refine):
                arguments.append(draw.choice(things))
            if call is split_mapf.refine:
                arguments.append(0.01)
            try:
                call(*arguments)
            except ValueError as error:
                self.assertGreater(len(str(error)), 10, arguments)


if __name__ == "__main__":
    unittest.main()
