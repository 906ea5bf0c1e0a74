#!/usr/bin/env python3
"""Fleets of robots that know nothing of routes: vehicles that speak VDA 5050 over a broker that is
killed on the way, and robots that run move_base."""

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

from fleet_case import FleetCase
from ros_processes import Program, Recorder, start_program, wait_until
from split_mapf.msg import PlanOutcome, RobotProgress, RobotState

PATIENCE = 90
FOLDER = os.path.dirname(os.path.abspath(__file__))
BRIDGE = roslib.packages.find_node("split_mapf", "vda5050_bridge_node")
MOSQUITTO = shutil.which("mosquitto", path=os.environ["PATH"] + ":/usr/sbin")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Robots(FleetCase):
    NAME = "robots_rostest"
    ROBOTS = 10
    SIZE = (24, 10)
    STEP = 0.25

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
            file.write("listener %d 127.0.0.1\nallow_anonymous false\npassword_file %s\nuser root\n" %
                       (port, self.path("passwords")))
        return port

    def write_starts(self, prefix=""):
        width = self.map_message.info.width
        starts = {prefix + path.robot_id: [path.cells[0] % width + 0.5, path.cells[0] // width + 0.5]
                  for path in self.plan.paths}
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

    @unittest.skipUnless(BRIDGE and MOSQUITTO, "libmosquitto or a broker is not here")
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
            sys.executable, os.path.join(FOLDER, "vda5050_vehicles.py"), "--port", str(port), "--user",
            "fleet", "--password", "secret", "--starts", self.write_starts("agv-"), "--speed",
            "%g" % (1 / self.STEP), "--blocked", "agv-" + victim)
        self.addCleanup(vehicles.end)
        self.assertTrue(wait_until(lambda: len({message.robot_id for message in
                                                self.progress.messages}) == self.ROBOTS),
                        bridge.output() + vehicles.output())
        goal = self.send()

        def told():
            return "".join(program.output() for program in [fleet, vehicles] + bridges)
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
        self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED, goal.result().message + told())
        self.assertEqual(self.count(RobotState.ARRIVED), self.ROBOTS)
        self.assertIn((victim, RobotProgress.BLOCKED),
                      {(message.robot_id, message.status) for message in self.progress.messages})
        for word in ("refused", "too close", "Traceback", "left out"):
            self.assertNotIn(word, told())
        self.assertIn(0, self.levels("vda5050"))


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "robots_rostest", Robots)
