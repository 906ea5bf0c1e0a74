"""A file that does not fit appears not at all, the one that was there stays, and the call says so."""

import os
import resource
import shutil
import subprocess
import unittest

from command import COMMAND, PATIENCE_S, CommandTest

MOST_BYTES = 400  # of a file, in these calls: every kind of result is longer
BEFORE = "what was there before\n"


class FullDiskTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.expect(0, "generate", "--width", 40, "--height", 40, "--agents", 30,
                    "--output-map", "p.map", "--output-scen", "p.scen")
        self.expect(0, "plan", *self.files("p"), "--output", "p.json")

    def expect_no_room(self, name, *arguments):
        """The call is refused the room for the file `name`, once without and once with one there."""
        for there in (False, True):
            with self.subTest(arguments=arguments, there=there):
                if there:
                    self.write(name, BEFORE)
                files = sorted(os.listdir(self.folder))
                result = subprocess.run(
                    [COMMAND, *map(str, arguments)], cwd=self.folder, timeout=PATIENCE_S,
                    stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                    universal_newlines=True, check=False,
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                          (MOST_BYTES, MOST_BYTES)))
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn(name, result.stderr)
                self.assertNotIn("internal error", result.stderr)
                self.assertEqual(sorted(os.listdir(self.folder)), files)
                if there:
                    with open(self.path(name), encoding="utf-8") as file:
                        self.assertEqual(file.read(), BEFORE)

    def test_plans(self):
        self.expect_no_room("r.json", "plan", *self.files("p"), "--output", "r.json")
        self.expect_no_room("r.json", "plan", *self.files("p"), "--refine", 0.1, "--time-limit", 1,
                            "--write-better", "--output", "r.json")

    def test_maps_and_scenarios(self):
        self.expect_no_room("q.map", "generate", "--width", 40, "--height", 40, "--output-map",
                            "q.map", "--output-scen", "q.scen")
        few = ["--width", 8, "--height", 8, "--agents", 30, "--output-map", "few.map"]
        self.expect(0, "generate", *few, "--output-scen", "few.scen")
        self.expect_no_room("q.scen", "generate", *few, "--output-scen", "q.scen")
        self.expect_no_room("q.json", "convert", *self.files("p"), "--output", "q.json")

    def test_pictures_and_animations(self):
        drawn = ["render", *self.files("p"), "--plan", "p.json"]
        self.expect_no_room("p.png", *drawn, "--output", "p.png")
        self.expect_no_room("p.gif", *drawn, "--animate", "p.gif")

    @unittest.skipIf(shutil.which("ffmpeg") is None, "ffmpeg is not here")
    def test_videos(self):
        self.expect_no_room("p.mp4", "render", *self.files("p"), "--plan", "p.json", "--animate",
                            "p.mp4")

    def test_standard_output(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = subprocess.run([COMMAND, "plan", *self.files("p"), "--output", "-"],
                                    cwd=self.folder, stdout=full, stderr=subprocess.PIPE,
                                    timeout=PATIENCE_S, universal_newlines=True, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn("standard output cannot be written", result.stderr)


if __name__ == "__main__":
    unittest.main()
