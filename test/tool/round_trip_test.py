"""generate -> plan -> validate -> render, and what validate and render say of broken plans."""

import json
import os
import shutil
import struct
import unittest

from command import CommandTest


class RoundTripTest(CommandTest):
    def test_every_kind_of_map(self):
        for kind in ["random", "warehouse", "rooms"]:
            self.generate(kind, "--type", kind, "--width", 40, "--height", 32, "--agents", 30,
                          "--seed", 4)
            plan = self.plan(0, kind, "--split", "2t")
            text = self.expect(0, "validate", *self.files(kind), "--plan", kind + ".json").stdout
            self.assertEqual(text, f"valid: 30 robots, makespan {plan['makespan']}, "
                             f"sum of costs {plan['sum_of_costs']}\n")
            for scale in [10, 20]:
                width, height = self.picture_size(kind, scale)
                self.assertEqual((width // scale, height // scale), (40, 32))

    def picture_size(self, kind, scale):
        name = f"{kind}-{scale}.png"
        text = self.expect(0, "render", *self.files(kind), "--plan", kind + ".json",
                           "--output", name, "--scale", scale).stdout
        size = self.png_size(name)
        self.assertEqual(text, f"{name}: {size[0]}x{size[1]} pixels, 30 robots\n")
        return size

    def png_size(self, name):
        with open(self.path(name), "rb") as file:
            head = file.read(24)
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        return struct.unpack(">II", head[16:24])

    def test_the_same_seed_generates_the_same_files(self):
        texts = []
        for name, seed in [("a", 7), ("b", 7), ("c", 8)]:
            self.generate(name, "--agents", 10, "--seed", seed)
            with open(self.path(name + ".map")) as file:
                grid = file.read()
            with open(self.path(name + ".scen")) as file:
                texts.append(grid + file.read().replace(name + ".map", "x.map"))
        self.assertEqual(texts[0], texts[1])
        self.assertNotEqual(texts[0], texts[2])

    def test_generated_maps_have_the_size_and_density_asked_for(self):
        self.generate("g", "--width", 30, "--height", 20, "--density", 0.25, "--agents", 5)
        with open(self.path("g.map")) as file:
            rows = file.read().split("map\n", 1)[1].split()
        self.assertEqual((len(rows), {len(row) for row in rows}), (20, {30}))
        self.assertEqual(sum(row.count("@") for row in rows), 150)
        with open(self.path("g.scen")) as file:
            self.assertEqual(len(file.read().splitlines()), 1 + 5)

    def test_robots_are_drawn_on_a_map_that_is_there(self):
        self.generate("g", "--width", 16, "--height", 16, "--density", 0.2, "--agents", 5)
        draw = ["generate", "--map", "g.map", "--agents", 30, "--seed", 4]
        self.expect(0, *draw, "--output-scen", "one.scen")
        self.expect(0, *draw, "--output-scen", "other.scen")
        with open(self.path("one.scen")) as one, open(self.path("other.scen")) as other:
            text = one.read()
            self.assertEqual(text, other.read())
        rows = [row.split("\t") for row in text.splitlines()[1:]]
        self.assertEqual(len(rows), 30)
        self.assertEqual({row[1] for row in rows}, {"g.map"})
        for columns in ((4, 5), (6, 7)):
            self.assertEqual(len({tuple(row[c] for c in columns) for row in rows}), 30)
        self.expect(0, "plan", "--map", "g.map", "--scen", "one.scen", "--output", "plan.json")
        self.expect_refusal("257 robots", "generate", "--map", "g.map", "--agents", 257,
                            "--output-scen", "no.scen")
        self.expect_refusal("--density", *draw, "--output-scen", "no.scen", "--density", 0.1)


class BrokenPlanTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write_problem("p", ["...", ".@.", "..."], [((0, 0), (2, 0)), ((0, 2), (2, 2))])

    def write_plan(self, *paths):
        self.write("plan.json", json.dumps({"paths": paths}))

    def violations(self, *paths):
        self.write_plan(*paths)
        result = self.expect(8, "validate", *self.files("p"), "--plan", "plan.json")
        *lines, last = result.stdout.splitlines()
        count = len(lines)
        self.assertEqual(last, f"not valid: {count} violation" + ("" if count == 1 else "s"))
        return lines

    def test_every_violation_is_listed(self):
        lines = self.violations([[1, 0], [1, 1], [2, 0]],
                                [[0, 2], [0, 1], [0, 0], [1, 0], [2, 0], [2, 0]])
        self.assertEqual(len(lines), 6, lines)
        for line, parts in zip(lines, [["robot 0", "start", "(0,0)"], ["robot 0", "(1,1)"],
                                       ["robot 0", "jump"], ["robot 1", "goal", "(2,2)"],
                                       ["robots 0 and 1", "(2,0)", "step 4"],
                                       ["robots 0 and 1", "(2,0)", "step 5"]]):
            for part in parts:
                self.assertIn(part, line)

    def test_cells_outside_the_map(self):
        lines = self.violations([[0, 0], [0, -1], [1, -1], [1, 0], [2, 0]],
                                [[0, 2], [1, 2], [2, 2]])
        self.assertEqual(len(lines), 2, lines)
        self.assertIn("(0,-1)", lines[0])

    def test_waiting_at_the_goal_is_valid_and_costs_nothing(self):
        self.write_plan([[0, 0], [1, 0], [2, 0], [2, 0], [2, 0]], [[0, 2], [1, 2], [2, 2]])
        result = self.expect(0, "validate", *self.files("p"), "--plan", "plan.json")
        self.assertEqual(result.stdout, "valid: 2 robots, makespan 2, sum of costs 4\n")

    def test_a_plan_for_fewer_robots_than_the_scenario_has(self):
        self.write_plan([[0, 0], [1, 0], [2, 0]])
        result = self.expect(0, "validate", *self.files("p"), "--plan", "plan.json")
        self.assertEqual(result.stdout, "valid: 1 robot, makespan 2, sum of costs 2\n")

    def test_a_plan_for_more_robots_than_the_scenario_has(self):
        self.write_plan([[0, 0]], [[0, 2]], [[1, 2]])
        self.expect_refusal("p.scen:4", "validate", *self.files("p"), "--plan", "plan.json")

    def test_render_refuses_the_plan_of_another_scenario(self):
        self.write_plan([[0, 0], [1, 0]], [[0, 2], [1, 2], [2, 2]])
        self.expect_refusal(["robot 0", "goal", "(1,0)", "(2,0)"], "render", *self.files("p"),
                            "--plan", "plan.json", "--output", "x.png")

    def test_render_refuses_scales_out_of_range(self):
        self.write_plan([[0, 0], [1, 0], [2, 0]])
        for scale in ["0", "257", "x"]:
            self.expect_refusal(["--scale", f"'{scale}'"], "render", *self.files("p"),
                                "--plan", "plan.json", "--output", "x.png", "--scale", scale)

    def test_render_shows_a_moment_a_film_and_how_cells_are_used(self):
        self.write_plan([[0, 0], [1, 0], [2, 0]], [[0, 2], [1, 2], [2, 2]])
        render = ["render", *self.files("p"), "--plan", "plan.json"]
        pictures = set()
        for name, options in [("at0.png", ["--at", 0]), ("at1.png", ["--at", 1]),
                              ("far.png", ["--at", 1e6]), ("heat.png", ["--heat"]),
                              ("paths.png", [])]:
            self.expect(0, *render, "--output", name, *options)
            with open(self.path(name), "rb") as file:
                pictures.add(file.read())
        self.assertEqual(len(pictures), 5)
        text = self.expect(0, *render, "--animate", "film.gif", "--duration", 3).stdout
        self.assertRegex(text, r"^film.gif: \d+x\d+ pixels, 4 s\n$")
        with open(self.path("film.gif"), "rb") as file:
            self.assertEqual(file.read(6), b"GIF89a")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not here")
    def test_render_writes_a_video(self):
        self.write_plan([[0, 0], [1, 0], [2, 0]], [[0, 2], [1, 2], [2, 2]])
        render = ["render", *self.files("p"), "--plan", "plan.json", "--scale", 31]
        text = self.expect(0, *render, "--animate", "film.mp4", "--duration", 2).stdout
        self.assertRegex(text, r"^film.mp4: \d+x\d+ pixels, 3 s\n$")
        with open(self.path("film.mp4"), "rb") as file:
            self.assertEqual(file.read(8)[4:], b"ftyp")
        self.assertNotIn("film.mp4.part", os.listdir(self.folder))
        # A folder in the place of what ffmpeg would write.
        os.mkdir(self.path("other.mp4.part"))
        self.expect_refusal(["other.mp4: ffmpeg "], *render, "--animate", "other.mp4")

    def test_render_without_ffmpeg_says_so(self):
        self.write_plan([[0, 0], [1, 0], [2, 0]])
        self.environment = {"PATH": self.folder}
        self.expect_refusal(["x.mp4", "needs the program ffmpeg", ".gif"], "render",
                            *self.files("p"), "--plan", "plan.json", "--animate", "x.mp4")

    def test_render_refuses_views_that_do_not_go_together(self):
        self.write_plan([[0, 0], [1, 0], [2, 0]])
        render = ["render", *self.files("p"), "--plan", "plan.json"]
        self.expect_refusal(["--output", "--animate"], *render)
        self.expect_refusal(["--at", "--heat"], *render, "--output", "x.png", "--at", 1, "--heat")
        self.expect_refusal(["--duration", "--animate"], *render, "--output", "x.png",
                            "--duration", 3)
        self.expect_refusal(["--duration", "6000"], *render, "--animate", "x.gif",
                            "--duration", 1e6)
        self.expect_refusal(["--at", "-1"], *render, "--output", "x.png", "--at", -1)
        self.expect_refusal(["/no/such"], *render, "--animate", "/no/such/x.gif")


if __name__ == "__main__":
    unittest.main()
