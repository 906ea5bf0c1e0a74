"""Planning: exit codes, JSON fields, summary, determinism."""

import os
import re
import subprocess
import tempfile
import time
import unittest

from command import COMMAND, OPTIMAL, CommandTest

FIELDS = ["status", "message", "solver", "split", "objective", "seed", "threads", "agents",
          "makespan", "sum_of_costs", "makespan_lower_bound", "sum_of_costs_lower_bound",
          "proved_lower_bound", "gap", "optimal", "certified_by", "runtime_s", "first_plan_s",
          "trace", "stages", "subproblems", "layout", "paths"]


class PlanTest(CommandTest):
    def test_refinement(self):
        self.generate("g", "--width", 16, "--height", 16, "--density", 0.1, "--agents", 60)
        first = self.plan(0, "g", "--objective", "sum_of_costs")
        refined = self.plan(0, "g", "--objective", "sum_of_costs", "--refine", 1)
        self.assertLess(refined["sum_of_costs"], first["sum_of_costs"])
        self.assertIn("refine", refined["stages"])
        costs = [row[2] for row in refined["trace"]]
        self.assertEqual(costs[0], first["sum_of_costs"])
        self.assertEqual(costs, sorted(costs, reverse=True))
        self.assertEqual(costs[-1], refined["sum_of_costs"])
        self.assertLess(refined["runtime_s"], 10)
        self.expect(0, "validate", *self.files("g"), "--plan", "g.json")

    def test_exports_for_viewers(self):
        self.write_problem("p", ["....", ".@.."], [((0, 0), (3, 1)), ((3, 0), (2, 1))])
        self.plan(0, "p")
        paths = self.read_json("p.json")["paths"]
        self.expect(0, "plan", *self.files("p"), "--output", "p.txt", "--export", "mapf-visualizer")
        with open(self.path("p.txt")) as file:
            rows = file.read().splitlines()
        self.assertEqual(len(rows), 5)
        for step, row in enumerate(rows):
            cells = [path[min(step, len(path) - 1)] for path in paths]
            self.assertEqual(row, "%d:" % step + "".join("(%d,%d)," % tuple(c) for c in cells))
        self.expect(0, "plan", *self.files("p"), "--output", "p.viz", "--export", "planviz")
        result = self.read_json("p.viz")
        self.assertEqual((result["actionModel"], result["teamSize"], result["makespan"],
                          result["sumOfCost"]), ("MAPF", 2, 4, 6))
        self.assertEqual(result["start"], [[0, 0, "E"], [0, 3, "E"]])
        self.assertEqual(result["actualPaths"][0], "R,R,R,D")
        self.assertEqual([row[-1] for row in result["events"]],
                         [[0, 4, "finished"], [1, 2, "finished"]])

    def test_refuses_exports_that_cannot_be(self):
        self.write_problem("p", ["...."], [((0, 0), (3, 0))])
        for parts, options in [(["planviz", "'x'"], ["--export", "x", "--output", "o"]),
                               (["--output"], ["--export", "planviz"]),
                               (["--write-better"], ["--export", "planviz", "--output", "o",
                                                     "--write-better"]),
                               (["size"], ["--export", "planviz", "--output", "o",
                                           "--robot-radius", "0.1"])]:
            self.expect_refusal(parts, "plan", *self.files("p"), *options)
        self.assertFalse(os.path.exists(self.path("o")))

    def test_writes_each_better_plan_while_it_refines(self):
        self.generate("g", "--width", 16, "--height", 16, "--density", 0.1, "--agents", 60)
        process = self.start("plan", *self.files("g"), "--objective", "sum_of_costs", "--refine", 2,
                             "--output", "g.json", "--write-better")
        seen = []
        while process.poll() is None:
            if os.path.exists(self.path("g.json")):
                cost = self.read_json("g.json")["sum_of_costs"]  # a whole file at any moment
                if cost not in seen:
                    seen.append(cost)
            time.sleep(0.01)
        process.communicate()
        self.assertGreaterEqual(len(seen), 2)
        self.assertEqual(seen, sorted(seen, reverse=True))
        self.assertFalse(os.path.exists(self.path("g.json.part")))
        self.expect(0, "validate", *self.files("g"), "--plan", "g.json")

    def test_a_file_that_is_written_again_keeps_its_names_and_its_mode(self):
        self.write_problem("p", ["...", "@.@"], [((0, 0), (2, 0))])
        self.write("a.json", "old")
        os.link(self.path("a.json"), self.path("b.json"))
        self.expect(0, "plan", *self.files("p"), "--output", "a.json")
        self.assertEqual(self.read_json("b.json")["status"], "solved")
        self.write("c.json", "old")
        os.chmod(self.path("c.json"), 0o600)
        self.expect(0, "plan", *self.files("p"), "--output", "c.json")
        self.assertEqual(os.stat(self.path("c.json")).st_mode & 0o777, 0o600)
        self.assertEqual([name for name in os.listdir(self.folder) if ".part" in name], [])

    def test_writes_into_a_file_whose_name_is_gone(self):
        self.write_problem("p", ["...", "@.@"], [((0, 0), (2, 0))])
        with tempfile.TemporaryFile(dir=self.folder) as out:
            result = subprocess.run(
                [COMMAND, "plan", *self.files("p"), "--output", "/dev/stdout", "--quiet"],
                cwd=self.folder, stdout=out, stderr=subprocess.PIPE, check=False)
            self.assertEqual(result.returncode, 0, result.stderr)
            out.seek(0)
            self.assertIn(b'"solved"', out.read())

    def test_write_better_needs_a_file(self):
        self.write_problem("p", ["...", "@.@"], [((0, 0), (2, 0))])
        for output in ([], ["--output", "-"]):
            result = self.expect(1, "plan", *self.files("p"), "--write-better", *output)
            self.assertIn("--output FILE", result.stderr)
        os.mkfifo(self.path("pipe"))
        result = self.expect(1, "plan", *self.files("p"), "--write-better", "--output", "pipe")
        self.assertIn("no plain file", result.stderr)

    def test_solved(self):
        # Two robots change places in a corridor with a siding: 4 and 3 steps.
        self.write_problem("p", ["...", "@.@"], [((0, 0), (2, 0)), ((2, 0), (0, 0))])
        result = self.plan(0, "p", "--objective", "sum_of_costs", "--suboptimality", 1,
                           "--seed", 5, "--threads", 2)
        for field in FIELDS:
            self.assertIn(field, result)
        self.assertEqual(result["status"], "solved")
        self.assertEqual((result["solver"], result["split"]), ("auto", "auto"))
        self.assertEqual((result["objective"], result["seed"], result["threads"]),
                         ("sum_of_costs", 5, 2))
        self.assertEqual((result["agents"], result["makespan"], result["sum_of_costs"]), (2, 4, 7))
        self.assertEqual((result["makespan_lower_bound"], result["sum_of_costs_lower_bound"]),
                         (2, 4))
        self.assertEqual((result["proved_lower_bound"], result["gap"], result["optimal"]),
                         (7, 0, True))
        self.assertNotEqual(result["certified_by"], "")
        self.assertGreaterEqual(result["runtime_s"], result["first_plan_s"])
        self.assertEqual(result["trace"][-1][1:], [4, 7, 7])
        self.assertEqual(len(result["subproblems"]), 1)
        self.assertEqual(result["subproblems"][0]["status"], "solved")
        self.assertIn("solve", result["stages"])
        starts_and_goals = [(path[0], path[-1]) for path in result["paths"]]
        self.assertEqual(starts_and_goals, [([0, 0], [2, 0]), ([2, 0], [0, 0])])
        self.assertEqual(sorted(len(path) - 1 for path in result["paths"]), [3, 4])

    def test_agents_takes_the_first_rows(self):
        self.write_problem("p", ["..."], [((0, 0), (1, 0)), ((2, 0), (2, 0))])
        self.assertEqual(self.plan(0, "p", "--agents", 1)["paths"], [[[0, 0], [1, 0]]])
        self.assertEqual(self.plan(0, "p")["paths"], [[[0, 0], [1, 0]], [[2, 0]]])

    def test_a_cut_off_robot_is_unsolvable_and_named(self):
        self.write_problem("p", [".@."], [((0, 0), (2, 0))])
        result = self.plan(2, "p")
        self.assertEqual((result["status"], result["paths"]), ("unsolvable", []))
        self.assertIn("robot 0", result["message"])
        error = self.run_command("plan", *self.files("p")).stderr
        self.assertIn("unsolvable: robot 0", error)

    def test_an_incomplete_solver_that_gives_up_says_so(self):
        # Each robot sits in the other's way whichever is planned first, but a plan exists.
        self.write_problem("p", ["...", "@.@"], [((0, 0), (2, 0)), ((2, 0), (0, 0))])
        result = self.plan(6, "p", "--solver", "prioritized", "--split", "none")
        self.assertEqual((result["status"], result["paths"]), ("no_plan_found", []))
        self.assertNotEqual(result["message"], "")

    def test_timeout_is_kept_and_written(self):
        self.generate_hard("h")
        begin = time.monotonic()
        result = self.plan(3, "h", "--time-limit", 1, *OPTIMAL)
        self.assertLess(time.monotonic() - begin, 3)
        self.assertEqual((result["status"], result["agents"], result["paths"]),
                         ("timeout", 250, []))
        self.assertIsNone(result["makespan"])
        self.assertGreater(result["sum_of_costs_lower_bound"], 0)

    def test_no_time_at_all_is_a_timeout_too(self):
        self.generate_hard("h")
        self.assertEqual(self.plan(3, "h", "--time-limit", 0)["status"], "timeout")

    def test_memory_limit_is_kept_and_written(self):
        self.generate_hard("h")
        result = self.plan(7, "h", "--memory-limit", 60, "--threads", 2, *OPTIMAL)
        self.assertEqual((result["status"], result["agents"], result["paths"]),
                         ("memory_limit", 250, []))

    def test_memory_limit_below_what_reading_takes(self):
        self.generate_hard("h")
        result = self.plan(7, "h", "--memory-limit", 1, "--threads", 2)
        self.assertEqual((result["status"], result["paths"]), ("memory_limit", []))

    def test_memory_limit_leaves_a_modest_call_alone(self):
        self.generate("g", "--agents", 20)
        self.assertEqual(self.plan(0, "g", "--memory-limit", 500)["status"], "solved")

    def test_the_same_plan_at_any_number_of_threads(self):
        self.generate("g", "--type", "rooms", "--width", 48, "--height", 40, "--agents", 60,
                      "--seed", 3)
        for options in [["--split", "none"], ["--split", "4t"],
                        ["--split", "3t", "--solver", "prioritized"]]:
            plans = [self.plan(0, "g", "--seed", 9, "--threads", threads, *options)
                     for threads in [1, 2, 8]]
            self.assertEqual([plan["threads"] for plan in plans], [1, 2, 8])
            self.assertEqual(plans[0]["paths"], plans[1]["paths"])
            self.assertEqual(plans[0]["paths"], plans[2]["paths"])

    def test_splits_solve_their_pieces(self):
        self.generate("g", "--agents", 30, "--seed", 1)
        result = self.plan(0, "g", "--split", "4t", "--split-option", "compaction=false")
        self.assertEqual(result["split"], "4t")
        self.assertEqual(len(result["subproblems"]), 4)
        self.assertEqual([piece["phase"] for piece in result["subproblems"]], [0, 1, 2, 3])


