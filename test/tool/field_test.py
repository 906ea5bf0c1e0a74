"""Files as the programs of the field write them are read, or refused at their place."""

import base64
import json
import unittest

from command import CommandTest
from field_files import write_files

SYMBOLS = {0: ".", 100: "@", 255: "?"}


class FieldFilesTest(CommandTest):
    def convert(self, map_name, scenario):
        files = ["--map", map_name] + (["--scen", scenario] if scenario else [])
        return self.run_command("convert", *files)

    def test_every_file_is_read_or_refused_at_its_place(self):
        for map_name, scenario, rows, ways, refusal in write_files(self.folder):
            with self.subTest(map=map_name, scenario=scenario):
                result = self.convert(map_name, scenario)
                if refusal:
                    self.assertEqual(result.returncode, 1, result.stdout)
                    self.assertTrue(result.stderr.startswith("split_mapf: " + refusal),
                                    result.stderr)
                    self.assertIn("expected", result.stderr)
                    continue
                self.assertEqual(result.returncode, 0, result.stderr)
                read = json.loads(result.stdout)
                self.assertEqual(rows_of(read), rows)
                if ways:
                    self.assertEqual([a + b for a, b in zip(read["starts"], read["goals"])], ways)
                else:
                    self.assertIsNone(read["starts"])


def rows_of(read):
    width = read["width"]
    text = "".join(SYMBOLS[value] for value in base64.b64decode(read["occupancy"]))
    return [text[i:i + width] for i in range(0, len(text), width)]


class ConvertTest(CommandTest):
    def setUp(self):
        super().setUp()
        write_files(self.folder)

    def convert(self, *options):
        return json.loads(self.expect(0, "convert", *options).stdout)

    def test_a_map_has_the_place_that_its_file_says(self):
        read = self.convert("--map", "unknown.yaml")
        self.assertEqual((read["width"], read["height"]), (3, 1))
        self.assertEqual(read["resolution"], 0.05)
        self.assertEqual(read["origin"], [-1.5, 2.0, 0.25])
        self.assertEqual(base64.b64decode(read["occupancy"]), bytes([0, 100, 255]))

    def test_a_movingai_map_has_the_resolution_that_was_asked_for(self):
        self.assertEqual(self.convert("--map", "plain.map")["resolution"], 1)
        read = self.convert("--map", "plain.map", "--resolution", "0.25")
        self.assertEqual((read["resolution"], read["origin"]), (0.25, [0, 0, 0]))
        self.expect_refusal("plain.yaml", "convert", "--map", "plain.yaml", "--resolution", "1")
        self.expect_refusal("above 0", "convert", "--map", "plain.map", "--resolution", "0")

    def test_the_first_robots(self):
        read = self.convert("--map", "plain.map", "--scen", "plain.scen", "--agents", 1)
        self.assertEqual((read["starts"], read["goals"]), ([[0, 0]], [[3, 2]]))
        self.expect_refusal("plain.scen:4: ", "convert", "--map", "plain.map", "--scen",
                            "plain.scen", "--agents", 3)

    def test_a_scenario_for_a_map_of_which_only_the_size_is_known(self):
        read = self.convert("--size", "4x3", "--scen", "on_a_wall.scen")
        self.assertEqual(read["goals"][0], [1, 1])
        self.assertIsNone(read["occupancy"])
        self.expect_refusal("plain.scen:2: ", "convert", "--size", "3x4", "--scen", "plain.scen")
        self.expect_refusal("outside.scen:2: ", "convert", "--size", "4x3", "--scen",
                            "outside.scen")
        for size in ["4", "4x", "x3", "0x3", "4x3x2", "-4x3", "4 x 3", "32769x1", "999999999x1"]:
            self.expect_refusal(["--size", f"'{size}'"], "convert", "--size", size, "--scen",
                                "plain.scen")

    def test_options_that_do_not_go_together(self):
        scen = ("--scen", "plain.scen")
        self.expect_refusal(["--map", "--size"], "convert", *scen)
        self.expect_refusal(["--map", "--size"], "convert", "--map", "plain.map", "--size", "4x3",
                            *scen)
        self.expect_refusal("--scen", "convert", "--size", "4x3")
        self.expect_refusal("--scen", "convert", "--map", "plain.map", "--agents", 1)
        self.expect_refusal("--map", "convert", "--size", "4x3", "--resolution", 1, *scen)

    def test_a_file_instead_of_standard_output(self):
        text = self.expect(0, "convert", "--map", "plain.map").stdout
        self.assertEqual(self.expect(0, "convert", "--map", "plain.map", "--output",
                                     "out.json").stdout, "")
        with open(self.path("out.json")) as file:
            self.assertEqual(file.read(), text)
        self.expect_refusal("no/out.json", "convert", "--map", "plain.map", "--output",
                            "no/out.json")


if __name__ == "__main__":
    unittest.main()
