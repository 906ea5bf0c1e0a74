"""From cells of a map to metres of its frame and back, and robots at either."""

import math

from geometry_msgs.msg import PoseStamped

from split_mapf.errors import InputError
from split_mapf.msg import RobotTask

try:
    import numpy
except ImportError:
    numpy = None


class Place:
    """Where a map lies: an OccupancyGrid, or the grid of a MultiRobotPlan."""

    def __init__(self, message):
        self.info = message.info if hasattr(message, "info") else message.grid
        self.frame = message.header.frame_id or "map"
        turn = self.info.origin.orientation
        # All zero means no rotation; a quaternion of another length is the planner's to refuse.
        self.yaw = 2 * math.atan2(turn.z, turn.w) if turn.z or turn.w else 0.0

    def metres(self, cell):
        """The centre of a cell (x, y), in metres of the map's frame."""
        x, y = ((value + 0.5) * self.info.resolution for value in cell)
        sine, cosine = math.sin(self.yaw), math.cos(self.yaw)
        origin = self.info.origin.position
        return (origin.x + cosine * x - sine * y, origin.y + sine * x + cosine * y)

    def cell(self, x, y):
        """The cell that contains a point of the map's frame. @throws InputError outside the map."""
        sine, cosine = math.sin(self.yaw), math.cos(self.yaw)
        x_from, y_from = x - self.info.origin.position.x, y - self.info.origin.position.y
        cell = (math.floor((cosine * x_from + sine * y_from) / self.info.resolution),
                math.floor((cosine * y_from - sine * x_from) / self.info.resolution))
        self.require(cell, "(%g, %g) m" % (x, y))
        return cell

    def require(self, cell, what):
        """@throws InputError, which names `what`, where the map does not have the cell."""
        if not (0 <= cell[0] < self.info.width and 0 <= cell[1] < self.info.height):
            raise InputError("%s lies outside the map of %dx%d cells" %
                             (what, self.info.width, self.info.height))

    def cells_of(self, path):
        """The cells of a RobotPath, one a step: an array [step, (x, y)], or a list of pairs."""
        width = self.info.width
        if numpy is None:
            return [(cell % width, cell // width) for cell in path.cells]
        cells = numpy.asarray(path.cells, numpy.int64)
        return numpy.stack([cells % width, cells // width], axis=1)

    def metres_of(self, path):
        """Where the robot of a RobotPath is at each step [m]: its poses where they were asked for
        (`fill_poses`), else the centres of its cells."""
        if path.path.poses:
            points = [(pose.pose.position.x, pose.pose.position.y) for pose in path.path.poses]
        else:
            points = [self.metres(cell) for cell in self.cells_of(path)]
        return points if numpy is None else numpy.array(points, float).reshape(-1, 2)

    def pose(self, x, y, yaw=None):
        """A pose of the map's frame; without a heading where there is none."""
        pose = PoseStamped()
        pose.header.frame_id = self.frame
        pose.pose.position.x, pose.pose.position.y = float(x), float(y)
        if yaw is not None:
            pose.pose.orientation.z, pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        return pose


def robots_at_cells(map, starts, goals, ids=None):  # pylint: disable=redefined-builtin
    """The robots of a goal, which go from the centres of cells to those of others. Without `ids`
    their names are r0, r1, ... @throws InputError for a cell outside the map."""
    place = Place(map)
    robots = []
    for index, (start, goal) in enumerate(_pairs(starts, goals)):
        name = ids[index] if ids else "r%d" % index
        ends = []
        for role, cell in (("start", start), ("goal", goal)):
            column, row = _whole_pair(name, role, cell)
            place.require((column, row), "robot '%s': its %s (%d,%d)" % (name, role, column, row))
            ends.append(place.pose(*place.metres((column, row))))
        robots.append(RobotTask(robot_id=name, start=ends[0], goal=ends[1]))
    return robots


def robots_at_poses(starts, goals, ids=None, radii=None, frame="map"):
    """The robots of a goal, which go from poses to poses: (x, y) or (x, y, yaw), in metres and
    radians of the frame. `radii` [m]: one a robot; 0 is the one of the options."""
    place = Place(_NoMap(frame))
    robots = []
    for index, (start, goal) in enumerate(_pairs(starts, goals)):
        name = ids[index] if ids else "r%d" % index
        for role, pose in (("start", start), ("goal", goal)):
            if len(pose) not in (2, 3):
                raise InputError("robot '%s': its %s is %s; (x, y) or (x, y, yaw) is expected" %
                                 (name, role, pose))
        robots.append(RobotTask(robot_id=name, start=place.pose(*start), goal=place.pose(*goal),
                                radius=float(radii[index]) if radii else 0.0))
    return robots


class _NoMap:
    """Stands for a map of which nothing matters but its frame."""

    def __init__(self, frame):
        from nav_msgs.msg import MapMetaData
        from std_msgs.msg import Header

        self.header = Header(frame_id=frame)
        self.info = MapMetaData()


def _pairs(starts, goals):
    starts, goals = list(starts), list(goals)
    if len(starts) != len(goals):
        raise InputError("%d starts but %d goals: one of each a robot is needed" %
                         (len(starts), len(goals)))
    return zip(starts, goals)


def _whole_pair(name, role, cell):
    try:
        column, row = cell
        if int(column) == column and int(row) == row:
            return int(column), int(row)
    except (TypeError, ValueError, OverflowError):
        pass
    raise InputError("robot '%s': its %s is %r; two whole numbers (x, y) are expected" %
                     (name, role, cell))
