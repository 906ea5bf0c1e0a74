"""Fleets whose goals come one by one: options, results, refusals."""

import math
import unittest

from command import CommandTest

KEYS = ["steps", "warmup", "goals_reached", "throughput", "free_flow_share", "service_steps",
        "step_cpu_ms", "first_step_ms", "waiting", "paths", "goals"]


class RollTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.generate("p", "--width", 16, "--height", 16, "--agents", 40)

    def roll(self, *options, code=0):
        self.expect(code, "roll", "--map", "p.map", "--output", "r.json", *options)
        return self.read_json("r.json")

    def require_sound(self, result):
        """Every step of the paths, and every goal, looked at again."""
        steps = result["steps"]
        blocked = set()
        with open(self.path("p.map")) as file:
            for y, row in enumerate(file.read().split("map\n")[1].split()):
                blocked |= {(x, y) for x, cell in enumerate(row) if cell == "@"}
        paths = [[tuple(cell) for cell in path] for path in result["paths"]]
        for t in range(steps + 1):
            here = [path[t] for path in paths]
            self.assertEqual(len(set(here)), len(here))
            self.assertFalse(blocked & set(here))
        for path in paths:
            self.assertEqual(len(path), steps + 1)
            for a, b in zip(path, path[1:]):
                self.assertLessEqual(abs(a[0] - b[0]) + abs(a[1] - b[1]), 1)
        moves = [{(path[t], path[t + 1]) for path in paths if path[t] != path[t + 1]}
                 for t in range(steps)]
        for step in moves:
            self.assertFalse(step & {(b, a) for a, b in step})
        counted = 0
        for path, goals in zip(paths, result["goals"]):
            for step, x, y in goals:
                self.assertEqual(path[step], (x, y))
                counted += step > result["warmup"]
        self.assertEqual(counted, result["goals_reached"])
        self.assertAlmostEqual(result["throughput"], counted / (steps - result["warmup"]))

    def test_random_goals_at_any_number_of_threads(self):
        options = ("--agents", 40, "--steps", 60, "--warmup", 10, "--step-expansions", 5000,
                   "--seed", 3)
        one = self.roll(*options, "--threads", 1)
        for key in KEYS:
            self.assertIn(key, one)
        self.assertEqual(set(one["service_steps"]), {"mean", "median", "p99", "max"})
        self.assertGreater(one["throughput"], 1)
        self.require_sound(one)
        two = self.roll(*options, "--threads", 3)
        self.assertEqual(one["paths"], two["paths"])
        self.assertEqual(one["goals"], two["goals"])

    def test_takes_starts_of_a_scenario_and_a_limit_of_time(self):
        result = self.roll("--starts", "p.scen", "--agents", 7, "--steps", 20, "--step-time", 0.001)
        self.assertEqual(len(result["paths"]), 7)
        self.require_sound(result)

    def test_robots_that_are_late(self):
        options = ("--agents", 40, "--steps", 80, "--warmup", 0, "--step-expansions", 3000)
        late = self.roll(*options, "--delay-probability", 0.05, "--min-delay", 2, "--max-delay", 6)
        self.require_sound(late)
        self.assertAlmostEqual(late["delayed"], 4 / 24, delta=0.06)
        prompt = self.roll(*options)
        self.assertEqual(prompt["delayed"], 0)
        self.assertLess(late["goals_reached"], prompt["goals_reached"])

    def test_lists_of_goals(self):
        self.write_problem("p", ["......", "......"], [((0, 0), (5, 0))])
        self.write("t.yaml", "robots:\n- {start: [0, 0], goals: [[5, 0], [0, 1]]}\n"
                             "- {start: [5, 0], goals: [[0, 1]]}\n- {start: [3, 0]}\n")
        result = self.roll("--tasks", "t.yaml", "--steps", 30, "--warmup", 0)
        self.require_sound(result)
        self.assertEqual([[goal[1:] for goal in goals] for goals in result["goals"]],
                         [[[5, 0], [0, 1]], [[0, 1]], []])

    def test_the_leagues_files(self):
        self.write_problem("p", ["......", "......"], [((0, 0), (5, 0))])
        self.write("t.agents", "2\n0\n5\n")
        self.write("t.tasks", "3\n5\n0\n6,11\n")
        self.expect(0, "roll", "--map", "p.map", "--starts", "t.agents", "--tasks", "t.tasks",
                    "--steps", 40, "--export", "lorr", "--output", "r.json")
        result = self.read_json("r.json")
        self.assertEqual(result["teamSize"], 2)
        self.assertEqual(result["numTaskFinished"], 4)
        moves = {"U": (-1, 0), "D": (1, 0), "L": (0, -1), "R": (0, 1), "W": (0, 0)}
        for robot in range(2):
            row, column, _ = result["start"][robot]
            cells = [[row, column]]
            for letter in result["actualPaths"][robot].split(","):
                row, column = row + moves[letter][0], column + moves[letter][1]
                cells.append([row, column])
            self.assertEqual(len(cells), 41)
            for task, step, word in result["events"][robot]:
                if word == "finished":
                    self.assertEqual(cells[step], result["tasks"][task][2])

    def refuse(self, parts, *options):
        self.expect_refusal(parts, "roll", "--map", "p.map", *options)

    def test_refuses_what_cannot_be(self):
        self.write("t.yaml", "robots:\n- {start: [0, 99]}\n")
        self.refuse(["t.yaml:2", "robot 0", "outside"], "--tasks", "t.yaml")
        self.refuse("--agents", "--steps", 5)
        self.refuse(["'t.txt'", ".tasks"], "--tasks", "t.txt", "--agents", 2)
        self.refuse("connected", "--agents", 9999)
        self.refuse("--window", "--agents", 2, "--window", 32)
        self.refuse("exclude", "--agents", 2, "--step-time", 1, "--step-expansions", 1)
        self.refuse("warmup", "--agents", 2, "--steps", 10, "--warmup", 10)
        self.refuse("0 to 1", "--agents", 2, "--delay-probability", 1.5)
        self.refuse("below the least", "--agents", 2, "--min-delay", 3, "--max-delay", 2)
        self.refuse("lorr", "--agents", 2, "--export", "planviz", "--output", "x.json")
        self.refuse("starts of its own", "--tasks", "t.yaml", "--starts", "p.scen")

    def write_two_rooms(self):
        """Two rooms of 3.5 m x 4.5 m with a door in the wall between them, and a closet
        whose door is too narrow."""
        gap = range(40, 54)
        rows = ["." * 70 + ("." if y in gap else "#") * 3 + "." * 70 for y in range(90)]
        closet = ["#" * 10 + "." * 4 + "#" * 129] + ["#" + "." * 40 + "#" * 102] * 40
        self.write_metric_map("rooms", rows + closet)

    def roll_with_size(self, *options):
        self.expect(0, "roll", "--map", "rooms.yaml", "--robot-radius", 0.3, "--clearance", 0.02,
                    "--output", "r.json", *options)
        return self.read_json("r.json")

    def require_apart(self, result):
        """Centres that go straight from step to step, all sampled in between."""
        side = result["grid"]["resolution"]
        paths = [[(x * side, y * side) for x, y in path] for path in result["paths"]]
        needed = 2 * result["robot_radius"] + result["clearance"] - 1e-6
        for t in range(result["steps"]):
            for part in (0, 0.25, 0.5, 0.75):
                places = [(a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]))
                          for a, b in ((path[t], path[t + 1]) for path in paths)]
                for i, one in enumerate(places):
                    for other in places[:i]:
                        self.assertGreaterEqual(math.dist(one, other), needed, f"step {t}")
        for path in paths:
            for a, b in zip(path, path[1:]):
                self.assertLessEqual(math.dist(a, b), result["longest_step"] + 1e-6)

    def test_robots_that_have_size_keep_apart(self):
        self.write_two_rooms()
        options = ("--agents", 8, "--steps", 80, "--warmup", 10, "--step-expansions", 3000)
        result = self.roll_with_size(*options, "--robot-speed", 0.5)
        self.assertGreater(result["goals_reached"], 10)
        self.assertAlmostEqual(result["step_duration"], result["longest_step"] / 0.5)
        self.assertLess(result["turns"], 1)
        self.require_apart(result)
        self.assertEqual(self.roll_with_size(*options, "--threads", 2)["paths"], result["paths"])

    def test_robots_that_have_size_and_are_late_keep_apart(self):
        self.write_two_rooms()
        result = self.roll_with_size("--agents", 8, "--steps", 60, "--warmup", 0,
                                     "--step-expansions", 2000, "--delay-probability", 0.05,
                                     "--min-delay", 2, "--max-delay", 6)
        self.assertGreater(result["delayed"], 0.05)
        self.assertGreater(result["goals_reached"], 5)
        self.require_apart(result)

    def test_cells_of_the_map_stand_for_the_nearest_vertices(self):
        self.write_two_rooms()
        self.write("t.yaml", "robots:\n- {start: [12, 14], goals: [[128, 70], [20, 20]]}\n"
                             "- {start: [130, 13], goals: [[14, 71]]}\n")
        result = self.roll_with_size("--tasks", "t.yaml", "--steps", 40, "--warmup", 0)
        self.assertEqual([len(goals) for goals in result["goals"]], [2, 1])
        for (_, x, y), wanted in zip(result["goals"][0], [(128, 70), (20, 20)]):
            self.assertLess(math.dist((x, y), wanted), 18)  # the lattice's spacing is 19 cells
        self.require_apart(result)

    def test_refuses_what_robots_that_have_size_cannot_do(self):
        self.write_two_rooms()
        size = ("--map", "rooms.yaml", "--robot-radius", 0.3)
        for parts, text, *options in (
                (["robots 0 and 1", "nearest"], "- {start: [12, 14]}\n- {start: [13, 14]}\n"),
                (["a start", "0.01 m", "(12,14)"], "- {start: [12, 14]}\n", "--snap-distance", 0.01),
                (["robot 0", "cut off"], "- {start: [12, 14], goals: [[20, 110]]}\n")):
            self.write("t.yaml", "robots:\n" + text)
            self.expect_refusal(parts, "roll", *size, "--tasks", "t.yaml", *options)
        self.expect_refusal("lorr", "roll", *size, "--agents", 2, "--export", "lorr", "--output",
                            "x.json")
        self.expect_refusal("snap_distance is 100 m", "roll", *size, "--agents", 2,
                            "--snap-distance", 100)
        self.refuse(["metres", "map_server"], "--agents", 2, "--robot-radius", 0.3)
        self.refuse("--snap-distance needs robots that have size", "--agents", 2,
                    "--snap-distance", 1)

    def test_a_limit_ends_the_run(self):
        result = self.roll("--agents", 40, "--steps", 1000000, "--time-limit", 0.5, code=3)
        self.assertLess(result["steps"], 1000000)


if __name__ == "__main__":
    unittest.main()
