#!/usr/bin/env python3
"""Asks planner_node for a long time, on a ROS master of its own: several clients send random goals, cancel
some of them and send what is no goal at all, while the map on the topic changes.

  plan_soak.py                              an hour, five clients
  plan_soak.py --node build/asan/devel/lib/split_mapf/planner_node --most-growth 100
                                            the same node built with -DSPLIT_MAPF_SANITIZE=address

Every goal has to end once; no plan may break a rule, by code that shares nothing with the node; what is no
goal may not be planned for; nothing may be an internal error; the node's memory may not grow once five
minutes (or the first third) are over; and the node has to end well, which leaks under a sanitizer prevent.

exit codes: 0 all is well, 1 something is not (see the last lines)
"""

import argparse
import collections
import copy
import os
import random
import signal
import sys
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

# First: it chooses the master's port.
from soak_run import OUTCOMES, SoakRun, cpu_and_memory, run_to_end  # noqa: E402
import rospy  # noqa: E402
from actionlib_msgs.msg import GoalStatus  # noqa: E402
from nav_msgs.msg import OccupancyGrid  # noqa: E402

from move_clients import PlainClient, pose_at  # noqa: E402
from ros_processes import Program, free_map, start_program, wait_until  # noqa: E402
from split_mapf.msg import (PlanPathsActionGoal, PlanPathsActionResult,  # noqa: E402
                            PlanPathsGoal, RobotTask)

# A goal may wait behind those of all others, each with its limit.
PATIENCE_SEC = 300
LOOK_SEC = 5
WARM_UP_SEC = 300
SOLVERS = ("", "auto", "conflict_optimizer", "ecbs", "lacam", "prioritized")
SPLITS = ("", "none", "2t", "2s", "2x2s2t")
SIGNS_OF_HARM = ("AddressSanitizer", "LeakSanitizer", "runtime error:", "terminate called")


