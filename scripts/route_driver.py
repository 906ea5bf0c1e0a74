#!/usr/bin/env python3
"""Drives one robot that runs move_base along the route that the fleet sends it.

Visits that are released and lie in one line become one goal, so the robot does not stop at each of
them. Where the robot is it learns from tf, and tells the fleet. When move_base gives up, the robot
counts as FAULT (~on_abort: fault) until somebody says that it can go on, or as BLOCKED (blocked)
until the fleet leads it elsewhere. move_base has to keep to its goal's line: a robot that leaves
the cells of its route counts as an obstacle where it is.

parameters
  ~robot        id of the robot; needed
  ~base_frame   frame of the robot (ROBOT/base_link)
  ~move_base    name of the action (ROBOT/move_base)
  ~tolerance    [m] from a visit, at which the robot has come to it (0.1)
  ~tf_timeout   [s] without a transform until the robot is lost (1)
  ~rate         [Hz] of progress (10)
  ~on_abort     fault or blocked (fault)
topics: ROBOT/route (in), progress (out); service ~pause (std_srvs/SetBool): true stops the robot,
false lets it go on, also after a fault
"""

import collections
import math
import re
import sys
import threading

import actionlib
import rospy
import tf2_ros
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped, Quaternion
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from std_srvs.srv import SetBool, SetBoolResponse

from split_mapf.msg import RobotProgress, RobotRoute

# What is done of a move that is not known to have ended.
MOST_OF_A_MOVE = 0.999
STRAIGHT = 1e-3  # [rad]


def ros_name_of(robot_id):
    """As the fleet names the robot's topics."""
    name = re.sub(rb"[^A-Za-z0-9_]", b"_", robot_id.encode()).decode("ascii")
    return name if re.match(r"[A-Za-z]", name) else "r" + name


def place_of(visit):
    return visit.pose.position.x, visit.pose.position.y


def heading_between(here, there):
    return math.atan2(there[1] - here[1], there[0] - here[0])


class RouteRun:
    """Where a robot is on its route, and how far it may go. Knows neither tf nor move_base."""

    def __init__(self, tolerance):
        self.tolerance = tolerance
        self.plan_id = ""
        self.sequence = 0
        self.fraction = 0.0
        self.frame = ""
        self.visits = []  # the first is the one that it came to last
        self.given_up = 0  # visits with numbers below are void
        self.known = 0  # the first number that it was never sent

    def take(self, route):
        """Takes up a route; one that does not lead through the robot's visit is left out."""
        visits = list(route.visits)
        if not visits:
            return
        if route.plan_id != self.plan_id:
            self.plan_id, self.sequence, self.fraction = route.plan_id, visits[0].sequence, 0.0
            self.given_up = self.known = 0
        here = [index for index, visit in enumerate(visits) if visit.sequence == self.sequence]
        if not here:
            return
        visits = visits[here[0]:]
        begun = self.fraction > 0 and len(self.visits) > 1
        if begun and (len(visits) < 2 or visits[1].sequence != self.visits[1].sequence):
            return  # it ends the move that it has begun first
        self.visits, self.frame = visits, route.header.frame_id
        self.known = max(self.known, max(visit.sequence for visit in visits) + 1)

    def may_go_to(self, index):
        visit = self.visits[index]
        begun = index == 1 and self.fraction > 0
        return visit.released and (visit.sequence >= self.given_up or begun)

    def give_up(self):
        self.given_up = self.known

    def has_new_way(self):
        """Whether visits are released that it has not given up."""
        return len(self.visits) > 1 and self.visits[1].released and \
            any(visit.released and visit.sequence >= self.given_up for visit in self.visits[1:])

    def target(self):
        """Index of the last visit of the straight, released run from here; 0: it has to stand."""
        index = 0
        while index + 1 < len(self.visits) and self.may_go_to(index + 1):
            if index > 0:
                turn = heading_between(place_of(self.visits[index]),
                                       place_of(self.visits[index + 1])) - self.heading()
                if abs(math.remainder(turn, 2 * math.pi)) > STRAIGHT:
                    break
            index += 1
        return index

    def heading(self):
        """Of the next move."""
        return heading_between(place_of(self.visits[0]), place_of(self.visits[1]))

    def reach(self, index):
        """The robot has come to a visit ahead."""
        self.visits = self.visits[index:]
        self.sequence, self.fraction = self.visits[0].sequence, 0.0

    def locate(self, x, y):
        """Takes in where the robot is: never less far than before."""
        while len(self.visits) > 1 and self.may_go_to(1):
            (from_x, from_y), (to_x, to_y) = place_of(self.visits[0]), place_of(self.visits[1])
            length = math.hypot(to_x - from_x, to_y - from_y)
            done = ((x - from_x) * (to_x - from_x) + (y - from_y) * (to_y - from_y)) / length
            if done < length - self.tolerance:
                if done > self.tolerance:
                    self.fraction = max(self.fraction, min(done / length, MOST_OF_A_MOVE))
                return
            if math.hypot(x - to_x, y - to_y) > self.tolerance and done < length:
                return  # beside the visit, not at it
            self.reach(1)


