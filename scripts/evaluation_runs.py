"""Runs an evaluation: one process a run, and a table of those that have ended.

Used by scripts/evaluate, whose help says what a user has to know.
"""
import csv
import datetime
import fcntl
import json
import os
import shlex
import subprocess
import sys
import time

from evaluation_description import COMMAND, output_of

# What makes two runs the same.
KEY = ["experiment", "series", "map", "source", "scenario", "repetition", "robots", "objective",
       "solver", "solver_options", "split", "split_options", "suboptimality", "threads", "limit",
       "refine", "seed", "commit", "machine", "cores"]
MEASURED = ["status", "seconds", "cpu_seconds", "first_plan_s", "peak_mib", "makespan",
            "makespan_lower_bound", "sum_of_costs", "sum_of_costs_lower_bound",
            "proved_lower_bound", "optimal", "certified_by", "stages", "pieces", "trace", "load",
            "date", "version", "command"]
# Exit codes of a call that worked: solved, unsolvable, out of time, no plan found, out of memory.
ENDINGS = {0, 2, 3, 6, 7}


def key_of(row):
    return tuple(str(row[name]) for name in KEY)


class Table:
    """runs.csv: a row a run that has ended."""

    def __init__(self, path):
        self.path = path
        self.rows = {}
        # Two calls at once would read each other's results.
        # pylint: disable-next=consider-using-with
        self.lock = open(path + ".lock", "w", encoding="utf-8")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise ValueError("another call is at work in %s" % os.path.dirname(path)) from error
        if not os.path.exists(path):
            return
        with open(path, encoding="utf-8", newline="") as file:
            text = file.read()
        whole = text[:text.rfind("\n") + 1]
        if whole != text:  # the machine went off within a row
            with open(path, "w", encoding="utf-8", newline="") as file:
                file.write(whole)
        reader = csv.DictReader(whole.splitlines())
        if reader.fieldnames and reader.fieldnames != KEY + MEASURED:
            raise ValueError("%s is a table of another version: move it away" % path)
        for row in reader:
            self.rows[key_of(row)] = row

    def add(self, row):
        is_new = not os.path.exists(self.path) or os.path.getsize(self.path) == 0
        with open(self.path, "a", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, KEY + MEASURED, lineterminator="\n")
            if is_new:
                writer.writeheader()
            writer.writerow(row)
        self.rows[key_of(row)] = {name: str(value) for name, value in row.items()}

    def row_of(self, run):
        return self.rows.get(key_of(run))

    def rows_of(self, runs):
        return [row for row in map(self.row_of, runs) if row]


def words_of(run, files):
    words = ["plan", "--map", files[0], "--scen", files[1], "--agents", run["robots"],
             "--objective", run["objective"], "--solver", run["solver"], "--split", run["split"],
             "--suboptimality", run["suboptimality"], "--threads", run["threads"],
             "--time-limit", run["limit"], "--refine", run["refine"], "--seed", run["seed"]]
    for option in run["solver_options"].split():
        words += ["--solver-option", option]
    for option in run["split_options"].split():
        words += ["--split-option", option]
    return [str(word) for word in words]


def measure(run, files, result_path):
    """Runs it and returns its row; None where it ended as no plan may, which is printed."""
    words = words_of(run, files)
    load = os.getloadavg()[0]
    if os.path.exists(result_path):
        os.unlink(result_path)
    with subprocess.Popen([COMMAND, *words, "--quiet", "--paths", "compact", "--output",
                           result_path], stderr=subprocess.PIPE, universal_newlines=True) as plan:
        try:
            error = plan.stderr.read()
            _, status, usage = os.wait4(plan.pid, 0)
        except BaseException:
            plan.kill()
            raise
        plan.returncode = os.WEXITSTATUS(status) if os.WIFEXITED(status) else -status
    shown = shlex.join(["split_mapf", *words])
    if plan.returncode not in ENDINGS or not os.path.exists(result_path):
        print("\nevaluate: exit code %d of: %s\n%s" % (plan.returncode, shown, error.strip()))
        return None
    with open(result_path, encoding="utf-8") as file:
        result = json.load(file)
    plain = ["status", "first_plan_s", "makespan", "makespan_lower_bound", "sum_of_costs",
             "sum_of_costs_lower_bound", "proved_lower_bound", "certified_by"]
    return {
        **run, **{name: "" if result[name] is None else result[name] for name in plain},
        "seconds": result["runtime_s"],
        "cpu_seconds": round(usage.ru_utime + usage.ru_stime, 3),
        "peak_mib": round(usage.ru_maxrss / 1024, 1),
        "optimal": int(result["optimal"]),
        "stages": " ".join("%s=%.4g" % stage for stage in result["stages"].items()),
        "pieces": len(result["subproblems"]),
        "trace": json.dumps(result["trace"], separators=(",", ":")),
        "load": round(load, 2),
        "date": datetime.datetime.now().isoformat(timespec="seconds"),
        "version": output_of(COMMAND, "--version"),
        "command": shown}


class Progress:
    """A line with what was done and an estimate of what is left."""

    def __init__(self, runs):
        self.left = list(runs)
        self.seconds = {}  # (experiment, series) -> of its last run
        self.begin = time.monotonic()
        self.total = len(runs)

    def _expected(self, run):
        known = self.seconds.get((run["experiment"], run["series"]))
        if known is None:
            known = (sum(self.seconds.values()) / len(self.seconds)) if self.seconds else 1
        return min(known, run["limit"] + 1)

    def print(self, run):
        seconds = sum(map(self._expected, self.left))
        line = "%d of %d, %s %s, %d robots; %d s gone, about %d s left" % (
            self.total - len(self.left) + 1, self.total, run["experiment"], run["series"],
            run["robots"], time.monotonic() - self.begin, seconds)
        if sys.stderr.isatty():
            print("\r%-100s" % line[:100], end="", file=sys.stderr, flush=True)
        elif (self.total - len(self.left)) % 20 == 0:
            print(line, file=sys.stderr, flush=True)

    def done(self, run, seconds=None):
        self.left.remove(run)
        if seconds is not None:
            self.seconds[(run["experiment"], run["series"])] = seconds


def climb_of(run):
    """Runs that differ in scenario and number of robots only."""
    return tuple(run[name] for name in KEY if name not in ("scenario", "repetition", "robots"))


def run_all(runs, table, description, folder):
    """Runs what the table has no row of. Returns how many ended as no plan may."""
    if not os.access(COMMAND, os.X_OK):
        raise ValueError("%s is not there: run scripts/build first" % COMMAND)
    wrong = 0
    solved = {}  # (climb, robots) -> whether any run had a plan
    progress = Progress(runs)
    for run in runs:
        climb = climb_of(run)
        given_up = any(known == climb and robots < run["robots"] and not any_plan
                       for (known, robots), any_plan in solved.items())
        row = table.row_of(run)
        if row is None and not given_up:
            progress.print(run)
            begin = time.monotonic()
            row = measure(run, description.files_of(run, folder),
                          os.path.join(folder, "result.json"))
            wrong += row is None
            if row:
                table.add(row)
            progress.done(run, time.monotonic() - begin)
        else:
            progress.done(run)
        if not given_up:
            at = (climb, run["robots"])
            solved[at] = solved.get(at, False) or (row is not None and row["status"] == "solved")
    if sys.stderr.isatty():
        print(file=sys.stderr)
    return wrong
