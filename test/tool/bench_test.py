"""Sweeps: one CSV row a combination, everything checked before anything is run, in shards that are
killed and resumed."""

import csv
import fcntl
import io
import os
import signal
import time
import unittest

from command import OPTIMAL, PATIENCE_S, CommandTest

SHARDS = 3


class BenchTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write_problem("p", ["....", "....", "...."],
                           [((0, 0), (3, 0)), ((3, 0), (0, 0)), ((0, 2), (3, 2))])

    def bench(self, *arguments):
        result = self.run_command("bench", "--map", "p.map", "--scen", "p.scen", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return list(csv.DictReader(io.StringIO(result.stdout)))

    def test_every_combination_has_a_row(self):
        rows = self.bench("--agents", "2,3", "--solvers", "ecbs,conflict_optimizer",
                          "--splits", "none,t(0.4,0.6)", "--objective", "sum_of_costs")
        self.assertEqual([(r["agents"], r["solver"], r["split"]) for r in rows],
                         [(n, solver, split) for n in ("2", "3")
                          for solver in ("ecbs", "conflict_optimizer")
                          for split in ("none", "t(0.4,0.6)")])
        for row in rows:
            self.assertEqual((row["status"], row["objective"], row["map"]),
                             ("solved", "sum_of_costs", "p.map"))
            self.assertEqual((row["cells"], row["conflicting"], row["largest_group"],
                              row["head_on"]), ("12", "1", "2", "0"))
            self.assertEqual(row["sum_of_costs_lower_bound"], "6" if row["agents"] == "2" else "9")
            self.assertGreaterEqual(int(row["sum_of_costs"]), int(row["sum_of_costs_lower_bound"]))
            self.assertGreaterEqual(float(row["seconds"]), float(row["first_plan_s"]))

    def test_a_file_gets_the_same_table(self):
        self.bench("--agents", "3", "--output", "table.csv")
        with open(self.path("table.csv")) as file:
            self.assertEqual(len(list(csv.DictReader(file))), 1)

    def test_nothing_is_run_before_everything_is_right(self):
        for arguments, what in [(["--solvers", "ecbs,magic"], "magic"),
                                (["--splits", "none,4x"], "4x"),
                                (["--agents", "2,0"], "'0'"),
                                (["--agents", "2,,3"], "empty"),
                                (["--map", "p.map", "--agents", "2"], "2 maps for 1")]:
            with self.subTest(arguments=arguments):
                agents = [] if "--agents" in arguments else ["--agents", "2"]
                result = self.run_command("bench", "--map", "p.map", "--scen", "p.scen", *agents,
                                          *arguments)
                self.assertEqual(result.returncode, 1)
                self.assertIn(what, result.stderr)
                self.assertEqual(result.stdout, "")


class ShardTest(CommandTest):
    SWEEP = ("--agents", "1,2,3", "--solvers", "ecbs,conflict_optimizer", "--splits",
             "none,t(0.4,0.6)")
    CELLS = 12

    def setUp(self):
        super().setUp()
        self.write_problem("p", ["....", "....", "...."],
                           [((0, 0), (3, 0)), ((3, 0), (0, 0)), ((0, 2), (3, 2))])
        # Names that need quotes, with a line break in them.
        for kind in (".map", ".scen"):
            os.rename(self.path("p" + kind), self.path("p,\n\"q\"" + kind))
        self.call = ("bench", *self.files("p,\n\"q\""), *self.SWEEP)

    def rows(self, name="table.csv"):
        """What the table holds, without what was measured."""
        with open(self.path(name), newline="") as file:
            rows = list(csv.reader(file, strict=True))
        self.assertEqual(rows[0][:3], ["map", "scen", "agents"])
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        return [tuple(row[:11]) for row in rows[1:]]

    def table(self):
        """All rows of the sweep, as bytes with their line breaks, the header first."""
        self.expect(0, *self.call, "--output", "table.csv")
        with open(self.path("table.csv"), "rb") as file:
            header, *rows = file.read().split(b'\n"p,\n')
        self.assertEqual(len(rows), self.CELLS)
        return [header + b"\n"] + [b'"p,\n' + row.rstrip(b"\n") + b"\n" for row in rows]

    def resume(self, content, *options):
        with open(self.path("table.csv"), "wb") as file:
            file.write(content)
        return self.run_command(*self.call, "--output", "table.csv", "--resume", *options)

    def test_shards_of_several_processes_are_the_sweep(self):
        whole = self.table()
        calls = [self.start(*self.call, "--shard", f"{i}/{SHARDS}", "--resume", "--output",
                            f"part-{i}.csv") for i in range(1, SHARDS + 1)]
        for process in calls:
            _, error = process.communicate(timeout=PATIENCE_S)
            self.assertEqual(process.returncode, 0, error)
        parts = [self.rows(f"part-{i}.csv") for i in range(1, SHARDS + 1)]
        self.assertEqual([len(part) for part in parts], [self.CELLS // SHARDS] * SHARDS)
        self.assertEqual(sorted(sum(parts, [])), sorted(self.rows()))
        self.assertEqual(len(whole), 1 + len(set(sum(parts, []))))
        # No shard has the cells of one solver only.
        for part in parts:
            self.assertEqual(len({row[4] for row in part}), 2)

    def test_a_table_is_resumed_wherever_it_ends(self):
        rows = self.table()
        whole = self.rows()
        text = b"".join(rows)
        ends = [sum(map(len, rows[:k])) for k in range(len(rows) + 1)]
        for end in [0, 1, ends[1] - 1, ends[1], ends[1] + 4, ends[2] - 1, ends[2], ends[5] + 40,
                    len(text) - 1, len(text)]:
            with self.subTest(end=end):
                result = self.resume(text[:end])
                self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
                self.assertEqual("cut off" in result.stderr, end not in ends)
                self.assertEqual(sorted(self.rows()), sorted(whole))
                with open(self.path("table.csv"), "rb") as file:
                    kept = max(e for e in ends if e <= end)
                    self.assertEqual(file.read()[:kept], text[:kept])

    def test_rows_may_be_there_in_any_order(self):
        header, *rows = self.table()
        whole = self.rows()
        result = self.resume(header + b"".join(rows[:6:-1]))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("5 rows from before, 7 combinations left", result.stderr)
        self.assertEqual(sorted(self.rows()), sorted(whole))

    def test_what_cannot_be_resumed_is_left_as_it_is(self):
        rows = self.table()
        text = b"".join(rows)
        for content, options, part in [
                (text, ["--seed", "7"], "which this sweep has not"),
                (b"a,b\n1,2\n", [], "table.csv:1: other columns"),
                (rows[0] + b"x,1\n" + rows[1], [], "table.csv:2: 2 fields; 24 are expected")]:
            with self.subTest(part=part):
                result = self.resume(content, *options)
                self.assertEqual(result.returncode, 1)
                self.assertIn(part, result.stderr)
                with open(self.path("table.csv"), "rb") as file:
                    self.assertEqual(file.read(), content)

    def test_two_processes_do_not_write_the_same_table(self):
        rows = self.table()
        with open(self.path("table.csv"), "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            for option in ((), ("--resume",)):
                self.expect_refusal("being written by another process", *self.call, "--output",
                                    "table.csv", *option)
            self.assertEqual(file.read(), b"".join(rows))

    def test_a_wrong_shard_is_refused(self):
        for shard in ("0/2", "3/2", "1", "1/", "/2", "1/0", "-1/2", "1/2/3", "a/b", "1.0/2",
                      "1/9999999999"):
            with self.subTest(shard=shard):
                self.expect_refusal(f"option --shard: '{shard}' was given, I/N is expected",
                                    *self.call, "--shard", shard)
        self.expect_refusal("--resume needs an --output file", *self.call, "--resume")
        self.expect_refusal("no plain file", *self.call, "--resume", "--output", "/dev/null")

    def test_more_shards_than_combinations(self):
        self.expect(0, *self.call, "--shard", "1/1000", "--output", "table.csv")
        self.assertLessEqual(len(self.rows()), 1)


class KilledTest(CommandTest):
    """The first combination is done at once, the second would take a minute."""

    def start_hard(self):
        self.generate_hard("h")
        process = self.start("bench", *self.files("h"), "--agents", "2,250", "--solvers", "ecbs",
                             *OPTIMAL[-4:], "--output", "t.csv", "--resume")
        end = time.monotonic() + PATIENCE_S
        while self.lines() < 2 and time.monotonic() < end:
            time.sleep(0.01)
        self.assertEqual(self.lines(), 2)
        return process

    def lines(self):
        try:
            with open(self.path("t.csv"), "rb") as file:
                return file.read().count(b"\n")
        except FileNotFoundError:
            return 0

    def expect_resumable(self, number, code):
        process = self.start_hard()
        process.send_signal(number)
        process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, code)
        self.assertEqual(self.lines(), 2)
        result = self.run_command(
            "bench", *self.files("h"), "--agents", "2,3", "--solvers", "ecbs", *OPTIMAL[-4:],
            "--output", "t.csv", "--resume")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("1 row from before, 1 combination left", result.stderr)
        with open(self.path("t.csv")) as file:
            self.assertEqual([(r["agents"], r["status"]) for r in csv.DictReader(file)],
                             [("2", "solved"), ("3", "solved")])

    def test_a_killed_sweep_goes_on(self):
        self.expect_resumable(signal.SIGKILL, -signal.SIGKILL)

    def test_an_interrupted_combination_has_no_row(self):
        self.expect_resumable(signal.SIGTERM, 4)


if __name__ == "__main__":
    unittest.main()