class CheckTest(CommandTest):
    def test_solvable(self):
        self.write_problem("p", ["...", "@.@"], [((0, 0), (2, 0)), ((2, 0), (0, 0))])
        self.assertEqual(self.expect(0, "check", *self.files("p")).stdout, "solvable\n")

    def test_unsolvable_although_no_robot_is_cut_off(self):
        self.write_problem("p", ["..."], [((0, 0), (2, 0)), ((2, 0), (0, 0))])
        text = self.expect(2, "check", *self.files("p")).stdout
        self.assertTrue(text.startswith("unsolvable: "), text)
        self.assertEqual(self.expect(0, "check", *self.files("p"), "--agents", 1).stdout,
                         "solvable\n")
        self.assertEqual(self.plan(2, "p")["status"], "unsolvable")


class OutputTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.generate("g", "--agents", 20)

    def test_the_summary_is_for_people(self):
        result = self.expect(0, "plan", *self.files("g"))
        self.assertRegex(result.stdout, r"status +solved, 20 robots")
        self.assertRegex(result.stdout, r"makespan +\d+  \(1\.\d{3} x the lower bound \d+\)")
        self.assertRegex(result.stdout, r"sum of costs +\d+  \(1\.\d{3} x the lower bound \d+\)")
        self.assertRegex(result.stdout, r"runtime +\d+\.\d{3} s on \d+ thread")
        self.assertEqual(result.stderr, "")

    def test_quiet_prints_nothing_but_errors(self):
        result = self.expect(0, "plan", *self.files("g"), "--quiet", "--output", "out.json")
        self.assertEqual((result.stdout, result.stderr), ("", ""))
        self.assertEqual(self.read_json("out.json")["status"], "solved")
        self.assertIn("time", self.expect(3, "plan", *self.files("g"), "--quiet",
                                          "--time-limit", 0).stderr)

    def test_a_dash_writes_json_alone_to_standard_output(self):
        self.expect(0, "plan", *self.files("g"), "--output", "file.json")
        text = self.expect(0, "plan", *self.files("g"), "--output", "-").stdout
        self.write("copy.json", text)
        self.assertEqual(self.read_json("copy.json")["paths"], self.read_json("file.json")["paths"])

    def test_progress_goes_to_standard_error_and_is_wiped(self):
        result = self.expect(0, "plan", *self.files("g"), "--progress")
        self.assertTrue(re.match(r"\r\d+\.\d s  \w+", result.stderr), repr(result.stderr))
        self.assertEqual(result.stderr[-1], "\r")

    def test_no_progress_without_a_terminal(self):
        self.assertEqual(self.expect(0, "plan", *self.files("g")).stderr, "")


if __name__ == "__main__":
    unittest.main()
