#!/usr/bin/env python3
"""check_distances.py on bags whose least distance is known."""

import contextlib
import importlib.util
import io
import os
import sys
import tempfile
import unittest

import rosbag
import rospy
from split_mapf.msg import RobotProgress

SCRIPT = os.path.join(os.path.dirname(__file__), "..", "..", "scripts", "check_distances.py")


def load():
    spec = importlib.util.spec_from_file_location("check_distances", SCRIPT)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    return script


class CheckDistances(unittest.TestCase):
    def check(self, poses):
        """Poses are (stamp, robot, x, y)."""
        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "a.bag")
            with rosbag.Bag(path, "w") as bag:
                for stamp, robot, x, y in poses:
                    message = RobotProgress(robot_id=robot)
                    message.pose.header.stamp = rospy.Time(stamp)
                    message.pose.header.frame_id = "map"
                    message.pose.pose.position.x, message.pose.pose.position.y = x, y
                    bag.write("/progress", message, rospy.Time(stamp))
            said = io.StringIO()
            sys.argv = [SCRIPT, path, "--distance", "0.7"]
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
                try:
                    code = load().main()
                except SystemExit as end:
                    code = end.code
            return code, said.getvalue()

    def test_sees_robots_that_report_at_other_moments(self):
        # They pass each other in one point, and no stamp is that of the other.
        poses = []
        for i in range(11):
            poses += [(10 + 0.1 * i, "a", i, 0), (10.03 + 0.1 * i, "b", 10 - i, 0)]
        code, said = self.check(poses)
        self.assertEqual(code, 2, said)
        self.assertIn("a and b", said)

    def test_takes_a_robot_that_reports_no_more_to_stand(self):
        poses = [(10, "a", 5, 0), (10.1, "a", 5, 0)]
        poses += [(10 + 0.1 * i, "b", i, 0.2) for i in range(11)]
        self.assertEqual(self.check(poses)[0], 2)

    def test_does_not_guess_the_way_where_poses_are_missing(self):
        # Straight on they would meet; the bag lacks how one went round the other.
        poses = [(10 + 0.1 * i, "a", 5, 0) for i in range(41)]
        poses += [(10, "b", 0, 0), (10.1, "b", 0, 0), (14, "b", 10, 0)]
        self.assertEqual(self.check(poses)[0], 0)

    def test_does_not_put_a_robot_where_its_last_pose_was_that_drove_on(self):
        # The bag ends with a pose of b; the last one of a, which drives ahead of it, is missing.
        poses = [(10 + 0.1 * i, "a", i, 0) for i in range(10)]
        poses += [(10 + 0.1 * i, "b", i - 1, 0) for i in range(12)]
        code, said = self.check(poses)
        self.assertEqual(code, 0, said)
        self.assertIn("1.000 m", said)

    def test_is_content_with_robots_that_keep_apart(self):
        poses = [(10 + 0.1 * i, robot, i, y) for i in range(11) for robot, y in (("a", 0), ("b", 1))]
        code, said = self.check(poses)
        self.assertEqual(code, 0, said)
        self.assertIn("1.000 m", said)

    def test_fails_where_there_is_nothing_to_compare(self):
        for poses in ([], [(10, "a", 0, 0), (11, "a", 1, 0)], [(10, "a", 0, 0), (10, "b", 5, 0)]):
            code, said = self.check(poses)
            self.assertEqual(code, 1, said)
            self.assertIn("nothing to compare", said)


if __name__ == "__main__":
    unittest.main()
