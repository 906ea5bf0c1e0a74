#!/usr/bin/env python3
"""Checks in a bag that no two robots ever came too close: reads the poses in RobotProgress messages.

Robots may report at moments of their own: between two of its poses each is taken to go straight,
and after its last one to stand if it stood. Where a robot is that drives is not known while poses
are missing, nor after its last one.
Positions are compared at moments that are --period apart at least, and between these the least
distance is that of continuous time, but for corners cut within a period.

exit codes: 0 they kept apart, 1 bad usage or nothing to compare, 2 some came too close
"""

import argparse
import array
import math
import sys

import rosbag


class Track:
    """The poses of a robot in order of their stamps, which are those of one that drives on."""

    def __init__(self):
        self.stamps, self.xs, self.ys = array.array("d"), array.array("d"), array.array("d")
        self.next = 0  # the first pose after the moment asked for last

    def add(self, stamp, x, y):
        if self.stamps and stamp <= self.stamps[-1]:
            return
        self.stamps.append(stamp)
        self.xs.append(x)
        self.ys.append(y)

    def drives_away(self):
        """Whether it drove when its last pose was taken."""
        return len(self.xs) > 1 and (self.xs[-1], self.ys[-1]) != (self.xs[-2], self.ys[-2])

    def at(self, moment, gap):
        """The place at a moment; none where that is not known. Moments come in order."""
        while self.next < len(self.stamps) and self.stamps[self.next] <= moment:
            self.next += 1
        if self.next == 0:
            return None
        last = self.next - 1
        x, y = self.xs[last], self.ys[last]
        if self.stamps[last] == moment:
            return (x, y)
        if self.next == len(self.stamps):
            return None if self.drives_away() else (x, y)
        duration = self.stamps[self.next] - self.stamps[last]
        dx, dy = self.xs[self.next] - x, self.ys[self.next] - y
        if duration > gap and (dx or dy):
            return None
        part = (moment - self.stamps[last]) / duration
        return (x + part * dx, y + part * dy)


def poses_of(bag, topic):
    """Stamps [s], robots and places, as they were recorded."""
    frame = None
    for _, message, _ in bag.read_messages(topics=[topic]):
        header = message.pose.header
        if not header.frame_id:
            continue
        frame = frame or header.frame_id
        if header.frame_id != frame:
            raise ValueError("poses in two frames, %s and %s" % (frame, header.frame_id))
        at = message.pose.pose.position
        if not (math.isfinite(at.x) and math.isfinite(at.y)):
            continue
        yield header.stamp.to_sec(), message.robot_id, at.x, at.y


def moments_of(poses, period, gap):
    """The places of all robots that are known, at moments in order, which are stamps of poses."""
    tracks = {}
    stamps = set()
    for stamp, robot, x, y in poses:
        tracks.setdefault(robot, Track()).add(stamp, x, y)
        stamps.add(stamp)
    latest = -math.inf
    for moment in sorted(stamps):
        if moment < latest + period:
            continue
        latest = moment
        places = ((robot, track.at(moment, gap)) for robot, track in tracks.items())
        yield {robot: place for robot, place in places if place}


def least_on_the_way(first, second, then_first, then_second):
    """Least distance of two points that go straight from one pair of places to another."""
    x, y = first[0] - second[0], first[1] - second[1]
    dx = then_first[0] - then_second[0] - x
    dy = then_first[1] - then_second[1] - y
    square = dx * dx + dy * dy
    part = min(1.0, max(0.0, -(x * dx + y * dy) / square)) if square > 0 else 0.0
    return math.hypot(x + part * dx, y + part * dy)


class Closest:
    """The least distance so far, and of whom: only robots in neighbouring squares of `reach` are
    compared."""

    def __init__(self, reach):
        self.reach = reach
        self.least, self.who = math.inf, None
        self.moments = 0
        self.places = 0
        self.robots = set()

    def take(self, now, then):
        here = {robot: place for robot, place in now.items() if robot in then}
        if len(here) < 2:
            return
        self.moments += 1
        self.places += len(here)
        self.robots.update(here)
        squares = {}
        for robot, (x, y) in here.items():
            squares.setdefault((int(x // self.reach), int(y // self.reach)), []).append(robot)
        for (column, row), robots in squares.items():
            near = [other for i in (-1, 0, 1) for j in (-1, 0, 1)
                    for other in squares.get((column + i, row + j), ())]
            for robot in robots:
                for other in near:
                    if other > robot:
                        self.compare(robot, other, now, then)

    def compare(self, robot, other, now, then):
        distance = least_on_the_way(now[robot], now[other], then[robot], then[other])
        if distance < self.least:
            self.least, self.who = distance, (robot, other)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag")
    parser.add_argument("--distance", type=float, required=True,
                        help="[m] that two robots have to keep, the sum of their radii")
    parser.add_argument("--reach", type=float, default=4.0,
                        help="[m] robots farther apart are not compared (4)")
    parser.add_argument("--period", type=float, default=0.05,
                        help="[s] between moments at least (0.05)")
    parser.add_argument("--gap", type=float, default=0.5,
                        help="[s] without a pose, as a bag may lack some, after which it is not "
                        "known where a robot is that drives (0.5)")
    parser.add_argument("--topic", default="/progress")
    args = parser.parse_args()
    if not 0 < args.distance <= args.reach or args.period <= 0:
        parser.exit(1, "check_distances: 0 < distance <= reach and 0 < period are expected\n")
    closest = Closest(args.reach)
    before = None
    try:
        with rosbag.Bag(args.bag) as bag:
            for now in moments_of(poses_of(bag, args.topic), args.period, args.gap):
                if before is not None:
                    closest.take(before, now)
                before = now
    except (OSError, ValueError, rosbag.ROSBagException) as error:
        parser.exit(1, "check_distances: %s\n" % error)
    if not closest.moments:
        parser.exit(1, "check_distances: no two robots at two moments on %s, so there is nothing to "
                    "compare\n" % args.topic)
    text = "%.3f m (%s and %s)" % ((closest.least,) + closest.who) if closest.who else (
        "more than %g m" % args.reach)
    known = 100 * closest.places / (closest.moments * len(closest.robots))
    print("%d robots, %d moments, %.0f %% of the places known: the least distance is %s" % (
        len(closest.robots), closest.moments + 1, known, text))
    return 0 if closest.least >= args.distance else 2


if __name__ == "__main__":
    sys.exit(main())
