#!/usr/bin/env python3
"""Goals of ~move, one after the other and many at once: they arrive, are preempted by newer ones,
cancelled, given to the best idle robot, or end with the reason why they cannot be reached, while
other robots go on."""

import random
import time

import rospy
import rosunit
from actionlib_msgs.msg import GoalStatus

from fleet_case import FleetCase
from move_clients import PlainClient, connect, distance, free_cells, goal_of, pose_at, task
from ros_processes import SentGoal, wait_until
from split_mapf.msg import PlanOutcome, RobotProgress, RobotState, RobotTask
from split_mapf.srv import AddRobot, BlockCells, RemoveRobot

PATIENCE = 60


class Move(FleetCase):
    NAME = "move_rostest"

    def start(self, *arguments, failures=()):
        fleet = self.start_fleet(2.0, "_step_duration:=%g" % self.STEP, *arguments)
        self.start_robots(failures)
        self.assertTrue(wait_until(lambda: len(self.progress.messages) > 2 * self.ROBOTS))
        self.cells = free_cells(self.map_message)
        self.client = connect()
        return fleet

    def test_takes_in_robots_by_order_only(self):
        self.start("_join_reporting:=false")
        rospy.wait_for_service("fleet/add_robot", 20)
        add = rospy.ServiceProxy("fleet/add_robot", AddRobot)
        remove = rospy.ServiceProxy("fleet/remove_robot", RemoveRobot)
        self.assertIn("report", add(RobotTask(robot_id="ghost")).message)
        self.assertTrue(wait_until(lambda: add(RobotTask(robot_id="r1")).ok))
        self.assertIn("already", add(RobotTask(robot_id="r1")).message)
        x, y = self.farther("r2", 4)
        self.assertTrue(add(task("r2", x, y)).ok)
        self.assertTrue(wait_until(lambda: distance(self.place_of("r2"), x, y) < 0.3))
        result = self.end_of(self.send(task("", *self.farther("r1", 4)), task("r3", x, y)))[1]
        self.assertEqual(result.outcome, PlanOutcome.UNKNOWN_ROBOT, result.message)
        self.assertIn("add_robot", result.message)
        self.assertIn(result.robot_ids[0], ("r1", "r2"))
        self.assertTrue(remove("r1").ok)
        result = self.end_of(self.send(task("r1", x, y)))[1]
        self.assertEqual(result.outcome, PlanOutcome.UNKNOWN_ROBOT, result.message)

    def send(self, *tasks):
        return SentGoal(self.client, goal_of(*tasks))

    def end_of(self, sent):
        self.assertTrue(sent.wait_for_end(PATIENCE))
        return sent.state(), sent.result()

    def place_of(self, robot):
        for message in reversed(self.progress.messages):
            if message.robot_id == robot:
                return message.pose
        return None

    def farther(self, robot, metres=10.0):
        """A free cell about so far from it."""
        pose = self.place_of(robot)
        return min(self.cells, key=lambda cell: abs(distance(pose, *cell) - metres))

    def state_of(self, robot):
        return next((state.state for state in self.latest() if state.robot_id == robot), None)

    def test_moves_preempts_cancels_and_assigns(self):
        fleet = self.start()
        # One of many robots.
        x, y = self.farther("r3")
        state, result = self.end_of(self.send(task("r3", x, y)))
        self.assertEqual((state, result.outcome), ("SUCCEEDED", 0), result.message)
        self.assertEqual(result.robot_ids, ["r3"])
        self.assertLess(distance(self.place_of("r3"), x, y), 1.0, fleet.output())

        # A newer goal, of another client.
        older = self.send(task("r5", *self.farther("r5")))
        self.assertTrue(wait_until(lambda: self.state_of("r5") == RobotState.MOVING))
        near = self.place_of("r5").pose.position
        self.client = connect()
        newer = self.send(task("r5", *min(
            self.cells, key=lambda cell: abs(cell[0] - near.x) + abs(cell[1] - near.y))))
        state, result = self.end_of(older)
        self.assertEqual((state, result.outcome), ("PREEMPTED", PlanOutcome.PREEMPTED))
        self.assertEqual(self.end_of(newer)[0], "SUCCEEDED")

        # Cancelled on its way.
        x, y = self.farther("r6")
        sent = self.send(task("r6", x, y))
        self.assertTrue(wait_until(lambda: self.state_of("r6") == RobotState.MOVING))
        sent.handle.cancel()
        state, result = self.end_of(sent)
        self.assertEqual((state, result.outcome), ("PREEMPTED", PlanOutcome.CANCELLED))
        self.assertTrue(wait_until(lambda: self.state_of("r6") == RobotState.IDLE))
        self.assertGreater(distance(self.place_of("r6"), x, y), 2.0)

        # Whoever is best.
        chosen = random.Random(2).sample(self.cells, 6)
        state, result = self.end_of(self.send(*[task("", *cell) for cell in chosen]))
        self.assertEqual(state, "SUCCEEDED", result.message)
        self.assertEqual(len(set(result.robot_ids)), 6)
        self.assertNotIn("", result.robot_ids)
        self.assert_kept_apart()

    def test_says_what_is_wrong_while_others_go_on(self):
        self.start(failures=["r0:0"])
        wall = self.map_message.data.index(100)
        wall = (wall % self.map_message.info.width + 0.5, wall // self.map_message.info.width + 0.5)
        x, y = self.farther("r7")
        a, b = self.cells[10], self.cells[20]
        sent = self.send(task("r1", *wall), task("r2", -5.0, 1.0), task("ghost", *a),
                         task("r4", *a), task("r4", *b), task("r8", float("nan"), 1.0),
                         task("r9", *a, frame="nowhere"), task("", *wall), task("r7", x, y))
        state, result = self.end_of(sent)
        self.assertEqual(state, "ABORTED")
        self.assertEqual(
            [(fault.robot_id, fault.code) for fault in result.faults],
            [("r1", PlanOutcome.BLOCKED_CELL), ("r2", PlanOutcome.OUTSIDE_MAP),
             ("ghost", PlanOutcome.UNKNOWN_ROBOT), ("r4", PlanOutcome.DUPLICATE_ROBOT_ID),
             ("r4", PlanOutcome.DUPLICATE_ROBOT_ID), ("r8", PlanOutcome.INVALID_POSE),
             ("r9", PlanOutcome.TRANSFORM_FAILED), ("7", PlanOutcome.BLOCKED_CELL)])
        self.assertEqual(result.outcome, PlanOutcome.BLOCKED_CELL)
        self.assertLess(distance(self.place_of("r7"), x, y), 1.0)
        # One with a fault, which it has told since its first route.
        self.assertTrue(wait_until(lambda: self.state_of("r0") == RobotState.ABSENT))
        state, result = self.end_of(self.send(task("r0", *a)))
        self.assertEqual((state, result.outcome), ("ABORTED", PlanOutcome.ROBOT_BLOCKED))
        # No robots, options that mean nothing, too little time.
        self.assertEqual(self.end_of(self.send())[1].outcome, PlanOutcome.NO_ROBOTS)
        goal = goal_of(task("r1", *a))
        goal.options.solver = "ecbs"
        result = self.end_of(SentGoal(self.client, goal))[1]
        self.assertEqual(result.outcome, PlanOutcome.INVALID_OPTION)
        self.assertIn("solver", result.message)
        goal = goal_of(task("r7", *self.farther("r7")))
        goal.options.time_limit = 0.3
        self.assertEqual(self.end_of(SentGoal(self.client, goal))[1].outcome, PlanOutcome.TIMEOUT)
        self.assert_kept_apart()

    def test_cells_closed_and_opened_a_tick_after_the_answer(self):
        self.start()
        self.assertEqual(self.end_of(self.send(task("r1", *self.farther("r1", 3))))[0], "SUCCEEDED")
        block = rospy.ServiceProxy("fleet/block_cells", BlockCells)
        for _ in range(3):
            x, y = self.farther("r1", 2)
            cell = int(y) * self.map_message.info.width + int(x)
            self.assertTrue(block([cell], True).ok)
            result = self.end_of(self.send(task("r1", x, y)))[1]
            self.assertEqual(result.outcome, PlanOutcome.BLOCKED_CELL, result.message)
            self.assertTrue(block([cell], False).ok)
            state, result = self.end_of(self.send(task("r1", x, y)))
            self.assertEqual(state, "SUCCEEDED", result.message)

    def test_sends_robots_beside_somebody_who_stands_on_two_cells(self):
        self.start()
        self.assertEqual(self.end_of(self.send(task("r1", *self.farther("r1", 3))))[0], "SUCCEEDED")
        x, y = next((x, y) for x, y in self.cells if (x + 1, y) in self.cells and all(
            distance(self.place_of(path.robot_id), x + 0.5, y) > 2 for path in self.plan.paths))
        topic = rospy.Publisher("progress", RobotProgress, queue_size=10)
        self.addCleanup(topic.unregister)
        # It is not of the fleet.
        stranger = RobotProgress(robot_id="stranger", status=RobotProgress.FAULT,
                                 pose=pose_at(x + 0.45, y))
        timer = rospy.Timer(rospy.Duration(0.05), lambda _event: topic.publish(stranger))
        self.addCleanup(timer.shutdown)
        self.assertTrue(wait_until(lambda: self.place_of("stranger")))
        outcomes = []

        def is_closed(cell):
            outcomes.append(self.end_of(self.send(task("r1", *cell)))[1].outcome)
            return outcomes[-1] == PlanOutcome.BLOCKED_CELL

        # From the tick on in which the node has heard of it.
        self.assertTrue(wait_until(lambda: is_closed((x, y))), outcomes)
        self.assertTrue(is_closed((x + 1, y)), outcomes)

    def test_ends_each_goal_of_many_clients_once(self):
        fleet = self.start("_max_tasks:=400")
        clients = [PlainClient("client_%d" % number) for number in range(10)]
        for client in clients:
            self.addCleanup(client.close)
        self.assertTrue(wait_until(lambda: all(client.is_connected() for client in clients)))
        draw = random.Random(7)
        for _ in range(20):
            for client in clients:
                robot = "" if draw.random() < 0.2 else "r%d" % draw.randrange(self.ROBOTS)
                goal = client.send(goal_of(task(robot, *draw.choice(self.cells))))
                if draw.random() < 0.2:
                    client.cancel(goal)
            time.sleep(0.05)
        # More than may be open.
        busy = clients[0].send(goal_of(*[task("", *self.cells[0]) for _ in range(401)]))
        self.assertTrue(wait_until(lambda: not any(client.open() for client in clients), PATIENCE),
                        fleet.output())
        # A cancel may come before its goal.
        kinds = {PlanOutcome.SUCCEEDED: (GoalStatus.SUCCEEDED,),
                 PlanOutcome.CANCELLED: (GoalStatus.PREEMPTED, GoalStatus.RECALLED),
                 PlanOutcome.PREEMPTED: (GoalStatus.PREEMPTED,),
                 PlanOutcome.SERVER_BUSY: (GoalStatus.REJECTED,)}
        outcomes = set()
        for client in clients:
            for goal, ends in client.ends.items():
                self.assertEqual(len(ends), 1, goal)
                outcome = ends[0].result.outcome
                self.assertIn(ends[0].status.status, kinds.get(outcome, ()), ends[0].result)
                outcomes.add(outcome)
        self.assertEqual(outcomes, set(kinds))
        self.assertEqual(clients[0].ends[busy][0].result.outcome, PlanOutcome.SERVER_BUSY)
        # Nobody has a goal any more, so a plan may be executed.
        self.assertTrue(wait_until(lambda: self.count(RobotState.IDLE) == self.ROBOTS))
        self.assert_kept_apart()


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "move_rostest", Move)
