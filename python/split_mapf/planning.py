"""Plans without ROS. Cells are (x, y): x is the column, y the row from the top.

A map is the name of a file (MovingAI .map, or .yaml of map_server) or a 2-D array, rows from the
top: where it is 0 or False a robot may go, everything else is blocked. Calls let other threads run
meanwhile. Ctrl-C ends them with KeyboardInterrupt; bad input with one of split_mapf.errors.
"""

import math
import numbers
import os

import numpy

try:
    from . import _core
except ImportError as error:
    raise ImportError("the planner's module split_mapf._core is not here (%s). It is built where "
                      "pybind11 and Python's headers are: python3-pybind11 and python3-dev on "
                      "Debian and Ubuntu" % error) from error
from ._core import Result, Verdict, Violation, solvers  # noqa: F401 (for users)
from .errors import InputError, OptionError

_MOST = 2**31 - 1


# pylint: disable=redefined-builtin
def plan(map, starts, goals, *, solver="auto", solver_options=(), split="auto", split_options=(),
         objective="makespan", suboptimality=1.5, time_limit=60, refine=0, straighten=False, seed=0,
         threads=0, occupied_threshold=65, unknown_space="blocked", callback=None):
    """Plans for robots that go from `starts` to `goals`, cells in the same order. Returns a Result,
    which is true where it has a plan; that no plan exists or was found in time is no exception.

    The options are those of `split_mapf plan --help`: names of a solver and a split, NAME=VALUE
    options of theirs (a list, or a dict), makespan or sum_of_costs, seconds for the whole call, and
    of these, seconds to `refine` the first plan; threads 0 are all processors. The last two say what
    cells of a map_server file are blocked.
    `callback(result)` is called with each better plan while the search goes on, the first one
    included; where it takes long, with the latest. If it returns False the plan is good enough.
    """
    request = _request(solver=solver, solver_options=solver_options, split=split,
                       split_options=split_options, objective=objective,
                       suboptimality=suboptimality, time_limit=time_limit, refine=refine,
                       straighten=straighten, seed=seed, threads=threads)
    problem = _problem(map, starts, goals, occupied_threshold, unknown_space)
    return _core.plan(problem, request, _callback(callback))


def refine(map, starts, goals, paths, seconds=10, *, objective="makespan", seed=0, threads=0,
           occupied_threshold=65, unknown_space="blocked", callback=None):
    """Improves a plan: a Result, or a list of one array of cells [step, (x, y)] a robot, wherever it
    comes from. Ends after `seconds`, or when the plan is proved to cost least. Returns a Result.
    Otherwise as plan(). A plan that is not valid is an InputError, which names the first violation.
    """
    request = _request(objective=objective, refine=seconds, seed=seed, threads=threads)
    problem = _problem(map, starts, goals, occupied_threshold, unknown_space)
    return _core.refine(problem, _paths(paths), request, _callback(callback))


def validate(map, starts, goals, paths, *, occupied_threshold=65, unknown_space="blocked"):
    """All that is wrong with a plan (see refine()), a list of Violation; empty where it is valid.
    The judge shares no code with the solvers."""
    problem = _problem(map, starts, goals, occupied_threshold, unknown_space)
    return _core.validate(problem, _paths(paths))


def check(map, starts, goals, *, time_limit=60, occupied_threshold=65, unknown_space="blocked"):
    """Whether a plan exists, decided without planning: a Verdict, which is true where one does."""
    problem = _problem(map, starts, goals, occupied_threshold, unknown_space)
    return _core.check(problem, _number("time_limit", time_limit, 0))


def read_map(path, *, occupied_threshold=65, unknown_space="blocked"):
    """The blocked cells of a map file: an array of bool [y, x], rows from the top."""
    return _core.read_map(os.fsencode(path), _whole("occupied_threshold", occupied_threshold, 1, 100),
                          _is_free(unknown_space))


def read_scenario(path, map, agents=None):
    """The starts and goals of a MovingAI .scen, of its first `agents` robots or of all: two arrays
    [robot, (x, y)]. `map`, a file or an array, is what its rows have to fit in size."""
    blocked = read_map(map) if _is_path(map) else _blocked(map)
    if agents is not None:
        agents = _whole("agents", agents, 1, _MOST)
    return _core.read_scenario(os.fsencode(path), blocked.shape[1], blocked.shape[0], agents)


def _request(**options):
    request = _core.Request()
    for name in ("solver", "split", "objective"):
        if name in options:
            setattr(request, name, _text(name, options[name]))
    for name in ("solver_options", "split_options"):
        if name in options:
            setattr(request, name, _settings(name, options[name]))
    for name in ("suboptimality", "time_limit", "refine"):
        if name in options:
            setattr(request, name, _number(name, options[name], 0))
    request.straighten = bool(options.get("straighten", False))
    request.seed = _whole("seed", options["seed"], 0, 2**64 - 1)
    request.threads = _whole("threads", options["threads"], 0, 1024)
    return request


