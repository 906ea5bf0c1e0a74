#!/usr/bin/env python3
"""Plans every goal of a bag (roslaunch split_mapf record.launch) again, and compares outcome, costs
and plan with what was recorded.

The goals go to a planner node that runs, with the options that their results say were used, so that
its own parameters have no say (but for a seed of 0, empty lists of options, and poses). Results of an
older version, and of goals that were refused before they were planned, have none: the goal's own are
sent then; start the node with the parameters of the recording. A goal without a map gets the one that
the topic had. The same goal has the same plan at any number of threads, unless the
clock cut the search (a time limit, refine_time) or the planner is another version; a bag with another
map than the result was planned on is told apart, and so is another version.

exit codes: 0 all are the same, 1 bad usage or no such bag, 2 some differ, 4 Ctrl-C, 5 no answer from
the node
"""

import argparse
import collections
import copy
import sys

import rosbag
import rospy

import split_mapf.ros as mapf
from split_mapf.msg import PlanOutcome
from split_mapf.ros.fleet import OUTCOME_NAMES

Recorded = collections.namedtuple("Recorded", "id goal result")


def read_goals(path, action, map_topic):
    """The goals of a bag with their results (None: it has none), in order."""
    goals, results = collections.OrderedDict(), {}
    grid = None
    with rosbag.Bag(path) as bag:
        for topic, message, _ in bag.read_messages([map_topic, action + "/goal",
                                                    action + "/result"]):
            if topic == map_topic:
                grid = message
            elif topic.endswith("/goal"):
                if not message.goal.map.data and grid is not None:
                    message.goal.map = grid
                goals.setdefault(message.goal_id.id, message.goal)
            else:
                results.setdefault(message.status.goal_id.id, message.result)
    return [Recorded(key, goal, results.get(key)) for key, goal in goals.items()]


def used(statistics):
    """Version, map and seed that a result tells; empty where it is of a version that told none."""
    return {name: getattr(statistics, name) for name in ("version", "map_hash", "seed")
            if getattr(statistics, "version", "")}


def differences(recorded, answer):
    """What is not as it was recorded, a sentence each; what explains the others first."""
    found = []
    plan = answer.plan
    was, now = used(recorded.statistics), used(answer.statistics)
    for name, words in (("version", "planned by version %s, recorded by %s"),
                        ("map_hash", "planned on map %s, recorded on %s"),
                        ("seed", "planned with seed %s, recorded with %s: set the node's parameter")):
        if was and now and was[name] != now[name]:
            found.append(words % (now[name], was[name]))
    if recorded.outcome != answer.outcome:
        found.append("outcome %s, recorded %s: %s" % (
            answer.outcome_name, OUTCOME_NAMES.get(recorded.outcome, recorded.outcome),
            answer.message))
    for name in ("makespan", "sum_of_costs"):
        was, now = getattr(recorded.plan, name), getattr(plan, name)
        if was != now:
            found.append("%s %d, recorded %d" % (name, now, was))
    was = {path.robot_id: path for path in recorded.plan.paths}
    now = {path.robot_id: path for path in plan.paths}
    if was.keys() != now.keys():
        found.append("%d robots, recorded %d; of one only: %s" %
                     (len(now), len(was), ", ".join(sorted(was.keys() ^ now.keys())[:10])))
    others = [name for name in was if name in now and not is_same_way(was[name], now[name])]
    if others:
        first = others[0]
        found.append("%d of %d robots take another way, the first is '%s', from step %d on" %
                     (len(others), len(was), first, first_step(was[first], now[first])))
    return found


def is_same_way(one, other):
    return (one.cells == other.cells and place_of(one.start) == place_of(other.start) and
            place_of(one.goal) == place_of(other.goal) and one.radius == other.radius)


def place_of(pose):
    """Messages of a bag have classes of their own, and are never equal to others."""
    return pose.position.x, pose.position.y, pose.orientation.z, pose.orientation.w


def first_step(one, other):
    for step, (cell, other_cell) in enumerate(zip(one.cells, other.cells)):
        if cell != other_cell:
            return step
    return min(len(one.cells), len(other.cells))


def options_used(recorded):
    """The options that the goal was planned with, the node's defaults among them; its own where the result
    tells none."""
    return recorded.result.statistics.options if used(recorded.result.statistics) else recorded.goal.options


def is_cut_by_the_clock(recorded):
    return (options_used(recorded).refine_time > 0 or
            recorded.result.outcome in (PlanOutcome.TIMEOUT, PlanOutcome.CANCELLED))


def resolve(fleet, recorded):
    """Plans a goal again and says how it compares. True where nothing differs."""
    goal = recorded.goal
    print("goal %s: %d robots, %dx%d cells" %
          (recorded.id, len(goal.robots), goal.map.info.width, goal.map.info.height))
    if recorded.result is None:
        print("  the bag has no result of it: not compared")
        return True
    told = used(recorded.result.statistics)
    if told:
        print("  recorded by version %(version)s, map %(map_hash)s, seed %(seed)d" % told)
        goal = copy.copy(goal)
        goal.options = options_used(recorded)
    sent = fleet.send_goal(goal)
    try:
        answer = sent.wait()
    except KeyboardInterrupt:
        sent.cancel()
        raise
    found = differences(recorded.result, answer)
    for text in found:
        print("  " + text)
    if not found:
        print("  the same: %s, makespan %d, sum of costs %d" %
              (answer.outcome_name, answer.plan.makespan, answer.plan.sum_of_costs))
    elif is_cut_by_the_clock(recorded):
        print("  the clock had its say in the recording: it may differ each time")
    return not found


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag", metavar="BAG")
    parser.add_argument("--action", default="/split_mapf/plan_paths",
                        help="name of the action in the bag (/split_mapf/plan_paths)")
    parser.add_argument("--server", default="split_mapf/plan_paths",
                        help="name of the action that plans again (split_mapf/plan_paths)")
    parser.add_argument("--map-topic", default="/map", help="in the bag (/map)")
    parser.add_argument("--wait", type=float, default=20.0, metavar="SECONDS",
                        help="patience until the node is there (20)")
    try:
        args = parser.parse_args(rospy.myargv()[1:])
    except SystemExit as end:
        raise SystemExit(1 if end.code else 0) from end
    try:
        goals = read_goals(args.bag, args.action.rstrip("/"), args.map_topic)
    except (OSError, rosbag.ROSBagException) as error:
        print("resolve_bag: %s: %s" % (args.bag, error), file=sys.stderr)
        return 1
    if not goals:
        print("resolve_bag: %s has no goal on %s/goal" % (args.bag, args.action), file=sys.stderr)
        return 1
    try:
        fleet = mapf.Fleet(args.server, args.wait)
        same = [resolve(fleet, recorded) for recorded in goals]
    except mapf.NoAnswer as error:
        print("resolve_bag: %s" % error, file=sys.stderr)
        return 5
    except KeyboardInterrupt:
        return 4
    finally:
        rospy.signal_shutdown("done")
    print("%d of %d goals as recorded" % (sum(same), len(same)))
    return 0 if all(same) else 2


if __name__ == "__main__":
    sys.exit(main())
