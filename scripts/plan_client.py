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
import array
import base64
import json
import math
import os
import subprocess
import sys
import threading
import time

import actionlib
import roslib.packages
import rospy
from actionlib_msgs.msg import GoalStatus
from nav_msgs.msg import OccupancyGrid

from split_mapf.msg import PlanOptions, PlanOutcome, PlanPathsAction, PlanPathsGoal, RobotTask

OUTCOME_NAMES = {
    value: name
    for name, value in vars(PlanOutcome).items()
    if name.isupper() and isinstance(value, int)
}
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
PASSAGES = {"true": PlanOptions.PASSAGES_ON, "false": PlanOptions.PASSAGES_OFF}
UNKNOWN_SPACE = {"blocked": PlanOptions.UNKNOWN_SPACE_BLOCKED,
                 "free": PlanOptions.UNKNOWN_SPACE_FREE}
STATUS_WORDS = {0: "solved", 2: "unsolvable", 3: "timeout", 4: "cancelled", 6: "no_plan_found",
                7: "memory_limit"}


class InputError(Exception):
    """A file or an option that does not say what it should."""


class NoAnswer(Exception):
    """The planner node, the map, or the command is not there."""


def find_command():
    """The command: catkin puts it beside this program."""
    beside = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "split_mapf")
    if os.path.isfile(beside):
        return beside
    places = roslib.packages.find_node("split_mapf", "split_mapf")
    if not places:
        raise NoAnswer("the command split_mapf, which reads maps and scenarios, is neither at %s "
                       "nor elsewhere in the package; build or install it" % beside)
    return places[0]


def convert(*options):
    """What the command reads from the files that the options name."""
    call = [find_command(), "convert"]
    for name, value in options:
        if value:
            call += ["--" + name, str(value)]
    done = subprocess.run(call, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        message = done.stderr.decode("utf-8", "replace").strip().replace("split_mapf: ", "", 1)
        error = InputError if done.returncode == 1 else NoAnswer
        raise error(message or "%s ended with code %d" % (call[0], done.returncode))
    return json.loads(done.stdout.decode("utf-8"))


def grid_of(read):
    """A map as an OccupancyGrid in frame `map`; its last row is the message's first."""
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    width, height = grid.info.width, grid.info.height = read["width"], read["height"]
    grid.info.resolution = read["resolution"]
    x, y, yaw = read["origin"]
    grid.info.origin.position.x, grid.info.origin.position.y = x, y
    grid.info.origin.orientation.z = math.sin(yaw / 2)
    grid.info.origin.orientation.w = math.cos(yaw / 2)
    cells = array.array("b", base64.b64decode(read["occupancy"]))
    grid.data = array.array("b")
    for row in reversed(range(height)):
        grid.data += cells[row * width:(row + 1) * width]
    return grid


def read_instance(args):
    """The map, and the ways of the robots as (start x, start y, goal x, goal y), or their poses."""
    scenario = (("scen", args.scen), ("agents", args.agents))
    if args.map:
        read = convert(("map", args.map), ("resolution", args.resolution), *scenario)
        grid = grid_of(read)
    else:
        grid = wait_for_map(args.wait)
        if not grid.data:
            raise InputError("the map on the topic %s has no cells" % rospy.resolve_name("map"))
        read = convert(("size", "%dx%d" % (grid.info.width, grid.info.height)), *scenario)
    if "robots" in read:
        return grid, read["robots"]
    return grid, [start + goal for start, goal in zip(read["starts"], read["goals"])]


def wait_for_map(patience):
    try:
        return rospy.wait_for_message("map", OccupancyGrid, timeout=patience)
    except rospy.ROSException as error:
        raise NoAnswer("no map on the topic %s within %g s; give one with --map" %
                       (rospy.resolve_name("map"), patience)) from error


def place(pose, grid, x, y):
    """Sets a pose to the centre of a cell, y counted from the top."""
    info = grid.info
    turn = info.origin.orientation
    along_x = (x + 0.5) * info.resolution
    along_y = (info.height - 1 - y + 0.5) * info.resolution
    sine, cosine = 2 * turn.w * turn.z, 1 - 2 * turn.z * turn.z
    pose.header.frame_id = grid.header.frame_id
    pose.pose.position.x = info.origin.position.x + cosine * along_x - sine * along_y
    pose.pose.position.y = info.origin.position.y + sine * along_x + cosine * along_y
    pose.pose.orientation.w = 1.0


def stand(pose, grid, x, y, yaw):
    """Sets a pose of the map's frame."""
    pose.header.frame_id = grid.header.frame_id
    pose.pose.position.x, pose.pose.position.y = x, y
    pose.pose.orientation.z, pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)


