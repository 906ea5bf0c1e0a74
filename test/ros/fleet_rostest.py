#!/usr/bin/env python3
"""A fleet without hardware carries out a plan: a robot dies, the executor is killed and starts
again, and progress, goals and services that are wrong have their answers. Positions are checked by
a script that knows the bag alone."""

import math
import os
import resource
import signal

import rospy
import rosunit
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from fleet_case import FleetCase
from ros_processes import Recorder, wait_until
from split_mapf.msg import (MultiRobotPlan, PlanOutcome, RobotPath, RobotProgress, RobotState,
                            RobotTask)
from split_mapf.srv import AddRobot, BlockCells, PauseRobots, RemoveRobot

PATIENCE = 90


class Fleet(FleetCase):
    def test_goes_on_without_a_robot_that_dies(self):
        fleet = self.start_fleet()
        # One that cannot have arrived by then.
        victim = max(self.plan.paths, key=lambda path: len(path.cells)).robot_id
        self.start_robots([victim + ":1"])
        goal = self.send()
        self.assertTrue(goal.wait_for_end(PATIENCE), fleet.output())
        result = goal.result()
        self.assertEqual(result.outcome, PlanOutcome.ROBOT_BLOCKED, result.message)
        self.assertEqual([fault.robot_id for fault in result.faults], [victim])
        self.assertEqual(self.count(RobotState.ARRIVED), self.ROBOTS - 1)
        self.assertFalse(os.path.exists(self.file))
        self.assert_kept_apart()

    def test_goes_on_when_the_executor_was_killed(self):
        fleet = self.start_fleet()
        self.start_robots()
        self.send()
        far = self.ROBOTS // 4
        self.assertTrue(wait_until(lambda: self.count(RobotState.ARRIVED) >= far, PATIENCE),
                        fleet.output())
        self.assertLess(self.count(RobotState.ARRIVED), self.ROBOTS)
        fleet.signal(signal.SIGKILL)
        fleet.wait()
        self.assertTrue(os.path.exists(self.file))
        fleet = self.start_fleet()
        # Who asks for the same again has the execution's end.
        self.assertTrue(fleet.wait_for_output("taking up again"), fleet.output())
        goal = self.send()
        self.assertTrue(goal.wait_for_end(PATIENCE), fleet.output())
        self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED, goal.result().message)
        self.assertEqual(self.count(RobotState.ARRIVED), self.ROBOTS)
        self.assert_kept_apart()

    def test_drives_on_when_the_disk_is_full(self):
        fleet = self.start_fleet()
        _, most = resource.prlimit(fleet.process.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(fleet.process.pid, resource.RLIMIT_FSIZE, (1, most))
        told = Recorder("/diagnostics", DiagnosticArray)
        self.addCleanup(told.close)
        self.start_robots()
        goal = self.send()

        def is_told():
            return any(status.level == DiagnosticStatus.ERROR and self.file in status.message
                       for message in told.messages for status in message.status)
        self.assertTrue(wait_until(is_told), told.messages[-1:])
        self.assertTrue(goal.wait_for_end(PATIENCE))
        self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED, goal.result().message)
        self.assertFalse(os.path.exists(self.file))

    def test_answers_what_cannot_be(self):
        fleet = self.start_fleet()
        self.start_robots()
        # The node hears of their places before it knows any map.
        self.assertTrue(wait_until(lambda: len(self.progress.messages) > 2 * self.ROBOTS))
        wrong = MultiRobotPlan()
        wrong.header, wrong.grid, wrong.step_duration = self.plan.header, self.plan.grid, self.STEP
        wrong.paths = [RobotPath(robot_id="ghost", cells=[0])]
        for plan, outcome, word in (
                (self.elsewhere(), PlanOutcome.INVALID_POSE, "begins"),
                (self.other_map(), PlanOutcome.INVALID_MAP, "grid"),
                (self.jumping(), PlanOutcome.INVALID_OPTION, "jumps"),
                (self.boasting(), PlanOutcome.INVALID_OPTION, "claims"),
                (wrong, PlanOutcome.UNKNOWN_ROBOT, "ghost")):
            goal = self.send(plan)
            self.assertTrue(goal.wait_for_end(), fleet.output())
            self.assertEqual(goal.result().outcome, outcome, goal.result().message)
            self.assertIn(word, goal.result().message)
        running = self.send()
        self.assertTrue(wait_until(lambda: self.count(RobotState.MOVING) > 0), fleet.output())
        busy = self.send()
        self.assertTrue(busy.wait_for_end(), fleet.output())
        self.assertEqual(busy.result().outcome, PlanOutcome.SERVER_BUSY)
        publisher = rospy.Publisher("progress", RobotProgress, queue_size=10)
        self.assertTrue(wait_until(lambda: publisher.get_num_connections() >= 2))
        plan_id = self.states.messages[-1].plan_id
        publisher.publish(RobotProgress(robot_id="r0", plan_id=plan_id, fraction=math.nan))
        publisher.publish(RobotProgress(robot_id="r0", plan_id=plan_id, sequence=100000))
        self.assertTrue(fleet.wait_for_output("progress that cannot be"), fleet.output())
        self.check_services()
        running.handle.cancel()
        self.assertTrue(running.wait_for_end(), fleet.output())
        self.assertEqual(running.result().outcome, PlanOutcome.CANCELLED)
        self.assert_kept_apart()

    def check_services(self):
        def call(name, kind, *arguments):
            service = "fleet/" + name
            rospy.wait_for_service(service, 20)
            return rospy.ServiceProxy(service, kind)(*arguments)
        self.assertFalse(call("block_cells", BlockCells, [10 ** 6], True).ok)
        self.assertTrue(call("block_cells", BlockCells, [0], True).ok)
        self.assertTrue(call("block_cells", BlockCells, [0], False).ok)
        self.assertFalse(call("pause", PauseRobots, ["ghost"], True).ok)
        self.assertTrue(call("pause", PauseRobots, [], True).ok)
        self.assertTrue(wait_until(lambda: self.count(RobotState.MOVING) == 0))
        self.assertTrue(call("pause", PauseRobots, [], False).ok)
        self.assertTrue(wait_until(lambda: self.count(RobotState.MOVING) > 0))
        self.assertFalse(call("remove_robot", RemoveRobot, "ghost").ok)
        self.assertIn("report", call("add_robot", AddRobot, RobotTask(robot_id="ghost")).message)

    def altered(self):
        plan = MultiRobotPlan(header=self.plan.header, grid=self.plan.grid, step_duration=self.STEP)
        plan.paths = [RobotPath(robot_id=path.robot_id, cells=list(path.cells))
                      for path in self.plan.paths]
        plan.makespan, plan.sum_of_costs = self.plan.makespan, self.plan.sum_of_costs
        return plan

    def other_map(self):
        plan = self.altered()
        plan.grid = type(plan.grid)(width=7, height=7, resolution=1.0, origin=plan.grid.origin)
        return plan

    def jumping(self):
        plan = self.altered()
        cells = plan.paths[0].cells
        plan.paths[0].cells = [cells[0]] * 2 + cells[2:]
        return plan

    def boasting(self):
        plan = self.altered()
        plan.makespan -= 1
        return plan

    def elsewhere(self):
        """Robots 0 and 1 with each other's paths."""
        plan = self.altered()
        plan.paths[0].robot_id, plan.paths[1].robot_id = "r1", "r0"
        return plan


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "fleet_rostest", Fleet)
