#!/usr/bin/env python3
"""Measures the action ~execute with robots without hardware, on a ROS master of its own. Not part of the
tests that run each time: it takes minutes, and its figures depend on the machine.

  execute_soak.py long   robots of a warehouse carry out a plan, then the same one backwards, and so on for
                         some minutes. Some are late; the node improves nothing (policy graph), is killed in
                         the middle of the last plan, and starts again. Every execution ends with all robots
                         at their goals, the node's memory stays flat, and places are checked from a bag by
                         a script that knows the bag alone.
  execute_soak.py death  robots carry out the plan, and some of them, drawn anew each time, die on the way:
                         each says FAULT, stands from then on, and is taken out by ~remove_robot. How long
                         from its FAULT until the first routes come that are planned anew (planning), and
                         from the call until each of the others was sent a route again (telling: routes go
                         out at the next tick, whether they are planned anew or not)? All arrive who still
                         have a way. Fails above 1 s of either, so it wants a machine that is not busy.

exit codes: 0 all is well, 1 something is not (see the last lines)
"""

import argparse
import os
import signal
import statistics
import struct
import sys
import time

# First: it chooses the master's port.
from soak_run import OUTCOMES, cpu_and_memory, run_to_end
import actionlib
import rospy
from nav_msgs.msg import OccupancyGrid

from fleet_case import make_plan
from move_soak import Soak
from ros_processes import SentGoal, start_program, wait_until
from split_mapf.msg import (ExecutePlanAction, ExecutePlanGoal, MultiRobotPlan, PlanOutcome, RobotPath,
                            RobotProgress, RobotRoute, RobotState)
from split_mapf.srv import RemoveRobot

LOOK_SEC = 10
# Beyond what a process needs once it has done everything once.
MOST_GROWTH_MIB = 20
MOST_SEC_TO_NEW_ROUTES = 1.0


def backwards(plan):
    """From the goals to the starts: as valid as the plan."""
    last = max(len(path.cells) for path in plan.paths)
    back = MultiRobotPlan(header=plan.header, grid=plan.grid, step_duration=plan.step_duration,
                          makespan=plan.makespan, objective=plan.objective)
    for path in plan.paths:
        cells = list(path.cells) + [path.cells[-1]] * (last - len(path.cells))
        cells.reverse()
        while len(cells) > 1 and cells[-2] == cells[-1]:
            cells.pop()
        back.paths.append(RobotPath(robot_id=path.robot_id, cells=cells))
    back.makespan = max(len(path.cells) - 1 for path in back.paths)
    back.sum_of_costs = sum(len(path.cells) - 1 for path in back.paths)
    return back


