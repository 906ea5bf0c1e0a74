#!/usr/bin/env python3
"""docs/integrating.md against the message files and parameters, and the code of docs/ and README."""

import os
import re
import subprocess
import tempfile
import unittest

from documents import read_blocks, read_tables

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..")
DOCS = os.path.join(ROOT, "docs")
TUTORIAL = os.path.join(DOCS, "tutorial.md")


def read(*names):
    with open(os.path.join(ROOT, *names), encoding="utf-8") as file:
        return file.read()


def fields_of(text):
    """(name, type) of a message's fields, in order."""
    return [(name, kind) for kind, name in
            re.findall(r"^([a-z]\S*|[A-Z]\S*)\s+(\w+)\s*(?:#.*)?$", text, flags=re.M)]


def constants_of(text):
    return [(name, value) for name, value in
            re.findall(r"^\S+\s+([A-Z]\w*)=(-?\d+)", text, flags=re.M)]


def parameters():
    """The planner's defaults as a table may show them."""
    values = {}
    for name, value in re.findall(r"^(\w+): ?(.*)$", read("config", "planner.yaml"), flags=re.M):
        try:
            value = "%g" % float(value)
        except ValueError:
            value = {"[]": "", '""': ""}.get(value, value)
        values[name] = value
    return values


class Integrating(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tables = read_tables(os.path.join(DOCS, "integrating.md"))

    def rows(self, title):
        return [(row[0].strip("`"), row[1]) for row in self.tables[title]]

    def test_has_every_field_of_the_messages(self):
        for name in ("RobotTask", "MultiRobotPlan", "RobotPath", "PlanStatistics"):
            self.assertEqual(self.rows("field of " + name), fields_of(read("msg", name + ".msg")))
        feedback = read("action", "PlanPaths.action").split("---")[2]
        self.assertEqual(self.rows("field of the feedback"), fields_of(feedback))

    def test_has_every_option_with_its_default(self):
        self.assertEqual(self.rows("option"), fields_of(read("msg", "PlanOptions.msg")))
        defaults = parameters()
        for row in self.tables["option"]:
            self.assertEqual(row[2], defaults[row[0].strip("`")], row)

    def test_has_every_outcome(self):
        self.assertEqual(self.rows("outcome"), constants_of(read("msg", "PlanOutcome.msg")))

    def test_names_what_the_node_has(self):
        source = "".join(
            read("src", "ros", room, name) for room in ("server", "convert")
            for name in os.listdir(os.path.join(ROOT, "src", "ros", room)))
        missing = [row[0] for row in self.tables["name"]
                   if '"%s"' % row[0].strip("`").split("/")[-1] not in source]
        self.assertEqual(missing, [])

    def test_leads_to_documents_that_are_there(self):
        for name in os.listdir(DOCS):
            if not name.endswith(".md"):
                continue
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", read("docs", name)):
                self.assertTrue(os.path.exists(os.path.join(DOCS, target)), (name, target))
        for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", read("README.md")):
            self.assertTrue(os.path.exists(os.path.join(ROOT, target)), target)


class Code(unittest.TestCase):
    def run_block(self, text, names):
        exec(text, names)  # pylint: disable=exec-used
        return names

    def test_a_notebook_takes_five_lines(self):
        block = read_blocks(TUTORIAL, "notebook")[0]
        self.assertEqual(len(block.splitlines()), 5)
        names = self.run_block(block, {})
        self.assertIn(repr(names["result"]), read("docs", "tutorial.md"))
        self.assertIn(block, read("docs", "python.md"))

    def test_the_shell_lines_and_the_rest_of_python_run(self):
        command = os.environ["SPLIT_MAPF_COMMAND"]
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as directory:
            os.chdir(directory)
            try:
                for block in read_blocks(TUTORIAL, "shell"):
                    subprocess.run(block, shell=True, check=True, stdout=subprocess.DEVNULL, env=dict(
                        os.environ, PATH="%s:%s" % (os.path.dirname(command), os.environ["PATH"])))
                self.assertTrue(os.path.getsize("plan.png") > 0)
                subprocess.run([command, "generate", "--type", "warehouse", "--width", "48",
                                "--height", "32", "--agents", "60", "--output-map", "w.map",
                                "--output-scen", "w.scen"], check=True, stdout=subprocess.DEVNULL)
                for text in (read("docs", "python.md"), read("README.md")):
                    blocks = re.findall(r"^```python\n(.*?)^```", text, flags=re.S | re.M)
                    self.assertTrue(blocks)
                    for block in blocks:
                        if "split_mapf.ros" not in block:
                            self.run_block(block, {})
            finally:
                os.chdir(before)


if __name__ == "__main__":
    unittest.main()
