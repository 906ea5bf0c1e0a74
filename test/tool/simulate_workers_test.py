"""scripts/simulate_workers tells from the pieces of a run how long it takes with workers."""

import json
import os
import subprocess

from command import PATIENCE_S, CommandTest

SCRIPT = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))),
                      "scripts", "simulate_workers")


class SimulateWorkersTest(CommandTest):
    def simulate(self, *arguments, code=0):
        result = subprocess.run(
            ["/usr/bin/python3", "-B", SCRIPT, *arguments], stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, timeout=PATIENCE_S, check=False, universal_newlines=True)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def seconds_of(self, pieces, *arguments):
        """By number of machines. @param pieces  phase and seconds of each, beside 0.5 s of others."""
        rows = [{"phase": phase, "seconds": seconds} for phase, seconds in pieces]
        self.write("plan.json", json.dumps(
            {"subproblems": rows, "stages": {"split": 0.25, "solve": 99, "replan": 0.25}}))
        table = self.simulate(self.path("plan.json"), "--journey", "0", *arguments).stdout
        return {int(row[0]): float(row[1]) for row in map(str.split, table.splitlines()[2:])}

    def test_pieces_of_one_round_run_side_by_side(self):
        pieces = [(phase, 1) for phase in range(4)]
        self.assertEqual(self.seconds_of(pieces, "--machines", "1,2,3,4,8"),
                         {1: 4.5, 2: 2.5, 3: 2.5, 4: 1.5, 8: 1.5})
        self.assertEqual(self.seconds_of(pieces, "--machines", "1,2", "--threads", "2"),
                         {1: 2.5, 2: 1.5})

    def test_the_longest_begins_first(self):
        self.assertEqual(self.seconds_of([(0, 1), (0, 1), (1, 2)], "--machines", "2"), {2: 2.5})

    def test_a_round_waits_for_the_one_before(self):
        self.assertEqual(self.seconds_of([(0, 1), (1, 2), (0, 3)], "--machines", "1,2"),
                         {1: 6.5, 2: 5.5})

    def test_short_pieces_stay_at_home_and_journeys_count(self):
        self.assertEqual(self.seconds_of([(0, 1), (0, 1)], "--machines", "2", "--least", "1.5"),
                         {2: 2.5})
        self.assertEqual(self.seconds_of([(0, 1), (0, 1)], "--machines", "2", "--journey", "0.5"),
                         {2: 2.0})

    def test_it_reads_what_plan_writes(self):
        self.write_problem("small", ["........"] * 8, [((0, y), (7, 7 - y)) for y in range(6)])
        self.expect(0, "plan", "--map", "small.map", "--scen", "small.scen", "--split", "2s2t",
                    "--output", "plan.json")
        pieces = len(self.read_json("plan.json")["subproblems"])
        said = self.simulate(self.path("plan.json")).stdout
        self.assertTrue(said.startswith("%d pieces in 1 rounds: " % pieces), said)

    def test_other_files_are_refused(self):
        self.write("plan.json", "{}")
        self.assertIn("no result of plan", self.simulate(self.path("plan.json"), code=1).stderr)
        for wrong in [("--machines", "0"), ("--threads", "0"), ("--journey", "-1"), ("--least", "nan")]:
            said = self.simulate(self.path("plan.json"), *wrong, code=2).stderr
            self.assertIn("argument %s: invalid" % wrong[0], said)

    def test_rounds_are_told_only_by_phases(self):
        self.assertEqual(self.seconds_of([(0, 1), (0, 1)], "--machines", "2"), {2: 1.5})
