#!/usr/bin/python3
"""Sums up what gcov counted: covered lines of each room, and every line that no test runs.

usage: sum_coverage.py BUILD ROOT [--least PERCENT]

BUILD has the counts (*.gcda) of a build with --coverage; scripts/coverage makes them. Counts the
sources and headers of the rooms that know no ROS. Exit code 1: fewer lines are covered than asked.
"""
import argparse
import collections
import json
import os
import subprocess
import sys

NO_CORE = ("ros", "rviz", "node", "tool", "python")


def room_of(path):
    """The room of a source file by its path from the root; None: not one that counts."""
    parts = path.split("/")
    if parts[:2] == ["include", "split_mapf"] and len(parts) > 3:
        room = parts[2]
    elif parts[0] == "src" and len(parts) > 2:
        room = parts[1]
    else:
        return None
    return None if room in NO_CORE else room


def counts_of(build):
    """The counts of every object that has run, as gcov's JSON."""
    for folder, _, names in os.walk(build):
        for name in names:
            if not name.endswith(".gcda"):
                continue
            found = subprocess.run(
                ["gcov", "--json-format", "--stdout", os.path.join(folder, name)],
                cwd=build, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            for line in found.stdout.splitlines():
                if line.strip():
                    yield json.loads(line)


def merge(build, root):
    """{file: {line: times that it was run}}; a header counts once, however many include it."""
    merged = collections.defaultdict(lambda: collections.defaultdict(int))
    for counts in counts_of(build):
        for entry in counts["files"]:
            path = os.path.join(counts["current_working_directory"], entry["file"])
            path = os.path.relpath(os.path.realpath(path), root)
            if room_of(path) is None:
                continue
            for line in entry["lines"]:
                merged[path][line["line_number"]] += line["count"]
    return merged


def as_ranges(numbers):
    """1 2 3 7 as '1-3 7'."""
    ranges = []
    for number in sorted(numbers):
        if ranges and ranges[-1][1] == number - 1:
            ranges[-1][1] = number
        else:
            ranges.append([number, number])
    return " ".join(str(a) if a == b else "%d-%d" % (a, b) for a, b in ranges)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("build")
    parser.add_argument("root")
    parser.add_argument("--least", type=float, default=0, help="percent of the lines")
    args = parser.parse_args()
    merged = merge(os.path.abspath(args.build), os.path.realpath(args.root))
    if not merged:
        sys.exit("sum_coverage.py: no program in %s has counted lines of the core" % args.build)
    rooms = collections.defaultdict(lambda: [0, 0])
    print("Lines that no test runs:")
    for path, lines in sorted(merged.items()):
        missed = [number for number, count in lines.items() if count == 0]
        room = rooms[room_of(path)]
        room[0] += len(lines) - len(missed)
        room[1] += len(lines)
        if missed:
            print("  %s: %s" % (path, as_ranges(missed)))
    covered, total = (sum(column) for column in zip(*rooms.values()))
    print("\n%-14s %8s %8s %7s" % ("room", "covered", "lines", "share"))
    for room, (run, of_all) in sorted(rooms.items()) + [("all", (covered, total))]:
        print("%-14s %8d %8d %6.1f%%" % (room, run, of_all, 100.0 * run / of_all))
    if 100.0 * covered < args.least * total:
        sys.exit("sum_coverage.py: fewer than %g %% of the lines are covered" % args.least)


if __name__ == "__main__":
    main()
