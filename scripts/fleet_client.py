#!/usr/bin/env python3
"""Has the fleet carry out the plan on the topic `plan`, and shows how it goes. Ctrl-C cancels: robots
stop at the end of what is released to them.

exit codes: 0 all robots arrived, 1 bad usage, 2 some did not, 4 cancelled, 5 no plan or no answer
"""

import argparse
import sys

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus

from split_mapf.msg import (ExecutePlanAction, ExecutePlanGoal, MultiRobotPlan, PlanOutcome)

NAMES = {value: name for name, value in vars(PlanOutcome).items()
         if name.isupper() and isinstance(value, int)}


def show(feedback):
    print("\rarrived %4d   moving %4d   waiting %4d   late %6.1f s " %
          (feedback.arrived, feedback.moving, feedback.waiting, feedback.late), end="", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wait", type=float, default=60.0,
                        help="[s] to wait for the plan and the node (60)")
    parser.add_argument("--action", default="fleet/execute",
                        help="name of the action (fleet/execute)")
    args = parser.parse_args(rospy.myargv()[1:])
    rospy.init_node("fleet_client", disable_signals=True)
    try:
        plan = rospy.wait_for_message("plan", MultiRobotPlan, timeout=args.wait)
    except rospy.ROSException:
        print("fleet_client: no plan on the topic %s within %g s" %
              (rospy.resolve_name("plan"), args.wait), file=sys.stderr)
        return 5
    client = actionlib.SimpleActionClient(args.action, ExecutePlanAction)
    if not client.wait_for_server(rospy.Duration(args.wait)):
        print("fleet_client: no action server %s within %g s; is executor_node running?" %
              (rospy.resolve_name(args.action), args.wait), file=sys.stderr)
        return 5
    print("executing a plan of %d robots, %.0f s" %
          (len(plan.paths), plan.makespan * plan.step_duration))
    try:
        client.send_goal(ExecutePlanGoal(plan=plan), feedback_cb=show)
        while not client.wait_for_result(rospy.Duration(0.2)):
            if rospy.is_shutdown():
                return 5
    except KeyboardInterrupt:
        client.cancel_goal()
        client.wait_for_result(rospy.Duration(30))
    result = client.get_result()
    print()
    if result is None or client.get_state() == GoalStatus.LOST:
        print("fleet_client: the executor gave no answer", file=sys.stderr)
        return 5
    print("%s after %.1f s (planned %.1f s): %s" %
          (NAMES.get(result.outcome, result.outcome), result.duration, result.planned,
           result.message))
    for fault in result.faults[:10]:
        print("  - " + fault.message)
    return {PlanOutcome.SUCCEEDED: 0, PlanOutcome.CANCELLED: 4}.get(result.outcome, 2)


if __name__ == "__main__":
    sys.exit(main())
