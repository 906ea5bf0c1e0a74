"""Starts and ends programs for the rostests in python, and waits for what they do."""

import glob
import json
import os
import random
import shutil
import signal
import subprocess
import tempfile
import time

import actionlib
import roslib.packages
import rospy
from actionlib_msgs.msg import GoalStatus
from nav_msgs.msg import OccupancyGrid

from split_mapf.msg import PlanPathsAction, PlanPathsGoal, RobotTask

# A warehouse of 24x12 cells; S are starts, G are goals, one robot a row.
WAREHOUSE = """\
........................
.S....................G.
...##..##..##..##..##...
...##..##..##..##..##...
.G....................S.
........................
.S....................G.
...##..##..##..##..##...
...##..##..##..##..##...
.G....................S.
........................
........................
"""
# Seconds that a test waits for a state that has to come, on a machine that is busy with other tests.
PATIENCE = 60
HARD_SIDE = 12
HARD_ROBOTS = 110


class Program:
    """A child process with its output in a file."""

    def __init__(self, *command, env=None):
        self.output_file = tempfile.NamedTemporaryFile(mode="w+", suffix=".log")
        merged = dict(os.environ, ROSCONSOLE_STDOUT_LINE_BUFFERED="1", PYTHONUNBUFFERED="1",
                      **(env or {}))
        self.process = subprocess.Popen(command, stdout=self.output_file,
                                        stderr=subprocess.STDOUT, env=merged,
                                        start_new_session=True)

    def output(self):
        with open(self.output_file.name, encoding="utf-8", errors="replace") as file:
            return file.read()

    def wait_for_output(self, text, patience=PATIENCE):
        return wait_until(lambda: text in self.output() or self.process.poll() is not None,
                          patience) and text in self.output()

    def signal(self, number):
        self.process.send_signal(number)

    def wait(self, patience=PATIENCE):
        """The exit code; None when it does not end."""
        try:
            return self.process.wait(patience)
        except subprocess.TimeoutExpired:
            return None

    def end(self):
        """Asks the whole group, then kills it."""
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            if self.process.poll() is not None:
                break
            os.killpg(self.process.pid, number)
            self.wait(15)
        self.output_file.close()


def start_program(name, *arguments, env=None):
    """Starts a program of this package, as roslaunch finds it: rosrun does not look into a devel
    space that lies in the package's own build folder."""
    return Program(roslib.packages.find_node("split_mapf", name)[0], *arguments, env=env)


def nats_server():
    """The path of the program; None where it is not installed."""
    return shutil.which("nats-server", path=os.environ["PATH"] + ":/usr/sbin:/usr/local/bin")


def start_nats_server(folder):
    """Starts one on a free port, with a queue in memory. Returns it and its URL."""
    config = os.path.join(folder, "server.conf")
    with open(config, "w", encoding="ascii") as file:
        file.write('listen: "127.0.0.1:-1"\n'
                   'jetstream { store_dir: "%s", max_memory_store: 64MB }\n' % folder)
    server = Program(nats_server(), "-c", config, "--ports_file_dir", folder)

    def ports():
        return [name for name in glob.glob(os.path.join(folder, "*.ports"))
                if os.path.getsize(name) > 0]
    if not wait_until(ports):
        raise RuntimeError("nats-server does not come up: " + server.output())
    with open(ports()[0], encoding="ascii") as file:
        return server, json.load(file)["nats"][0]


def wait_until(condition, patience=PATIENCE):
    end = time.monotonic() + patience
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.05)
    return False


def rows_of_map():
    return WAREHOUSE.split()


def robots_of_map():
    """(start x, start y, goal x, goal y) of every robot, y from the top."""
    robots = []
    for y, row in enumerate(rows_of_map()):
        if "S" in row:
            robots.append((row.index("S"), y, row.index("G"), y))
    return robots


def write_instance(directory):
    """Writes the warehouse as a MovingAI .map and .scen and returns their paths."""
    return write_files(directory, rows_of_map(), robots_of_map())


def write_hard_instance(directory):
    """The same for an instance that nobody solves optimally within minutes."""
    robots = [tuple(int(value) for value in start + end) for start, end in hard_robots()]
    return write_files(directory, ["." * HARD_SIDE] * HARD_SIDE, robots)


