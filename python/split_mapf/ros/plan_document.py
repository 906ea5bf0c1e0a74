"""An answer as the JSON that `split_mapf plan --output` writes, for the commands that read it."""

import math

from split_mapf.msg import PlanOutcome

_STATUS = {
    PlanOutcome.SUCCEEDED: "solved",
    PlanOutcome.CANCELLED: "cancelled",
    PlanOutcome.TIMEOUT: "timeout",
    PlanOutcome.UNSOLVABLE: "unsolvable",
    PlanOutcome.UNREACHABLE_GOAL: "unsolvable",
    PlanOutcome.NO_PLAN_FOUND: "no_plan_found",
    PlanOutcome.MEMORY_LIMIT: "memory_limit",
}


def document_of(answer):
    """The fields that an answer carries, as a dict. Cells have y from the top there."""
    plan, statistics = answer.plan, answer.statistics
    width, height = plan.grid.width, plan.grid.height
    document = {
        "status": _STATUS.get(answer.outcome, "error"),
        "message": answer.message,
        "solver": statistics.solver,
        "split": statistics.split,
        "objective": plan.objective,
        "agents": len(plan.paths),
        "makespan": plan.makespan if plan.paths else None,
        "sum_of_costs": plan.sum_of_costs if plan.paths else None,
        "makespan_lower_bound": statistics.makespan_lower_bound,
        "sum_of_costs_lower_bound": statistics.sum_of_costs_lower_bound,
        "proved_lower_bound": statistics.proved_lower_bound,
        "optimal": statistics.optimal,
        "certified_by": statistics.certified_by,
        "runtime_s": statistics.runtime,
        "first_plan_s": statistics.first_plan if plan.paths else None,
        "stages": dict(zip(statistics.stage_names, statistics.stage_seconds)),
        "paths": [[[cell % width, height - 1 - cell // width] for cell in path.cells]
                  for path in plan.paths],
    }
    if plan.longest_step > 0:
        document.update(_discs_of(plan))
    return document


def _discs_of(plan):
    """What is said of robots that have size."""
    origin = plan.grid.origin
    yaw = 2 * math.atan2(origin.orientation.z, origin.orientation.w)
    return {
        "grid": {"resolution": plan.grid.resolution, "width": plan.grid.width,
                 "height": plan.grid.height,
                 "origin": [origin.position.x, origin.position.y, yaw]},
        "robot_radius": plan.robot_radius,
        "clearance": plan.clearance,
        "longest_step": plan.longest_step,
        "step_duration": plan.step_duration,
        "departure_steps": plan.departure_steps,
        "arrival_steps": plan.arrival_steps,
        "robots": [path.robot_id for path in plan.paths],
        "radii": [path.radius for path in plan.paths],
        "least_clearance": [path.least_clearance for path in plan.paths],
        "poses": [[[pose.pose.position.x, pose.pose.position.y] for pose in path.path.poses]
                  for path in plan.paths],
    }
