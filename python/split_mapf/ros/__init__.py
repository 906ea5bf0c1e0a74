"""A client of the planner node.

    import split_mapf.ros as mapf
    fleet = mapf.Fleet()
    grid = fleet.map()
    robots = mapf.robots_at_cells(grid, starts=[(2, 3), (9, 3)], goals=[(9, 3), (2, 3)])
    answer = fleet.plan(robots, grid)
    print(answer.message, answer.paths)

Cells are (x, y) in the order of an OccupancyGrid: x is the column, y the row from the bottom.
"""

from .files import read_instance, read_map
from .fleet import Answer, Fleet, Goal, NoAnswer, make_options
from .plan_document import document_of
from .places import Place, robots_at_cells, robots_at_poses

__all__ = ["Answer", "Fleet", "Goal", "NoAnswer", "Place", "document_of", "make_options",
           "read_instance", "read_map", "robots_at_cells", "robots_at_poses"]
