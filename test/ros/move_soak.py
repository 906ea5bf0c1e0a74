#!/usr/bin/env python3
"""Measures the action ~move with robots without hardware, on a ROS master of its own. Not part of the
tests that run each time: it takes minutes, and its figures depend on the machine.

  move_soak.py burst   1,000 goals of 20 clients, preempted and cancelled at random, while half of the
                       robots are busy: every goal has to end once. Then new goals for idle robots: how
                       long until each robot moves. Then 10,000 goals at once.
  move_soak.py hour    robots always have goals; some are late, some die, aisles are blocked, the node is
                       killed and starts again. Every goal ends, or was lost with the node; places are
                       checked from a bag. Goals a step are compared with those of `split_mapf roll`
                       on the same map, with the same delays.

exit codes: 0 all is well, 1 something is not (see the last lines)
"""

import argparse
import contextlib
import json
import os
import random
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

# First: it chooses the master's port.
from soak_run import OUTCOMES, SoakRun, cpu_and_memory, run_to_end  # noqa: E402
import roslib.packages  # noqa: E402
import rospy  # noqa: E402
from nav_msgs.msg import OccupancyGrid  # noqa: E402

from fleet_case import command, make_plan  # noqa: E402
from move_clients import PlainClient, free_cells, goal_of, task  # noqa: E402
from ros_processes import Program, start_program, wait_until  # noqa: E402
from split_mapf.msg import FleetState, MultiRobotPlan, PlanOutcome, RobotPath  # noqa: E402
from split_mapf.srv import BlockCells  # noqa: E402

# How robots are late: the chance of one that is not, a step, and for how long [steps].
DELAY_PROBABILITY, DELAYS = 0.0005, (10, 30)
LEAST_SHARE_OF_ROLL = 0.85


class Movements:
    """When robots began to move, from raw messages: 500 robots are too many to decode in python."""

    def __init__(self):
        self.awaited = {}
        self.begun = {}
        self.subscriber = rospy.Subscriber("progress", rospy.AnyMsg, self.take, queue_size=20000,
                                           tcp_nodelay=True)

    def take(self, message):
        buffer = message._buff  # pylint: disable=protected-access
        (length,) = struct.unpack_from("<I", buffer, 0)
        robot = buffer[4:4 + length].decode()
        if robot not in self.awaited:
            return
        offset = 4 + length
        (length,) = struct.unpack_from("<I", buffer, offset)
        sequence, fraction = struct.unpack_from("<If", buffer, offset + 4 + length)
        first = self.awaited[robot]
        if first is None:
            self.awaited[robot] = (sequence, fraction)
        elif first != (sequence, fraction):
            self.begun[robot] = time.monotonic()
            del self.awaited[robot]


