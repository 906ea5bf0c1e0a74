"""Plans executed by robots that are late: options, results, refusals."""

import unittest

from command import CommandTest

KEYS = ["policy", "seed", "planned_sum_of_costs", "executed_sum_of_costs", "ratio",
        "planned_makespan", "executed_makespan", "delayed_share", "replans", "replan_cpu_ms",
        "unfinished", "paths"]
LATE = ("--delay-probability", 0.02, "--min-delay", 3, "--max-delay", 9)


class SimulateTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.generate("p", "--width", 16, "--height", 16, "--agents", 20)
        self.planned = self.plan(0, "p", "--objective", "sum_of_costs")

    def simulate(self, *options, code=0):
        self.expect(code, "simulate", *self.files("p"), "--plan", "p.json", "--output", "s.json",
                    *options)
        return self.read_json("s.json")

    def test_without_delays_the_plan_is_what_is_executed(self):
        result = self.simulate("--policy", "lockstep")
        for key in KEYS:
            self.assertIn(key, result)
        self.assertEqual(result["ratio"], 1)
        self.assertEqual(result["executed_sum_of_costs"], self.planned["sum_of_costs"])
        self.assertEqual(result["delayed_share"], 0)
        self.assertEqual(result["paths"], self.planned["paths"])

    def test_delays_cost_and_replanning_gives_some_of_it_back(self):
        ratios = {}
        for policy in ["lockstep", "graph", "replan"]:
            result = self.simulate("--policy", policy, *LATE, "--seed", 3)
            self.assertEqual(result["policy"], policy)
            self.assertEqual(result["unfinished"], [])
            self.assertEqual(set(result["replan_cpu_ms"]), {"mean", "max"})
            self.assertGreater(result["delayed_share"], 0)
            ratios[policy] = result["ratio"]
        self.assertGreater(ratios["lockstep"], ratios["graph"])
        self.assertGreaterEqual(ratios["graph"], ratios["replan"])

    def test_what_was_executed_is_a_valid_plan(self):
        self.simulate(*LATE, "--release", 0.7, "--turn-time", 0.5, "--delay-process", "poisson",
                      "--delay-distribution", "gaussian")
        self.expect(0, "validate", *self.files("p"), "--plan", "s.json")

    def test_the_same_seed_gives_the_same_execution(self):
        one = self.simulate(*LATE, "--seed", 5)
        two = self.simulate(*LATE, "--seed", 5)
        three = self.simulate(*LATE, "--seed", 6)
        self.assertEqual(one["paths"], two["paths"])
        self.assertNotEqual(one["paths"], three["paths"])

    def test_turns_and_releases_cost(self):
        plain = self.simulate("--policy", "graph")["ratio"]
        self.assertGreater(self.simulate("--policy", "graph", "--turn-time", 1)["ratio"], plain)
        self.assertGreater(self.simulate("--policy", "graph", "--release", 0.7)["ratio"], plain)

    def test_the_leagues_format(self):
        result = self.simulate(*LATE, "--export", "lorr")
        self.assertEqual(result["teamSize"], 20)
        self.assertEqual(result["numTaskFinished"], 20)
        lengths = {len(path.split(",")) for path in result["actualPaths"]}
        self.assertEqual(len(lengths), 1)
        moves = {"U": (-1, 0), "D": (1, 0), "L": (0, -1), "R": (0, 1), "W": (0, 0)}
        for robot in range(20):
            row, column, _ = result["start"][robot]
            for letter in result["actualPaths"][robot].split(","):
                row, column = row + moves[letter][0], column + moves[letter][1]
            self.assertEqual([row, column], result["tasks"][robot][2])
        self.assertEqual(len(result["delayIntervals"]), 20)
        self.assertTrue(any(result["delayIntervals"]))

    def test_robots_that_never_arrive_are_named(self):
        result = self.simulate("--policy", "graph", "--delay-probability", 1, "--step-limit", 9,
                               code=6)
        moving = [i for i, path in enumerate(self.planned["paths"]) if len(path) > 1]
        self.assertEqual(result["unfinished"], moving)

    def refuse(self, parts, *options):
        self.expect_refusal(parts, "simulate", *self.files("p"), "--plan", "p.json", *options)

    def test_refuses_what_cannot_be(self):
        self.refuse(["'warp'", "lockstep"], "--policy", "warp")
        self.refuse("probability", "--delay-probability", 1.5)
        self.refuse(["greatest delay", "least"], "--min-delay", 5, "--max-delay", 4)
        self.refuse("bernoulli", "--delay-process", "normal")
        self.refuse("uniform", "--delay-distribution", "normal")
        self.refuse("release", "--release", 2)
        self.refuse("turn-time", "--turn-time", -1)
        self.refuse("lorr", "--export", "planviz", "--output", "x.json")
        self.refuse("--output", "--export", "lorr")
        self.refuse("rings", "--rings", "forbid")

    def test_refuses_a_plan_that_is_not_valid(self):
        self.write("p.json", '{"paths": [[[0, 0], [5, 5]]]}')
        self.refuse(["p.json", "not valid"])
        self.write("p.json", '{"paths": []}')
        self.refuse("no plan")


class StraightenTest(CommandTest):
    @staticmethod
    def turns(paths):
        count = 0
        for path in paths:
            moves = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(path, path[1:]) if a != b]
            count += sum(a != b for a, b in zip(moves, moves[1:]))
        return count

    def test_takes_turns_out_and_keeps_every_cost(self):
        self.generate("p", "--width", 24, "--height", 24, "--agents", 40)
        plain = self.plan(0, "p", "--objective", "sum_of_costs")
        straight = self.plan(0, "p", "--objective", "sum_of_costs", "--straighten")
        self.assertEqual([len(path) for path in plain["paths"]],
                         [len(path) for path in straight["paths"]])
        self.assertLess(self.turns(straight["paths"]), 0.7 * self.turns(plain["paths"]))
        self.expect(0, "validate", *self.files("p"), "--plan", "p.json")


if __name__ == "__main__":
    unittest.main()