def fault_of(grid, starts, goals, plan):
    """What is wrong with a plan; empty: nothing. Cells are indices into the map's data."""
    paths = [list(path.cells) for path in plan.paths]
    if len(paths) != len(starts):
        return "%d paths for %d robots" % (len(paths), len(starts))
    for robot, path in enumerate(paths):
        if not path or path[0] != starts[robot] or path[-1] != goals[robot]:
            return "robot %d does not go from its start to its goal" % robot
        for cell in path:
            if cell >= len(grid.data) or grid.data[cell] != 0:
                return "robot %d is in cell %d, which is not free" % (robot, cell)
        for before, cell in zip(path, path[1:]):
            across = abs(before % grid.info.width - cell % grid.info.width)
            if across + abs(before // grid.info.width - cell // grid.info.width) > 1:
                return "robot %d jumps" % robot
    if plan.makespan != max(len(path) for path in paths) - 1:
        return "the makespan is not the plan's"
    return fault_between(paths)


def fault_between(paths):
    last = max(len(path) for path in paths)
    before = {}
    for step in range(last):
        now = {}
        for robot, path in enumerate(paths):
            cell = path[min(step, len(path) - 1)]
            if cell in now:
                return "robots %d and %d meet at step %d" % (now[cell], robot, step)
            now[cell] = robot
        for cell, robot in now.items():
            other = before.get(cell)
            if other is not None and other != robot:
                path, step_before = paths[robot], min(step - 1, len(paths[robot]) - 1)
                if now.get(path[step_before]) == other:
                    return "robots %d and %d change places at step %d" % (other, robot, step)
        before = now
    return ""


class Sent:
    """What is known of a goal."""

    def __init__(self, kind, grid, starts, goals):
        self.kind, self.grid, self.starts, self.goals = kind, grid, starts, goals


class RandomGoals:
    """Goals of one client, and what they ask for."""

    def __init__(self, seed, maps):
        self.draw = random.Random(seed)
        self.maps = maps

    def next(self):
        kind = self.draw.choices(("own map", "map of the topic", "bad"), (6, 2, 3))[0]
        if kind == "map of the topic":
            return self.goal_on_topic()
        goal, sent = self.goal_on_own_map()
        if kind == "bad":
            sent.kind = self.spoil(goal)
        return goal, sent

    def goal_on_own_map(self):
        side = self.draw.randint(8, 40)
        grid = free_map(side, self.draw.randint(8, 40))
        density = self.draw.choice((0, 0.05, 0.1, 0.2))
        grid.data = [100 if self.draw.random() < density else 0 for _ in grid.data]
        free = [cell for cell, value in enumerate(grid.data) if value == 0]
        robots = min(self.draw.randint(1, 40), len(free) // 3)
        starts, goals = self.draw.sample(free, robots), self.draw.sample(free, robots)
        goal = self.goal_between(grid.info.width, starts, goals)
        goal.map = grid
        return goal, Sent("own map", grid, starts, goals)

    def goal_on_topic(self):
        """In the lowest row, which is free on every map."""
        width = min(grid.info.width for grid in list(self.maps.values()))
        starts = self.draw.sample(range(width), self.draw.randint(1, 6))
        goals = self.draw.sample(range(width), len(starts))
        return self.goal_between(10 ** 6, starts, goals), Sent("map of the topic", None, starts, goals)

    def goal_between(self, width, starts, goals):
        goal = PlanPathsGoal()
        for number, (start, end) in enumerate(zip(starts, goals)):
            goal.robots.append(RobotTask(
                robot_id="r%d" % number, start=pose_at(start % width + 0.5, start // width + 0.5),
                goal=pose_at(end % width + 0.5, end // width + 0.5)))
        options = goal.options
        options.solver, options.split = self.draw.choice(SOLVERS), self.draw.choice(SPLITS)
        options.objective = self.draw.choice(("", "makespan", "sum_of_costs"))
        options.time_limit = self.draw.choice((0.3, 1.0, 2.0))
        options.refine_time = self.draw.choice((0, 0, 0.2))
        options.seed = self.draw.randrange(1000)
        options.fill_poses = self.draw.random() < 0.2
        return goal

    def spoil(self, goal):
        """Makes it one that no server may plan for. @return how."""
        robot = self.draw.choice(goal.robots)
        nan = float("nan")
        kinds = {
            "a start that is no number": lambda: setattr(robot.start.pose.position, "x", nan),
            "a goal off the map": lambda: setattr(robot.goal.pose.position, "y", 1e12),
            "an unknown frame": lambda: setattr(robot.start.header, "frame_id", "nowhere"),
            "an unknown solver": lambda: setattr(goal.options, "solver", "nobody"),
            "a split that is none": lambda: setattr(goal.options, "split", "0x9q"),
            "a negative bound": lambda: setattr(goal.options, "suboptimality", 0.1),
            "no robots": goal.robots.clear,
            "a robot twice": lambda: goal.robots.append(copy.deepcopy(robot)),
            "a map that is too short": lambda: setattr(goal.map, "data", goal.map.data[:-1]),
            "a map that is all wall": lambda: setattr(goal.map, "data", [100] * len(goal.map.data)),
            "a map without resolution": lambda: setattr(goal.map.info, "resolution", 0.0),
            "much text": lambda: setattr(robot, "robot_id", "x" * 100000),
        }
        kind = self.draw.choice(sorted(kinds))
        kinds[kind]()
        return "bad: " + kind


class PlanSoak(SoakRun):
    def __init__(self, options):
        super().__init__("plan_soak")
        self.options = options
        self.sent = {}
        self.outcomes = []
        self.maps = {}
        self.draw = random.Random(options.seed)
        self.stopping = threading.Event()
        self.map_topic = rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True)
        self.change_map()

    def change_map(self):
        """To one of another size than the last ones, so that a plan tells by its map which it is for."""
        size = 20 + len(self.maps) % 30
        grid = free_map(size, 60 - size)
        wall = self.draw.choice((0, 0.1, 0.2))
        grid.data = [100 if at >= size and self.draw.random() < wall else 0
                     for at in range(len(grid.data))]
        if len(self.maps) < 30:
            self.maps[(size, 60 - size)] = grid
        else:
            grid = self.draw.choice(list(self.maps.values()))
        self.map_topic.publish(grid)

    def start_node(self):
        arguments = ("__name:=split_mapf", "_threads:=2", "_time_limit:=3.0", "_max_queued_goals:=12",
                     "_publish_paths:=false")
        # Memory that was freed is kept for a while by AddressSanitizer, 256 MiB by default.
        env = {"ASAN_OPTIONS": "quarantine_size_mb=16:detect_leaks=1"}
        if self.options.node:
            self.node = self.start(Program(self.options.node, *arguments, env=env))
        else:
            self.node = self.start(start_program("planner_node", *arguments, env=env))

    def run(self):
        self.start_node()
        clients = [PlainClient("client_%d" % number, "split_mapf/plan_paths", PlanPathsActionGoal,
                               PlanPathsActionResult) for number in range(self.options.clients)]
        # A node under a sanitizer is slow to begin.
        connected = wait_until(lambda: all(client.is_connected() for client in clients), PATIENCE_SEC)
        if not connected:
            raise RuntimeError("no action server: " + self.node.output())
        threads = [threading.Thread(target=self.conduct_to_end, args=(client, number))
                   for number, client in enumerate(clients)]
        for thread in threads:
            thread.start()
        self.watch()
        self.stopping.set()
        for thread in threads:
            thread.join()
        self.judge(clients)
        self.end_node()

    def wait_for_ends(self, clients):
        """@return false when a goal has none, or the node is down."""
        def are_ended():
            return not any(client.open() for client in clients)
        wait_until(lambda: are_ended() or self.node.process.poll() is not None, PATIENCE_SEC)
        return are_ended()

    def conduct_to_end(self, client, number):
        try:
            self.conduct(client, number)
        except Exception as error:  # pylint: disable=broad-except
            self.require(False, "client %d has stopped: %r" % (number, error))

    def conduct(self, client, number):
        goals = RandomGoals(self.options.seed * 1000 + number, self.maps)
        draw = goals.draw
        while not self.stopping.is_set():
            for _ in range(draw.choice((1, 1, 1, 2, 3))):
                goal, sent = goals.next()
                name = client.send(goal)
                self.sent[name] = sent
                if draw.random() < 0.15:
                    time.sleep(draw.choice((0, 0.01, 0.3)))
                    client.cancel(name)
            if not self.wait_for_ends([client]):
                self.require(False, "client %d waits for %s" % (number, client.open()))
                return
            self.judge_ended(client)
            time.sleep(draw.random() * self.options.pause)

    def watch(self):
        """Changes the map and looks at the node's memory until the time is up."""
        begun = time.monotonic()
        length = 60 * self.options.minutes
        warm = min(WARM_UP_SEC, length / 3)
        self.memory = {False: [self.memory_mib()], True: []}
        while time.monotonic() - begun < length and not self.wrong:
            time.sleep(LOOK_SEC)
            if self.node.process.poll() is not None:
                self.require(False, "the node ended: " + self.node.output()[-2000:])
                return
            self.memory[time.monotonic() - begun > warm].append(self.memory_mib())
            self.change_map()

    def memory_mib(self):
        return cpu_and_memory(self.node.process.pid)[1]

    def judge_ended(self, client):
        """Looks at the ends that came, and keeps no plan."""
        with client.lock:
            ends = [end for ended in client.ends.values() for end in ended if end.result is not None]
        for end in ends:
            self.judge_end(self.sent[end.status.goal_id.id], end)
            self.outcomes.append(OUTCOMES.get(end.result.outcome, "?"))
            end.result = None

    def judge_end(self, sent, end):
        result = end.result
        outcome = OUTCOMES.get(result.outcome, str(result.outcome))
        what = "%s (%s): " % (end.status.goal_id.id, sent.kind)
        succeeded = end.status.status == GoalStatus.SUCCEEDED
        self.require(outcome != "INTERNAL_ERROR", what + result.message)
        self.require(succeeded == (outcome == "SUCCEEDED"), what + "ended as both")
        self.require(result.message != "", what + "without a word")
        if not result.plan.paths:
            self.require(not succeeded, what + "succeeded without a plan")
            return
        self.require(not sent.kind.startswith("bad"), what + "is planned for")
        grid, starts, goals = sent.grid, sent.starts, sent.goals
        if grid is None:
            grid = self.maps[(result.plan.grid.width, result.plan.grid.height)]
        fault = fault_of(grid, starts, goals, result.plan)
        self.require(not fault, what + fault)

    def judge(self, clients):
        for client in clients:
            self.judge_ended(client)
            self.require(not client.open(), "without an end: %s" % client.open())
            for goal, ends in client.ends.items():
                self.require(len(ends) == 1, "%s ended %d times" % (goal, len(ends)))
        counts = collections.Counter(self.outcomes)
        print("%d goals of %d clients: %s" % (len(self.sent), len(clients), ", ".join(
            "%s %d" % item for item in sorted(counts.items()))))
        # A node that plans for nobody is flat, too.
        self.require(3 * counts["SUCCEEDED"] > len(self.sent), "few goals succeeded")

    def end_node(self):
        early, late = self.memory[False], self.memory[True]
        self.require(late, "the memory was not looked at: too short, or ended too early")
        if late:
            print("memory [MiB]: at most %.0f at first, %.0f to %.0f after it, %.0f at the end" %
                  (max(early), min(late), max(late), late[-1]))
            self.require(max(late) <= max(early) + self.options.most_growth, "memory has grown")
        self.node.signal(signal.SIGINT)
        code = self.node.wait(120)
        output = self.node.output()
        harm = [line for line in output.splitlines() if any(sign in line for sign in SIGNS_OF_HARM)]
        self.require(code == 0 and not harm, "the node ended with %s: %s" % (code, harm[:3]))

    def end(self):
        self.stopping.set()
        super().end()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--clients", type=int, default=5)
    parser.add_argument("--pause", type=float, default=0.2,
                        help="of a client between its goals, at most [s] (0.2)")
    parser.add_argument("--node", help="the program (default: this package's planner_node)")
    parser.add_argument("--most-growth", type=float, default=20,
                        help="beyond what the node had at first [MiB] (20)")
    parser.add_argument("--seed", type=int, default=1)
    soak = PlanSoak(parser.parse_args())
    return run_to_end(soak, soak.run)


if __name__ == "__main__":
    sys.exit(main())