def make_goal(args, grid, rows):
    goal = PlanPathsGoal()
    if args.map:
        goal.map = grid
    poses = [row for row in rows if isinstance(row, dict)]
    if poses:
        for robot in poses:
            task = RobotTask(robot_id=robot["id"], radius=robot["radius"] or 0.0)
            stand(task.start, grid, *robot["start"])
            stand(task.goal, grid, *robot["goal"])
            goal.robots.append(task)
        rows = []
    for index, (start_x, start_y, goal_x, goal_y) in enumerate(rows):
        task = RobotTask(robot_id="r%d" % index)
        place(task.start, grid, start_x, start_y)
        place(task.goal, grid, goal_x, goal_y)
        goal.robots.append(task)
    for name in ("solver", "split", "objective", "suboptimality", "time_limit", "refine_time",
                 "seed", "threads", "step_duration", "solver_options", "split_options",
                 "robot_radius", "clearance", "cell_size", "snap_distance", "robot_speed",
                 "ignore_specks"):
        value = getattr(args, name)
        if value is not None:
            # In a goal 0 stands for the node's parameter, a negative number for zero.
            zero = -1 if name == "ignore_specks" else -1.0
            has_zero = isinstance(value, float) or name == "ignore_specks"
            setattr(goal.options, name, zero if value == 0 and has_zero else value)
    if args.passages:
        goal.options.passages = PASSAGES[args.passages]
    if args.unknown_space:
        goal.options.unknown_space = UNKNOWN_SPACE[args.unknown_space]
    sized = have_size(args, goal, grid.info.resolution)
    if poses and not sized:
        raise InputError("%s: robots at poses need a size, or the node would take them to the "
                         "centres of their cells: `radius` there, --robot-radius, or robot_radius "
                         "of the node" % args.scen)
    # The file says where robots that have size are at each step.
    goal.options.fill_poses = bool(args.output) and sized
    return goal


