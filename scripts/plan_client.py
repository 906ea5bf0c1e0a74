#!/usr/bin/env python3
"""Sends a planning goal to the planner node and shows how it goes.

The robots come from a MovingAI .scen, or from a .yaml with poses of robots that have size; the map
from a MovingAI .map, a map_server .yaml or, without --map, from the topic `map` (for instance of:
roslaunch split_mapf planner.launch map_file:=FILE).
Files are read by `split_mapf convert`, as by all commands. Ctrl-C cancels the goal.

exit codes: 0 a valid plan, 1 bad usage or bad input, 2 no plan exists, 3 time limit, 4 cancelled,
5 internal error or no answer from the node, 6 no plan found, 7 memory limit
"""

import argparse
import json
import sys
import threading

import rospy
from actionlib_msgs.msg import GoalStatus

import split_mapf.ros as mapf
from split_mapf.errors import InputError
from split_mapf.msg import PlanOutcome

EXIT_CODES = {
    PlanOutcome.SUCCEEDED: 0,
    PlanOutcome.CANCELLED: 4,
    PlanOutcome.TIMEOUT: 3,
    PlanOutcome.UNSOLVABLE: 2,
    PlanOutcome.UNREACHABLE_GOAL: 2,
    PlanOutcome.NO_PLAN_FOUND: 6,
    PlanOutcome.MEMORY_LIMIT: 7,
    PlanOutcome.SERVER_BUSY: 5,
    PlanOutcome.INTERNAL_ERROR: 5,
}
# Of a goal, by the names that they have there.
OPTIONS = ("solver", "split", "objective", "suboptimality", "time_limit", "refine_time", "seed",
           "threads", "step_duration", "solver_options", "split_options", "robot_radius",
           "clearance", "cell_size", "snap_distance", "robot_speed", "ignore_specks", "passages",
           "unknown_space")


def read_instance(args, fleet=None):
    """The map, and the ways of the robots as [start x, start y, goal x, goal y] with y from the top,
    or their poses."""
    if args.map:
        return mapf.read_instance(args.map, args.scen, args.agents, args.resolution)
    try:
        grid = fleet.map(wait=args.wait)
    except mapf.NoAnswer as error:
        raise mapf.NoAnswer("%s; give one with --map" % error) from error
    if not grid.data:
        raise InputError("the map on the topic %s has no cells" % rospy.resolve_name("map"))
    size = "%dx%d" % (grid.info.width, grid.info.height)
    return grid, mapf.read_instance(None, args.scen, args.agents, size=size)[1]


def make_robots(grid, rows):
    if rows and isinstance(rows[0], dict):
        return mapf.robots_at_poses([row["start"] for row in rows], [row["goal"] for row in rows],
                                    [row["id"] for row in rows],
                                    [row["radius"] or 0.0 for row in rows], grid.header.frame_id)
    top = grid.info.height - 1
    return mapf.robots_at_cells(grid, [(x, top - y) for x, y, _, _ in rows],
                                [(x, top - y) for _, _, x, y in rows])


def make_options(args, grid, robots, are_posed):
    options = {name: getattr(args, name) for name in OPTIONS}
    sized = have_size(args, robots, grid.info.resolution)
    if are_posed and not sized:
        raise InputError("%s: robots at poses need a size, or the node would take them to the "
                         "centres of their cells: `radius` there, --robot-radius, or robot_radius "
                         "of the node" % args.scen)
    # The file says where robots that have size are at each step.
    options["fill_poses"] = bool(args.output) and sized
    return options


def have_size(args, robots, resolution):
    """Whether the node will build a planning graph: as its own rule for goal and parameters."""
    node = rospy.resolve_name(args.server).rsplit("/", 1)[0]

    def value(name):
        asked = getattr(args, name)
        return rospy.get_param("%s/%s" % (node, name), 0) if asked is None else asked

    return (any(robot.radius > 0 for robot in robots) or value("robot_radius") > 0 or
            value("clearance") > 0 or
            (value("cell_size") > 0 and abs(value("cell_size") - resolution) > 1e-6 * resolution))


class ProgressLine:
    """Feedback as one line that is written over; without a terminal a line each stage."""

    def __init__(self, quiet):
        self.quiet = quiet
        self.lock = threading.Lock()
        self.stage = None
        self.is_drawn = False

    def show(self, feedback):
        if self.quiet:
            return
        text = "%6.1f s  %s" % (feedback.elapsed, feedback.stage)
        if feedback.subproblems_total > 1:
            text += "  %d/%d pieces" % (feedback.subproblems_done, feedback.subproblems_total)
        if feedback.makespan:
            text += "  makespan %d" % feedback.makespan
        with self.lock:
            if sys.stdout.isatty():
                sys.stdout.write("\r\033[K" + text)
                self.is_drawn = True
            elif feedback.stage != self.stage:
                sys.stdout.write(text + "\n")
            self.stage = feedback.stage
            sys.stdout.flush()

    def close(self):
        with self.lock:
            if self.is_drawn:
                sys.stdout.write("\n")
            self.is_drawn = False


def wait_for_end(goal):
    """The answer; the first Ctrl-C cancels the goal, the second one does not wait."""
    try:
        return goal.wait()
    except KeyboardInterrupt:
        goal.cancel()
        return goal.wait()


