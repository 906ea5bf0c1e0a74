#!/usr/bin/env python3
"""A small fleet manager: orders of a warehouse, each a shelf and then a station, given to robots through
the action `move` of the node `fleet`. warehouse_manager.cpp does the same in C++.

It draws the warehouse, publishes it as `map`, says on `plan` where robots without hardware begin, and
learns from `progress` which robots there are and where.

parameters: ~robots (200) placed at the begin; 0: real ones; ~columns (8), ~rows (16) of shelves;
~orders (0: no end) after which it stops; ~seed (0); ~report (5) seconds between lines
"""

import collections
import random
import sys

import actionlib
import rospy
from actionlib import CommState
from geometry_msgs.msg import Point, PoseStamped
from nav_msgs.msg import OccupancyGrid
from visualization_msgs.msg import Marker, MarkerArray

from split_mapf.msg import (MoveRobotsAction, MoveRobotsGoal, MultiRobotPlan, PlanOutcome, RobotPath,
                            RobotProgress, RobotTask)

FRAME = "map"
CELL = 1.0  # [m]
REST = 5.0  # [s] that a robot is left alone whose move failed
SILENCE = 2.0  # [s] after which a robot is given no order
TICK = 0.1  # [s]

OUTCOMES = {value: name for name, value in vars(PlanOutcome).items()
            if name.isupper() and isinstance(value, int)}


