"""Who is too close to whom, as those know who move the robots."""

import itertools
import math


def tell_who_is_too_close(robots, least):
    """Prints two robots that are closer. `robots` have x and y [m] and are found by their names."""
    for (name, one), (other_name, other) in itertools.combinations(robots.items(), 2):
        apart = math.hypot(one.x - other.x, one.y - other.y)
        if apart < least:
            print("too close: %s, %s: %g" % (name, other_name, apart), flush=True)
