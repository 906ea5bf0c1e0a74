#!/usr/bin/env python3
"""Checks in a bag that no two robots ever came too close: reads the poses in RobotProgress messages.

Robots whose poses have one stamp are compared; between two stamps each is taken to go straight, so
the least distance is that of continuous time but for corners cut within a period.

exit codes: 0 they kept apart, 1 bad usage or nothing recorded, 2 some came too close
"""

import argparse
import math
import sys

import rosbag


def moments_of(bag, topic):
    """Positions of all robots by stamp, in order."""
    moments = {}
    for _, message, _ in bag.read_messages(topics=[topic]):
        at = message.pose.pose.position
        moments.setdefault(message.pose.header.stamp.to_nsec(), {})[message.robot_id] = (at.x, at.y)
    return [moments[stamp] for stamp in sorted(moments)]


def least_on_the_way(first, second, then_first, then_second):
    """Least distance of two points that go straight from one pair of places to another."""
    x, y = first[0] - second[0], first[1] - second[1]
    dx = then_first[0] - then_second[0] - x
    dy = then_first[1] - then_second[1] - y
    square = dx * dx + dy * dy
    part = min(1.0, max(0.0, -(x * dx + y * dy) / square)) if square > 0 else 0.0
    return math.hypot(x + part * dx, y + part * dy)


def closest(moments, reach):
    """The least distance, and who: only robots in neighbouring buckets of `reach` are compared."""
    least, who = math.inf, None
    for now, then in zip(moments, moments[1:]):
        buckets = {}
        for robot, (x, y) in now.items():
            buckets.setdefault((int(x // reach), int(y // reach)), []).append(robot)
        for (column, row), robots in buckets.items():
            near = [other for i in (-1, 0, 1) for j in (-1, 0, 1)
                    for other in buckets.get((column + i, row + j), ())]
            for robot in robots:
                for other in near:
                    if other <= robot or robot not in then or other not in then:
                        continue
                    distance = least_on_the_way(now[robot], now[other], then[robot], then[other])
                    if distance < least:
                        least, who = distance, (robot, other)
    return least, who


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag")
    parser.add_argument("--distance", type=float, required=True,
                        help="[m] that two robots have to keep, the sum of their radii")
    parser.add_argument("--reach", type=float, default=4.0,
                        help="[m] robots farther apart are not compared (4)")
    parser.add_argument("--topic", default="/progress")
    args = parser.parse_args()
    with rosbag.Bag(args.bag) as bag:
        moments = moments_of(bag, args.topic)
    robots = {robot for moment in moments for robot in moment}
    if len(moments) < 2 or len(robots) < 2:
        print("check_distances: fewer than two robots or moments on %s" % args.topic,
              file=sys.stderr)
        return 1
    least, who = closest(moments, args.reach)
    text = "%.3f m (%s and %s)" % ((least,) + who) if who else "more than %g m" % args.reach
    print("%d robots, %d moments: the least distance is %s" % (len(robots), len(moments), text))
    return 0 if least >= args.distance else 2


if __name__ == "__main__":
    sys.exit(main())
