#!/usr/bin/env python3
"""scripts/plan_client.py against the planner node, as a user starts it."""

import importlib.util
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import roslib.packages
import rosunit

from ros_processes import Program, start_program, write_hard_instance, write_instance

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "tool"))

from field_files import write_files  # noqa: E402 (its folder is known only now)

SYMBOLS = {0: ".", 100: "@", -1: "?"}


def load_client():
    """The client as a module, beside its command as where it was started."""
    sys.argv[0] = roslib.packages.find_node("split_mapf", "plan_client.py")[0]
    source = os.path.join(HERE, "..", "..", "scripts", "plan_client.py")
    spec = importlib.util.spec_from_file_location("plan_client", source)
    client = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(client)
    return client


def rows_of(grid):
    """From the top; the first row of the message is the lowest."""
    width, height = grid.info.width, grid.info.height
    text = "".join(SYMBOLS[value] for value in grid.data)
    return [text[row * width:(row + 1) * width] for row in reversed(range(height))]


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
        code = program.wait()
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
        for part in ("SUCCEEDED", "robots        4", "makespan", "sum of costs"):
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

    def test_says_that_there_is_no_master(self):
        client = Program(roslib.packages.find_node("split_mapf", "plan_client.py")[0], "--map",
                         self.map, "--scen", self.scen, "--wait", "0.5",
                         env={"ROS_MASTER_URI": "http://localhost:1"})
        self.addCleanup(client.end)
        self.assertEqual(client.wait(), 5, client.output())
        self.assertIn("no ROS master answers on http://localhost:1", client.output())

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
        self.assertIn("test.scen:6: read the end of the file after 4 robots, expected 5", output)
        self.edit(self.scen, "\t12\t", "\t13\t")
        code, output = self.run_client("--map", self.map, "--scen", self.scen)
        self.assertEqual(code, 1)
        self.assertIn("test.scen:2: read a map of 24x13", output)
        code, output = self.run_client("--colour", "red")
        self.assertEqual(code, 1)

    def test_reads_every_file_as_the_command_does(self):
        client = load_client()
        command = roslib.packages.find_node("split_mapf", "split_mapf")[0]
        for map_name, scenario, rows, ways, _ in write_files(self.directory):
            files = ["--map", os.path.join(self.directory, map_name), "--scen",
                     os.path.join(self.directory, scenario or "none.scen")]
            if not scenario:
                # The client always has robots: one that stays in a free cell.
                self.write_one_robot(files[3], rows or ["."])
            answer = subprocess.run([command, "check"] + files, stdout=subprocess.PIPE,
                                    stderr=subprocess.PIPE, check=False)
            try:
                grid, read_ways = client.read_instance(client.parse_arguments(files))
            except client.InputError as error:
                self.assertEqual(answer.returncode, 1, (map_name, scenario, answer))
                self.assertEqual("split_mapf: %s\n" % error, answer.stderr.decode())
                continue
            self.assertIn(answer.returncode, (0, 2), (map_name, scenario, answer))
            self.assertEqual(rows_of(grid), rows, (map_name, scenario))
            if ways:
                self.assertEqual(read_ways, ways, (map_name, scenario))

    @staticmethod
    def write_one_robot(path, rows):
        x, y = next((row.index("."), y) for y, row in enumerate(rows) if "." in row)
        with open(path, "w", encoding="ascii") as file:
            file.write("version 1\n0\tm.map\t%d\t%d\t%d\t%d\t%d\t%d\t0\n" %
                       (len(rows[0]), len(rows), x, y, x, y))

    def test_plans_on_a_map_server_map_at_its_place(self):
        write_files(self.directory)
        code, output = self.run_client(
            "--map", os.path.join(self.directory, "plain.yaml"),
            "--scen", os.path.join(self.directory, "several_tabs.scen"), "--output", self.plan)
        self.assertEqual(code, 0, output)
        with open(self.plan, encoding="ascii") as file:
            paths = json.load(file)["paths"]
        self.assertEqual([(path[0], path[-1]) for path in paths],
                         [([0, 0], [3, 2]), ([3, 0], [0, 2])])

    def test_reads_the_scenario_for_the_map_on_the_topic(self):
        message = "{header: {frame_id: map}, info: {resolution: 0.5, width: 24, height: 12, " \
                  "origin: {orientation: {w: 1.0}}}, data: %s}" % ([0] * 24 * 12)
        publisher = Program("rostopic", "pub", "-l", "map", "nav_msgs/OccupancyGrid", message)
        self.addCleanup(publisher.end)
        self.assertTrue(publisher.wait_for_output("latching"), publisher.output())
        code, output = self.run_client("--scen", self.scen, "--output", self.plan)
        self.assertEqual(code, 0, output)
        with open(self.plan, encoding="ascii") as file:
            self.assertEqual(json.load(file)["paths"][0][0], [1, 1])
        self.edit(self.scen, "\t12\t", "\t13\t")
        code, output = self.run_client("--scen", self.scen)
        self.assertEqual(code, 1, output)
        self.assertIn("test.scen:2: read a map of 24x13", output)

    def write_room(self, robots):
        """A room of 4 m x 3 m with a column of unknown cells in it, and a scenario of poses."""
        places = [os.path.join(self.directory, name) for name in ("room.yaml", "poses.yaml")]
        with open(os.path.join(self.directory, "room.pgm"), "w", encoding="ascii") as file:
            file.write("P2\n80 60\n255\n" + ("254 " * 40 + "205 " + "254 " * 39 + "\n") * 60)
        with open(places[0], "w", encoding="ascii") as file:
            file.write("image: room.pgm\nresolution: 0.05\norigin: [1, 2, 0.5]\nnegate: 0\n"
                       "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
        with open(places[1], "w", encoding="ascii") as file:
            file.write("robots:\n" + "".join("- %s\n" % robot for robot in robots))
        return places

    def test_plans_for_robots_that_have_size(self):
        room, poses = self.write_room(["{id: a, start: [1.5, 3.0, 0], goal: [3.5, 4.4, 1]}",
                                       "{id: b, start: [3.5, 3.7, 0], goal: [1.4, 3.6, 0]}"])
        files = ("--map", room, "--scen", poses)
        # The poses were taken to centres of cells, and nobody was told.
        code, output = self.run_client(*files)
        self.assertEqual(code, 1, output)
        self.assertIn("poses.yaml: robots at poses need a size", output)
        code, output = self.run_client(*files, "--clearance", "0.2", "--passages", "false",
                                       "--unknown-space", "free", "--robot-speed", "0.5",
                                       "--output", self.plan)
        self.assertEqual(code, 0, output)
        with open(self.plan, encoding="ascii") as file:
            plan = json.load(file)
        self.assertEqual(plan["grid"]["width"], 80)
        for found, wanted in zip(plan["grid"]["origin"], (1, 2, 0.5)):
            self.assertAlmostEqual(found, wanted)
        self.assertAlmostEqual(plan["step_duration"], plan["longest_step"] / 0.5)
        self.assertEqual((plan["poses"][0][0], plan["poses"][0][-1]), ([1.5, 3.0], [3.5, 4.4]))
        checked = start_program("split_mapf", "validate", *files, "--plan", self.plan,
                                "--unknown-space", "free")
        self.addCleanup(checked.end)
        self.assertEqual(checked.wait(), 0, checked.output())

    def test_refuses_a_resolution_that_would_have_no_effect(self):
        code, output = self.run_client("--scen", self.scen, "--resolution", "0.5")
        self.assertEqual(code, 1, output)
        write_files(self.directory)
        code, output = self.run_client("--map", os.path.join(self.directory, "plain.yaml"),
                                       "--scen", self.scen, "--resolution", "0.5")
        self.assertEqual(code, 1, output)
        self.assertIn("plain.yaml", output)

    def test_cancels_on_ctrl_c(self):
        map_path, scen_path = write_hard_instance(self.directory)
        client = self.start("--map", map_path, "--scen", scen_path, "--solver",
                            "ecbs", "--split", "none", "--suboptimality", "1", "--objective",
                            "sum_of_costs")
        self.assertTrue(client.wait_for_output(" s  solve"), client.output())
        os.killpg(client.process.pid, signal.SIGINT)
        self.assertEqual(client.wait(), 4, client.output())
        self.assertIn("CANCELLED (PREEMPTED)", client.output())


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "client_rostest", PlanClient)
