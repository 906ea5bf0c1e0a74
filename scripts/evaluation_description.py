"""What an evaluation consists of: a description, read and checked, and the runs that it asks for.

Used by scripts/evaluate, whose help says what a user has to know.
"""
import hashlib
import os
import platform
import shlex
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
COMMAND = os.environ.get("SPLIT_MAPF_COMMAND", os.path.join(
    ROOT, "build", "devel", "lib", "split_mapf", "split_mapf"))

# What an experiment or a series may say about its runs, and what holds where neither does.
DEFAULTS = {
    "map": None, "robots": [], "scenarios": 5, "repetitions": 1, "objective": "makespan",
    "solver": "auto", "solver_options": [], "split": "none", "split_options": [],
    "suboptimality": 1.5, "threads": None, "limit": 60, "refine": 0, "seed": 0,
}
# What an experiment says beside that.
OF_EXPERIMENTS = {"title", "plot", "series", "quick", "compare"}
PLOTS = {"robots", "series", "threads", "cells", "time", "trade"}


def output_of(*words):
    """What a program prints; nothing where it fails or is not there."""
    try:
        result = subprocess.run(words, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                check=False, universal_newlines=True)
    except OSError:
        return ""
    return result.stdout.strip()


SOURCES = ["src", "include", "config", "cmake", "CMakeLists.txt"]


def commit_of_sources():
    """The commit that last changed what is run, with a plus where it was changed since."""
    name = output_of("git", "log", "-1", "--format=%h", "--abbrev=10", "--", *SOURCES)
    changed = output_of("git", "status", "--porcelain", "--untracked-files=no", "--", *SOURCES)
    return (name or "unknown") + ("+" if changed else "")


def machine_name():
    """Model of the processor; no name of the computer."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                if line.startswith("model name"):
                    return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.machine()


class Description:
    """What a YAML file says is to be run."""

    def __init__(self, path, quick, wanted):
        try:
            import yaml  # pylint: disable=import-outside-toplevel
        except ImportError as error:
            raise ValueError("python's yaml is not here (Debian: python3-yaml)") from error
        with open(path, encoding="utf-8") as file:
            try:
                content = yaml.safe_load(file)
            except yaml.YAMLError as error:
                raise ValueError("%s: %s" % (path, error)) from error
        if not isinstance(content, dict) or not {"maps", "experiments"} <= set(content):
            raise ValueError("%s: 'maps' and 'experiments' are expected" % path)
        self.path = path
        self.maps = content["maps"]
        self.quick = quick
        unknown = set(wanted) - set(content["experiments"])
        if unknown:
            raise ValueError("no experiment %s in %s; there are %s"
                             % (", ".join(sorted(unknown)), path,
                                ", ".join(content["experiments"])))
        self.experiments = {name: self._resolved(name, experiment)
                            for name, experiment in content["experiments"].items()
                            if not wanted or name in wanted}
        self.data = os.environ.get("SPLIT_MAPF_BENCHMARKS", "")

    def _resolved(self, name, experiment):
        merged = dict(experiment)
        if self.quick:
            merged.update(experiment.get("quick", {}))
        merged.setdefault("series", {"": {}})
        if "title" not in merged or "plot" not in merged:
            raise ValueError("%s: experiment %s needs a title and a plot" % (self.path, name))
        if merged["plot"] not in PLOTS:
            raise ValueError("%s: experiment %s: plot '%s' is none of %s"
                             % (self.path, name, merged["plot"], ", ".join(sorted(PLOTS))))
        for part in [merged, *merged["series"].values()]:
            allowed = set(DEFAULTS) | (OF_EXPERIMENTS if part is merged else set())
            unknown = set(part) - allowed
            if unknown:
                raise ValueError("%s: experiment %s: '%s' says nothing; there are %s"
                                 % (self.path, name, sorted(unknown)[0],
                                    ", ".join(sorted(allowed))))
        if not all({**merged, **series}.get("map") for series in merged["series"].values()):
            raise ValueError("%s: experiment %s needs a map, or each of its series one"
                             % (self.path, name))
        for part in [merged, *merged["series"].values()]:
            for place in listed(part.get("map")):
                if place is not None and place not in self.maps:
                    raise ValueError("%s: experiment %s: map '%s' is not among the maps"
                                     % (self.path, name, place))
        return merged

    def runs(self):
        """Every run, in order. A run is what makes it: the entries of KEY."""
        here = {"commit": commit_of_sources(), "machine": machine_name(),
                "cores": len(os.sched_getaffinity(0))}
        return [dict(run, **here) for name in self.experiments for run in self._runs_of(name)]

    def _runs_of(self, name):
        experiment = self.experiments[name]
        for label, series in experiment["series"].items():
            what = {**DEFAULTS, **{key: experiment[key] for key in DEFAULTS if key in experiment},
                    **series}
            for place in listed(what["map"]):
                for threads in listed(what["threads"]):
                    for robots in listed(what["robots"]):
                        for number in range(what["scenarios"] * what["repetitions"]):
                            yield {
                                **{key: what[key] for key in
                                   ("objective", "solver", "split", "suboptimality", "limit",
                                    "refine", "seed")},
                                "experiment": name, "series": label, "map": place,
                                "source": self.source_of(place),
                                "robots": robots,
                                "scenario": 1 + number // what["repetitions"],
                                "repetition": 1 + number % what["repetitions"],
                                "threads": threads or len(os.sched_getaffinity(0)),
                                "solver_options": " ".join(what["solver_options"]),
                                "split_options": " ".join(what["split_options"])}

    def data_of(self, place):
        """Path of the map's data without ending; None where there are none."""
        name = self.maps[place].get("data")
        path = os.path.join(self.data, name) if self.data and name else None
        return path if path and os.path.exists(path + ".map") else None

    def source_of(self, place):
        """Where the map is from: data, or generated, with a hash of the words that generate it."""
        if self.data_of(place):
            return "data"
        words = self.maps[place]["generate"].encode("utf-8")
        return "generated-" + hashlib.sha256(words).hexdigest()[:8]

    def files_of(self, run, folder):
        """Map and scenario of a run; generates what is not there."""
        data = self.data_of(run["map"])
        if data:
            return data + ".map", "%s-random-%d.scen" % (data, run["scenario"])
        os.makedirs(os.path.join(folder, "maps"), exist_ok=True)
        # With each number of robots the same seed gives the same map.
        stem = os.path.join(folder, "maps", "%s-%s-%d-%d" % (
            run["map"], run["source"].rpartition("-")[2], run["robots"], run["scenario"]))
        if not os.path.exists(stem + ".scen"):
            words = [COMMAND, "generate", *shlex.split(self.maps[run["map"]]["generate"]),
                     "--agents", str(run["robots"]), "--seed", str(run["scenario"]),
                     "--output-map", stem + ".map", "--output-scen", stem + ".scen"]
            result = subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                    check=False, universal_newlines=True)
            if result.returncode != 0:
                raise ValueError("%s: %s" % (shlex.join(words), result.stderr.strip()))
        return stem + ".map", stem + ".scen"


def listed(value):
    return value if isinstance(value, list) else [value]
