#!/usr/bin/env python3
"""Fleets of robots that know nothing of routes: vehicles that speak VDA 5050 over a broker that is
killed on the way, and robots that run move_base."""

import getpass
import importlib.util
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import unittest

import roslib.packages
import rospy
import rosunit
from diagnostic_msgs.msg import DiagnosticArray
from std_srvs.srv import SetBool

from fleet_case import FleetCase
from ros_processes import Program, Recorder, start_program, wait_until
from split_mapf.msg import (MultiRobotPlan, PlanOutcome, RobotProgress, RobotRoute, RobotState,
                            RouteVisit)

try:
    import paho.mqtt.publish
except ImportError:
    paho = None

PATIENCE = 90
DRIVEN = 4  # robots with a driver each
FOLDER = os.path.dirname(os.path.abspath(__file__))
BRIDGE = roslib.packages.find_node("split_mapf", "vda5050_bridge_node")
MOSQUITTO = shutil.which("mosquitto", path=os.environ["PATH"] + ":/usr/sbin")


def load_driver():
    path = os.path.join(FOLDER, "..", "..", "scripts", "route_driver.py")
    spec = importlib.util.spec_from_file_location("route_driver", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def make_route(places, released, plan_id="p", numbers=None):
    route = RobotRoute(plan_id=plan_id)
    for index, (x, y) in enumerate(places):
        visit = RouteVisit(sequence=numbers[index] if numbers else index,
                           released=index <= released)
        visit.pose.position.x, visit.pose.position.y = x, y
        route.visits.append(visit)
    return route


class Run(unittest.TestCase):
    """What the driver makes of a route, without tf and move_base."""
    LINE = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2)]

    def setUp(self):
        self.run_ = load_driver().RouteRun(0.1)

    def test_visits_in_one_line_are_one_goal(self):
        self.run_.take(make_route(self.LINE, 0))
        self.assertEqual(self.run_.target(), 0)
        self.run_.take(make_route(self.LINE, 1))
        self.assertEqual(self.run_.target(), 1)
        self.run_.take(make_route(self.LINE, 4))
        self.assertEqual(self.run_.target(), 2)  # there it turns
        self.run_.reach(2)
        self.assertEqual(self.run_.target(), 2)

    def test_knows_where_it_is_and_never_goes_back(self):
        self.run_.take(make_route(self.LINE, 2))
        for x, y, sequence, fraction in ((0.05, 0, 0, 0), (0.5, 0.02, 0, 0.5), (0.4, 0, 0, 0.5),
                                         (0.95, 0, 1, 0), (1.25, 0, 1, 0.25), (2.0, 0.01, 2, 0),
                                         (2.0, 0.5, 2, 0)):  # nobody lets it go there
            self.run_.locate(x, y)
            self.assertEqual((self.run_.sequence, self.run_.fraction), (sequence, fraction), (x, y))

    def test_beside_a_visit_is_not_at_it(self):
        self.run_.take(make_route(self.LINE, 2))
        self.run_.locate(0.95, 0.4)
        self.assertEqual(self.run_.sequence, 0)

    def test_what_was_given_up_is_not_gone_to_but_the_move_that_was_begun(self):
        self.run_.take(make_route(self.LINE, 2))
        self.run_.locate(0.5, 0)
        self.run_.give_up()
        self.assertEqual(self.run_.target(), 1)
        self.assertFalse(self.run_.has_new_way())
        self.run_.take(make_route([(0, 0), (1, 0), (1, 1)], 2, numbers=[0, 1, 9]))
        self.assertTrue(self.run_.has_new_way())
        # A late route that leads elsewhere from where it is under way is left out.
        self.run_.take(make_route([(0, 0), (0, 1)], 1, numbers=[0, 12]))
        self.assertEqual(self.run_.visits[1].sequence, 1)

    def test_another_plan_begins_at_its_first_visit(self):
        self.run_.take(make_route(self.LINE, 2))
        self.run_.reach(2)
        self.run_.take(make_route([(2, 0), (3, 0)], 1, "q", [5, 6]))
        self.assertEqual((self.run_.plan_id, self.run_.sequence), ("q", 5))
        self.run_.take(make_route([(0, 0)], 0, "q", [2]))  # not where it is
        self.assertEqual(self.run_.sequence, 5)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Robots(FleetCase):
    NAME = "robots_rostest"
    ROBOTS = 10
    SIZE = (24, 10)
    STEP = 0.25

    def path_of(self, name):
        return next(path.cells for path in self.plan.paths if path.robot_id == name)

    def path(self, name):
        return os.path.join(self.directory.name, name)

    def start_broker(self):
        broker = Program(MOSQUITTO, "-c", self.path("broker.conf"))
        self.addCleanup(broker.end)
        return broker

    def write_broker(self):
        """A broker that asks for a name and a password. @return its port."""
        port = free_port()
        subprocess.run(("mosquitto_passwd", "-b", "-c", self.path("passwords"), "fleet", "secret"),
                       check=True)
        with open(self.path("broker.conf"), "w", encoding="ascii") as file:
            file.write("listener %d 127.0.0.1\nallow_anonymous false\npassword_file %s\nuser %s\n" %
                       (port, self.path("passwords"), getpass.getuser()))
        return port

    def write_starts(self, names, prefix=""):
        width = self.map_message.info.width
        starts = {prefix + name: [self.path_of(name)[0] % width + 0.5,
                                  self.path_of(name)[0] // width + 0.5] for name in names}
        with open(self.path("starts.json"), "w", encoding="ascii") as file:
            json.dump(starts, file)
        return self.path("starts.json")

    def start_bridge(self, port):
        rospy.set_param("/vda5050_bridge/robots", ["%s=agv-%s" % (path.robot_id, path.robot_id)
                                                   for path in self.plan.paths])
        bridge = start_program(
            "vda5050_bridge_node", "routes:=fleet/routes", "_port:=%d" % port, "_user:=fleet",
            "_password:=secret", "_manufacturer:=ACME", "_resend_time:=0.5")
        self.addCleanup(bridge.end)
        return bridge

    def levels(self, name):
        return [status.level for message in self.diagnostics.messages for status in message.status
                if status.name.endswith(name)]

    @unittest.skipUnless(BRIDGE and MOSQUITTO and paho, "a part of MQTT is missing")
    def test_vda5050_vehicles_arrive_though_the_broker_is_killed(self):
        self.diagnostics = Recorder("/diagnostics", DiagnosticArray)
        self.addCleanup(self.diagnostics.close)
        port = self.write_broker()
        victim = max(self.plan.paths, key=lambda path: len(path.cells)).robot_id
        fleet = self.start_fleet(20, "_release_ahead:=4")
        bridge = self.start_bridge(port)
        bridges = [bridge]
        # It is there before the broker is.
        self.assertTrue(bridge.wait_for_output("cannot be reached"), bridge.output())
        broker = self.start_broker()
        vehicles = Program(
            sys.executable, os.path.join(FOLDER, "vda5050_vehicles.py"), "--port", str(port),
            "--user", "fleet", "--password", "secret", "--starts",
            self.write_starts([path.robot_id for path in self.plan.paths], "agv-"), "--speed",
            "%g" % (1 / self.STEP), "--blocked", "agv-" + victim)
        self.addCleanup(vehicles.end)
        self.assertTrue(wait_until(lambda: len({message.robot_id for message in
                                                self.progress.messages}) == self.ROBOTS),
                        bridge.output() + vehicles.output())
        goal = self.send()

        def told():
            return "".join(program.output() for program in [fleet, vehicles] + bridges)
        paho.mqtt.publish.single("uagv/v2/ACME/agv-r0/state", '{"orderId": 3}', port=port,
                                 auth={"username": "fleet", "password": "secret"})
        self.assertTrue(bridge.wait_for_output("'orderId' is '3'; a text is expected"), told())
        self.assertTrue(wait_until(lambda: self.count(RobotState.ARRIVED) >= 2, PATIENCE), told())
        self.assertLess(self.count(RobotState.ARRIVED), self.ROBOTS)
        broker.signal(signal.SIGKILL)
        broker.wait()
        self.assertTrue(bridge.wait_for_output("is away"), told())
        self.assertTrue(wait_until(lambda: self.levels("vda5050")[-1:] == [2]), told())
        self.start_broker()
        # The bridge dies as well: another one goes on with the orders that are under way.
        self.assertTrue(wait_until(lambda: bridge.output().count("connected to") == 2), told())
        bridge.signal(signal.SIGKILL)
        bridge.wait()
        bridges.append(self.start_bridge(port))
        self.assertTrue(goal.wait_for_end(PATIENCE), told())
        self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED,
                         goal.result().message + told())
        self.assertEqual(self.count(RobotState.ARRIVED), self.ROBOTS)
        self.assertIn((victim, RobotProgress.BLOCKED),
                      {(message.robot_id, message.status) for message in self.progress.messages})
        for word in ("refused", "too close", "Traceback"):
            self.assertNotIn(word, told())
        self.assertIn(0, self.levels("vda5050"))

    def start_drivers(self, robots):
        """A driver for each robot. Python takes its time to begin."""
        drivers = [start_program("route_driver.py", "__name:=driver_" + robot, "_robot:=" + robot,
                                 "_tolerance:=0.1", "_rate:=20") for robot in robots]
        for driver in drivers:
            self.addCleanup(driver.end)
        return drivers

    def pause(self, robot, paused):
        name = "driver_%s/pause" % robot
        rospy.wait_for_service(name, 30)
        self.assertTrue(rospy.ServiceProxy(name, SetBool)(paused).success)

    def said(self, robot, status):
        return any(message.robot_id == robot and message.status == status
                   for message in self.progress.messages)

    def test_robots_with_move_base_arrive_though_one_gives_up(self):
        names = [path.robot_id for path in self.plan.paths[:DRIVEN]]
        plan = MultiRobotPlan(header=self.plan.header, grid=self.plan.grid, step_duration=self.STEP)
        plan.paths = self.plan.paths[:DRIVEN]
        moves = [len(path.cells) - 1 for path in plan.paths]
        plan.makespan, plan.sum_of_costs = max(moves), sum(moves)
        victim, other = sorted(names, key=lambda name: -len(self.path_of(name)))[:2]
        bodies = Program(
            sys.executable, os.path.join(FOLDER, "fake_move_base.py"), "--starts",
            self.write_starts(names), "--speed", "%g" % (1 / self.STEP), "--gives-up", victim)
        self.addCleanup(bodies.end)
        drivers = self.start_drivers(names)
        fleet = self.start_fleet(20, "_release_ahead:=4")

        def told():
            return "".join(program.output() for program in [fleet, bodies] + drivers)
        self.assertTrue(wait_until(lambda: all(self.said(name, RobotProgress.OK)
                                               for name in names)), told())
        goal = self.send(plan)
        self.assertTrue(wait_until(lambda: self.said(victim, RobotProgress.FAULT) or
                                   goal.wait_for_end(0.01)), told())
        self.assertTrue(self.said(victim, RobotProgress.FAULT), told())
        # Nobody is sent away from where a paused robot stands.
        self.pause(other, True)
        self.assertTrue(wait_until(lambda: self.said(other, RobotProgress.PAUSED)), told())
        self.pause(victim, False)
        self.pause(other, False)
        self.assertTrue(goal.wait_for_end(PATIENCE), told())
        self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED,
                         goal.result().message + told())
        self.assertEqual(self.count(RobotState.ARRIVED), DRIVEN)
        self.assertLess(bodies.output().count("goal: "), sum(moves), told())
        for word in ("too close", "Traceback", "ERROR"):
            self.assertNotIn(word, told())


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "robots_rostest", "__main__")
