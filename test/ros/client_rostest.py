#!/usr/bin/env python3
"""scripts/plan_client.py against the planner node, as a user starts it."""

import json
import os
import shutil
import signal
import tempfile
import unittest

import rosunit

from ros_processes import start_program, write_hard_instance, write_instance


class PlanClient(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.mkdtemp()
        self.map, self.scen = write_instance(self.directory)
        self.plan = os.path.join(self.directory, "plan.json")

    def tearDown(self):
        shutil.rmtree(self.directory)

    def start(self, *arguments):
        program = start_program("plan_client.py", *arguments)
        self.addCleanup(program.end)
        return program

    def run_client(self, *arguments):
        program = self.start(*arguments)
        code = program.wait(60)
        return code, program.output()

    def edit(self, path, old, new):
        with open(path, encoding="ascii") as file:
            text = file.read()
        self.assertIn(old, text)
        with open(path, "w", encoding="ascii") as file:
            file.write(text.replace(old, new, 1))

    def test_plans_and_prints_the_outcome(self):
        code, output = self.run_client("--map", self.map, "--scen", self.scen,
                                       "--output", self.plan)
        self.assertEqual(code, 0, output)
        for part in ("SUCCEEDED", "robots        4", "makespan", "sum of costs", "solve"):
            self.assertIn(part, output)
        with open(self.plan, encoding="ascii") as file:
            plan = json.load(file)
        self.assertEqual(plan["status"], "solved")
        self.assertEqual(len(plan["paths"]), 4)
        self.assertEqual(plan["paths"][0][0], [1, 1])
        self.assertEqual(plan["paths"][0][-1], [22, 1])
        checked = start_program("split_mapf", "validate", "--map", self.map, "--scen", self.scen,
                                "--plan", self.plan)
        self.addCleanup(checked.end)
        self.assertEqual(checked.wait(), 0, checked.output())

    def test_takes_the_first_robots_and_options(self):
        code, output = self.run_client("--map", self.map, "--scen", self.scen, "--agents", "2",
                                       "--solver", "prioritized", "--split", "none",
                                       "--objective", "sum_of_costs", "--output", self.plan)
        self.assertEqual(code, 0, output)
        with open(self.plan, encoding="ascii") as file:
            plan = json.load(file)
        self.assertEqual(plan["agents"], 2)
        self.assertEqual(plan["solver"], "prioritized")
        self.assertEqual(plan["objective"], "sum_of_costs")

    def test_tells_the_outcome_by_its_exit_code(self):
        base = ("--map", self.map, "--scen", self.scen)
        for code, part, arguments in (
                (1, "UNKNOWN_SOLVER", base + ("--solver", "oracle")),
                (1, "INVALID_SPLIT", base + ("--split", "8q")),
                (3, "TIMEOUT", base + ("--time-limit", "0")),
                (5, "no planner answers", base + ("--server", "nowhere", "--wait", "1")),
                (5, "no map on the topic", ("--scen", self.scen, "--wait", "1"))):
            found, output = self.run_client(*arguments)
            self.assertEqual(found, code, output)
            self.assertIn(part, output)

    def test_names_a_robot_that_is_cut_off(self):
        # Walls round the first robot's goal, in the upper right corner.
        with open(self.map, encoding="ascii") as file:
            lines = file.read().splitlines()
        lines[4:7] = [row[:21] + wall for row, wall in zip(lines[4:7], ("@@@", "@G@", "@@@"))]
        with open(self.map, "w", encoding="ascii") as file:
            file.write("\n".join(lines) + "\n")
        code, output = self.run_client("--map", self.map, "--scen", self.scen)
        self.assertEqual(code, 2, output)
        self.assertIn("'r0'", output)
        self.assertIn("UNREACHABLE_GOAL", output)

    def test_refuses_bad_input_naming_the_place(self):
        self.edit(self.map, "........................", "...........x............")
        code, output = self.run_client("--map", self.map, "--scen", self.scen)
        self.assertEqual(code, 1)
        self.assertIn("test.map:5: read 'x'", output)
        code, output = self.run_client("--map", self.map, "--scen", "nowhere.scen")
        self.assertEqual(code, 1)
        self.edit(self.map, "x", ".")
        code, output = self.run_client("--map", self.map, "--scen", self.scen, "--agents", "5")
        self.assertEqual(code, 1)
        self.assertIn("read 4 robots, expected 5", output)
        self.edit(self.scen, "\t12\t", "\t13\t")
        code, output = self.run_client("--map", self.map, "--scen", self.scen)
        self.assertEqual(code, 1)
        self.assertIn("test.scen:2: made for a map of 24x13", output)
        code, output = self.run_client("--colour", "red")
        self.assertEqual(code, 1)

    def test_cancels_on_ctrl_c(self):
        map_path, scen_path = write_hard_instance(self.directory)
        client = self.start("--map", map_path, "--scen", scen_path, "--solver",
                            "ecbs", "--split", "none", "--suboptimality", "1", "--objective",
                            "sum_of_costs")
        self.assertTrue(client.wait_for_output("solve"), client.output())
        os.killpg(client.process.pid, signal.SIGINT)
        self.assertEqual(client.wait(5), 4, client.output())
        self.assertIn("CANCELLED (PREEMPTED)", client.output())


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "client_rostest", PlanClient)