class Warehouse:
    """Blocks of shelves of 10 x 2 cells between aisles one cell wide; stations at the left edge."""

    def __init__(self, columns, rows):
        self.width, self.height = 11 * columns + 6, 3 * rows + 3
        self.blocked = {(4 + 11 * column + x, 2 + 3 * row + y)
                        for column in range(columns) for row in range(rows)
                        for x in range(10) for y in range(2)}
        self.free = [(x, y) for y in range(self.height) for x in range(self.width)
                     if (x, y) not in self.blocked]
        self.stations = [(1, y) for y in range(1, self.height - 1, 2)]
        # A robot picks from the cell in front of a shelf.
        self.picks = [(x, y) for x, y in self.free
                      if (x, y - 1) in self.blocked or (x, y + 1) in self.blocked]

    def as_map(self):
        message = OccupancyGrid()
        message.header.frame_id = FRAME
        message.info.resolution = CELL
        message.info.width, message.info.height = self.width, self.height
        message.info.origin.orientation.w = 1
        message.data = [100 if (x, y) in self.blocked else 0
                        for y in range(self.height) for x in range(self.width)]
        return message

    def starts_of(self, robots):
        """A plan in which every robot stands where it begins, all over the warehouse."""
        if robots > len(self.free) // 3:
            raise ValueError("~robots is %d; a warehouse of %d free cells has room for %d: raise "
                             "~columns or ~rows" % (robots, len(self.free), len(self.free) // 3))
        plan = MultiRobotPlan()
        plan.header.frame_id = FRAME
        plan.grid = self.as_map().info
        plan.step_duration = 1
        for i in range(robots):
            x, y = self.free[i * len(self.free) // robots]
            plan.paths.append(RobotPath(robot_id="r%d" % i, cells=[y * self.width + x]))
        return plan


def cell_at(position):
    return int(position.x // CELL), int(position.y // CELL)


def point_in(cell, height=0.0):
    return Point((cell[0] + 0.5) * CELL, (cell[1] + 0.5) * CELL, height)


class Order:
    """To the shelf first, then to the station."""

    def __init__(self, pick, station):
        self.legs = [pick, station]


class Robot:
    def __init__(self):
        self.cell = None
        self.heard = 0.0
        self.is_well = False
        self.order = None
        self.goal = None  # handle of the move under way; actionlib forgets goals without one
        self.rests_until = 0.0


class Manager:
    def __init__(self):
        self.warehouse = Warehouse(rospy.get_param("~columns", 8), rospy.get_param("~rows", 16))
        self.chance = random.Random(rospy.get_param("~seed", 0))
        self.most_orders = rospy.get_param("~orders", 0)
        self.robots = collections.defaultdict(Robot)
        self.waiting = collections.deque()
        self.ended = collections.deque()  # moves, as they end: (robot, handle)
        self.given = self.done = self.failed = 0
        self.times = collections.deque()  # of the orders done in the last minute
        self.begin = rospy.get_time()
        self.map = rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True)
        self.plan = rospy.Publisher("plan", MultiRobotPlan, queue_size=1, latch=True)
        self.markers = rospy.Publisher("~markers", MarkerArray, queue_size=1, latch=True)
        self.map.publish(self.warehouse.as_map())
        robots = rospy.get_param("~robots", 200)
        if robots > 0:
            self.plan.publish(self.warehouse.starts_of(robots))
        self.moves = actionlib.ActionClient("fleet/move", MoveRobotsAction)
        rospy.Subscriber("progress", RobotProgress, self.hear, queue_size=1000)

    def hear(self, progress):
        robot = self.robots[progress.robot_id]
        robot.cell = cell_at(progress.pose.pose.position)
        robot.heard = rospy.get_time()
        robot.is_well = progress.status == RobotProgress.OK

    def run(self):
        rospy.loginfo("%d stations, %d places to pick from; waiting for fleet/move",
                      len(self.warehouse.stations), len(self.warehouse.picks))
        self.moves.wait_for_server()
        self.begin = rospy.get_time()
        next_report = self.begin
        while not rospy.is_shutdown() and not 0 < self.most_orders <= self.done:
            self.take_ends()
            self.take_orders()
            self.give_orders()
            if rospy.get_time() >= next_report:
                next_report = rospy.get_time() + rospy.get_param("~report", 5.0)
                self.report()
            rospy.sleep(TICK)
        self.report()

    def take_orders(self):
        """As many come in as there are robots, so that none is idle."""
        open_orders = self.given - self.done
        limit = len(self.robots)
        if self.most_orders:
            limit = min(limit, open_orders + self.most_orders - self.given)
        for _ in range(limit - open_orders):
            self.waiting.append(Order(self.chance.choice(self.warehouse.picks),
                                      self.chance.choice(self.warehouse.stations)))
            self.given += 1

    def give_orders(self):
        """Each order to the nearest robot that is free."""
        now = rospy.get_time()
        free = {name: robot.cell for name, robot in list(self.robots.items())
                if not robot.order and robot.is_well and now >= robot.rests_until
                and now - robot.heard < SILENCE}
        while self.waiting and free:
            order = self.waiting.popleft()
            x, y = order.legs[0]
            name = min(free, key=lambda name: abs(free[name][0] - x) + abs(free[name][1] - y))
            del free[name]
            self.robots[name].order = order
            self.send(name)

    def send(self, name):
        robot = self.robots[name]
        task = RobotTask(robot_id=name)  # an empty start: where it is
        task.goal = PoseStamped()
        task.goal.header.frame_id = FRAME
        task.goal.pose.position = point_in(robot.order.legs[0])

        def note(handle):
            if handle.get_comm_state() == CommState.DONE:
                self.ended.append((name, handle))

        robot.goal = self.moves.send_goal(MoveRobotsGoal(robots=[task]), transition_cb=note)

    def take_ends(self):
        while self.ended:
            name, handle = self.ended.popleft()
            robot = self.robots[name]
            result = handle.get_result()
            if result is not None and result.outcome == PlanOutcome.SUCCEEDED:
                robot.order.legs.pop(0)
                if robot.order.legs:
                    self.send(name)
                    continue
                self.done += 1
                self.times.append(rospy.get_time())
            else:
                # Somebody else brings the order to its end.
                why = "no answer" if result is None else "%s: %s" % (
                    OUTCOMES.get(result.outcome, result.outcome), result.message)
                rospy.logwarn("robot %s did not get to %s: %s", name, robot.order.legs[0], why)
                self.failed += 1
                self.waiting.appendleft(robot.order)
                robot.rests_until = rospy.get_time() + REST
            robot.order = robot.goal = None

    def report(self):
        now = rospy.get_time()
        while self.times and self.times[0] < now - 60:
            self.times.popleft()
        span = max(1.0, min(60.0, now - self.begin))
        busy = [robot for robot in list(self.robots.values()) if robot.order]
        print("%5.0f s: %5d orders done, %5.1f a minute; %d of %d robots busy, %d orders wait, "
              "%d moves failed" % (now - self.begin, self.done, 60 * len(self.times) / span,
                                   len(busy), len(self.robots), len(self.waiting), self.failed),
              flush=True)
        self.markers.publish(MarkerArray(markers=[
            self.marker("stations", (0.1, 0.7, 0.2), map(point_in, self.warehouse.stations)),
            self.marker("picks", (0.9, 0.5, 0.1), [point_in(robot.order.legs[0]) for robot in busy
                                                   if len(robot.order.legs) == 2])]))

    @staticmethod
    def marker(space, colour, points):
        marker = Marker(ns=space, type=Marker.CUBE_LIST, points=list(points))
        marker.header.frame_id = FRAME
        marker.pose.orientation.w = 1
        marker.scale.x = marker.scale.y = 0.9 * CELL
        marker.scale.z = 0.02
        marker.color.r, marker.color.g, marker.color.b = colour
        marker.color.a = 0.8
        return marker


def main():
    rospy.init_node("warehouse_manager")
    try:
        Manager().run()
    except rospy.ROSInterruptException:
        pass
    except ValueError as error:
        print("warehouse_manager: %s" % error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
