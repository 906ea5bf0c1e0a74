#!/usr/bin/env python3
"""Records `progress` of hundreds of robots into a bag without losing any of it: rosbag keeps 100
messages at most for a topic, and a fleet that reports at once sends more. Ends by SIGINT.

usage: record_progress.py FILE.bag
"""

import os
import queue
import signal
import sys
import threading

import rosbag
import rospy
from split_mapf.msg import RobotProgress


def record(bag, arrived, ended):
    """Until the end was asked for, and all that had arrived by then is written."""
    kind, md5 = RobotProgress._type, RobotProgress._md5sum  # pylint: disable=protected-access
    while not (ended.is_set() and arrived.empty()):
        try:
            stamp, message = arrived.get(timeout=0.2)
        except queue.Empty:
            continue
        data = message._buff  # pylint: disable=protected-access
        bag.write("/progress", (kind, data, md5, 0, RobotProgress), stamp, raw=True)


def main():
    arrived, ended = queue.SimpleQueue(), threading.Event()
    signal.signal(signal.SIGINT, lambda *_: ended.set())
    rospy.init_node("record_progress", anonymous=True, disable_signals=True)

    def take(message):
        if not ended.is_set():
            arrived.put((rospy.Time.now(), message))

    rospy.Subscriber("progress", rospy.AnyMsg, take, tcp_nodelay=True, buff_size=2 ** 24)
    with rosbag.Bag(sys.argv[1], "w") as bag:
        record(bag, arrived, ended)
    os._exit(0)  # rospy's threads may wait for a master that has ended already


if __name__ == "__main__":
    main()