def have_size(args, goal, resolution):
    """Whether the node will build a planning graph: as its own rule for goal and parameters."""
    node = rospy.resolve_name(args.server).rsplit("/", 1)[0]

    def value(name):
        asked = getattr(args, name)
        return rospy.get_param("%s/%s" % (node, name), 0) if asked is None else asked

    return (any(robot.radius > 0 for robot in goal.robots) or value("robot_radius") > 0 or
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


def find_server(name, patience):
    client = actionlib.ActionClient(name, PlanPathsAction)
    # With a time of its own it would wait in ROS time, which may stand or leap; this is wall time.
    waiting = threading.Thread(target=client.wait_for_server, daemon=True)
    waiting.start()
    waiting.join(patience)
    if waiting.is_alive():
        raise NoAnswer("no planner answers on %s within %g s; is planner_node running?" %
                       (rospy.resolve_name(name), patience))
    return client


def run_goal(client, goal, progress):
    """Sends the goal and waits for its end. Returns its terminal state and the result."""
    handle = client.send_goal(goal, feedback_cb=lambda _, feedback: progress.show(feedback))
    cancelled = False
    while handle.get_comm_state() != actionlib.CommState.DONE:
        try:
            time.sleep(0.02)
            # The connection of the goal topic ends with the server.
            if client.pub_goal.get_num_connections() == 0:
                raise NoAnswer("the planner node has gone")
        except KeyboardInterrupt:
            if cancelled:
                raise
            cancelled = True
            handle.cancel()
    progress.close()
    return handle.get_terminal_state(), handle.get_result()


def print_outcome(state, result, seconds):
    statistics = result.statistics
    print("%s (%s) after %.2f s" % (OUTCOME_NAMES.get(result.outcome, str(result.outcome)),
                                    GoalStatus.to_string(state), seconds))
    print("  " + result.message)
    for fault in result.faults[:10]:
        print("  - " + fault.message)
    if len(result.faults) > 10:
        print("  - and %d more" % (len(result.faults) - 10))
    if result.plan.paths:
        print("  robots        %d" % len(result.plan.paths))
        print_cost("makespan    ", result.plan.makespan, statistics.makespan_lower_bound)
        print_cost("sum of costs", result.plan.sum_of_costs, statistics.sum_of_costs_lower_bound)
        print("  planned in    %.2f s, %d %s%s" %
              (statistics.runtime, statistics.subproblems,
               "piece" if statistics.subproblems == 1 else "pieces",
               ", proved optimal by " + statistics.certified_by if statistics.optimal else ""))


def print_cost(name, cost, bound):
    ratio = "   %.3f times the lower bound %d" % (cost / bound, bound) if bound else ""
    print("  %s  %d%s" % (name, cost, ratio))


def write_json(path, result, exit_code):
    """The fields of `split_mapf plan --output` that a result carries."""
    plan, statistics = result.plan, result.statistics
    width, height = plan.grid.width, plan.grid.height
    document = {
        "status": STATUS_WORDS.get(exit_code, "error"),
        "message": result.message,
        "solver": statistics.solver,
        "split": statistics.split,
        "objective": plan.objective,
        "agents": len(plan.paths),
        "makespan": plan.makespan if plan.paths else None,
        "sum_of_costs": plan.sum_of_costs if plan.paths else None,
        "makespan_lower_bound": statistics.makespan_lower_bound,
        "sum_of_costs_lower_bound": statistics.sum_of_costs_lower_bound,
        "proved_lower_bound": statistics.proved_lower_bound,
        "optimal": statistics.optimal,
        "certified_by": statistics.certified_by,
        "runtime_s": statistics.runtime,
        "first_plan_s": statistics.first_plan if plan.paths else None,
        "stages": dict(zip(statistics.stage_names, statistics.stage_seconds)),
        "paths": [[[cell % width, height - 1 - cell // width] for cell in path.cells]
                  for path in plan.paths],
    }
    if plan.longest_step > 0:
        origin = plan.grid.origin
        yaw = 2 * math.atan2(origin.orientation.z, origin.orientation.w)
        document.update({
            "grid": {"resolution": plan.grid.resolution, "width": width, "height": height,
                     "origin": [origin.position.x, origin.position.y, yaw]},
            "robot_radius": plan.robot_radius,
            "clearance": plan.clearance,
            "longest_step": plan.longest_step,
            "step_duration": plan.step_duration,
            "departure_steps": plan.departure_steps,
            "arrival_steps": plan.arrival_steps,
            "robots": [path.robot_id for path in plan.paths],
            "radii": [path.radius for path in plan.paths],
            "least_clearance": [path.least_clearance for path in plan.paths],
            "poses": [[[pose.pose.position.x, pose.pose.position.y] for pose in path.path.poses]
                      for path in plan.paths],
        })
    try:
        with open(path, "w", encoding="ascii") as file:
            json.dump(document, file)
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
    options.add_argument("--passages", choices=tuple(PASSAGES))
    options.add_argument("--unknown-space", choices=tuple(UNKNOWN_SPACE))
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
        return args
    except SystemExit as end:
        # argparse says 2 for bad usage, which stands for "unsolvable" here.
        raise SystemExit(1 if end.code else 0) from end


def run(args):
    client = find_server(args.server, args.wait)
    goal = make_goal(args, *read_instance(args))
    begin = time.monotonic()
    state, result = run_goal(client, goal, ProgressLine(args.quiet))
    if result is None:
        raise NoAnswer("the goal was lost")
    # A goal that was recalled before the node had seen it has an empty result.
    if state == GoalStatus.RECALLED:
        result.outcome = PlanOutcome.CANCELLED
    print_outcome(state, result, time.monotonic() - begin)
    exit_code = EXIT_CODES.get(result.outcome, 1)
    if args.output:
        write_json(args.output, result, exit_code)
    return exit_code


def main():
    args = parse_arguments(rospy.myargv()[1:])
    rospy.init_node("plan_client", anonymous=True, disable_signals=True)
    try:
        return run(args)
    except InputError as error:
        print("plan_client: %s" % error, file=sys.stderr)
        return 1
    except NoAnswer as error:
        print("plan_client: %s" % error, file=sys.stderr)
        return 5
    except KeyboardInterrupt:
        return 4
    finally:
        rospy.signal_shutdown("done")


if __name__ == "__main__":
    sys.exit(main())
