#!/usr/bin/env python3
"""Robots whose move_base goes straight to its goal, with their transforms. One may be asked to give
up on its first goal. Says who is sent a goal ("goal: ...") and who comes too close."""

import argparse
import json
import math
import threading
import time

import actionlib
import rospy
from geometry_msgs.msg import TransformStamped
from move_base_msgs.msg import MoveBaseAction
from tf2_msgs.msg import TFMessage

from keeping_apart import tell_who_is_too_close

TICK = 0.02
# A robot gives up when it has gone so far.
GIVES_UP_AFTER = 0.5


class Robot:
    def __init__(self, name, x, y, gives_up):
        self.name, self.x, self.y = name, x, y
        self.gives_up_in = GIVES_UP_AFTER if gives_up else math.inf
        self.goal = None
        self.lock = threading.Lock()
        self.server = actionlib.ActionServer(name + "/move_base", MoveBaseAction, self.take,
                                             self.cancel, auto_start=False)
        self.server.start()

    def take(self, goal):
        with self.lock:
            if self.goal is not None:
                self.goal.set_canceled(None, "another goal came")
            goal.set_accepted()
            self.goal = goal
            print("goal: " + self.name, flush=True)

    def cancel(self, goal):
        with self.lock:
            if self.goal is not None and self.goal == goal:
                self.goal.set_canceled()
                self.goal = None

    def drive(self, way):
        with self.lock:
            if self.goal is None:
                return
            to = self.goal.get_goal().target_pose.pose.position
            left = math.hypot(to.x - self.x, to.y - self.y)
            part = 1.0 if left <= way else way / left
            self.x, self.y = self.x + part * (to.x - self.x), self.y + part * (to.y - self.y)
            self.gives_up_in -= way
            if self.gives_up_in < 0:
                self.goal.set_aborted(None, "something is in the way")
                self.goal, self.gives_up_in = None, math.inf
            elif part >= 1.0:
                self.goal.set_succeeded()
                self.goal = None

    def transform(self, now):
        found = TransformStamped()
        found.header.frame_id, found.header.stamp = "map", now
        found.child_frame_id = self.name + "/base_link"
        found.transform.translation.x, found.transform.translation.y = self.x, self.y
        found.transform.rotation.w = 1.0
        return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--starts", required=True, help="JSON: name to [x, y]")
    parser.add_argument("--speed", type=float, default=1.0)
    parser.add_argument("--apart", type=float, default=0.7)
    parser.add_argument("--gives-up", help="name of the robot that does")
    args = parser.parse_args()
    rospy.init_node("fake_move_base")
    with open(args.starts, encoding="ascii") as file:
        robots = {name: Robot(name, x, y, name == args.gives_up)
                  for name, (x, y) in json.load(file).items()}
    transforms = rospy.Publisher("/tf", TFMessage, queue_size=10)
    while not rospy.is_shutdown():
        for robot in robots.values():
            robot.drive(args.speed * TICK)
        transforms.publish([robot.transform(rospy.Time.now()) for robot in robots.values()])
        tell_who_is_too_close(robots, args.apart)
        time.sleep(TICK)


if __name__ == "__main__":
    main()
