#!/usr/bin/env python3
"""Two robots change sides on the map of the topic `map`."""
import split_mapf.ros as mapf
fleet = mapf.Fleet()
grid = fleet.map()
answer = fleet.plan(mapf.robots_at_cells(grid, [(1, 1), (5, 1)], [(5, 1), (1, 1)]), grid)
print(answer.message, answer.paths["r0"])