def print_outcome(answer):
    plan, statistics = answer.plan, answer.statistics
    print("%s (%s) after %.2f s" % (answer.outcome_name, answer.state_name, answer.seconds))
    print("  " + answer.message)
    for fault in answer.faults[:10]:
        print("  - " + fault.message)
    if len(answer.faults) > 10:
        print("  - and %d more" % (len(answer.faults) - 10))
    if answer:
        print("  robots        %d" % len(plan.paths))
        print_cost("makespan    ", plan.makespan, statistics.makespan_lower_bound)
        print_cost("sum of costs", plan.sum_of_costs, statistics.sum_of_costs_lower_bound)
        print("  planned in    %.2f s, %d %s%s" %
              (statistics.runtime, statistics.subproblems,
               "piece" if statistics.subproblems == 1 else "pieces",
               ", proved optimal by " + statistics.certified_by if statistics.optimal else ""))


def print_cost(name, cost, bound):
    ratio = "   %.3f times the lower bound %d" % (cost / bound, bound) if bound else ""
    print("  %s  %d%s" % (name, cost, ratio))


def write_json(path, answer):
    """The fields of `split_mapf plan --output` that an answer carries."""
    try:
        with open(path, "w", encoding="ascii") as file:
            json.dump(mapf.document_of(answer), file)
            file.write("\n")
    except OSError as error:
        raise InputError("%s: %s" % (path, error.strerror)) from error


def at_least(least, kind):
    def parse(text):
        value = kind(text)
        if not least <= value < float("inf"):
            raise ValueError
        return value

    parse.__name__ = "number (>= %g)" % least
    return parse


def parse_arguments(arguments):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--map", help="MovingAI .map, or map_server .yaml (default: the map on the "
                                      "topic `map`)")
    parser.add_argument("--scen", required=True,
                        help="MovingAI .scen, or .yaml with poses of robots that have size")
    parser.add_argument("--agents", type=at_least(0, int), default=0, metavar="N",
                        help="take the first N rows of the scenario; 0: all (0)")
    parser.add_argument("--resolution", type=at_least(1e-6, float), metavar="M",
                        help="side of a cell of a MovingAI .map in metres (1)")
    options = parser.add_argument_group("planning options (default: the node's parameters)")
    options.add_argument("--solver")
    options.add_argument("--split")
    options.add_argument("--objective", choices=("makespan", "sum_of_costs"))
    options.add_argument("--solver-option", action="append", dest="solver_options",
                         metavar="NAME=VALUE")
    options.add_argument("--split-option", action="append", dest="split_options",
                         metavar="NAME=VALUE")
    options.add_argument("--suboptimality", type=float)
    options.add_argument("--time-limit", type=float, metavar="SECONDS")
    options.add_argument("--refine-time", type=float, metavar="SECONDS")
    options.add_argument("--step-duration", type=float, metavar="SECONDS")
    for name, unit in (("robot-radius", "METRES"), ("clearance", "METRES"),
                       ("cell-size", "METRES"), ("snap-distance", "METRES"),
                       ("robot-speed", "M/S")):
        options.add_argument("--" + name, type=at_least(0, float), metavar=unit)
    options.add_argument("--ignore-specks", type=at_least(0, int), metavar="CELLS")
    options.add_argument("--passages", choices=("true", "false"))
    options.add_argument("--unknown-space", choices=("blocked", "free"))
    options.add_argument("--seed", type=at_least(0, int))
    options.add_argument("--threads", type=at_least(0, int))
    parser.add_argument("--server", default="split_mapf/plan_paths",
                        help="name of the action (split_mapf/plan_paths)")
    parser.add_argument("--wait", type=at_least(0, float), default=20.0, metavar="SECONDS",
                        help="patience until the node, and the map, are there (20)")
    parser.add_argument("--output", metavar="FILE", help="write the plan as JSON")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    try:
        args = parser.parse_args(arguments)
        if args.resolution and not args.map:
            parser.error("--resolution needs --map")
        args.passages = {"true": True, "false": False}.get(args.passages)
        args.seed, args.threads = args.seed or None, args.threads or None  # 0: the node's
        return args
    except SystemExit as end:
        # argparse says 2 for bad usage, which stands for "unsolvable" here.
        raise SystemExit(1 if end.code else 0) from end


def run(args):
    fleet = mapf.Fleet(args.server, args.wait, resend=0)
    grid, rows = read_instance(args, fleet)
    robots = make_robots(grid, rows)
    options = make_options(args, grid, robots, isinstance(rows[0], dict))
    progress = ProgressLine(args.quiet)
    answer = wait_for_end(fleet.send(robots, grid if args.map else None, progress.show, **options))
    progress.close()
    if answer.state == GoalStatus.LOST:
        raise mapf.NoAnswer(answer.message)
    print_outcome(answer)
    exit_code = EXIT_CODES.get(answer.outcome, 1)
    if args.output:
        write_json(args.output, answer)
    return exit_code


def main():
    args = parse_arguments(rospy.myargv()[1:])
    try:
        return run(args)
    except InputError as error:
        print("plan_client: %s" % error, file=sys.stderr)
        return 1
    except mapf.NoAnswer as error:
        print("plan_client: %s" % error, file=sys.stderr)
        return 5
    except KeyboardInterrupt:
        return 4
    finally:
        rospy.signal_shutdown("done")


if __name__ == "__main__":
    sys.exit(main())
