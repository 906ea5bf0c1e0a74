"""Space splits as a user sees them: plan, the layout in the JSON, render --regions."""

import unittest

from command import CommandTest


class LayoutTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.generate("g", "--width", 40, "--height", 32, "--agents", 30, "--seed", 4)

    def test_every_phase_owns_every_cell_and_ends_in_a_state_a_robot(self):
        plan = self.plan(0, "g", "--split", "2x2s2t")
        layout = plan["layout"]
        self.assertEqual(layout["partition"], "rectangles")
        for runs in layout["ownerships"]:
            self.assertEqual(sum(cells for _, cells in runs), 40 * 32)
            self.assertEqual({region for region, _ in runs} - {-1}, {0, 1, 2, 3})
        self.assertGreater(len(layout["buffers"]), 0)
        for phase in layout["phases"]:
            self.assertEqual(len({tuple(state) for state in phase["states"]}), 30)
        goals = [path[-1] for path in plan["paths"]]
        self.assertEqual(layout["phases"][-1]["states"], goals)
        self.assertEqual({row["phase"] for row in plan["subproblems"]},
                         set(range(len(layout["phases"]))))
        self.expect(0, "validate", *self.files("g"), "--plan", "g.json")

    def test_a_time_split_has_no_layout(self):
        self.assertIsNone(self.plan(0, "g", "--split", "2t")["layout"])

    def test_render_shows_regions(self):
        self.plan(0, "g", "--split", "4s", "--split-option", "partition=dynamic")
        call = ["render", *self.files("g"), "--plan", "g.json", "--output", "g.png"]
        pictures = set()
        for extra in [[], ["--regions"], ["--regions", "--phase", 1]]:
            self.expect(0, *call, *extra)
            with open(self.path("g.png"), "rb") as file:
                pictures.add(file.read())
        self.assertEqual(len(pictures), 3)
        self.assertIn("no phase 99", self.expect(1, *call, "--regions", "--phase", 99).stderr)
        self.assertIn("--regions", self.expect(1, *call, "--phase", 1).stderr)
        self.plan(0, "g", "--split", "none")
        self.assertIn("space split", self.expect(1, *call, "--regions").stderr)

    def test_options_without_a_meaning_are_refused(self):
        for split, option in [("4t", "buffer=4x2"), ("4s", "buffer=4"), ("4s", "buffer=1x2"),
                              ("4s", "lambda1=-1"), ("4s", "lambda2=nan"),
                              ("4s", "partition=round"), ("4t", "phase_steps=9")]:
            result = self.expect(1, "plan", *self.files("g"), "--split", split,
                                 "--split-option", option)
            self.assertIn(option.split("=")[0], result.stderr)
        self.assertIn("does not fit", self.expect(
            1, "plan", *self.files("g"), "--split", "1x64s",
            "--split-option", "partition=rectangles").stderr)


if __name__ == "__main__":
    unittest.main()
