#!/usr/bin/env python3
"""Robots of 0.3 m on the planning graph of a small building. They carry out a plan, from exactly their
starts to exactly their goals, late, and one of them dying; or goals come one by one. Positions are
checked by a script that knows the bag alone."""

import copy
import math
import os
import signal
import tempfile

import rospy
import rosunit
from geometry_msgs.msg import Point
from nav_msgs.msg import OccupancyGrid

from fleet_case import FleetCase
from move_clients import connect, goal_of, pose_at, task
from ros_processes import PATIENCE, Recorder, SentGoal, action_client, start_program, wait_until
from split_mapf.msg import (MultiRobotPlan, PlanOutcome, PlanPathsGoal, RobotPath, RobotProgress,
                            RobotRoute, RobotState, RobotTask)
from split_mapf.srv import AddRobot, BlockCells, PauseRobots, RemoveRobot

RADIUS = 0.3
SPEED = 5.0
# A pause has to come while they drive, on a busy machine, too.
SLOWLY = SPEED / 3
CELL = 0.1
# Two rooms, robots of the one go to the other through two doors.
ROOMS = (121, 60)
DOORS = (range(8, 18), range(40, 50))
# Nobody of the plan goes there.
MIDDLE = (3.63, 2.94)


def building():
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    grid.info.width, grid.info.height = ROOMS
    grid.info.resolution = CELL
    grid.info.origin.orientation.w = 1.0
    wall = ROOMS[0] // 2
    grid.data = [100 if x == wall and not any(y in door for door in DOORS) else 0
                 for y in range(ROOMS[1]) for x in range(ROOMS[0])]
    return grid