def _problem(map, starts, goals, occupied_threshold, unknown_space):
    threshold = _whole("occupied_threshold", occupied_threshold, 1, 100)
    place = os.fsencode(map) if _is_path(map) else _blocked(map)
    return _core.Problem(place, threshold, _is_free(unknown_space), _cells("start", starts),
                         _cells("goal", goals))


def _is_path(map):
    return isinstance(map, (str, bytes, os.PathLike))


def _blocked(map):
    try:
        cells = numpy.asarray(map)
    except ValueError as error:
        raise InputError("map: %s" % error) from error
    if cells.ndim != 2 or cells.dtype.kind not in "buif":
        raise InputError("map: an array of shape %s and type %s was given; the name of a file, or "
                         "numbers in rows of equal length are expected" %
                         (cells.shape, cells.dtype))
    return numpy.ascontiguousarray(cells != 0)


def _cells(role, cells):
    """An array of rows (x, y); `role` says what of a robot they are."""
    array = _whole_rows(cells)
    if array is not None:
        return array
    try:
        rows = list(cells)
    except TypeError:
        raise InputError("%ss: %r was given, a list of cells (x, y) is expected" %
                         (role, cells)) from None
    for robot, cell in enumerate(rows):
        if not _is_cell(cell):
            raise InputError("robot %d: its %s is %r; two whole numbers (x, y) are expected, column "
                             "and row from the top" % (robot, role, cell))
    return numpy.array([[int(x), int(y)] for x, y in rows], numpy.int32).reshape(-1, 2)


def _whole_rows(cells):
    """The cells as they are passed on, where they are fit for it at once; else None."""
    if not isinstance(cells, numpy.ndarray) or cells.dtype.kind not in "iu":
        return None
    if cells.ndim != 2 or cells.shape[1] != 2:
        return None
    if cells.size and not (-_MOST <= int(cells.min()) and int(cells.max()) <= _MOST):
        return None
    return numpy.ascontiguousarray(cells, numpy.int32)


def _is_cell(cell):
    try:
        x, y = cell
    except (TypeError, ValueError):
        return False
    return all(isinstance(value, numbers.Integral) and not isinstance(value, bool) and
               -_MOST <= value <= _MOST for value in (x, y))


def _paths(paths):
    given = paths.paths if isinstance(paths, Result) else paths
    try:
        robots = list(given)
    except TypeError:
        raise InputError("paths: %r was given, a list of one array of cells a robot is expected" %
                         (given,)) from None
    return [_path(robot, path) for robot, path in enumerate(robots)]


def _path(robot, path):
    array = _whole_rows(path)
    if array is not None:
        return array
    try:
        cells = list(path)
    except TypeError:
        raise InputError("robot %d: its path is %r; a list of cells (x, y) is expected" %
                         (robot, path)) from None
    for step, cell in enumerate(cells):
        if not _is_cell(cell):
            raise InputError("robot %d: its path has %r at step %d; two whole numbers (x, y) are "
                             "expected" % (robot, cell, step))
    return numpy.array([[int(x), int(y)] for x, y in cells], numpy.int32).reshape(-1, 2)


def _text(name, value):
    if isinstance(value, str):
        return value
    raise OptionError("%s: %r was given, text is expected" % (name, value))


def _settings(name, value):
    if isinstance(value, dict):
        value = ["%s=%s" % (key, _word(one)) for key, one in value.items()]
    if isinstance(value, (list, tuple)) and all(isinstance(one, str) for one in value):
        return list(value)
    raise OptionError("%s: %r was given, a dict, or a list of NAME=VALUE is expected" %
                      (name, value))


def _word(value):
    return str(value).lower() if isinstance(value, bool) else value


def _number(name, value, least):
    if isinstance(value, numbers.Real) and not math.isnan(value) and value >= least:
        return float(value)
    raise OptionError("%s: %r was given, a number of at least %g is expected" % (name, value, least))


def _whole(name, value, least, most):
    if isinstance(value, numbers.Integral) and not isinstance(value, bool) and least <= value <= most:
        return int(value)
    raise OptionError("%s: %r was given, a whole number from %d to %d is expected" %
                      (name, value, least, most))


def _is_free(unknown_space):
    if unknown_space in ("blocked", "free"):
        return unknown_space == "free"
    raise OptionError("unknown_space: %r was given, blocked or free is expected" % (unknown_space,))


def _callback(callback):
    if callback is None or callable(callback):
        return callback
    raise OptionError("callback: %r was given, a function of one Result is expected" % (callback,))