class RouteDriver:
    def __init__(self):
        self.robot = str(rospy.get_param("~robot", ""))
        self.on_abort = rospy.get_param("~on_abort", "fault")
        if not self.robot:
            raise ValueError("parameter ~robot is needed: the id of the robot")
        if self.on_abort not in ("fault", "blocked"):
            raise ValueError("parameter ~on_abort is '%s'; fault or blocked is expected" %
                             self.on_abort)
        name = ros_name_of(self.robot)
        self.base_frame = rospy.get_param("~base_frame", name + "/base_link")
        self.tf_timeout = self.positive("~tf_timeout", 1.0)
        self.run = RouteRun(self.positive("~tolerance", 0.1))
        self.lock = threading.RLock()
        self.status = RobotProgress.OK  # but for what the moment says
        self.paused = False
        self.goal = None  # sequence of the visit that move_base is sent to
        self.handle = None  # of that goal
        self.ended = collections.deque()  # visits and handles of goals that have ended
        self.buffer = tf2_ros.Buffer()
        self.listener = tf2_ros.TransformListener(self.buffer)
        # The simple client cries out when a goal takes the place of another one.
        self.move_base = actionlib.ActionClient(
            rospy.get_param("~move_base", name + "/move_base"), MoveBaseAction)
        self.progress = rospy.Publisher("progress", RobotProgress, queue_size=10)
        self.routes = rospy.Subscriber(name + "/route", RobotRoute, self.take_route, queue_size=1)
        self.service = rospy.Service("~pause", SetBool, self.pause)
        self.timer = rospy.Timer(rospy.Duration(1 / self.positive("~rate", 10.0)), self.tick)

    @staticmethod
    def positive(name, value):
        value = rospy.get_param(name, value)
        if not isinstance(value, (int, float)) or not 0 < value < math.inf:
            raise ValueError("parameter %s is %r; a number above 0 is expected" % (name, value))
        return float(value)

    def take_route(self, route):
        with self.lock:
            if route.plan_id != self.run.plan_id:
                self.stop()
            self.run.take(route)
            if self.status == RobotProgress.BLOCKED and self.run.has_new_way():
                self.status = RobotProgress.OK
        self.tick()

    def pause(self, request):
        with self.lock:
            self.paused = request.data
            if not self.paused:
                self.status = RobotProgress.OK
        self.tick()
        return SetBoolResponse(success=True)

    def stop(self):
        if self.goal is not None:
            self.handle.cancel()
        self.goal = self.handle = None

    def tick(self, _event=None):
        with self.lock:
            while self.ended:
                self.take_end(*self.ended.popleft())
            pose = self.look()
            if pose is not None and self.run.visits:
                self.run.locate(pose.pose.position.x, pose.pose.position.y)
            status = self.judge(pose)
            if status == RobotProgress.OK and self.run.visits:
                self.drive()
            else:
                self.stop()
            self.tell(pose, status)

    def look(self):
        """The robot's pose in the route's frame; None: nobody knows."""
        frame = self.run.frame or "map"
        try:
            found = self.buffer.lookup_transform(frame, self.base_frame, rospy.Time(0))
        except tf2_ros.TransformException:
            return None
        if (rospy.Time.now() - found.header.stamp).to_sec() > self.tf_timeout:
            return None
        pose = PoseStamped(header=found.header)
        pose.pose.position.x = found.transform.translation.x
        pose.pose.position.y = found.transform.translation.y
        pose.pose.orientation = found.transform.rotation
        return pose

    def judge(self, pose):
        if self.status != RobotProgress.OK:
            return self.status
        if pose is None:
            return RobotProgress.LOST
        return RobotProgress.PAUSED if self.paused else RobotProgress.OK

    def drive(self):
        """Has move_base go to the end of the straight run, if that is another one than before."""
        target = self.run.target()
        if target == 0:
            if self.goal != self.run.sequence:
                self.stop()  # its goal is void; one that it has nearly come to it may end
            return
        visit = self.run.visits[target]
        if visit.sequence == self.goal:
            return
        if not self.move_base.wait_for_server(rospy.Duration(0.01)):
            rospy.logwarn_throttle(10, "robot %s: no move_base answers" % self.robot)
            return
        heading = self.run.heading()
        goal = MoveBaseGoal()
        goal.target_pose.header.frame_id = self.run.frame
        goal.target_pose.header.stamp = rospy.Time.now()
        goal.target_pose.pose.position = visit.pose.position
        goal.target_pose.pose.orientation = Quaternion(z=math.sin(heading / 2),
                                                       w=math.cos(heading / 2))
        self.goal = visit.sequence
        self.handle = self.move_base.send_goal(
            goal, transition_cb=lambda handle, sent=visit.sequence: self.watch(handle, sent))

    def watch(self, handle, sent):
        """Called with locks of actionlib held, so what follows is done elsewhere."""
        if handle.get_comm_state() == actionlib.CommState.DONE:
            self.ended.append((handle, sent))

    def take_end(self, handle, sent):
        """move_base has come to the end of a goal."""
        if handle != self.handle:
            return  # of an older one
        self.goal = self.handle = None
        state = handle.get_terminal_state()
        if state == GoalStatus.SUCCEEDED:
            for index, visit in enumerate(self.run.visits):
                if index > 0 and visit.sequence == sent:
                    self.run.reach(index)
                    break
        elif state in (GoalStatus.ABORTED, GoalStatus.REJECTED, GoalStatus.LOST):
            rospy.logwarn("robot %s: move_base gave up: %s", self.robot,
                          handle.get_goal_status_text() or "it does not say why")
            self.run.give_up()
            self.status = RobotProgress.FAULT if self.on_abort == "fault" else RobotProgress.BLOCKED

    def tell(self, pose, status):
        message = RobotProgress(robot_id=self.robot, plan_id=self.run.plan_id,
                                sequence=self.run.sequence, fraction=self.run.fraction,
                                status=status)
        if pose is not None:
            message.pose = pose
        self.progress.publish(message)


def main():
    rospy.init_node("route_driver")
    try:
        driver = RouteDriver()
    except ValueError as error:
        rospy.logfatal("%s", error)
        return 1
    rospy.on_shutdown(driver.stop)
    rospy.spin()
    return 0


if __name__ == "__main__":
    sys.exit(main())