def write_files(directory, rows, robots):
    map_path = os.path.join(directory, "test.map")
    scen_path = os.path.join(directory, "test.scen")
    letters = str.maketrans("#", "@")
    with open(map_path, "w", encoding="ascii") as file:
        file.write("type octile\nheight %d\nwidth %d\nmap\n" % (len(rows), len(rows[0])))
        file.writelines(row.translate(letters) + "\n" for row in rows)
    with open(scen_path, "w", encoding="ascii") as file:
        file.write("version 1\n")
        for cells in robots:
            file.write("0\ttest.map\t%d\t%d\t%d\t%d\t%d\t%d\t0\n" %
                       ((len(rows[0]), len(rows)) + cells))
    return map_path, scen_path


def free_map(width, height=None):
    """Cells of 1 m, all of them free; a square when there is no height."""
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    grid.info.width, grid.info.height = width, height or width
    grid.info.resolution = 1.0
    grid.info.origin.orientation.w = 1.0
    grid.data = bytes(grid.info.width * grid.info.height)
    return grid


def warehouse_goal(with_map=True):
    rows = rows_of_map()
    goal = PlanPathsGoal()
    if with_map:
        goal.map = free_map(len(rows[0]), len(rows))
        goal.map.data = [100 if cell == "#" else 0 for row in reversed(rows) for cell in row]
    for index, (start_x, start_y, goal_x, goal_y) in enumerate(robots_of_map()):
        task = RobotTask(robot_id="robot_%d" % index)
        for pose, x, y in ((task.start, start_x, start_y), (task.goal, goal_x, goal_y)):
            pose.header.frame_id = "map"
            pose.pose.position.x = x + 0.5
            pose.pose.position.y = len(rows) - y - 0.5
            pose.pose.orientation.w = 1.0
        goal.robots.append(task)
    return goal


def hard_robots():
    """Start and goal of each robot."""
    shuffle = random.Random(1)
    cells = [(x, y) for x in range(HARD_SIDE) for y in range(HARD_SIDE)]
    return zip(shuffle.sample(cells, HARD_ROBOTS), shuffle.sample(cells, HARD_ROBOTS))


def hard_goal():
    """An open square full of robots: nobody finds an optimal plan within minutes."""
    goal = ecbs_goal(HARD_SIDE, hard_robots())
    goal.options.split = "none"
    goal.options.suboptimality = 1.0
    return goal


def crowd_goal():
    """200 robots, planned for in pieces of a tenth of a second and more."""
    draw = random.Random(1)
    cells = [(x, y) for x in range(40) for y in range(40)]
    goal = ecbs_goal(40, zip(draw.sample(cells, 200), draw.sample(cells, 200)))
    goal.options.split = "2s4t"
    goal.options.suboptimality = 1.02
    return goal


def ecbs_goal(side, robots):
    """For robots on an open square, each with start and goal."""
    goal = PlanPathsGoal(map=free_map(side))
    for start, end in robots:
        task = RobotTask()
        for pose, (x, y) in ((task.start, start), (task.goal, end)):
            pose.pose.position.x, pose.pose.position.y = x + 0.5, y + 0.5
            pose.pose.orientation.w = 1.0
        goal.robots.append(task)
    goal.options.solver = "ecbs"
    goal.options.objective = "sum_of_costs"
    return goal


class SentGoal:
    """A goal that was sent, and its end."""

    def __init__(self, client, goal):
        self.handle = client.send_goal(goal)

    def is_active(self):
        return self.handle.get_comm_state() == actionlib.CommState.ACTIVE

    def is_pending(self):
        return self.handle.get_comm_state() == actionlib.CommState.PENDING

    def wait_for_end(self, patience=PATIENCE):
        return wait_until(
            lambda: self.handle.get_comm_state() == actionlib.CommState.DONE, patience)

    def state(self):
        return GoalStatus.to_string(self.handle.get_terminal_state())

    def result(self):
        return self.handle.get_result()


def action_client():
    client = actionlib.ActionClient("split_mapf/plan_paths", PlanPathsAction)
    if not client.wait_for_server(rospy.Duration(PATIENCE)):
        raise RuntimeError("no action server")
    return client


class Recorder:
    """Keeps the messages of a topic."""

    def __init__(self, topic, kind):
        self.messages = []
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append)

    def wait_for(self, count=1, patience=PATIENCE):
        return wait_until(lambda: len(self.messages) >= count, patience)

    def close(self):
        self.subscriber.unregister()


def robots_of(array):
    """Positions of the robots' marker."""
    for marker in array.markers:
        if marker.ns == "robots":
            return [(point.x, point.y) for point in marker.points]
    return []
