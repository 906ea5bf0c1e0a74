#!/usr/bin/env python3
"""How the planner node starts and ends: parameters, signals, rosnode kill, diagnostics."""

import importlib.util
import os
import signal
import tempfile
import unittest

import roslib.packages
import rosnode
import rospy
import rosunit
from diagnostic_msgs.msg import DiagnosticArray

from ros_processes import (Recorder, SentGoal, action_client, crowd_goal, hard_goal, nats_server,
                           start_nats_server, start_program, wait_until, warehouse_goal)
from split_mapf.msg import PlanOutcome
from split_mapf.srv import ListSolvers


def latest(diagnostics):
    """What the planner reported last."""
    for message in reversed(diagnostics.messages):
        for status in message.status:
            if status.name == "split_mapf: planner":
                return dict(((pair.key, pair.value) for pair in status.values),
                            level=status.level, summary=status.message)
    return {}


class Lifecycle(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("lifecycle_rostest")

    def setUp(self):
        if rospy.has_param("/split_mapf"):
            rospy.delete_param("/split_mapf")

    def start(self, *arguments, env=None):
        program = start_program("planner_node", *arguments, env=env)
        self.addCleanup(program.end)
        return program

    def start_ready(self, *arguments, env=None):
        program = self.start(*arguments, env=env)
        self.assertTrue(program.wait_for_output("ready:"), program.output())
        return program

    def assert_ends_well(self, end):
        """A running and a waiting goal get their ends before the node has its own."""
        planner = self.start_ready("_threads:=1")
        client = action_client()
        running = SentGoal(client, hard_goal())
        self.assertTrue(wait_until(running.is_active), planner.output())
        waiting = SentGoal(client, warehouse_goal())
        self.assertTrue(wait_until(waiting.is_pending), planner.output())
        end(planner)
        self.assertEqual(planner.wait(), 0, planner.output())
        for goal, state in ((running, "PREEMPTED"), (waiting, "RECALLED")):
            self.assertTrue(goal.wait_for_end(), planner.output())
            self.assertEqual(goal.state(), state)
            self.assertEqual(goal.result().outcome, PlanOutcome.CANCELLED)

    def test_ends_every_goal_on_sigint(self):
        self.assert_ends_well(lambda planner: planner.signal(signal.SIGINT))

    def test_ends_every_goal_on_sigterm(self):
        self.assert_ends_well(lambda planner: planner.signal(signal.SIGTERM))

    def test_ends_every_goal_on_rosnode_kill(self):
        self.assert_ends_well(lambda planner: rosnode.kill_nodes(["/split_mapf"]))

    def test_replay_ends_on_sigterm(self):
        replay = start_program("replay_node")
        self.addCleanup(replay.end)
        self.assertTrue(replay.wait_for_output("waiting for a plan"), replay.output())
        replay.signal(signal.SIGTERM)
        self.assertEqual(replay.wait(), 0)

    def test_refuses_bad_parameters_naming_them(self):
        for argument, expected in (("_time_limit:=soon", "~time_limit"),
                                   ("_threads:=-2", "~threads"),
                                   ("_solver:=oracle", "oracle"),
                                   ("_split:=8q", "8q"),
                                   ("_map_file:=/nowhere.map", "/nowhere.map"),
                                   ("_workers:=localhost", "workers: "),
                                   ("_max_queued_goals:=0", "~max_queued_goals")):
            planner = self.start(argument)
            self.assertEqual(planner.wait(), 1, argument)
            self.assertIn(expected, planner.output())
            rospy.delete_param("/split_mapf")
        rospy.set_param("/split_mapf/solver_plugins", ["a/B"])
        planner = self.start()
        self.assertEqual(planner.wait(), 1)
        self.assertIn("~solver_plugins: class 'a/B' is declared by no package", planner.output())
        replay = start_program("replay_node", "_rate:=fast")
        self.addCleanup(replay.end)
        self.assertEqual(replay.wait(), 1)
        self.assertIn("~rate", replay.output())
        rospy.delete_param("/replay")

    def test_warns_of_misspelt_parameters(self):
        planner = self.start_ready("_time_limt:=3")
        self.assertIn("~time_limt is not one of this node", planner.output())

    def test_reports_diagnostics(self):
        diagnostics = Recorder("/diagnostics", DiagnosticArray)
        self.addCleanup(diagnostics.close)
        planner = self.start_ready("_threads:=2", "_max_queued_goals:=3")
        client = action_client()
        for options in ({"solver": "oracle"}, {}):
            self.assertTrue(self.plan(client, **options).wait_for_end(), planner.output())
        self.assertTrue(wait_until(lambda: latest(diagnostics).get("goals finished") == "2"),
                        latest(diagnostics))
        values = latest(diagnostics)
        self.assertEqual(values["level"], 0)
        self.assertEqual(values["summary"], "ready")
        self.assertEqual(values["workers"], "2")
        self.assertEqual(values["goals allowed"], "3")
        self.assertEqual(values["goals running"], "0")
        self.assertEqual(values["last outcome"], "SUCCEEDED")
        self.assertEqual(values["last outcomes"], "SUCCEEDED, UNKNOWN_SOLVER")
        self.assertEqual(values["plug-in searches that do not stop"], "0")
        self.assertGreater(float(values["memory [MiB]"]), 1)

    def start_worker(self):
        """With a server of its own. Returns the server and its URL."""
        if nats_server() is None:
            self.skipTest("no nats-server is installed")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        server, url = start_nats_server(folder.name)
        self.addCleanup(server.end)
        worker = start_program("split_mapf", "worker", "--threads", "1", "--server", url)
        self.addCleanup(worker.end)
        if not worker.wait_for_output("ready") and "libnats" in worker.output():
            self.skipTest("the node was built without libnats")
        self.assertIn("ready", worker.output(), server.output())
        return server, url

    def cells_of_crowd(self, planner):
        """Of a plan with pieces that are worth a journey to a worker."""
        sent = SentGoal(action_client(), crowd_goal())
        self.assertTrue(sent.wait_for_end(), planner.output())
        result = sent.result()
        self.assertEqual(result.outcome, PlanOutcome.SUCCEEDED, result.message)
        self.assertGreater(result.statistics.subproblems, 1)
        return [path.cells for path in result.plan.paths]

    def test_workers_elsewhere_help_and_nobody_depends_on_them(self):
        server, url = self.start_worker()
        diagnostics = Recorder("/diagnostics", DiagnosticArray)
        self.addCleanup(diagnostics.close)
        alone = self.start_ready("_threads:=1")
        cells = self.cells_of_crowd(alone)
        alone.end()
        self.assertNotIn("pieces asked of workers elsewhere", latest(diagnostics))
        planner = self.start_ready("_threads:=1", "_workers:=" + url)

        def is_answered():
            return int(latest(diagnostics).get("pieces answered by workers elsewhere", 0)) > 0
        for _ in range(10):  # a busy machine may have none left for the worker
            self.assertEqual(self.cells_of_crowd(planner), cells)
            if wait_until(is_answered, 2):
                break
        self.assertTrue(is_answered(), latest(diagnostics))
        self.assertEqual(latest(diagnostics)["level"], 0)

        server.end()
        self.assertTrue(planner.wait_for_output("pieces are solved here"), planner.output())
        self.assertEqual(self.cells_of_crowd(planner), cells)
        self.assertTrue(wait_until(
            lambda: latest(diagnostics)["summary"].startswith("workers elsewhere cannot be asked")))
        self.assertEqual(latest(diagnostics)["level"], 1)

    def test_takes_new_defaults_for_the_next_goal(self):
        if importlib.util.find_spec("split_mapf.cfg") is None:
            self.skipTest("the node was built without dynamic_reconfigure")
        from dynamic_reconfigure.client import Client  # pylint: disable=import-outside-toplevel
        planner = self.start_ready("_threads:=1", "_robot_speed:=2.0", "_solver:=ecbs",
                                   "_time_limit:=50")
        defaults = Client("/split_mapf", timeout=60)
        shown = defaults.get_configuration(timeout=60)
        self.assertEqual((shown["solver"], shown["time_limit"], shown["step_duration"]),
                         ("ecbs", 50, 0), "what the node was started with")
        client = action_client()
        hard = hard_goal()
        hard.options.solver = ""
        running = SentGoal(client, hard)
        self.assertTrue(wait_until(running.is_active), planner.output())
        shown = defaults.update_configuration({"solver": "lacam", "step_duration": 0.5})
        self.assertEqual((shown["solver"], shown["step_duration"]), ("lacam", 0.5))
        running.handle.cancel()
        self.assertTrue(running.wait_for_end(), planner.output())
        self.assertEqual(running.result().statistics.solver, "ecbs", "a running goal keeps its own")
        after = SentGoal(client, warehouse_goal())
        self.assertTrue(after.wait_for_end(), planner.output())
        self.assertEqual(after.result().statistics.solver, "lacam")
        self.assertEqual(after.result().plan.step_duration, 0.5)

        # What the options refuse leaves all as it was.
        shown = defaults.update_configuration({"solver": "oracle", "seed": 9})
        self.assertEqual((shown["solver"], shown["seed"]), ("lacam", 0))
        self.assertTrue(planner.wait_for_output("stay as they are: solver 'oracle' is unknown"))
        shown = defaults.update_configuration({"time_limit": 1e12, "step_duration": 1e-9})
        self.assertEqual((shown["time_limit"], shown["step_duration"]), (50, 0.5))
        # Each alone: nothing beside it is at fault, and none may be bent into a value that is taken.
        for name, value in (("time_limit", -5.0), ("time_limit", 1e12), ("suboptimality", 0.5),
                            ("seed", -1), ("ignore_specks", -1), ("unknown_space", 7),
                            ("occupied_threshold", 300)):
            before = shown[name]
            shown = defaults.update_configuration({name: value})
            self.assertEqual(shown[name], before, planner.output())
            self.assertTrue(planner.wait_for_output(
                "stay as they are: %s %.6g is out of range" % (name, value)), planner.output())

    def test_the_next_node_starts_with_what_was_reconfigured(self):
        if importlib.util.find_spec("split_mapf.cfg") is None:
            self.skipTest("the node was built without dynamic_reconfigure")
        from dynamic_reconfigure.client import Client  # pylint: disable=import-outside-toplevel
        rospy.set_param("/split_mapf", {"solver": "ecbs", "solver_options": ["joint=false"],
                                        "split": "2t", "split_options": ["check=always"]})
        planner = self.start_ready()
        defaults = Client("/split_mapf", timeout=60)
        shown = defaults.update_configuration({"time_limit": 20.0})
        self.assertEqual(shown["time_limit"], 20)
        self.assertEqual(rospy.get_param("/split_mapf/solver_options"), ["joint=false"])
        # Neither takes the options of the other.
        shown = defaults.update_configuration({"solver": "lacam", "split": "none"})
        self.assertEqual((shown["solver"], shown["split"]), ("lacam", "none"), planner.output())
        self.assertEqual(rospy.get_param("/split_mapf/solver_options"), [])
        self.assertEqual(rospy.get_param("/split_mapf/split_options"), [])
        planner.end()
        self.start_ready()

    def test_a_speed_alone_derives_the_step_also_in_the_next_node(self):
        self.start_ready().end()
        planner = self.start_ready("_robot_speed:=0.5")
        goal = SentGoal(action_client(), warehouse_goal())
        self.assertTrue(goal.wait_for_end(), planner.output())
        self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED, goal.result().message)
        self.assertEqual(goal.result().plan.step_duration, 2)

    def start_with_plugins(self, *arguments):
        """With the packages of plug-ins, which stand in the test folder, where ROS looks for some."""
        folder = os.path.join(roslib.packages.get_pkg_dir("split_mapf"), "test")
        packages = [os.path.join(folder, name) for name in ("downstream", "plugin/misbehaving")]
        rospy.set_param("/split_mapf/solver_plugins", [
            "split_mapf_downstream/OneByOne", "split_mapf_downstream/EveryOther", "misbehaving/Solver"])
        return self.start_ready(
            *arguments,
            env={"ROS_PACKAGE_PATH": ":".join(packages + [os.environ["ROS_PACKAGE_PATH"]])})

    def plan(self, client, **options):
        goal = warehouse_goal()
        for name, value in options.items():
            setattr(goal.options, name, value)
        return SentGoal(client, goal)

    def test_plans_by_solvers_of_other_packages(self):
        planner = self.start_with_plugins("_threads:=1")
        rospy.wait_for_service("/split_mapf/list_solvers", 60)
        listed = rospy.ServiceProxy("/split_mapf/list_solvers", ListSolvers)()
        for name in ("one_by_one", "misbehaving", "lacam"):
            self.assertIn(name, listed.names)
        client = action_client()
        for options in ({"solver": "one_by_one"}, {"solver": "lacam", "split": "every_other"}):
            goal = self.plan(client, **options)
            self.assertTrue(goal.wait_for_end(), planner.output())
            self.assertEqual(goal.result().outcome, PlanOutcome.SUCCEEDED, goal.result().message)
        thrown = self.plan(client, solver="misbehaving", solver_options=["how=throw"])
        self.assertTrue(thrown.wait_for_end(), planner.output())
        self.assertEqual(thrown.result().outcome, PlanOutcome.NO_PLAN_FOUND)
        self.assertIn("threw: no oil", thrown.result().message)

        # One that hangs ends at its limit, others go on, and so does the node, until it is told to end.
        hung = self.plan(client, solver="misbehaving", solver_options=["how=hang"], time_limit=0.2)
        self.assertTrue(hung.wait_for_end(), planner.output())
        self.assertEqual(hung.result().outcome, PlanOutcome.TIMEOUT)
        self.assertIn("did not stop at its deadline", hung.result().message)
        other = self.plan(client)
        self.assertTrue(other.wait_for_end(), planner.output())
        self.assertEqual(other.result().outcome, PlanOutcome.SUCCEEDED, other.result().message)
        planner.signal(signal.SIGTERM)
        self.assertEqual(planner.wait(), 0, planner.output())
        self.assertIn("1 searches of plug-ins do not stop", planner.output())

    def test_holds_its_memory_over_many_goals(self):
        planner = self.start_ready("_threads:=1")
        client = action_client()

        def memory():
            with open("/proc/%d/statm" % planner.process.pid, encoding="ascii") as file:
                return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2 ** 20

        def threads():
            return len(os.listdir("/proc/%d/task" % planner.process.pid))
        for _ in range(20):
            self.assertTrue(SentGoal(client, warehouse_goal()).wait_for_end())
        before, threads_before = memory(), threads()
        for _ in range(60):
            self.assertTrue(SentGoal(client, warehouse_goal()).wait_for_end())
        self.assertLess(memory() - before, 20)
        self.assertLessEqual(threads(), threads_before + 2)


if __name__ == "__main__":
    rosunit.unitrun("split_mapf", "lifecycle_rostest", Lifecycle)
