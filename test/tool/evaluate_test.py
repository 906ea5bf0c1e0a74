"""scripts/evaluate runs what a description says, once, and keeps a row of each run."""

import csv
import fcntl
import importlib.util
import os
import subprocess
import unittest

from command import COMMAND, PATIENCE_S, CommandTest

SCRIPT = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))),
                      "scripts", "evaluate")
DESCRIPTION = """
maps:
  small: {data: movingai/small, generate: --width 16 --height 16 --density 0}
experiments:
  splits:
    title: Splits
    plot: robots
    map: small
    solver: ecbs
    scenarios: 2
    limit: 20
    robots: [5, 10]
    series: {none: {}, 2t: {split: 2t, split_options: [variant=makespan]}}
    quick: {robots: [5], scenarios: 1}
  hopeless:
    title: No time at all
    plot: robots
    map: small
    limit: 0
    robots: [100, 120, 140]
    scenarios: 1
"""


@unittest.skipIf(importlib.util.find_spec("yaml") is None, "python's yaml is not here")
class EvaluateTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("description.yaml", DESCRIPTION)

    def evaluate(self, *arguments, code=0, **environment):
        result = subprocess.run(
            ["/usr/bin/python3", "-B", SCRIPT, "--description", self.path("description.yaml"),
             "--output", self.path("out"), *arguments],
            env={"PATH": "/nowhere", "SPLIT_MAPF_COMMAND": COMMAND, **environment},
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=PATIENCE_S, check=False,
            universal_newlines=True)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def rows(self):
        with open(self.path("out/runs.csv"), encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def test_a_row_says_all_about_a_run(self):
        self.evaluate("splits")
        rows = self.rows()
        self.assertEqual([(row["series"], row["robots"], row["scenario"]) for row in rows],
                         [(series, robots, scenario) for series in ("none", "2t")
                          for robots in ("5", "10") for scenario in ("1", "2")])
        for row in rows:
            self.assertEqual((row["status"], row["solver"], row["source"]),
                             ("solved", "ecbs", self.rows()[0]["source"]))
            self.assertRegex(row["source"], "^generated-[0-9a-f]{8}$")
            self.assertGreaterEqual(int(row["makespan"]), int(row["makespan_lower_bound"]))
            self.assertGreater(float(row["peak_mib"]), 1)
            self.assertIn("validate=", row["stages"])
            self.assertEqual(row["pieces"], "2" if row["series"] == "2t" else "1")
            self.assertIn("--split-option variant=makespan" if row["series"] == "2t" else "none",
                          row["command"])

    def test_what_was_interrupted_goes_on(self):
        self.evaluate("splits")
        whole = self.rows()
        with open(self.path("out/runs.csv"), encoding="utf-8") as file:
            lines = file.read().splitlines(keepends=True)
        # Four runs, and half a row of the fifth.
        with open(self.path("out/runs.csv"), "w", encoding="utf-8") as file:
            file.write("".join(lines[:5]) + lines[5][:40])
        self.evaluate("splits")
        self.assertEqual(self.rows()[:4], whole[:4])
        self.assertEqual([row["makespan"] for row in self.rows()],
                         [row["makespan"] for row in whole])
        self.evaluate("splits")
        self.assertEqual(len(self.rows()), 8)

    def test_quick_runs_less(self):
        self.evaluate("--quick", "splits")
        self.assertEqual([row["robots"] for row in self.rows()], ["5", "5"])

    def test_a_map_that_is_generated_otherwise_is_another(self):
        self.evaluate("--quick", "splits")
        self.write("description.yaml", DESCRIPTION.replace("--width 16", "--width 9"))
        self.evaluate("--quick", "splits")
        self.assertEqual(len(self.rows()), 4)
        self.assertEqual(len([name for name in os.listdir(self.path("out/maps"))
                              if name.endswith(".scen")]), 2)

    def test_two_calls_at_once_do_not_read_each_others_results(self):
        os.makedirs(self.path("out"))
        with open(self.path("out/runs.csv.lock"), "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertIn("another call is at work", self.evaluate("splits", code=1).stderr)

    def test_more_robots_are_not_tried_where_fewer_had_no_plan(self):
        self.evaluate("hopeless")
        self.assertEqual([(row["robots"], row["status"]) for row in self.rows()],
                         [("100", "timeout")])

    def test_maps_of_others_are_used_where_they_are(self):
        os.makedirs(self.path("data/movingai"))
        self.expect(0, "generate", "--width", 8, "--height", 8, "--agents", 20,
                    "--output-map", "data/movingai/small.map",
                    "--output-scen", "data/movingai/small-random-1.scen")
        self.evaluate("--quick", "splits", SPLIT_MAPF_BENCHMARKS=self.path("data"))
        self.assertEqual({row["source"] for row in self.rows()}, {"data"})
        self.assertFalse(os.path.exists(self.path("out/maps")))

    def test_a_description_with_a_slip_is_refused(self):
        for old, new, part in [("solver: ecbs", "solvers: ecbs", "'solvers' says nothing"),
                               ("    map: small\n    solver", "    map: large\n    solver",
                                "map 'large' is not among the maps"),
                               ("    title: Splits\n", "", "needs a title"),
                               ("    map: small\n    solver", "    solver", "needs a map"),
                               ("plot: robots", "plot: pie", "'pie'")]:
            with self.subTest(new=new):
                self.write("description.yaml", DESCRIPTION.replace(old, new, 1))
                self.assertIn(part, self.evaluate(code=1).stderr)
        self.assertIn("no experiment magic", self.evaluate("magic", code=1).stderr)

    def test_a_run_that_may_not_end_so_is_shown_and_counted(self):
        self.write("description.yaml", DESCRIPTION.replace("split: 2t", "split: 2x"))
        result = self.evaluate("--quick", "splits", code=1)
        self.assertIn("--split 2x", result.stdout)
        self.assertEqual([row["series"] for row in self.rows()], ["none"])


if __name__ == "__main__":
    unittest.main()
