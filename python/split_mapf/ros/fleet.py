"""The action client of the planner node. All patience is counted by the wall: the node's answer may
take as long as it likes, but a clock of a simulation that stands still keeps nobody waiting."""

import contextlib
import os
import signal
import threading
import time

import actionlib
import rosgraph
import rospy
from actionlib_msgs.msg import GoalStatus
from nav_msgs.msg import OccupancyGrid

from split_mapf.errors import OptionError
from split_mapf.msg import (PlanOptions, PlanOutcome, PlanPathsAction, PlanPathsGoal,
                            PlanPathsResult)
from split_mapf.ros.places import Place

OUTCOME_NAMES = {value: name for name, value in vars(PlanOutcome).items()
                 if name.isupper() and isinstance(value, int)}
_WORDS = {
    "passages": {False: PlanOptions.PASSAGES_OFF, True: PlanOptions.PASSAGES_ON},
    "unknown_space": {"blocked": PlanOptions.UNKNOWN_SPACE_BLOCKED,
                      "free": PlanOptions.UNKNOWN_SPACE_FREE},
}
_TYPES = dict(zip(PlanOptions.__slots__, PlanOptions._slot_types))
_RANGES = {"uint32": (0, 2**32 - 1), "int32": (-2**31, 2**31 - 1), "int8": (-128, 127)}
_POLL = 0.02  # [s]


@contextlib.contextmanager
def _interrupted_later():
    """Ctrl-C comes once this is over: a goal that is just being sent cannot be cancelled."""
    before = signal.getsignal(signal.SIGINT)
    is_heard = threading.current_thread() is threading.main_thread() and before is not None
    if not is_heard:
        yield
        return
    came = []
    signal.signal(signal.SIGINT, lambda *what: came.append(what))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if not came:
        return
    if callable(before):
        before(*came[0])
    else:
        os.kill(os.getpid(), signal.SIGINT)


class NoAnswer(Exception):
    """The ROS master, the planner node, a map or the command is not there."""


class Answer:
    """How a goal ended. True where it has a plan. A goal that was recalled or lost, of which nobody
    reports, has the outcome CANCELLED; `state` tells them apart."""

    def __init__(self, state, result, seconds, lost=""):
        result = result or PlanPathsResult()
        self.state = state
        self.seconds = seconds
        self.outcome, self.message = result.outcome, result.message
        if state in (GoalStatus.RECALLED, GoalStatus.LOST):
            self.outcome = PlanOutcome.CANCELLED
            self.message = lost or result.message or "cancelled before the planner began"
        self.faults, self.plan, self.statistics = result.faults, result.plan, result.statistics

    @property
    def outcome_name(self):
        """Of the constant of PlanOutcome: SUCCEEDED, UNSOLVABLE, ..."""
        return OUTCOME_NAMES.get(self.outcome, str(self.outcome))

    @property
    def state_name(self):
        """Of actionlib: SUCCEEDED, ABORTED, PREEMPTED, RECALLED, REJECTED or LOST."""
        return GoalStatus.to_string(self.state)

    @property
    def paths(self):
        """Robot -> its cells, one a step: an array [step, (x, y)]. Who has arrived stays."""
        place = Place(self.plan)
        return {path.robot_id: place.cells_of(path) for path in self.plan.paths}

    @property
    def metres(self):
        """The same in metres of the map's frame, see Place.metres_of()."""
        place = Place(self.plan)
        return {path.robot_id: place.metres_of(path) for path in self.plan.paths}

    def __bool__(self):
        return bool(self.plan.paths)

    def __repr__(self):
        return "<%s: %s>" % (self.outcome_name, self.message)


class Fleet:
    """A connection to the planner node, for as many goals as you like, from any thread."""

    def __init__(self, action="split_mapf/plan_paths", wait=20.0, resend=1):
        """Makes this process a ROS node if it is none. @param wait  [s] patience with the master and
        the node, now and whenever it has gone. @param resend  how often a goal is sent again to a
        node that came back: planning moves nothing, so that is safe. @throws NoAnswer."""
        self.wait, self.resend = wait, resend
        join_ros(wait)
        self.name = rospy.resolve_name(action)
        self._client = actionlib.ActionClient(action, PlanPathsAction)
        self.find_server()

    def find_server(self):
        """@throws NoAnswer when no planner node is there in time."""
        waiting = threading.Thread(target=self._client.wait_for_server, daemon=True)
        waiting.start()
        waiting.join(self.wait)
        if waiting.is_alive():
            raise NoAnswer("no planner answers on %s within %g s; is planner_node running?" %
                           (self.name, self.wait))

    def has_server(self):
        """Whether the node is connected: the connection of the goal topic ends with it."""
        return self._client.pub_goal.get_num_connections() > 0

    def map(self, topic="map", wait=None):
        """The map on the topic. @throws NoAnswer when none comes."""
        return wait_for_map(topic, self.wait if wait is None else wait)

    def plan(self, robots, map=None, progress=None, **options):  # pylint: disable=redefined-builtin
        """Plans for robots (see robots_at_cells() and robots_at_poses()) and returns the Answer.
        @param map  an OccupancyGrid; None: the node's own, of its topic. @param progress  called
        with feedback, in another thread. @param options  those of PlanOptions by their names; here 0
        means 0. Ctrl-C cancels the goal. @throws NoAnswer when the node is not there."""
        goal = self.send(robots, map, progress, **options)
        try:
            return goal.wait()
        except KeyboardInterrupt:
            goal.cancel()
            goal.wait(2.0)
            raise

    def send(self, robots, map=None, progress=None, **options):  # pylint: disable=redefined-builtin
        """The same without waiting. Returns the Goal."""
        message = PlanPathsGoal(robots=list(robots), options=make_options(**options))
        if map is not None:
            message.map = map
        return self.send_goal(message, progress)

    def send_goal(self, message, progress=None):
        """The same for a PlanPathsGoal."""
        if not self.has_server():
            self.find_server()
        goal = Goal(self, self._client, message, progress)
        try:
            goal.send()
        except KeyboardInterrupt:
            goal.cancel()
            raise
        return goal


