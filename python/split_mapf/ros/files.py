"""Map and scenario files as messages. `split_mapf convert` reads them, as all commands do."""

import array
import base64
import json
import math
import os
import subprocess
import sys

import roslib.packages
from nav_msgs.msg import OccupancyGrid

from split_mapf.errors import InputError
from split_mapf.ros.fleet import NoAnswer


def read_map(path, resolution=None):
    """A MovingAI .map or map_server .yaml as an OccupancyGrid in frame `map`. @param resolution  side
    of a cell of a .map in metres (1). @throws InputError as the command, NoAnswer without it."""
    return grid_of(convert(("map", path), ("resolution", resolution)))


def read_instance(map_path, scenario_path, agents=0, resolution=None, size=None):
    """A map (None without `map_path`: then `size` is its "WIDTHxHEIGHT") and the robots of a
    scenario, of its first `agents` rows or of all (0): a list of [start x, start y, goal x, goal y]
    with y from the top, as in the file; or, of a .yaml of poses, of dicts with `id`, `start` and
    `goal` [x, y, yaw] and `radius`. @throws as read_map()."""
    read = convert(("map", map_path), ("resolution", resolution), ("size", size),
                   ("scen", scenario_path), ("agents", agents))
    rows = read["robots"] if "robots" in read else [
        start + goal for start, goal in zip(read["starts"], read["goals"])]
    return grid_of(read) if map_path else None, rows


def find_command():
    """The command: catkin puts it beside this package's programs."""
    beside = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "split_mapf")
    if os.path.isfile(beside):
        return beside
    places = roslib.packages.find_node("split_mapf", "split_mapf")
    if not places:
        raise NoAnswer("the command split_mapf, which reads maps and scenarios, is neither at %s "
                       "nor elsewhere in the package; build or install it" % beside)
    return places[0]


def convert(*options):
    """What the command reads from the files that the options name."""
    call = [find_command(), "convert"]
    for name, value in options:
        if value:
            call += ["--" + name, str(value)]
    done = subprocess.run(call, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        message = done.stderr.decode("utf-8", "replace").strip().replace("split_mapf: ", "", 1)
        error = InputError if done.returncode == 1 else NoAnswer
        raise error(message or "%s ended with code %d" % (call[0], done.returncode))
    return json.loads(done.stdout.decode("utf-8"))


def grid_of(read):
    """A map as an OccupancyGrid in frame `map`; its last row is the message's first."""
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    width, height = grid.info.width, grid.info.height = read["width"], read["height"]
    grid.info.resolution = read["resolution"]
    x, y, yaw = read["origin"]
    grid.info.origin.position.x, grid.info.origin.position.y = x, y
    grid.info.origin.orientation.z = math.sin(yaw / 2)
    grid.info.origin.orientation.w = math.cos(yaw / 2)
    cells = array.array("b", base64.b64decode(read["occupancy"]))
    grid.data = array.array("b")
    for row in reversed(range(height)):
        grid.data += cells[row * width:(row + 1) * width]
    return grid
