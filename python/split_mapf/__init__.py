"""Multi-robot path planning: split_mapf from Python.

Without ROS, on maps of files or arrays:

    import split_mapf
    starts, goals = split_mapf.read_scenario("w.scen", "w.map")
    result = split_mapf.plan("w.map", starts, goals)
    print(result.makespan, result.paths[0])

`split_mapf.ros` is a client of the planner node. `split_mapf.msg` and `split_mapf.srv` are its
messages and services.
"""

import importlib

# What plans comes with a library and numpy, which those who want the messages alone do without.
_PLANNING = ("plan", "refine", "validate", "check", "read_map", "read_scenario", "solvers",
             "Result", "Verdict", "Violation")
_ERRORS = ("InputError", "OptionError", "UnknownSolverError", "SplitSpecError", "InstanceError",
           "Fault")

__all__ = list(_PLANNING + _ERRORS)


def __getattr__(name):
    if name in _PLANNING:
        return getattr(importlib.import_module("split_mapf.planning"), name)
    if name in _ERRORS:
        return getattr(importlib.import_module("split_mapf.errors"), name)
    raise AttributeError("module 'split_mapf' has no attribute %r" % name)


def __dir__():
    return sorted(list(globals()) + __all__)
