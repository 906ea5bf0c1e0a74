"""Large maps: memory at the peak is a small multiple of the map, whatever the way's length."""

import os
import subprocess
import unittest

from command import COMMAND, CommandTest


class BigMapTest(CommandTest):
    def write_map(self, rows, robots):
        width, height = len(rows[0]), len(rows)
        with open(self.path("p.map"), "w") as file:
            file.write("type octile\nheight %d\nwidth %d\nmap\n" % (height, width))
            file.writelines(row + "\n" for row in rows)
        with open(self.path("p.scen"), "w") as file:
            file.write("version 1\n")
            for start, goal in robots:
                file.write("0\tp.map\t%d\t%d\t%d\t%d\t%d\t%d\t0\n" % (width, height, *start, *goal))

    def plan_within(self, mebibytes, *options):
        """Plans, and checks the greatest memory that the process had."""
        with open(self.path("errors"), "w") as errors:
            process = subprocess.Popen(
                [COMMAND, "plan", "--map", "p.map", "--scen", "p.scen", "--output", "p.json",
                 "--quiet", *options], cwd=self.folder, stdin=subprocess.DEVNULL, stderr=errors)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.WEXITSTATUS(status)
        self.assertEqual(process.returncode, 0)
        self.assertLess(usage.ru_maxrss / 1024, mebibytes)
        return self.read_json("p.json")

    def test_a_large_hall_with_a_few_robots(self):
        # 16 million cells: 260 bytes a cell before.
        side = 4000
        self.write_map(["." * side] * side,
                       [((5 * i, 0), (side - 1 - 5 * i, side - 1)) for i in range(3)])
        result = self.plan_within(150)
        self.assertEqual(result["status"], "solved")
        self.assertEqual(result["makespan"], result["makespan_lower_bound"])
        check = self.run_command("check", "--map", "p.map", "--scen", "p.scen")
        self.assertEqual(check.stdout, "solvable\n")

    def serpentine(self, side):
        """A corridor of one cell that winds through a square, and its two ends."""
        rows = []
        for y in range(side):
            wall = "@" * (side - 1)
            if y % 2 == 0:
                rows.append("." * side)
            else:
                rows.append(wall + "." if y % 4 == 1 else "." + wall)
        last = side - 1
        return rows, (0, 0), (last if last % 4 == 0 else 0, last)

    def test_one_robot_on_a_long_way(self):
        # 80,800 steps: a bit for each step of each cell was 1.6 GB.
        rows, start, end = self.serpentine(401)
        self.write_map(rows, [(start, end)])
        result = self.plan_within(60)
        self.assertEqual(result["makespan"], 80800)
        self.assertTrue(result["optimal"])

    def test_a_few_robots_on_a_long_way(self):
        rows, start, end = self.serpentine(401)
        third = (end[0] - 8 if end[0] else 8, end[1])
        self.write_map(rows, [((8, 0), end), (start, third)])
        result = self.plan_within(150)
        self.assertEqual(result["status"], "solved")


if __name__ == "__main__":
    unittest.main()