class Soak(SoakRun):
    def __init__(self, arguments):
        super().__init__("move_soak")
        self.options = arguments
        self.draw = random.Random(arguments.seed)
        self.directory = tempfile.TemporaryDirectory()
        width, height = arguments.size
        self.grid, _ = make_plan(self.directory.name, 2, width, height, arguments.step)
        self.cells = free_cells(self.grid)
        self.publish_starts()
        self.state = None
        rospy.Subscriber("fleet/state", FleetState, self.take_state)

    def take_state(self, message):
        self.state = message

    def publish_starts(self):
        free = [index for index, value in enumerate(self.grid.data) if value == 0]
        starts = self.draw.sample(free, self.options.robots)
        plan = MultiRobotPlan(grid=self.grid.info, step_duration=self.options.step)
        plan.header.frame_id = "map"
        plan.paths = [RobotPath(robot_id="r%d" % i, cells=[cell]) for i, cell in enumerate(starts)]
        self.topics = [rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True),
                       rospy.Publisher("plan", MultiRobotPlan, queue_size=1, latch=True)]
        self.topics[0].publish(self.grid)
        self.topics[1].publish(plan)

    def start_fleet(self):
        self.fleet = self.start(start_program(
            "executor_node", "_execution_file:=" + os.path.join(self.directory.name, "kept.json"),
            "_step_duration:=%g" % self.options.step, "_threads:=1", "_release_ahead:=3",
            "_robot_radius:=%g" % self.options.radius))
        if not self.fleet.wait_for_output("ready:"):
            raise RuntimeError(self.fleet.output())

    def start_robots(self, *arguments):
        self.start(start_program(
            "fake_robots_node", "routes:=fleet/routes", "_speed:=%g" % (1 / self.options.step),
            "_rate:=10", "_publish_tf:=false", *arguments))

    @contextlib.contextmanager
    def recording(self, bag):
        """All that robots report meanwhile is in the bag."""
        record = os.path.join(os.path.dirname(os.path.abspath(__file__)), "record_progress.py")
        recorder = self.start(Program(sys.executable, record, bag))
        yield
        recorder.signal(signal.SIGINT)
        self.require(recorder.wait(600) == 0, "the bag was not closed")

    def connect(self):
        clients = [PlainClient("client_%d" % i) for i in range(self.options.clients)]
        wait_until(lambda: all(client.is_connected() for client in clients))
        return clients

    def random_task(self, robot):
        return goal_of(task(robot, *self.draw.choice(self.cells)))

    def outcomes(self, clients):
        counts = {}
        for client in clients:
            for ends in client.ends.values():
                name = OUTCOMES[ends[0].result.outcome]
                counts[name] = counts.get(name, 0) + 1
                self.require(len(ends) == 1, "a goal ended %d times" % len(ends))
        return counts

    # --- burst ---

    def burst(self):
        self.start_fleet()
        self.start_robots()
        clients = self.connect()
        time.sleep(2)
        busy = self.options.robots // 2
        begun = time.monotonic()
        for number in range(self.options.goals):
            client = clients[number % len(clients)]
            goal = client.send(self.random_task("r%d" % self.draw.randrange(busy)))
            if self.draw.random() < 0.2:
                client.cancel(goal)
            time.sleep(0.01)
        print("%d goals sent in %.1f s" % (self.options.goals, time.monotonic() - begun))
        self.measure_reaction(clients[0], range(busy, self.options.robots))
        wait_until(lambda: not any(client.open() for client in clients), 300)
        left = sum(len(client.open()) for client in clients)
        self.require(left == 0, "%d goals have no end" % left)
        print("ends: %s" % self.outcomes(clients))
        self.flood(clients)

    def measure_reaction(self, client, idle):
        """Of idle robots, while others drive."""
        watch = Movements()
        waits = []
        for number in self.draw.sample(list(idle), min(100, len(idle))):
            robot = "r%d" % number
            watch.awaited[robot] = None
            wait_until(lambda: watch.awaited.get(robot) is not None, 5)
            sent = time.monotonic()
            client.send(self.random_task(robot))
            if wait_until(lambda: robot in watch.begun, 10):
                waits.append(watch.begun[robot] - sent)
        waits.sort()
        print("a new goal moves its robot, %d robots, %d of them measured: median %.0f ms, 90 %% "
              "%.0f ms, at most %.0f ms" %
              (self.options.robots, len(waits), 1e3 * statistics.median(waits),
               1e3 * waits[len(waits) * 9 // 10], 1e3 * waits[-1]))
        self.require(statistics.median(waits) <= 0.3, "robots move too late")

    def flood(self, clients):
        before, _ = cpu_and_memory(self.fleet.process.pid)
        begun = time.monotonic()
        for number in range(self.options.flood):
            clients[number % len(clients)].send(self.random_task(""))
        time.sleep(5)
        self.require(self.fleet.process.poll() is None, "the node is down")
        waiting = self.state.waiting if self.state else 0
        for client in clients:
            for goal in client.open():
                client.cancel(goal)
        wait_until(lambda: not any(client.open() for client in clients), 120)
        left = sum(len(client.open()) for client in clients)
        self.require(left == 0, "%d goals of the flood have no end" % left)
        after, memory = cpu_and_memory(self.fleet.process.pid)
        print("%d goals at once: %d wait after 5 s; all cancelled after %.1f s; %.1f s of CPU, "
              "%.0f MiB; all ends: %s" %
              (self.options.flood, waiting, time.monotonic() - begun, after - before, memory,
               self.outcomes(clients)))

    # --- hour ---

    def hour(self):
        deaths = ["r%d:%d" % (robot, self.draw.uniform(0.1, 0.9) * 60 * self.options.minutes)
                  for robot in self.draw.sample(range(self.options.robots), self.options.deaths)]
        rospy.set_param("/fake_robots/failures", deaths)
        self.start_fleet()
        self.start_robots("_delay_probability:=%g" % DELAY_PROBABILITY, "_min_delay:=%d" % DELAYS[0],
                          "_max_delay:=%d" % DELAYS[1], "_delay_step:=%g" % self.options.step)
        bag = self.options.bag or os.path.join(self.directory.name, "run.bag")
        with self.recording(bag):
            clients = self.connect()
            self.conduct(clients)
        wait_until(lambda: not any(client.open() for client in clients), 5)
        self.check(bag)

    def conduct(self, clients):
        begun = time.monotonic()
        end = begun + 60 * self.options.minutes
        current, lost, blocked, events = {}, 0, [], 0
        next_event, next_look = begun + 20, begun + 10
        restarts = [begun + 60 * self.options.minutes * (i + 1) / (self.options.restarts + 1)
                    for i in range(self.options.restarts)]
        memory = []
        while time.monotonic() < end:
            now = time.monotonic()
            for number in range(self.options.robots):
                client = clients[number % len(clients)]
                goal = current.get(number)
                if goal is not None and goal not in client.ends:
                    continue
                if goal is not None and client.ends[goal][0].result.outcome in (
                        PlanOutcome.ROBOT_BLOCKED, PlanOutcome.ROBOT_LOST,
                        PlanOutcome.UNKNOWN_ROBOT) and now - client.sent[goal] < 5:
                    continue
                current[number] = client.send(self.random_task("r%d" % number))
            if now > next_event:
                events += 1
                blocked = self.block_aisle(blocked)
                next_event = now + 20
            if now > next_look:
                cpu, resident = cpu_and_memory(self.fleet.process.pid)
                memory.append(resident)
                next_look = now + 10
            if restarts and now > restarts[0]:
                restarts.pop(0)
                lost += self.restart(clients, current)
            time.sleep(0.05)
        self.report(clients, lost, events, memory, time.monotonic() - begun)

    def block_aisle(self, blocked):
        service = rospy.ServiceProxy("fleet/block_cells", BlockCells)
        try:
            if blocked:
                service(blocked, False)
                return []
            info = self.grid.info
            x, y = self.draw.choice(self.cells)
            first = int(y) * info.width + int(x)
            cells = [first + i for i in range(3) if first + i < len(self.grid.data)]
            service(cells, True)
            return cells
        except rospy.ServiceException as error:
            print("block_cells: %s" % error)
            return blocked

    def restart(self, clients, current):
        self.fleet.signal(signal.SIGKILL)
        self.fleet.wait()
        lost = 0
        for client in clients:
            for goal in client.open():
                del client.sent[goal]
                lost += 1
        current.clear()
        self.start_fleet()
        wait_until(lambda: all(client.is_connected() for client in clients))
        time.sleep(1)
        return lost

    def report(self, clients, lost, events, memory, seconds):
        ends = self.outcomes(clients)
        sent = sum(client.count for client in clients)
        arrived = ends.get("SUCCEEDED", 0)
        print("%.0f s, %d robots, %d died, %d times an aisle was blocked or opened, %d restarts" %
              (seconds, self.options.robots, self.options.deaths, events, self.options.restarts))
        print("%d goals: %s, lost with the node %d, open %d" %
              (sent, ends, lost, sum(len(client.open()) for client in clients)))
        self.compare(arrived * self.options.step / seconds)
        cpu, _ = cpu_and_memory(self.fleet.process.pid)
        print("memory [MiB]: %s; CPU of the last node %.1f s" %
              (" ".join("%.0f" % value for value in memory[::max(1, len(memory) // 12)]), cpu))
        self.require(arrived > 0, "nobody arrived")

    def compare(self, throughput):
        """With what `roll` reaches where nobody dies and no aisle is blocked; a client that gives one
        goal after the other is known_goals = 1."""
        result = os.path.join(self.directory.name, "roll.json")
        subprocess.run([command(), "roll", "--map", os.path.join(self.directory.name, "fleet.map"),
                        "--agents", str(self.options.robots), "--known-goals", "1",
                        "--delay-probability", str(DELAY_PROBABILITY), "--min-delay",
                        str(DELAYS[0]), "--max-delay", str(DELAYS[1]), "--seed",
                        str(self.options.seed), "--output", result, "--quiet"], check=True)
        with open(result, encoding="ascii") as file:
            rolled = json.load(file)["throughput"]
        share = throughput / rolled
        print("goals a step: %.2f, %.0f %% of the %.2f of roll" % (throughput, 100 * share, rolled))
        self.require(share >= LEAST_SHARE_OF_ROLL, "fewer goals a step than roll reaches")

    def check(self, bag):
        script = roslib.packages.find_node("split_mapf", "check_distances.py")[0]
        least = 2 * self.options.radius if self.options.radius > 0 else 0.7
        found = subprocess.run([sys.executable, script, bag, "--distance", "%g" % least],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        print(found.stdout.decode().strip())
        self.require(found.returncode == 0, "robots came too close")

    def end(self):
        super().end()
        self.directory.cleanup()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mode", choices=("burst", "hour"))
    parser.add_argument("--robots", type=int, default=500)
    parser.add_argument("--clients", type=int, default=20)
    parser.add_argument("--goals", type=int, default=1000, help="burst: goals (1000)")
    parser.add_argument("--flood", type=int, default=10000, help="burst: goals at once (10000)")
    parser.add_argument("--minutes", type=float, default=60, help="hour: length (60)")
    parser.add_argument("--deaths", type=int, default=10, help="hour: robots that fail (10)")
    parser.add_argument("--restarts", type=int, default=3, help="hour: kills of the node (3)")
    parser.add_argument("--size", type=int, nargs=2, default=(161, 63), metavar=("W", "H"),
                        help="of the warehouse [cells] (161 63)")
    parser.add_argument("--step", type=float, default=1.0, help="[s] (1)")
    parser.add_argument("--radius", type=float, default=0.25, help="[m] of robots (0.25)")
    parser.add_argument("--bag", help="hour: where to keep the bag (it is thrown away)")
    parser.add_argument("--seed", type=int, default=1)
    soak = Soak(parser.parse_args())
    return run_to_end(soak, getattr(soak, soak.options.mode))


if __name__ == "__main__":
    sys.exit(main())
