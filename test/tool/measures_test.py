"""The scripts that measure the package: what they call worse."""

import contextlib
import importlib.machinery
import importlib.util
import io
import os
import unittest

SCRIPTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts")


def load(name):
    """A script as a module; it has no .py in its name."""
    loader = importlib.machinery.SourceFileLoader(name, os.path.join(SCRIPTS, name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


class Benchmark(unittest.TestCase):
    def test_what_costs_a_quarter_more_is_marked(self):
        text = io.StringIO()
        with contextlib.redirect_stdout(text):
            worse = load("benchmark").print_beside(
                "plans", {"same": 1.2, "dear": 1.3, "new": 9.0}, {"same": 1.0, "dear": 1.0})
        self.assertEqual(worse, 1)
        marked = [line for line in text.getvalue().splitlines() if "WORSE" in line]
        self.assertEqual(len(marked), 1)
        self.assertIn("dear", marked[0])
        self.assertIn("+30 %", marked[0])


if __name__ == "__main__":
    unittest.main()
