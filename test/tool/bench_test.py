"""Sweeps: one CSV row a combination, everything checked before anything is run."""

import csv
import io
import unittest

from command import CommandTest


class BenchTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write_problem("p", ["....", "....", "...."],
                           [((0, 0), (3, 0)), ((3, 0), (0, 0)), ((0, 2), (3, 2))])

    def bench(self, *arguments):
        result = self.run_command("bench", "--map", "p.map", "--scen", "p.scen", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return list(csv.DictReader(io.StringIO(result.stdout)))

    def test_every_combination_has_a_row(self):
        rows = self.bench("--agents", "2,3", "--solvers", "ecbs,conflict_optimizer",
                          "--splits", "none,t(0.4,0.6)", "--objective", "sum_of_costs")
        self.assertEqual([(r["agents"], r["solver"], r["split"]) for r in rows],
                         [(n, solver, split) for n in ("2", "3")
                          for solver in ("ecbs", "conflict_optimizer")
                          for split in ("none", "t(0.4,0.6)")])
        for row in rows:
            self.assertEqual((row["status"], row["objective"], row["map"]),
                             ("solved", "sum_of_costs", "p.map"))
            self.assertEqual((row["cells"], row["conflicting"], row["largest_group"],
                              row["head_on"]), ("12", "1", "2", "0"))
            self.assertEqual(row["sum_of_costs_lower_bound"], "6" if row["agents"] == "2" else "9")
            self.assertGreaterEqual(int(row["sum_of_costs"]), int(row["sum_of_costs_lower_bound"]))
            self.assertGreaterEqual(float(row["seconds"]), float(row["first_plan_s"]))

    def test_a_file_gets_the_same_table(self):
        self.bench("--agents", "3", "--output", "table.csv")
        with open(self.path("table.csv")) as file:
            self.assertEqual(len(list(csv.DictReader(file))), 1)

    def test_nothing_is_run_before_everything_is_right(self):
        for arguments, what in [(["--solvers", "ecbs,magic"], "magic"),
                                (["--splits", "none,4x"], "4x"),
                                (["--agents", "2,0"], "'0'"),
                                (["--agents", "2,,3"], "empty"),
                                (["--map", "p.map", "--agents", "2"], "2 maps for 1")]:
            with self.subTest(arguments=arguments):
                agents = [] if "--agents" in arguments else ["--agents", "2"]
                result = self.run_command("bench", "--map", "p.map", "--scen", "p.scen", *agents,
                                          *arguments)
                self.assertEqual(result.returncode, 1)
                self.assertIn(what, result.stderr)
                self.assertEqual(result.stdout, "")


if __name__ == "__main__":
    unittest.main()
