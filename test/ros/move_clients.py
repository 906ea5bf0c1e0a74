"""Clients of the action ~move, for its rostest and for measurements."""

import math
import threading
import time

import actionlib
import rospy
from actionlib_msgs.msg import GoalID
from geometry_msgs.msg import PoseStamped

from split_mapf.msg import MoveRobotsAction, MoveRobotsActionGoal, MoveRobotsActionResult
from split_mapf.msg import MoveRobotsGoal, RobotTask


def pose_at(x, y, frame="map"):
    pose = PoseStamped()
    pose.header.frame_id = frame
    pose.pose.position.x, pose.pose.position.y = x, y
    pose.pose.orientation.w = 1.0
    return pose


def task(robot, x, y, frame="map"):
    return RobotTask(robot_id=robot, goal=pose_at(x, y, frame))


def goal_of(*tasks):
    return MoveRobotsGoal(robots=list(tasks))


def free_cells(grid):
    """The centres of all free cells of a map message."""
    info = grid.info
    return [(info.origin.position.x + (index % info.width + 0.5) * info.resolution,
             info.origin.position.y + (index // info.width + 0.5) * info.resolution)
            for index, value in enumerate(grid.data) if value == 0]


def connect(name="fleet/move"):
    client = actionlib.ActionClient(name, MoveRobotsAction)
    if not client.wait_for_server(rospy.Duration(30)):
        raise RuntimeError("no action server " + name)
    return client


class PlainClient:
    """Sends goals and gathers results as messages, without the state machines of actionlib, which
    are slow for thousands of goals in python. Several of them are as many clients."""

    def __init__(self, name, action="fleet/move", goal_type=MoveRobotsActionGoal,
                 result_type=MoveRobotsActionResult):
        self.name = name
        self.lock = threading.Lock()
        self.sent = {}
        self.ends = {}
        self.count = 0
        self.goal_type = goal_type
        self.goals = rospy.Publisher(action + "/goal", goal_type, queue_size=20000)
        self.cancels = rospy.Publisher(action + "/cancel", GoalID, queue_size=20000)
        self.results = rospy.Subscriber(action + "/result", result_type, self.take,
                                        queue_size=20000, tcp_nodelay=True)

    def is_connected(self):
        return (self.goals.get_num_connections() > 0 and self.cancels.get_num_connections() > 0
                and self.results.get_num_connections() > 0)

    def send(self, goal):
        message = self.goal_type(goal=goal)
        message.header.stamp = message.goal_id.stamp = rospy.Time.now()
        self.count += 1
        message.goal_id.id = "%s-%d" % (self.name, self.count)
        with self.lock:
            self.sent[message.goal_id.id] = time.monotonic()
        self.goals.publish(message)
        return message.goal_id.id

    def cancel(self, goal_id):
        self.cancels.publish(GoalID(id=goal_id))

    def take(self, message):
        with self.lock:
            if message.status.goal_id.id in self.sent:
                self.ends.setdefault(message.status.goal_id.id, []).append(message)

    def open(self):
        with self.lock:
            return [goal for goal in self.sent if goal not in self.ends]

    def close(self):
        for end in (self.goals, self.cancels, self.results):
            end.unregister()


def distance(pose, x, y):
    return math.hypot(pose.pose.position.x - x, pose.pose.position.y - y)
