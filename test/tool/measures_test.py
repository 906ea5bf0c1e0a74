"""The scripts that measure the package: what they count, and what they call worse."""

import contextlib
import importlib.machinery
import importlib.util
import io
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")


def load(name):
    """A script as a module; it has no .py in its name."""
    loader = importlib.machinery.SourceFileLoader(name, os.path.join(SCRIPTS, name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


class Coverage(unittest.TestCase):
    SOURCE = "int twice(int x) {\n  if (x < 0) {\n    return 0;\n  }\n  return 2 * x;\n}\n"

    def sum_up(self, root, *more):
        return subprocess.run([sys.executable, os.path.join(SCRIPTS, "sum_coverage.py"), root, root,
                               *more], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True, check=False)

    def test_a_line_that_nobody_runs_is_named_and_a_high_demand_fails(self):
        with tempfile.TemporaryDirectory() as root:
            os.makedirs(os.path.join(root, "src", "core"))
            with open(os.path.join(root, "src", "core", "twice.cpp"), "w", encoding="utf-8") as file:
                file.write(self.SOURCE)
            with open(os.path.join(root, "main.cpp"), "w", encoding="utf-8") as file:
                file.write("int twice(int x);\nint main() { return twice(0); }\n")
            subprocess.run(["g++", "--coverage", "src/core/twice.cpp", "main.cpp", "-o", "program"],
                           cwd=root, check=True)
            subprocess.run([os.path.join(root, "program")], cwd=root, check=True)
            result = self.sum_up(root, "--least", "70")
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertIn("src/core/twice.cpp: 3\n", result.stdout)
            self.assertNotIn("main.cpp", result.stdout)
            self.assertEqual(self.sum_up(root, "--least", "90").returncode, 1)

    def test_nothing_counted_is_no_full_coverage(self):
        with tempfile.TemporaryDirectory() as root:
            self.assertEqual(self.sum_up(root).returncode, 1)


class Benchmark(unittest.TestCase):
    def compare(self, measured):
        text = io.StringIO()
        recorded = {"a": 1.0, "b": 1.0, "dear": 1.0}
        with contextlib.redirect_stdout(text):
            worse = load("benchmark").print_beside("plans", measured, recorded)
        return worse, [line for line in text.getvalue().splitlines() if "WORSE" in line]

    def test_what_costs_a_quarter_more_than_the_others_is_marked(self):
        worse, marked = self.compare({"a": 1.2, "b": 1.1, "dear": 1.6, "new": 9.0})
        self.assertEqual(worse, 1)
        self.assertEqual(len(marked), 1)
        self.assertIn("dear", marked[0])
        self.assertIn("+33 %", marked[0])

    def test_what_makes_all_dearer_is_said_once(self):
        worse, marked = self.compare({"a": 1.4, "b": 1.3, "dear": 1.5})
        self.assertEqual(worse, 0)
        self.assertEqual(len(marked), 1)
        self.assertIn("ALL WORSE", marked[0])


if __name__ == "__main__":
    unittest.main()