class Goal:
    """A goal of Fleet.send_goal()."""

    def __init__(self, fleet, client, message, progress):
        self._fleet, self._client = fleet, client
        self._message, self._progress = message, progress
        self._resends = fleet.resend
        self._began = time.monotonic()
        self._cancelled = False
        self._answer = None
        self._handle = None
        self._sent = self._began

    def send(self):
        """For Fleet.send_goal(). Ctrl-C meanwhile is heard once the goal is on its way."""
        show = self._progress and (lambda _, feedback: self._progress(feedback))
        self._sent = time.monotonic()
        with _interrupted_later():
            self._handle = self._client.send_goal(self._message, feedback_cb=show)

    def cancel(self):
        """Asks the node to stop; the answer comes by wait(), and has a plan if one was found."""
        self._cancelled = True
        if self._handle is not None:
            self._handle.cancel()

    def wait(self, patience=None):
        """The Answer; None when there is none yet after so many seconds."""
        end = float("inf") if patience is None else time.monotonic() + patience
        while self._answer is None:
            if self._handle.get_comm_state() == actionlib.CommState.DONE:
                self._take(self._handle.get_terminal_state(), self._handle.get_result())
            elif not self._fleet.has_server() or self._is_unheard():
                self._take(GoalStatus.LOST, None)
            elif time.monotonic() >= end:
                return None
            else:
                time.sleep(_POLL)
        return self._answer

    def _is_unheard(self):
        """A node that began and went between two looks never says anything of the goal."""
        waits = self._handle.get_comm_state() == actionlib.CommState.WAITING_FOR_GOAL_ACK
        return waits and time.monotonic() - self._sent > self._fleet.wait + 1

    def _take(self, state, result):
        lost = ""
        if state == GoalStatus.LOST:
            lost = "the planner node has gone"
            if self._resends > 0 and not self._cancelled:
                self._resends -= 1
                try:
                    self._fleet.find_server()
                    return self.send()
                except NoAnswer as error:
                    lost += ": %s" % error
        self._answer = Answer(state, result, time.monotonic() - self._began, lost)
        return None


def join_ros(patience):
    """Makes this process a ROS node if it is none. @throws NoAnswer when there is no master after so
    many seconds: rospy itself would wait for ever."""
    if rospy.core.is_initialized():
        return
    end = time.monotonic() + patience
    while not rosgraph.is_master_online():
        if time.monotonic() >= end:
            raise NoAnswer("no ROS master answers on %s within %g s; is roscore running?" %
                           (rosgraph.get_master_uri(), patience))
        time.sleep(0.1)
    rospy.init_node("split_mapf_client", anonymous=True, disable_signals=True)


def wait_for_map(topic, patience):
    """The map on the topic. @throws NoAnswer."""
    try:
        return rospy.wait_for_message(topic, OccupancyGrid, timeout=patience)
    except rospy.ROSException as error:
        raise NoAnswer("no map on the topic %s within %g s" %
                       (rospy.resolve_name(topic), patience)) from error


def make_options(**values):
    """PlanOptions by their names; None: the node's parameter. 0 means 0, where a message has a number
    below 0 for it. `passages` is a bool, `unknown_space` is blocked or free, and what is NAME=VALUE
    may be a dict. @throws OptionError."""
    options = PlanOptions()
    for name, value in values.items():
        if value is None:
            continue
        if name not in PlanOptions.__slots__:
            raise OptionError("'%s' is no option of a goal: one of %s is expected" %
                              (name, ", ".join(PlanOptions.__slots__)))
        setattr(options, name, _option(name, value, getattr(options, name)))
    return options


def _option(name, value, default):
    if name in _WORDS:
        if value in _WORDS[name]:
            return _WORDS[name][value]
        raise OptionError("%s: %r was given, %s is expected" %
                          (name, value, " or ".join(map(str, _WORDS[name]))))
    if isinstance(value, dict) and isinstance(default, list):
        value = ["%s=%s" % (key, _word(one)) for key, one in value.items()]
    expected = (int, float) if isinstance(default, float) else type(default)
    if not isinstance(value, expected) or isinstance(value, bool) != isinstance(default, bool):
        raise OptionError("%s: %r was given, a value of type %s is expected" %
                          (name, value, type(default).__name__))
    if isinstance(default, float):
        return -1.0 if value == 0 else float(value)
    least, most = _RANGES.get(_TYPES[name], (0, 0))
    if isinstance(default, int) and not isinstance(default, bool) and not least <= value <= most:
        raise OptionError("%s: %d was given, a whole number from %d to %d is expected" %
                          (name, value, least, most))
    return -1 if name in ("ignore_specks", "occupied_threshold") and value == 0 else value


def _word(value):
    """Options say true and false, Python True and False."""
    return str(value).lower() if isinstance(value, bool) else value
