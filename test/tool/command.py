"""Drives the built split_mapf command as a user would.

The environment variable SPLIT_MAPF_COMMAND names the program under test.
"""

import json
import os
import shutil
import subprocess
import tempfile
import unittest

COMMAND = os.environ["SPLIT_MAPF_COMMAND"]

# Far more than any call here takes: a call that reaches it hangs.
PATIENCE_S = 120


class CommandTest(unittest.TestCase):
    """A test with a directory of its own, in which every call runs."""

    maxDiff = None
    environment = {}  # of the calls, beside the test's own

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="split_mapf_test_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)

    def read_json(self, name):
        with open(self.path(name)) as file:
            return json.load(file)

    def start(self, *arguments):
        """Starts a call and leaves it running."""
        process = subprocess.Popen(
            [COMMAND, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)

        def clean():
            process.kill()
            process.communicate()

        self.addCleanup(clean)
        return process

    def run_command(self, *arguments):
        result = subprocess.run(
            [COMMAND, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=PATIENCE_S,
            env=dict(os.environ, **self.environment))
        # Decoded here: text mode would turn carriage returns into new lines.
        result.stdout = result.stdout.decode()
        result.stderr = result.stderr.decode()
        return result

    def expect(self, code, *arguments):
        """Runs a call and requires its exit code."""
        result = self.run_command(*arguments)
        self.assertEqual(result.returncode, code, f"{arguments}\n{result.stdout}{result.stderr}")
        return result

    def expect_refusal(self, parts, *arguments):
        """Runs a call that has to end with exit code 1, and with a message that has all `parts`."""
        result = self.expect(1, *arguments)
        self.assertEqual(result.stdout, "")
        self.assertNotIn("internal error", result.stderr)
        for part in [parts] if isinstance(parts, str) else parts:
            self.assertIn(part, result.stderr)
        return result

    def write_problem(self, name, rows, ways):
        """Writes name.map from rows of . and @, and name.scen from ways ((x, y), (x, y))."""
        height, width = len(rows), len(rows[0])
        self.write(name + ".map", f"type octile\nheight {height}\nwidth {width}\nmap\n"
                   + "".join(row + "\n" for row in rows))
        self.write(name + ".scen", "version 1\n" + "".join(
            f"0\t{name}.map\t{width}\t{height}\t{a[0]}\t{a[1]}\t{b[0]}\t{b[1]}\t0\n"
            for a, b in ways))

    def write_metric_map(self, name, rows, resolution=0.05, origin=(0, 0, 0)):
        """Writes name.yaml and name.pgm from rows of . (free), # (occupied) and ? (unknown)."""
        grey = {".": 254, "#": 0, "?": 205}
        self.write(name + ".pgm", f"P2\n{len(rows[0])} {len(rows)}\n255\n" + "".join(
            " ".join(str(grey[cell]) for cell in row) + "\n" for row in rows))
        self.write(name + ".yaml",
                   f"image: {name}.pgm\nresolution: {resolution}\norigin: {list(origin)}\n"
                   "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")

    def generate(self, name, *options):
        self.expect(0, "generate", "--output-map", name + ".map", "--output-scen", name + ".scen",
                    *options)

    def plan(self, code, name, *options):
        """Plans a problem and returns the JSON that was written."""
        self.expect(code, "plan", "--map", name + ".map", "--scen", name + ".scen",
                    "--output", name + ".json", *options)
        return self.read_json(name + ".json")

    def files(self, name):
        return ("--map", name + ".map", "--scen", name + ".scen")

    def generate_hard(self, name):
        """Writes a problem that optimal search does not solve within a minute."""
        self.generate(name, "--width", 32, "--height", 32, "--density", 0.2, "--agents", 250)


# What makes a problem of generate_hard() hard.
OPTIMAL = ("--solver", "ecbs", "--split", "none", "--objective", "sum_of_costs",
           "--suboptimality", "1")
