"""Solvers and splitters of other people's libraries."""

import os
import signal
import time
import unittest

from command import PATIENCE_S, CommandTest

EXAMPLE = os.environ["SPLIT_MAPF_EXAMPLE_PLUGINS"]
MISBEHAVING = os.environ["SPLIT_MAPF_MISBEHAVING_PLUGINS"]


class PluginTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write_problem("p", ["....", "...."], [((0, 0), (3, 0)), ((0, 1), (3, 1))])

    def plan_by(self, code, *options):
        self.expect(code, "plan", *self.files("p"), "--output", "p.json", *options)
        return self.read_json("p.json")

    def test_a_solver_and_a_splitter_plan(self):
        for options in (["--solver", "one_by_one"], ["--split", "every_other"]):
            result = self.plan_by(0, "--solver-plugins", EXAMPLE, *options)
            self.assertEqual(len(result["paths"]), 2)
            self.expect(0, "validate", *self.files("p"), "--plan", "p.json")

    def test_they_are_listed(self):
        text = self.expect(0, "solvers", "--solver-plugins", EXAMPLE,
                           "--solver-plugins", MISBEHAVING).stdout
        for part in ("one_by_one\n", "made by every_other\n", "misbehaving\n", "how=none"):
            self.assertIn(part, text)

    def test_what_does_wrong_has_no_plan(self):
        for how in ("throw", "collide", "unsolvable"):
            result = self.plan_by(6, "--solver-plugins", MISBEHAVING, "--solver", "misbehaving",
                               "--solver-option", "how=" + how)
            self.assertEqual(result["status"], "no_plan_found")
            self.assertIn("solver 'misbehaving' of plug-in", result["message"])

    def test_one_that_hangs_ends_at_the_limit_and_by_a_signal(self):
        hang = ["--solver-plugins", MISBEHAVING, "--solver", "misbehaving",
                "--solver-option", "how=hang"]
        result = self.plan_by(3, *hang, "--time-limit", "0.1")
        self.assertIn("did not stop at its deadline", result["message"])
        process = self.start("plan", *self.files("p"), *hang)
        time.sleep(0.3)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 4)

    def test_libraries_that_are_none(self):
        self.expect_refusal(["plug-in library 'none.so' cannot be loaded", "none.so"],
                            "solvers", "--solver-plugins", "none.so")
        self.expect_refusal(["solver 'one_by_one' is registered already"],
                            "solvers", "--solver-plugins", EXAMPLE, "--solver-plugins", EXAMPLE)
        self.environment = {"SPLIT_MAPF_MISBEHAVING_THROWS_WHEN_LOADED": "1"}
        self.expect_refusal(["threw something that is no std::exception while it was loaded"],
                            "solvers", "--solver-plugins", MISBEHAVING)


if __name__ == "__main__":
    unittest.main()
