"""Draws the table of an evaluation with gnuplot. Used by scripts/evaluate.

A point is the median of its scenarios; a run without a plan counts as later and dearer than all
others, so a point is missing where half of the scenarios or more had none. Hollow marks are figures
of others, in the colour of the series that does the same.
"""
import csv
import json
import math
import os
import shutil
import statistics
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# Told apart by people who do not see all colours, and on paper by their marks.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
# A hundredth more or less is seen, a thousandth is no mountain.
RATIO_RANGE = "set yrange [*<0.99:1.01<*]"
MARKS = [(7, 6), (5, 4), (9, 8), (13, 12), (11, 10), (15, 14), (3, 3)]  # filled, hollow


def figures_of(name):
    """Rows of a file of bench/ with figures of others."""
    with open(os.path.join(ROOT, "bench", name), encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def ratio_of(row):
    """Cost against the shortest paths; infinite without a plan."""
    cost = "makespan" if row["objective"] == "makespan" else "sum_of_costs"
    if row["status"] != "solved" or float(row[cost + "_lower_bound"]) == 0:
        return math.inf
    return float(row[cost]) / float(row[cost + "_lower_bound"])


def seconds_of(row):
    return max(float(row["seconds"]), 1e-3) if row["status"] == "solved" else math.inf


def median_points(rows, place_of, value_of):
    """[(place, median)], in order of places; without those that are infinite."""
    values = {}
    for row in rows:
        values.setdefault(place_of(row), []).append(value_of(row))
    # Of two middle ones the worse: half of the scenarios solved are no more than half.
    points = [(place, statistics.median_high(list_)) for place, list_ in sorted(values.items())]
    return [point for point in points if math.isfinite(point[1])]


class Plot:
    """A picture of panels, each with its curves, as a script of gnuplot."""

    def __init__(self, title, note, panels, width=1100, height=520):
        self.lines = ["set terminal pngcairo size %d,%d font 'DejaVu Sans,11' noenhanced"
                      % (width, height),
                      "set multiplot layout 1,%d title %s font 'DejaVu Sans,13'"
                      % (panels, quoted(title)),
                      "set label 1 %s at screen 0.5,0.915 center font 'DejaVu Sans,9' textcolor "
                      "rgb '#555555'" % quoted(note),
                      "set grid lc rgb '#dddddd' lt 1", "set tics nomirror", "set border 3",
                      "set tmargin 5"]
        self.blocks = 0

    def panel(self, settings, curves):
        """curves: [(title, points, style)]; points: [(x, y)] or [(x, y, word)]."""
        parts, blocks = [], []
        for title, points, style in curves:
            if not points:
                continue
            self.blocks += 1
            blocks += ["$d%d << END" % self.blocks,
                       *(" ".join([*("%.8g" % value for value in point[:2]),
                                   *map(quoted, point[2:])]) for point in points), "END"]
            parts.append("$d%d using %s with %s title %s"
                         % (self.blocks, "1:2:3" if len(points[0]) > 2 else "1:2", style,
                            quoted(title)))
        self.lines += settings + blocks
        # An empty panel keeps its place, and says so.
        self.lines.append("plot " + (", \\\n  ".join(parts) or "[1:2] [1:2] NaN title 'no plan'"))
        self.lines += ["unset label 1", "unset logscale", "set xtics auto", "set format '%h'",
                       "set yrange [*:*]"]

    def write(self, path):
        script = "\n".join(["set output %s" % quoted(path), *self.lines, "unset multiplot", ""])
        result = subprocess.run(["gnuplot"], input=script, stderr=subprocess.PIPE, check=False,
                                universal_newlines=True)
        if result.returncode != 0:  # its warnings are of ranges
            raise ValueError("gnuplot cannot draw %s: %s" % (path, result.stderr.strip()))


def quoted(text):
    return '"%s"' % str(text).replace("\\", "\\\\").replace('"', "'")


def lines_style(index):
    return "linespoints lc rgb '%s' lw 2 pt %d ps 1.1" % (COLOURS[index % len(COLOURS)],
                                                          MARKS[index % len(MARKS)][0])


def others_style(index, kind="linespoints dt 3"):
    return "%s lc rgb '%s' lw 1.5 pt %d ps 1.5" % (kind, COLOURS[index % len(COLOURS)],
                                                   MARKS[index % len(MARKS)][1])


def note_of(rows):
    """What a reader must know of the runs behind a plot."""
    loads = [float(row["load"]) for row in rows]
    cores = {int(row["cores"]) for row in rows}
    note = "%s, %s cores, commit %s" % (rows[0]["machine"], "/".join(map(str, sorted(cores))),
                                        rows[0]["commit"])
    # Its own threads are part of the load that a run finds.
    if statistics.median(loads) > 2 * max(cores):
        note += ", other programs ran beside (load %.0f)" % statistics.median(loads)
    scenarios = {row["scenario"] for row in rows}
    return note + ", %d scenario%s" % (len(scenarios), "" if len(scenarios) == 1 else "s")


def cost_label(rows):
    return ("makespan" if rows[0]["objective"] == "makespan" else "sum of costs") + \
        " / shortest paths"


def others_of(description, name, rows):
    """The authors' figures for an experiment, where the map is theirs."""
    if description.experiments[name].get("compare") != "authors":
        return []
    for row in rows:
        if row["source"] != "data" and description.maps[row["map"]].get("alike") is False:
            return []
    return [figure for figure in figures_of("authors_figures.csv") if figure["experiment"] == name]


def draw_growth(description, name, rows, path, place_of, axis, settings_of_x=""):
    """Seconds and cost over robots, threads or cells."""
    plot = Plot(description.experiments[name]["title"], note_of(rows), 2)
    others = others_of(description, name, rows)
    labels = list(description.experiments[name]["series"])
    for value_of, field, settings in [
            (seconds_of, "seconds", ["set logscale y", "set ylabel 'seconds to the plan'",
                                     "set format y '%g'"]),
            (ratio_of, "ratio", ["set ylabel %s" % quoted(cost_label(rows)), RATIO_RANGE])]:
        curves = []
        for index, label in enumerate(labels):
            own = [row for row in rows if row["series"] == label]
            curves.append((label, median_points(own, place_of, value_of), lines_style(index)))
            points = [(float(figure["robots"]), float(figure[field])) for figure in others
                      if figure["series"] == label and figure[field]]
            curves.append((label + ", authors", points, others_style(index)))
        plot.panel([*settings, "set xlabel %s" % quoted(axis), settings_of_x,
                    "set offsets %s, %s" % ("0, 0" if "log" in settings_of_x else "graph 0.05, graph 0.05",
                                            "0, 0" if field == "seconds"
                                            else "graph 0.08, graph 0.05"),
                    "set key outside bottom center horizontal maxrows 3 font ',9'"], curves)
    plot.write(path)


def draw_series(description, name, rows, path):
    """Seconds and cost of each series, one beside the other."""
    experiment = description.experiments[name]
    plot = Plot(experiment["title"], note_of(rows), 2)
    labels = list(experiment["series"])
    others = others_of(description, name, rows)
    tics = ", ".join("%s %d" % (quoted(label), i) for i, label in enumerate(labels))
    for value_of, field, settings in [
            (seconds_of, "seconds", ["set logscale y", "set ylabel 'seconds to the plan'",
                                     "set format y '%g'"]),
            (ratio_of, "ratio", ["set ylabel %s" % quoted(cost_label(rows)), RATIO_RANGE])]:
        own = median_points(rows, lambda row: labels.index(row["series"]), value_of)
        theirs = [(labels.index(figure["series"]), float(figure[field])) for figure in others]
        plot.panel([*settings, "set xtics (%s)" % tics, "set xlabel 'buffer'" if name == "buffers"
                    else "unset xlabel", "set xrange [-0.5:%g]" % (len(labels) - 0.5),
                    "set offsets 0, 0, %s" % ("0, 0" if field == "seconds"
                                              else "graph 0.1, graph 0.1"),
                    "set key outside bottom center horizontal"],
                   [("split_mapf", own, lines_style(0)),
                    ("authors", theirs, others_style(1))])
    plot.write(path)


def draw_time(description, name, rows, path):
    """Cost over time, one panel a series; marks of peers."""
    experiment = description.experiments[name]
    labels = [label for label in experiment["series"]
              if any(row["series"] == label for row in rows)]
    plot = Plot(experiment["title"], note_of(rows), len(labels), width=340 * len(labels))
    peers = figures_of("peers_figures.csv")
    names = sorted({figure["peer"] for figure in peers})
    for label in labels:
        own = [row for row in rows if row["series"] == label]
        curves = []
        for row in own:
            trace = json.loads(row["trace"])
            bound = float(row["sum_of_costs_lower_bound"])
            points = [(max(step[0], 1e-3), step[2] / bound) for step in trace]
            if points:  # it held until the limit
                points.append((float(row["limit"]), points[-1][1]))
            curves.append(("split_mapf" if row is own[0] else "", points,
                           "steps lc rgb '%s' lw 2" % COLOURS[0]))
        alike = own[0]["source"] == "data" or \
            description.maps[own[0]["map"]].get("alike") is not False
        for index, peer in enumerate(names):
            points = [(float(figure["seconds"]), float(figure["ratio"])) for figure in peers
                      if alike and figure["peer"] == peer and figure["map"] == own[0]["map"]
                      and figure["robots"] == own[0]["robots"]]
            curves.append((peer, points, others_style(index + 1)))
        plot.panel(["set logscale x", "set xlabel 'seconds'", "set format x '%g'",
                    "set ylabel %s" % quoted(cost_label(own)),
                    "set title %s font ',10'" % quoted("%s, %s robots" % (label, own[0]["robots"])),
                    "set offsets 0, 0, graph 0.1, graph 0.05",
                    "set key outside bottom center horizontal maxrows 2 font ',9'"], curves)
    plot.write(path)


def draw_trade(description, name, rows, path):
    """One panel a map: how many times as fast a split makes a solver, and as dear its plan."""
    experiment = description.experiments[name]
    maps = list(dict.fromkeys(row["map"] for row in rows))
    plot = Plot(experiment["title"], note_of(rows), len(maps), width=400 * len(maps))
    for place in maps:
        curves = []
        here = [row for row in rows if row["map"] == place]
        solvers = list(dict.fromkeys(row["solver"] for row in here))
        for index, solver in enumerate(solvers):
            points = []
            of_solver = [row for row in here if row["solver"] == solver]
            for split in dict.fromkeys(row["split"] for row in of_solver if row["split"] != "none"):
                medians = [statistics.median_high([value_of(row) for row in of_solver
                                                   if row["split"] == wanted] or [math.inf])
                           for value_of in (seconds_of, ratio_of) for wanted in ("none", split)]
                if all(map(math.isfinite, medians)):
                    points.append((medians[0] / medians[1], medians[3] / medians[2], split))
            style = "lc rgb '%s'" % COLOURS[index]
            curves.append((solver, [point[:2] for point in points],
                           "points %s pt %d ps 1.5" % (style, MARKS[index][0])))
            # One above the other, as many have the same cost.
            curves.append(("", points, "labels center offset 0,%g font ',8' tc rgb '%s'"
                           % (0.9 + 0.9 * index, COLOURS[index])))
        plot.panel(["set logscale x", "set format x '%g'", "set xlabel 'times as fast'",
                    "set ylabel 'cost, of that without split'",
                    "set title %s font ',10'"
                    % quoted("%s, %s robots" % (place, here[0]["robots"])),
                    "set arrow 1 from first 1, graph 0 to first 1, graph 1 nohead dt 2",
                    "set xrange [*<0.5:2<*]", "set yrange [*<0.95:1.05<*]",
                    "set offsets 0, 0, graph 0.25, 0",
                    "set key outside bottom center horizontal font ',9'"], curves)
    plot.write(path)


def cells_of(row):
    """Cells of a generated square map, whose name ends with its side."""
    return float(row["map"].rsplit("-", 1)[1]) ** 2


DRAWERS = {
    "robots": lambda *a: draw_growth(*a, lambda row: float(row["robots"]), "robots"),
    "threads": lambda *a: draw_growth(*a, lambda row: float(row["threads"]), "threads",
                                      "set xtics 1"),
    "cells": lambda *a: draw_growth(*a, cells_of, "cells of the map", "set logscale x"),
    "series": draw_series,
    "time": draw_time,
    "trade": draw_trade,
}


def draw_all(description, rows, folder):
    """A PNG for each experiment that has rows."""
    if not shutil.which("gnuplot"):
        print("evaluate: gnuplot is not here (Debian: gnuplot-nox): no plots, the table alone")
        return
    for name, experiment in description.experiments.items():
        own = [row for row in rows if row["experiment"] == name]
        if not own:
            print("%s: no run, no plot" % name)
            continue
        path = os.path.join(folder, name + ".png")
        DRAWERS[experiment["plot"]](description, name, own, path)
        print(path)
