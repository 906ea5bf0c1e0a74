"""The command `roadmap`: planning graphs of robots that have size, on maps of map_server."""

import os
import re
import unittest

from command import CommandTest


class RoadmapTest(CommandTest):
    def write_two_rooms(self, door):
        """Two rooms of 60x60 cells with a door of so many cells in the wall between them."""
        gap = range(23, 23 + door)
        self.write_metric_map("rooms", ["." * 60 + ("." if y in gap else "#") * 3 + "." * 60
                                        for y in range(60)])

    def report(self, *options):
        text = self.expect(0, "roadmap", "--map", "rooms.yaml", *options).stdout
        return {name: float(number) for name, number in
                re.findall(r"(vertices|edges|reach|rooms|lost|seconds): ([0-9.]+)", text)}

    def test_passes_a_door_one_cell_wider_than_the_robot(self):
        self.write_two_rooms(door=13)
        report = self.report("--robot-radius", 0.3, "--output", "graph.png")
        self.assertEqual((report["rooms"], report["lost"]), (2, 0))
        self.assertGreater(report["reach"], 98)
        with open(self.path("graph.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    def test_a_clearance_may_close_that_door(self):
        self.write_two_rooms(door=13)
        # Sealed rooms are two pieces of ground, each served by its own piece of the graph.
        report = self.report("--robot-radius", 0.3, "--clearance", 0.1)
        self.assertEqual((report["rooms"], report["lost"]), (2, 0))
        self.assertLess(report["edges"], self.report("--robot-radius", 0.3)["edges"])

    def test_without_passages_the_lattice_stands_alone(self):
        self.write_two_rooms(door=13)
        lattice = self.report("--robot-radius", 0.3, "--passages", "false")
        self.assertLessEqual(lattice["reach"], self.report("--robot-radius", 0.3)["reach"])

    def test_specks_and_unknown_cells(self):
        # A corridor of 1.5 m with a speck in its middle: 0.725 m are left on both sides.
        rows = ["." * 120 for _ in range(30)]
        rows[15] = "." * 60 + "#" + "." * 59
        self.write_metric_map("rooms", rows)
        plain = self.report("--robot-radius", 0.4)
        freed = self.report("--robot-radius", 0.4, "--ignore-specks", 1)
        self.assertGreater(freed["edges"], plain["edges"])
        rows[15] = rows[15].replace("#", "?")
        self.write_metric_map("rooms", rows)
        self.assertEqual(self.report("--robot-radius", 0.4)["edges"], plain["edges"])
        unknown_free = self.report("--robot-radius", 0.4, "--unknown-space", "free")
        self.assertEqual(unknown_free["edges"], freed["edges"])

    def test_refusals(self):
        self.write_two_rooms(door=13)
        self.write("grid.map", "type octile\nheight 1\nwidth 1\nmap\n.\n")
        roadmap = ["roadmap", "--map", "rooms.yaml"]
        self.expect_refusal(["MovingAI", ".yaml"], "roadmap", "--map", "grid.map")
        self.expect_refusal("--robot-radius", *roadmap, "--robot-radius", "-0.1")
        self.expect_refusal("--robot-radius", *roadmap, "--robot-radius", "nan")
        self.expect_refusal(["robot_radius is 5 m", "nowhere on the map"], *roadmap,
                            "--robot-radius", 5)
        self.expect_refusal(["cell_size is 0.3 m", "at least 0.85 m"], *roadmap,
                            "--robot-radius", 0.3, "--cell-size", 0.3)
        self.expect_refusal(["--passages", "true or false"], *roadmap, "--passages", "maybe")
        self.assertFalse(os.path.exists(self.path("graph.png")))

    def test_a_time_limit_ends_it(self):
        self.write_two_rooms(door=13)
        self.assertIn("timeout", self.expect(3, "roadmap", "--map", "rooms.yaml", "--robot-radius",
                                             0.3, "--time-limit", 0).stderr)


if __name__ == "__main__":
    unittest.main()
