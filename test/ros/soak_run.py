"""What the long measurements share: a ROS master of its own, programs that are ended, and a list of what
was wrong. To be imported before rospy, as it chooses the master's port."""

import os
import socket

with socket.socket() as probe:
    probe.bind(("localhost", 0))
    PORT = probe.getsockname()[1]
os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % PORT

import rospy  # noqa: E402

from ros_processes import Program, wait_until  # noqa: E402
from split_mapf.msg import PlanOutcome  # noqa: E402

OUTCOMES = {value: name for name, value in vars(PlanOutcome).items()
            if name.isupper() and isinstance(value, int)}


def cpu_and_memory(pid):
    """Seconds of CPU and MiB of memory of a process."""
    with open("/proc/%d/stat" % pid, encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    ticks = os.sysconf("SC_CLK_TCK")
    pages = int(fields[21])
    return ((int(fields[11]) + int(fields[12])) / ticks,
            pages * os.sysconf("SC_PAGE_SIZE") / 2 ** 20)


class SoakRun:
    """@param name  of this program as a ROS node."""

    def __init__(self, name):
        self.programs = []
        self.wrong = []
        self.start(Program("roscore", "-p", str(PORT)))
        wait_until(self.has_master)
        rospy.init_node(name, disable_signals=True)

    @staticmethod
    def has_master():
        with socket.socket() as master:
            return master.connect_ex(("localhost", PORT)) == 0

    def start(self, program):
        self.programs.append(program)
        return program

    def require(self, is_well, what):
        if not is_well:
            self.wrong.append(what)

    def end(self):
        for program in reversed(self.programs):
            program.end()


def run_to_end(soak, run):
    """Runs a part of it, ends its programs and says what was wrong. @return the exit code."""
    try:
        run()
    finally:
        soak.end()
    for what in soak.wrong[:10]:
        print("wrong: " + what)
    return 1 if soak.wrong else 0