class ExecuteSoak(Soak):
    policy = "graph"

    def publish_starts(self):
        """Of a plan for all robots."""
        width, height = self.options.size
        self.grid, self.plan = make_plan(self.directory.name, self.options.robots, width, height,
                                         self.options.step)
        self.topics = [rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True),
                       rospy.Publisher("plan", MultiRobotPlan, queue_size=1, latch=True)]
        self.topics[0].publish(self.grid)
        self.topics[1].publish(self.plan)

    def start_fleet(self):
        self.fleet = self.start(start_program(
            "executor_node", "_execution_file:=" + os.path.join(self.directory.name, "kept.json"),
            "_threads:=1", "_policy:=" + self.policy, "_release_ahead:=3", "_progress_timeout:=30",
            "_robot_radius:=%g" % self.options.radius))
        if not self.fleet.wait_for_output("ready:"):
            raise RuntimeError(self.fleet.output())

    def send(self, plan):
        client = actionlib.ActionClient("fleet/execute", ExecutePlanAction)
        client.wait_for_server(rospy.Duration(60))
        return SentGoal(client, ExecutePlanGoal(plan=plan))

    def run(self):
        self.start_fleet()
        self.start_robots("_delay_probability:=0.0005", "_min_delay:=10", "_max_delay:=30",
                          "_delay_step:=%g" % self.options.step)
        bag = os.path.join(self.directory.name, "run.bag")
        with self.recording(bag):
            time.sleep(2)
            self.conduct()
        self.check(bag)

    def conduct(self):
        self.begun = time.monotonic()
        self.shares, self.memory, self.executions = [], [], 0
        plan, is_killed = self.plan, False
        while not is_killed:
            is_killed = time.monotonic() - self.begun > 24 * self.options.minutes
            self.execute(plan, is_killed)
            plan = backwards(plan)
            if self.wrong:
                break
        self.report()

    def execute(self, plan, is_killed):
        self.state = None
        goal = self.send(plan)
        if is_killed:
            goal = self.kill_and_start_again(plan)
        wait_until(lambda: self.look() and goal.wait_for_end(0.05), 3600)
        result = goal.result()
        name = OUTCOMES.get(result.outcome, "?") if result else "no end"
        self.require(name == "SUCCEEDED", "%s: %s" % (name, result.message if result else ""))
        self.executions += 1

    def kill_and_start_again(self, plan):
        some = len(plan.paths) // 4
        # What was told of the execution before is no news.
        wait_until(lambda: self.state and self.state.plan_id and self.arrived() < some)
        reached = wait_until(lambda: self.look() and self.arrived() >= some, 3600)
        self.require(reached, "the execution in which the node is killed did not get on")
        print("killed when %d of %d robots had arrived" % (self.arrived(), len(plan.paths)))
        self.fleet.signal(signal.SIGKILL)
        self.fleet.wait()
        self.sample = None
        killed = time.monotonic()
        self.start_fleet()
        self.require(self.fleet.wait_for_output("taking up again"), self.fleet.output())
        print("taken up again after %.1f s" % (time.monotonic() - killed))
        return self.send(plan)

    def arrived(self):
        robots = self.state.robots if self.state else []
        return sum(robot.state == RobotState.ARRIVED for robot in robots)

    sample = None
    looked = 0

    def look(self):
        """Every ten seconds: how much CPU and memory the node takes. @return true."""
        now = time.monotonic()
        if now - self.looked < LOOK_SEC:
            return True
        cpu, memory = cpu_and_memory(self.fleet.process.pid)
        if self.sample:
            self.shares.append(100 * (cpu - self.sample[1]) / (now - self.sample[0]))
            self.memory.append(memory)
        self.sample = (now, cpu)
        self.looked = now
        return True

    def report(self):
        print("%.0f s, %d robots at 10 Hz, %d executions, the last one with a kill and a restart" %
              (time.monotonic() - self.begun, self.options.robots, self.executions))
        if not self.shares:
            self.require(False, "too short to measure anything")
            return
        print("CPU of the node, shares of a core in %d windows of %d s: median %.1f %%, at most %.1f %%"
              % (len(self.shares), LOOK_SEC, statistics.median(self.shares), max(self.shares)))
        print("memory [MiB]: %s" % " ".join("%.0f" % value for value in self.memory[
            ::max(1, len(self.memory) // 20)]))
        # The first third brings what is made once.
        grown = max(self.memory) - max(self.memory[:len(self.memory) // 3 + 1])
        self.require(grown <= MOST_GROWTH_MIB, "memory has grown by %.0f MiB" % grown)
        self.require(statistics.median(self.shares) < 20, "the node takes 20 % of a core")


def name_in(message):
    """The first string of a raw message, and what follows it. Thousands of messages a second are too
    many to decode in python."""
    buffer = message._buff  # pylint: disable=protected-access
    (length,) = struct.unpack_from("<I", buffer, 0)
    return buffer[4:4 + length].decode(), buffer, 4 + length


class Deaths:
    """Robots that say FAULT, and all routes, with the times at which they came."""

    def __init__(self):
        self.faults = {}
        self.routes = []
        rospy.Subscriber("progress", rospy.AnyMsg, self.take_progress, queue_size=20000,
                         tcp_nodelay=True)
        rospy.Subscriber("fleet/routes", rospy.AnyMsg, self.take_route, queue_size=20000,
                         tcp_nodelay=True)

    def take_progress(self, message):
        robot, buffer, offset = name_in(message)
        (length,) = struct.unpack_from("<I", buffer, offset)
        # Behind the plan's id: sequence, fraction, status.
        if buffer[offset + 4 + length + 8] == RobotProgress.FAULT:
            self.faults.setdefault(robot, time.monotonic())

    def take_route(self, message):
        self.routes.append((time.monotonic(), message._buff))  # pylint: disable=protected-access

    def routes_between(self, begin, end):
        return [(at, RobotRoute().deserialize(buffer)) for at, buffer in list(self.routes)
                if begin < at <= end]


def is_renumbered(route):
    """Visits that were planned anew have numbers that do not follow those before."""
    numbers = [visit.sequence for visit in route.visits]
    return any(b != a + 1 for a, b in zip(numbers, numbers[1:]))


class DeathSoak(ExecuteSoak):
    policy = "replan"

    def run(self):
        self.until_planned, self.until_told, self.without_way = [], [], 0
        for execution in range(self.options.executions):
            self.die_on_the_way(execution)
        self.tell("from a FAULT to the first routes that are planned anew", self.until_planned)
        self.tell("from the call of ~remove_robot until all were sent routes again", self.until_told)
        print("%d robots had no way to their goals" % self.without_way)

    def die_on_the_way(self, execution):
        """One execution, with a node and robots of its own."""
        victims = self.draw.sample(range(self.options.robots), self.options.deaths)
        length = max(len(path.cells) for path in self.plan.paths) * self.options.step
        times = [self.draw.uniform(0.05, 0.6) * length for _ in victims]
        rospy.set_param("/fake_robots/failures",
                        ["r%d:%.2f" % death for death in zip(victims, times)])
        rospy.set_param("/fake_robots/seed", execution)
        self.start_fleet()
        deaths = Deaths()
        self.start_robots("_delay_probability:=0.0005", "_min_delay:=10", "_max_delay:=30",
                          "_delay_step:=%g" % self.options.step)
        time.sleep(2)
        self.state = None
        goal = self.send(self.plan)
        remove = rospy.ServiceProxy("fleet/remove_robot", RemoveRobot)
        removed = set()

        def goes_on():
            for robot, at in list(deaths.faults.items()):
                if robot not in removed and time.monotonic() - at > 3:
                    removed.add(robot)
                    self.measure(deaths, remove, robot, removed)
            return goal.wait_for_end(0.05)

        self.require(wait_until(goes_on, 3600), "the execution has no end")
        self.require(len(removed) == len(victims), "%d robots died" % len(removed))
        self.judge(goal.result(), removed)
        for program in (self.programs.pop(), self.programs.pop()):
            program.end()

    def measure(self, deaths, remove, robot, removed):
        died = deaths.faults[robot]
        anew = [at for at, route in deaths.routes_between(died, died + 3) if is_renumbered(route)]
        # Those of one plan come at once; later ones are improvements.
        if anew:
            self.until_planned.append(max(at for at in anew if at - anew[0] < 0.1) - died)
        called = time.monotonic()
        self.require(remove(robot).ok, "%s cannot be removed" % robot)
        others = {"r%d" % i for i in range(self.options.robots)} - removed

        def missing():
            return others - {route.robot_id for _, route in deaths.routes_between(called, 1e18)}

        if not wait_until(lambda: not missing(), 10):
            self.require(False, "%d robots have no younger route" % len(missing()))
            return
        last = {}
        for at, route in deaths.routes_between(called, 1e18):
            last.setdefault(route.robot_id, at)
        self.until_told.append(max(last[other] for other in others) - called)

    def judge(self, result, removed):
        """Who is named at the end has no way, as somebody dead stands at its goal."""
        at_fault = {fault.robot_id: fault for fault in result.faults}
        for robot, fault in at_fault.items():
            self.require(fault.code in (PlanOutcome.UNREACHABLE_GOAL, PlanOutcome.BLOCKED_CELL),
                         "%s: %s" % (robot, fault.message))
        self.without_way += len(at_fault)
        expected = self.options.robots - len(removed) - len(at_fault)
        self.require(wait_until(lambda: self.arrived() == expected, 5),
                     "%d robots arrived, not %d" % (self.arrived(), expected))
        self.executions = 1

    def tell(self, what, seconds):
        if not seconds:
            self.require(False, "nothing measured: " + what)
            return
        print("%s, %d robots, %d draws: median %.2f s, at most %.2f s" %
              (what, self.options.robots, len(seconds), statistics.median(seconds), max(seconds)))
        self.require(max(seconds) <= MOST_SEC_TO_NEW_ROUTES, "too long " + what)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mode", choices=("long", "death"), nargs="?", default="long")
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--executions", type=int, default=4, help="death: of the plan (4)")
    parser.add_argument("--deaths", type=int, default=5, help="death: in each execution (5)")
    parser.add_argument("--minutes", type=float, default=10,
                        help="long: after two fifths of them the next execution is the last one (10)")
    parser.add_argument("--size", type=int, nargs=2, default=(161, 63), metavar=("W", "H"),
                        help="of the warehouse [cells] (161 63)")
    parser.add_argument("--step", type=float, default=1.0, help="[s] (1)")
    parser.add_argument("--radius", type=float, default=0.35, help="[m] of robots (0.35)")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    soak = (ExecuteSoak if options.mode == "long" else DeathSoak)(options)
    return run_to_end(soak, soak.run)


if __name__ == "__main__":
    sys.exit(main())