def tasks():
    """Robots in two columns, each to the place of one beyond the wall."""
    left = [(0.7 + 1.31 * (i % 2), 0.8 + 2.05 * (i // 2)) for i in range(5)]
    right = [(ROOMS[0] * CELL - x, y) for x, y in left]
    robots = []
    for index, (start, goal) in enumerate(zip(left + right, list(reversed(right)) + left[::-1])):
        task = RobotTask(robot_id="r%d" % index)
        for pose, (x, y) in ((task.start, start), (task.goal, goal)):
            pose.header.frame_id = "map"
            pose.pose.position.x, pose.pose.position.y = x, y
            pose.pose.orientation.w = 1.0
        robots.append(task)
    return robots


class DiscFleet(FleetCase):
    ROBOTS = 10
    APART = 2 * RADIUS

    @classmethod
    def setUpClass(cls):
        rospy.init_node("disc_fleet_rostest")
        cls.directory = tempfile.TemporaryDirectory()
        cls.map_topic = rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True)
        cls.map_topic.publish(building())
        planner = start_program("planner_node", "__name:=split_mapf", "_publish_paths:=false")
        try:
            goal = PlanPathsGoal(map=building(), robots=tasks())
            goal.options.robot_radius = RADIUS
            goal.options.robot_speed = SPEED
            sent = SentGoal(action_client(), goal)
            assert sent.wait_for_end(PATIENCE), planner.output()
            assert sent.result().outcome == PlanOutcome.SUCCEEDED, sent.result().message
            cls.plan = sent.result().plan
        finally:
            planner.end()
        cls.STEP = cls.plan.step_duration
        cls.plan_topic = rospy.Publisher("plan", MultiRobotPlan, queue_size=1, latch=True)
        cls.plan_topic.publish(cls.plan)

    def place_of(self, robot_id):
        for message in reversed(self.progress.messages):
            if message.robot_id == robot_id:
                return message.pose.pose.position
        return None

    def assert_at_goal(self, path):
        at = self.place_of(path.robot_id)
        goal = path.goal.position
        self.assertLess(math.hypot(at.x - goal.x, at.y - goal.y), 1e-3, path.robot_id)

    def test_goes_from_pose_to_pose_without_a_robot_that_dies(self):
        fleet = self.start_fleet()
        victim = max(self.plan.paths, key=lambda path: len(path.cells)).robot_id
        self.start_robots([victim + ":2"], speed=SPEED)
        goal = self.send()
        self.assertTrue(goal.wait_for_end(PATIENCE), fleet.output())
        result = goal.result()
        self.assertEqual(result.outcome, PlanOutcome.ROBOT_BLOCKED, result.message)
        self.assertIn(victim, [fault.robot_id for fault in result.faults])
        at_fault = {fault.robot_id for fault in result.faults}
        arrived = [path for path in self.plan.paths if path.robot_id not in at_fault]
        # Its legs may keep who stands next to it.
        self.assertGreaterEqual(len(arrived), self.ROBOTS - 3, result.message)
        for path in arrived:
            self.assert_at_goal(path)
        self.assert_kept_apart()

    def test_all_arrive_though_the_fleet_is_paused_for_a_while(self):
        fleet = self.start_fleet()
        self.start_robots(speed=SLOWLY)
        goal = self.send()
        self.assertTrue(wait_until(lambda: self.count(RobotState.MOVING) > 2, PATIENCE),
                        fleet.output())
        pause = rospy.ServiceProxy("fleet/pause", PauseRobots)
        self.assertTrue(pause([], True).ok)
        self.assertTrue(wait_until(lambda: self.count(RobotState.MOVING) == 0, PATIENCE))
        self.assertTrue(pause([], False).ok)
        self.assertTrue(goal.wait_for_end(PATIENCE), fleet.output())
        self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED, goal.result().message)
        self.assertEqual(self.count(RobotState.ARRIVED), self.ROBOTS)
        for path in self.plan.paths:
            self.assert_at_goal(path)
        self.assert_kept_apart()

    def play(self, path, aside):
        """A robot that stands where its path begins, so far from there as `aside` says [m]. The
        other robots of the plan are fakes."""
        others = copy.deepcopy(self.plan)
        others.paths = [other for other in others.paths if other.robot_id != path.robot_id]
        self.plan_topic.publish(others)
        self.addCleanup(self.plan_topic.publish, self.plan)
        topic = rospy.Publisher("progress", RobotProgress, queue_size=10)
        self.addCleanup(topic.unregister)

        def report(_event):
            plan_ids = [state.plan_id for state in self.states.messages[-1:]]
            message = RobotProgress(robot_id=path.robot_id, plan_id="".join(plan_ids))
            message.pose.header.frame_id = "map"
            message.pose.header.stamp = rospy.Time.now()
            message.pose.pose = copy.deepcopy(path.start)
            message.pose.pose.position.y += aside[0]
            topic.publish(message)

        timer = rospy.Timer(rospy.Duration(0.05), report)
        self.addCleanup(timer.shutdown)

    def test_goes_on_without_a_robot_that_left_its_way(self):
        fleet = self.start_fleet()
        strayed = self.plan.paths[0]
        aside = [0.0]
        self.play(strayed, aside)
        self.start_robots(speed=SPEED)
        goal = self.send()
        self.assertTrue(wait_until(lambda: len(self.plan_ids()) == 1, PATIENCE), fleet.output())
        aside[0] = 2 * RADIUS
        self.assertTrue(goal.wait_for_end(PATIENCE), fleet.output())
        faults = {fault.robot_id: fault.message for fault in goal.result().faults}
        self.assertIn("left", faults[strayed.robot_id])
        # Its neighbours may have no way past it.
        arrived = [path for path in self.plan.paths if path.robot_id not in faults]
        self.assertGreaterEqual(len(arrived), self.ROBOTS - 3, goal.result().message)
        for path in arrived:
            self.assert_at_goal(path)
        self.assert_kept_apart()

    def plan_ids(self):
        """Of the parts that have begun so far."""
        return {state.plan_id for state in self.states.messages if state.plan_id}

    def kill_and_start_again(self, fleet, start=None):
        fleet.signal(signal.SIGKILL)
        fleet.wait()
        self.assertTrue(os.path.exists(self.file))
        fleet = start() if start else self.start_fleet()
        self.assertTrue(fleet.wait_for_output("taking up again"), fleet.output())
        return fleet

    def test_goes_on_when_the_executor_was_killed_on_a_leg_and_on_the_graph(self):
        fleet = self.start_fleet()
        self.start_robots(speed=SLOWLY)
        self.send()
        pause = rospy.ServiceProxy("fleet/pause", PauseRobots)
        pause.wait_for_service(PATIENCE)
        self.assertTrue(wait_until(lambda: pause([], True).ok, PATIENCE), fleet.output())
        self.assertTrue(wait_until(lambda: len(self.plan_ids()) == 1, PATIENCE), fleet.output())
        self.assertTrue(wait_until(lambda: os.path.exists(self.file), PATIENCE))
        # Another robot is to join when all are on the graph.
        late = self.free_vertex()
        self.appear("late", *late)
        self.assertTrue(wait_until(lambda: self.add("late", *MIDDLE).ok, PATIENCE),
                        fleet.output())
        self.assertIn("already", self.add("late", *MIDDLE).message)
        # And one that stays, and does not know where it is.
        self.join_without_pose("blind", self.free_vertex(late, MIDDLE))
        fleet = self.kill_and_start_again(fleet)
        self.assertTrue(wait_until(lambda: pause([], False).ok, PATIENCE), fleet.output())
        self.assertTrue(wait_until(lambda: len(self.plan_ids()) == 2, PATIENCE), fleet.output())
        self.assertTrue(wait_until(lambda: self.count(RobotState.MOVING) > 2, PATIENCE))
        fleet = self.kill_and_start_again(fleet)
        # Who asks for the same again has the execution's end.
        self.assert_all_arrive_with(self.send(), "late", *MIDDLE, joined=2)
        self.assertEqual(len(self.plan_ids()), 3)

    def join_without_pose(self, robot_id, place):
        """A robot that says its visits alone, and is at each as soon as it may go there."""
        topic = rospy.Publisher("progress", RobotProgress, queue_size=10)
        self.addCleanup(topic.unregister)
        routes = Recorder("fleet/routes", RobotRoute)
        self.addCleanup(routes.close)

        def report(_event):
            message = RobotProgress(robot_id=robot_id)
            message.pose.header.stamp = rospy.Time.now()
            route = next((route for route in reversed(routes.messages)
                          if route.robot_id == robot_id), None)
            if route:
                message.plan_id = route.plan_id
                message.sequence = max(visit.sequence for visit in route.visits if visit.released)
            topic.publish(message)

        timer = rospy.Timer(rospy.Duration(0.05), report)
        self.addCleanup(timer.shutdown)
        add = rospy.ServiceProxy("fleet/add_robot", AddRobot)
        blind = RobotTask(robot_id=robot_id)
        self.assertTrue(wait_until(lambda: "no pose" in add(blind).message, PATIENCE))
        blind.start = pose_at(*place)
        answer = add(blind)
        self.assertTrue(answer.ok, answer.message)

    def appear(self, robot_id, x, y):
        """A robot without hardware, beside those of the plan."""
        path = RobotPath(robot_id=robot_id, cells=[0])
        path.start.position.x, path.start.position.y = x, y
        self.plan_topic.publish(MultiRobotPlan(grid=self.plan.grid, header=self.plan.header,
                                               robot_radius=RADIUS, paths=[path],
                                               longest_step=self.plan.longest_step))
        self.addCleanup(self.plan_topic.publish, self.plan)
        self.assertTrue(wait_until(lambda: self.place_of(robot_id) is not None, PATIENCE))

    def free_vertex(self, *others):
        """Where nobody stands or begins, far from all goals, and from other places."""
        taken = [Point(x, y, 0) for x, y in others]
        taken += [self.place_of(path.robot_id) for path in self.plan.paths]
        taken += [pose.position for path in self.plan.paths for pose in (path.start, path.goal)]
        for cell in sorted({cell for path in self.plan.paths for cell in path.cells}):
            x, y = (cell % ROOMS[0] + 0.5) * CELL, (cell // ROOMS[0] + 0.5) * CELL
            if min(math.hypot(at.x - x, at.y - y) for at in taken) > 4 * RADIUS:
                return x, y
        raise RuntimeError("all vertices are taken")

    @staticmethod
    def add(robot_id, x, y, radius=0.0):
        task_of_robot = task(robot_id, x, y)
        task_of_robot.radius = radius
        return rospy.ServiceProxy("fleet/add_robot", AddRobot)(task_of_robot)

    def assert_all_arrive_with(self, goal, robot_id, x, y, joined=1):
        self.assertTrue(goal.wait_for_end(PATIENCE), self.latest())
        self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED, goal.result().message)
        self.assertEqual(self.count(RobotState.ARRIVED), self.ROBOTS + joined)
        at = self.place_of(robot_id)
        self.assertLess(math.hypot(at.x - x, at.y - y), 1e-3)
        for path in self.plan.paths:
            self.assert_at_goal(path)
        self.assert_kept_apart()

    def test_a_robot_joins_the_plan_while_others_drive(self):
        fleet = self.start_fleet()
        self.start_robots(speed=SLOWLY)
        goal = self.send()
        pause = rospy.ServiceProxy("fleet/pause", PauseRobots)
        self.assertTrue(wait_until(lambda: len(self.plan_ids()) == 2, PATIENCE), fleet.output())
        answer = pause([], True)
        self.assertTrue(answer.ok, "%s, %s" % (answer.message, goal.result()))
        self.assertTrue(wait_until(lambda: self.count(RobotState.MOVING) == 0, PATIENCE))
        x, y = self.free_vertex()
        self.appear("late", x, y)
        first = self.plan.paths[0].goal.position
        add = rospy.ServiceProxy("fleet/add_robot", AddRobot)
        elsewhere = RobotTask(robot_id="late", start=pose_at(*MIDDLE))
        # From its first report on.
        self.assertTrue(wait_until(lambda: "from its start" in add(elsewhere).message))
        for answer, reason in ((self.add("late", first.x, first.y), self.plan.paths[0].robot_id),
                               (self.add("late", *MIDDLE, radius=2 * RADIUS), "radius"),
                               (self.add("late", *MIDDLE, radius=float("nan")), "radius"),
                               (self.add("late", MIDDLE[0], 0.1), "does not fit"),
                               (self.add(self.plan.paths[0].robot_id, *MIDDLE), "already"),
                               (self.add("nobody", *MIDDLE), "does not report")):
            self.assertFalse(answer.ok)
            self.assertIn(reason, answer.message)
        self.assertTrue(self.add("late", *MIDDLE).ok)
        self.assertIn("already", self.add("late", *MIDDLE).message)
        # No plan is made meanwhile: it is let in, and takes no part.
        remove = rospy.ServiceProxy("fleet/remove_robot", RemoveRobot)
        self.assertIn("does not join", remove("late").message)
        self.assertFalse(remove("late").ok)
        self.assertTrue(wait_until(lambda: self.add("late", *MIDDLE).ok))
        self.assertTrue(pause([], False).ok)
        self.assert_all_arrive_with(goal, "late", *MIDDLE)

    def stand_on_vertices(self):
        """Robots appear where their paths on the graph begin."""
        plan = copy.deepcopy(self.plan)
        for path in plan.paths:
            cell = path.cells[0]
            path.start.position.x = (cell % ROOMS[0] + 0.5) * CELL
            path.start.position.y = (cell // ROOMS[0] + 0.5) * CELL
        self.plan_topic.publish(plan)
        self.addCleanup(self.plan_topic.publish, self.plan)
        self.start_robots(speed=SPEED)
        return plan

    def start_rolling(self):
        return self.start_fleet(5.0, "_robot_radius:=%g" % RADIUS, "_step_duration:=0",
                                "_robot_speed:=%g" % SPEED)

    def result_of(self, *tasks_of_goal):
        sent = SentGoal(self.mover, goal_of(*tasks_of_goal))
        self.assertTrue(sent.wait_for_end(PATIENCE))
        return sent.result()

    def goals(self, swapped=False):
        ends = [path.start if swapped else path.goal for path in self.plan.paths]
        return [task(path.robot_id, end.position.x, end.position.y)
                for path, end in zip(self.plan.paths, ends)]

    def assert_near_goals(self, wanted):
        for one in wanted:
            at, goal = self.place_of(one.robot_id), one.goal.pose.position
            self.assertLess(math.hypot(at.x - goal.x, at.y - goal.y), 0.7, one.robot_id)

    def test_goals_come_one_by_one_also_after_a_restart(self):
        plan = self.stand_on_vertices()
        fleet = self.start_rolling()
        self.mover = connect()
        self.assertTrue(wait_until(lambda: len(self.progress.messages) > 2 * self.ROBOTS))
        result = self.result_of(*self.goals())
        self.assertEqual(result.outcome, PlanOutcome.SUCCEEDED, result.message)
        wall = ((ROOMS[0] // 2 + 0.5) * CELL, 0.05)
        result = self.result_of(task("r0", *wall), task("r1", 0.1, -0.1), task("", 1.0, 1.0))
        self.assertEqual([fault.code for fault in result.faults],
                         [PlanOutcome.BLOCKED_CELL, PlanOutcome.OUTSIDE_MAP], result.message)
        self.assertIn(result.robot_ids[2], [path.robot_id for path in plan.paths])
        # The doors are closed, and opened again.
        block = rospy.ServiceProxy("fleet/block_cells", BlockCells)
        doors = [y * ROOMS[0] + ROOMS[0] // 2 for door in DOORS for y in door]
        self.assertTrue(block(doors, True).ok)
        result = self.result_of(self.goals(swapped=True)[0])
        self.assertEqual(result.outcome, PlanOutcome.UNREACHABLE_GOAL, result.message)
        self.assertTrue(block(doors, False).ok)
        # They count as open from the node's next tick on.
        first = self.goals(swapped=True)[0]
        self.assertTrue(wait_until(
            lambda: self.result_of(first).outcome == PlanOutcome.SUCCEEDED))
        SentGoal(self.mover, goal_of(*self.goals(swapped=True)))
        self.assertTrue(wait_until(lambda: self.count(RobotState.MOVING) > 2, PATIENCE))
        fleet = self.kill_and_start_again(fleet, self.start_rolling)
        self.mover = connect()
        self.assertTrue(wait_until(lambda: self.count(RobotState.IDLE) == self.ROBOTS, PATIENCE),
                        fleet.output())
        for one in self.goals(swapped=True)[:2]:
            result = self.result_of(one)
            self.assertEqual(result.outcome, PlanOutcome.SUCCEEDED, result.message)
            self.assert_near_goals([one])
        self.assert_kept_apart()
        # Another one stands between the vertices.
        newcomer = copy.deepcopy(plan.paths[0])
        newcomer.robot_id = "r99"
        newcomer.start.position.x += 0.35
        self.plan_topic.publish(MultiRobotPlan(grid=plan.grid, header=plan.header,
                                               longest_step=plan.longest_step, paths=[newcomer]))
        self.assertTrue(wait_until(lambda: self.place_of("r99") is not None, PATIENCE))
        result = self.result_of(task("r99", 1.0, 1.0))
        self.assertEqual(result.outcome, PlanOutcome.UNKNOWN_ROBOT, result.message)
        self.assertIn("not on a vertex of the planning graph", result.message)

    def test_a_robot_joins_exactly_on_a_vertex_and_drops_out_when_it_leaves(self):
        path = copy.deepcopy(self.plan.paths[0])
        path.start.position.x = (path.cells[0] % ROOMS[0] + 0.5) * CELL
        path.start.position.y = (path.cells[0] // ROOMS[0] + 0.5) * CELL
        aside = [0.4 * CELL]
        fleet = self.start_rolling()
        self.play(path, aside)
        self.mover = connect()
        # Until its reports come to the node it may be about to.
        self.assertTrue(wait_until(
            lambda: "not on a vertex" in self.result_of(task(path.robot_id, 1.0, 1.0)).message,
            PATIENCE), fleet.output())
        aside[0] = 0.0
        self.assertTrue(wait_until(lambda: self.count(RobotState.IDLE) == 1, PATIENCE),
                        fleet.output())
        aside[0] = 2 * RADIUS
        self.assertTrue(wait_until(lambda: self.count(RobotState.ABSENT) == 1, PATIENCE),
                        fleet.output())
        self.assertIn("left its way", self.latest()[0].message)

    def test_refuses_a_plan_of_another_graph(self):
        self.start_fleet(5.0, "_cell_size:=1.3")
        goal = self.send()
        self.assertTrue(goal.wait_for_end(PATIENCE))
        self.assertEqual(goal.result().outcome, PlanOutcome.INVALID_OPTION)
        self.assertIn("cell_size", goal.result().message)
        closer = copy.deepcopy(self.plan)
        closer.robot_radius = closer.paths[0].radius = 0.9
        goal = self.send(closer)
        self.assertTrue(goal.wait_for_end(PATIENCE))
        self.assertEqual(goal.result().outcome, PlanOutcome.INVALID_OPTION)
        self.assertIn("cannot be executed", goal.result().message)


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "disc_fleet_rostest", DiscFleet)
