"""Robots that have size, at any pose: plan, generate, validate and render on maps of map_server."""

import json
import math
import os
import struct
import unittest

from command import CommandTest

POSES = """robots:
- {id: a, start: [1.03, 2.0, 0], goal: [6.5, 2.02, 1.57]}
- {id: b, start: [6.1, 3.3, 0], goal: [1.0, 1.2, 0]}
"""


class PosesTest(CommandTest):
    def write_two_rooms(self, door=13, origin=(0, 0, 0)):
        """Two rooms of 3.5 m x 4.5 m with a door of so many cells in the wall between them."""
        gap = range(40, 40 + door)
        self.write_metric_map("rooms", ["." * 70 + ("." if y in gap else "#") * 3 + "." * 70
                                        for y in range(90)], origin=origin)

    def plan(self, code, *options):
        return self.expect(code, "plan", "--map", "rooms.yaml", "--scen", "poses.yaml",
                           "--robot-radius", 0.3, "--output", "plan.json", *options)

    def test_late_robots_that_have_size_keep_apart(self):
        self.write_two_rooms()
        self.write("poses.yaml", POSES)
        self.plan(0)
        files = ["--map", "rooms.yaml", "--scen", "poses.yaml", "--plan", "plan.json"]
        for policy in ["lockstep", "graph", "replan"]:
            self.expect(0, "simulate", *files, "--robot-radius", 0.3, "--policy", policy,
                        "--delay-probability", 0.05, "--max-delay", 5, "--output", "run.json")
            result = self.read_json("run.json")
            self.assertEqual(result["unfinished"], [])
            self.assertGreater(result["delayed_share"], 0)
            first, second = result["poses"]
            self.assertGreaterEqual(self.least_gap(first, second), 0.6 - 1e-5)
            self.assertAlmostEqual(math.hypot(first[-1][0] - 6.5, first[-1][1] - 2.02), 0)
            self.assertAlmostEqual(math.hypot(second[0][0] - 6.1, second[0][1] - 3.3), 0)
        # Another graph has other vertices.
        self.expect_refusal("not on the planning graph", "simulate", *files, "--cell-size", 1.2)
        self.expect_refusal("--release means nothing", "simulate", *files, "--release", 0.5)
        self.write_problem("grid", ["..", ".."], [((0, 0), (1, 1))])
        self.expect_refusal("--ignore-specks needs robots that have size", "simulate", "--map",
                            "grid.map", "--scen", "grid.scen", "--plan", "plan.json",
                            "--ignore-specks", 3)

    def least_gap(self, first, second):
        """Between two centres that go straight from step to step, sampled."""
        least = math.inf
        for step in range(max(len(first), len(second))):
            a, b = (way[min(step, len(way) - 1)] for way in (first, second))
            c, d = (way[min(step + 1, len(way) - 1)] for way in (first, second))
            for part in (share / 50 for share in range(50)):
                least = min(least, math.hypot(*(a[k] - b[k] + part * (c[k] - a[k] - d[k] + b[k])
                                                for k in (0, 1))))
        return least

    def test_plans_from_pose_to_pose(self):
        self.write_two_rooms()
        self.write("poses.yaml", POSES)
        self.plan(0, "--robot-speed", 0.5)
        result = self.read_json("plan.json")
        self.assertEqual(result["status"], "solved")
        self.assertEqual(result["robots"], ["a", "b"])
        self.assertEqual(result["grid"], {"resolution": 0.05, "width": 143, "height": 90,
                                          "origin": [0, 0, 0]})
        self.assertEqual((result["robot_radius"], result["clearance"]), (0.3, 0))
        self.assertAlmostEqual(result["step_duration"], result["longest_step"] / 0.5)
        first, second = result["poses"]
        self.assertEqual((first[0], first[-1]), ([1.03, 2.0], [6.5, 2.02]))
        self.assertEqual((second[0], second[-1]), ([6.1, 3.3], [1.0, 1.2]))
        self.assertGreaterEqual(self.least_gap(first, second), 0.6 - 1e-6)
        # Cells are those of the map, and the poses between the legs are their centres.
        x, y = result["paths"][0][0]
        begin = result["departure_steps"]
        for got, want in zip(first[begin], [(x + 0.5) * 0.05, (90 - y - 0.5) * 0.05]):
            self.assertAlmostEqual(got, want)
        self.assertIn("valid: 2 robots of radius 0.3 m", self.validate(0))

    def validate(self, code, *options):
        return self.expect(code, "validate", "--map", "rooms.yaml", "--scen", "poses.yaml",
                           "--plan", "plan.json", *options).stdout

    def test_a_turned_map_is_the_same_world(self):
        self.write_two_rooms(origin=(3, -2, math.pi / 2))
        self.write("poses.yaml", "robots:\n- {id: a, start: [1, -1, 0], goal: [0.5, 4.5, 0]}\n")
        self.plan(0)
        way = self.read_json("plan.json")["poses"][0]
        self.assertEqual((way[0], way[-1]), ([1, -1], [0.5, 4.5]))
        self.assertTrue(all(-1.5 < x < 3 and -2 < y < 5.15 for x, y in way), way)
        self.validate(0)

    def test_every_split_but_rectangles(self):
        self.write_two_rooms()
        self.write("poses.yaml", POSES)
        for split in ("none", "2t", "2s", "2s2t"):
            self.plan(0, "--split", split)
            self.validate(0)
        self.expect_refusal("partition=dynamic", "plan", "--map", "rooms.yaml", "--scen",
                            "poses.yaml", "--robot-radius", 0.3, "--split", "2s",
                            "--split-option", "partition=rectangles")

    def test_robots_of_several_sizes(self):
        self.write_two_rooms(door=17)
        self.write("poses.yaml", "robots:\n"
                   "- {id: small, start: [0.12, 0.15, 0], goal: [6.9, 4.3, 0], radius: 0.1}\n"
                   "- {id: large, start: [6, 3, 0], goal: [1, 1, 0], radius: 0.4}\n")
        self.plan(0, "--snap-distance", 2)
        result = self.read_json("plan.json")
        self.assertEqual((result["robot_radius"], result["radii"]), (0.4, [0.1, 0.4]))
        self.assertGreaterEqual(self.least_gap(*result["poses"]), 0.5 - 1e-6)
        self.validate(0)

    def test_radii_that_only_the_plan_says_were_ignored(self):
        self.write_two_rooms(door=17)
        self.write("poses.yaml", "robots:\n"
                   "- {id: medium, start: [0.5, 0.5, 0], goal: [6.8, 4.15, 0]}\n"
                   "- {id: large, start: [6, 3, 0], goal: [1, 1, 0], radius: 0.4}\n")
        self.plan(0, "--snap-distance", 2)
        plan = self.read_json("plan.json")
        self.assertEqual((plan["robot_radius"], plan["radii"]), (0.4, [0.3, 0.4]))
        self.validate(0)
        self.validate(8, "--robot-radius", 0.4)
        for radii, expected in (([0.3], "radii: read 1 number, expected 2"),
                                ([0.3, -1], "radii, robot 1: read '-1'"),
                                (7, "radii: read '7', expected a list")):
            self.write("plan.json", json.dumps({**plan, "radii": radii}))
            self.expect_refusal(expected, "validate", "--map", "rooms.yaml", "--scen",
                                "poses.yaml", "--plan", "plan.json")

    def test_cells_of_a_scen_are_poses_in_their_middle(self):
        self.write_two_rooms()
        self.write("poses.scen", "version 1\n0 rooms 143 90 20 20 120 60 0\n")
        self.expect(0, "plan", "--map", "rooms.yaml", "--scen", "poses.scen", "--robot-radius",
                    0.3, "--output", "plan.json")
        way = self.read_json("plan.json")["poses"][0]
        self.assertAlmostEqual(way[0][0], 1.025)
        self.assertAlmostEqual(way[0][1], 3.475)

    def test_validate_finds_discs_that_meet_between_steps(self):
        self.write_two_rooms()
        self.write("poses.yaml", POSES)
        self.plan(0)
        plan = self.read_json("plan.json")
        plan["poses"][0] = [[1.03, 2.0], [1.9, 2.0], [1.9, 2.0], [6.5, 2.02]]
        plan["poses"][1] = [[6.1, 3.3], [1.0, 1.2]]
        self.write("plan.json", json.dumps(plan))
        found = self.validate(8)
        self.assertIn("of an obstacle", found)
        self.assertIn("robot 'a' comes within", found)
        self.assertIn("of robot 'b' in step 1", found)
        plan["poses"][1] = [[6.1, 3.3], [1.1, 1.2]]
        self.write("plan.json", json.dumps(plan))
        self.assertIn("robot 'b' ends at (1.1, 1.2), its goal is (1, 1.2)", self.validate(8))

    def test_generate_draws_poses_that_can_be_planned_for(self):
        self.write_two_rooms()
        draw = ["generate", "--map", "rooms.yaml", "--robot-radius", 0.3, "--agents", 6]
        self.expect(0, *draw, "--output-scen", "poses.yaml")
        self.expect(0, *draw, "--output-scen", "again.yaml")
        with open(self.path("poses.yaml")) as one, open(self.path("again.yaml")) as other:
            self.assertEqual(one.read(), other.read())
        self.plan(0)
        self.validate(0)
        self.expect_refusal("no room for 500 robots", "generate", "--map", "rooms.yaml",
                            "--robot-radius", 0.3, "--agents", 500, "--output-scen", "poses.yaml")
        self.expect_refusal("expected for poses", *draw, "--output-scen", "poses.scen")
        self.expect_refusal("--width", *draw, "--output-scen", "poses.yaml", "--width", 5)

    def test_render_draws_discs_over_the_map(self):
        self.write_two_rooms()
        self.write("poses.yaml", POSES)
        self.plan(0)
        self.expect(0, "render", "--map", "rooms.yaml", "--scen", "poses.yaml", "--plan",
                    "plan.json", "--output", "plan.png", "--scale", 4)
        with open(self.path("plan.png"), "rb") as file:
            header = file.read(24)
        self.assertEqual(struct.unpack(">II", header[16:24]), (143 * 4, 90 * 4))

    def test_faults_say_distance_and_need(self):
        self.write_two_rooms(door=11)
        plan = ["plan", "--map", "rooms.yaml", "--scen", "poses.yaml", "--robot-radius", 0.3]

        def robots(*rows):
            self.write("poses.yaml", "robots:\n" + "".join(
                f"- {{id: r{i}, start: {list(row[:2]) + [0]}, goal: {list(row[2:]) + [0]}}}\n"
                for i, row in enumerate(rows)))

        robots((1, 1, 0.2, 1), (1.5, 1, 2, 2), (3.6, 1, 1, 3), (9, 1, 2, 3))
        text = self.expect_refusal("robot 'r0': its goal (0.2, 1) is 0.2 m from an obstacle, "
                                   "0.3 m are needed", *plan).stderr
        self.assertIn("robot 'r1': its start (1.5, 1) is 0.5 m from that of robot 'r0', "
                      "0.6 m are needed", text)
        self.assertIn("robot 'r2': its start (3.6, 1) is 0 m from an obstacle", text)
        self.assertIn("robot 'r3': its start (9, 1) lies outside the map", text)
        # A door of 9 cells is too narrow. So is one of 11, but by centres of cells alone, which
        # reach 0.275 m in one of 12 as well, through which a disc fits, that is no proof.
        robots((1, 1, 6, 1))
        for door, code, way, status in ((9, 2, 0.225, "unsolvable"), (11, 6, 0.275, "no_plan_found"),
                                        (12, 6, 0.275, "no_plan_found")):
            self.write_two_rooms(door)
            text = self.expect(code, *plan, "--output", "plan.json").stderr
            self.assertIn(f"the widest way from its start to its goal has {way} m to an obstacle "
                          "at (3.", text)
            self.assertIn("0.3 m needed", text)
            self.assertEqual(self.read_json("plan.json")["status"], status)
        # All discs in one place.
        robots((1, 1, 1, 1), (1, 1, 1, 1), (1, 1, 1, 1))
        self.expect_refusal("is 0 m from that of robot 'r0'", *plan)

    def test_bad_pose_files_name_their_line(self):
        self.write_two_rooms()
        plan = ["plan", "--map", "rooms.yaml", "--scen", "poses.yaml", "--robot-radius", 0.3]
        for line, expected in (
                ("- {id: a, start: [1, 1, 0]}", "robot 'a': goal is missing"),
                ("- {start: [1, 1, 0], goal: [1, 1, 0]}", "without the key 'id'"),
                ("- {id: a, start: [1, .nan, 0], goal: [1, 1, 0]}", "expected a finite number"),
                ("- {id: a, start: [1, 1], goal: [1, 1, 0]}", "expected [x, y, yaw]"),
                ("- {id: a, start: [1, 1, 0], goal: [1, 1, 0], size: 1}", "the key 'size'"),
                ("- {id: a, start: [1, 1, 0], goal: [1, 1, 0], radius: -1}", "radius: read '-1'"),
                ("- {id: z, start: [1, 1, 0], goal: [1, 1, 0]}",
                 "the id 'z' a second time (first in line 2)"),
                ("- 7", "read no robot")):
            self.write("poses.yaml", "robots:\n- {id: z, start: [1, 1, 0], goal: [2, 2, 0]}\n"
                       + line + "\n")
            self.expect_refusal(["poses.yaml:3: ", expected], *plan)
        self.write("poses.yaml", "robots: [\n")
        self.expect_refusal(["poses.yaml:2: ", "malformed YAML"], *plan)
        self.write("poses.yaml", "robots: []\n")
        self.expect_refusal(["poses.yaml:1: ", "no robots"], *plan)
        self.write("poses.yaml", POSES)
        self.expect_refusal(["poses.yaml:2: ", "3 robots"], *plan, "--agents", 3)

    def test_bad_options(self):
        self.write_two_rooms()
        self.write("poses.yaml", POSES)
        self.write_problem("grid", ["..", ".."], [((0, 0), (1, 1))])
        plan = ["plan", "--map", "rooms.yaml", "--scen", "poses.yaml"]
        self.expect_refusal("nowhere on the map", *plan, "--robot-radius", 5)
        self.expect_refusal("at least 0.85 m is needed", *plan, "--robot-radius", 0.3,
                            "--cell-size", 0.5)
        self.expect_refusal("ten cell sizes", *plan, "--robot-radius", 0.3, "--snap-distance", 9)
        self.expect_refusal("no metres", "plan", "--map", "grid.map", "--scen", "grid.scen",
                            "--robot-radius", 0.3)
        self.expect_refusal("--snap-distance", "plan", "--map", "grid.map", "--scen", "grid.scen",
                            "--snap-distance", 1)
        # validate and render made nothing of it.
        self.plan(0)
        for command in (["validate"], ["render", "--output", "plan.png"]):
            self.expect_refusal("snap-distance", *command, "--map", "rooms.yaml", "--scen",
                                "poses.yaml", "--plan", "plan.json", "--snap-distance", 1)
        # Those that know no sizes spoke of 'version 1' and of jumps.
        self.write_problem("rooms", ["." * 143] * 90, [((20, 49), (130, 49)), ((122, 23), (20, 65))])
        for command in (["check"], ["bench", "--agents", 2]):
            text = self.expect(1, *command, "--map", "rooms.yaml", "--scen", "poses.yaml").stderr
            self.assertIn("poses.yaml: holds poses of robots that have size", text)
        self.expect_refusal("plan.json: read a plan of robots that have size", "simulate", "--map",
                            "rooms.yaml", "--scen", "rooms.scen", "--plan", "plan.json")
        self.write_metric_map("rooms", ["."], resolution=1)
        self.write("poses.yaml", "robots:\n- {id: a, start: [0.5, 0.5, 0], goal: [0.5, 0.5, 0]}\n")
        self.plan(0)
        self.assertFalse(os.path.exists(self.path("plan.json.part")))


if __name__ == "__main__":
    unittest.main()
