"""What rostests of a fleet have in common: a plan on a map, the executor, states, goals."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import actionlib
import rosbag
import roslib.packages
import rospy
from nav_msgs.msg import OccupancyGrid

from ros_processes import Recorder, SentGoal, start_program
from split_mapf.msg import (ExecutePlanAction, ExecutePlanGoal, FleetState, MultiRobotPlan,
                            RobotPath, RobotProgress)


def command():
    return roslib.packages.find_node("split_mapf", "split_mapf")[0]


def run(*arguments):
    subprocess.run((command(),) + arguments, check=True, stdout=subprocess.DEVNULL)


def make_plan(directory, robots, width, height, step):
    """A warehouse as a map message, and a plan for robots r0, r1, ... on it."""
    files = {name: os.path.join(directory, "fleet." + name) for name in ("map", "scen", "plan")}
    instance = ("--map", files["map"], "--scen", files["scen"])
    run("generate", "--type", "warehouse", "--width", str(width), "--height", str(height),
        "--agents", str(robots), "--seed", "1", "--output-map", files["map"], "--output-scen",
        files["scen"])
    run("plan", *instance, "--objective", "sum_of_costs", "--output", files["plan"])
    with open(files["map"], encoding="ascii") as file:
        rows = file.read().split("\nmap\n", 1)[1].split()
    with open(files["plan"], encoding="ascii") as file:
        found = json.load(file)
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    grid.info.width, grid.info.height, grid.info.resolution = len(rows[0]), len(rows), 1.0
    grid.info.origin.orientation.w = 1.0
    grid.data = [0 if cell == "." else 100 for row in reversed(rows) for cell in row]
    plan = MultiRobotPlan(grid=grid.info, step_duration=step, makespan=found["makespan"],
                          sum_of_costs=found["sum_of_costs"], objective="sum_of_costs")
    plan.header.frame_id = "map"
    for index, path in enumerate(found["paths"]):
        plan.paths.append(RobotPath(robot_id="r%d" % index, cells=[
            (len(rows) - 1 - y) * len(rows[0]) + x for x, y in path]))
    return grid, plan


class FleetCase(unittest.TestCase):
    """One plan for all tests of a class; an executor of its own for each."""
    NAME = "fleet_rostest"
    ROBOTS = 24
    SIZE = (28, 16)
    STEP = 0.15
    # Twice the radius of the largest robot that fits into the cells.
    APART = 0.70

    @classmethod
    def setUpClass(cls):
        rospy.init_node(cls.NAME)
        cls.directory = tempfile.TemporaryDirectory()
        cls.map_message, cls.plan = make_plan(cls.directory.name, cls.ROBOTS, *cls.SIZE, cls.STEP)
        cls.map_topic = rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True)
        cls.map_topic.publish(cls.map_message)
        cls.plan_topic = rospy.Publisher("plan", MultiRobotPlan, queue_size=1, latch=True)
        cls.plan_topic.publish(cls.plan)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def setUp(self):
        self.file = os.path.join(self.directory.name, "execution.json")
        if os.path.exists(self.file):
            os.remove(self.file)
        for name in ("/fleet", "/fake_robots"):
            if rospy.has_param(name):
                rospy.delete_param(name)
        self.progress = Recorder("progress", RobotProgress)
        self.addCleanup(self.progress.close)
        self.states = Recorder("fleet/state", FleetState)
        self.addCleanup(self.states.close)

    def start_fleet(self, patience=5.0, *arguments):
        fleet = start_program("executor_node", "_execution_file:=" + self.file,
                              "_replan_period:=1.0", "_threads:=1",
                              "_progress_timeout:=%g" % patience, *arguments)
        self.addCleanup(fleet.end)
        self.assertTrue(fleet.wait_for_output("ready:"), fleet.output())
        return fleet

    def send(self, plan=None):
        client = actionlib.ActionClient("fleet/execute", ExecutePlanAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(30)))
        return SentGoal(client, ExecutePlanGoal(plan=plan or self.plan))

    def latest(self):
        return self.states.messages[-1].robots if self.states.messages else []

    def count(self, state):
        return sum(robot.state == state for robot in self.latest())

    def start_robots(self, failures=(), speed=None):
        rospy.set_param("/fake_robots/failures", list(failures))
        robots = start_program("fake_robots_node", "routes:=fleet/routes",
                               "_speed:=%g" % (speed or 1 / self.STEP), "_rate:=20",
                               "_delay_probability:=0.01", "_min_delay:=3", "_max_delay:=8",
                               "_delay_step:=%g" % self.STEP)
        self.addCleanup(robots.end)
        return robots

    def assert_kept_apart(self):
        path = os.path.join(self.directory.name, self.id().rsplit(".", 1)[-1] + ".bag")
        with rosbag.Bag(path, "w") as bag:
            for message in self.progress.messages:
                bag.write("/progress", message, message.pose.header.stamp)
        script = roslib.packages.find_node("split_mapf", "check_distances.py")[0]
        check = subprocess.run([sys.executable, script, path, "--distance", str(self.APART)],
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        self.assertEqual(check.returncode, 0, check.stdout)
