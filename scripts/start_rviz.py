#!/usr/bin/env python3
"""Starts rviz with the arguments given where a display is there; else says what to do instead.

Without a display rviz itself ends with an abort of Qt, in the middle of the output of the planner.

usage: start_rviz.py [--plugin CONFIG] [--fit TOPIC] [ARGUMENT OF RVIZ...]

  --plugin CONFIG  instead of the file after -d, where the plug-in of rviz is that CONFIG needs
  --fit TOPIC      moves the view of that file to the latched map on TOPIC, where one comes in a moment;
                   the plug-in does so itself
"""

import argparse
import ctypes
import os
import re
import shutil
import subprocess
import sys
import tempfile

PLUGIN = os.path.join("lib", "libsplit_mapf_rviz.so")
PATIENCE = 8.0  # [s] for a map; rviz opens without one afterwards
VIEW_PIXELS = 700.0  # the shorter side of the 3D view of rviz/split_mapf.rviz
RIM = 1.06


def display_fault():
    """Why no window can be opened; None: it can."""
    if os.environ.get("QT_QPA_PLATFORM"):
        # Whoever chose how Qt draws knows more than this script.
        return None
    name = os.environ.get("DISPLAY")
    if not name:
        return "there is no display (DISPLAY is not set)"
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return None
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
    display = x11.XOpenDisplay(None)
    if not display:
        return "the display %s (DISPLAY) cannot be opened" % name
    x11.XCloseDisplay(display)
    return None


def find_rviz():
    """On the path as a rule; rospack knows it in a workspace of its own."""
    found = shutil.which("rviz")
    if found or not shutil.which("rosrun"):
        return [found] if found else None
    known = subprocess.run(["rospack", "find", "rviz"], stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL, check=False).returncode == 0
    return ["rosrun", "rviz", "rviz"] if known else None


def has_plugin():
    """Whether rviz would find the library; it looks where workspaces are."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
    return any(os.path.exists(os.path.join(prefix, PLUGIN)) for prefix in prefixes if prefix)


def wait_for_map(topic):
    """MapMetaData of the map on a topic; None: none came in time."""
    import rospy  # pylint: disable=import-outside-toplevel
    from nav_msgs.msg import OccupancyGrid  # pylint: disable=import-outside-toplevel
    # A name of its own: rviz takes the one that roslaunch gave.
    rospy.init_node("start_rviz", argv=[sys.argv[0]], anonymous=True, disable_signals=True)
    try:
        return rospy.wait_for_message(topic, OccupancyGrid, timeout=PATIENCE).info
    except rospy.ROSException:
        return None
    finally:
        rospy.signal_shutdown("rviz starts")


def fitted(text, info):
    """The text of a configuration of rviz with its view from above fitted to a map that is not turned."""
    width = info.width * info.resolution
    height = info.height * info.resolution
    for key, value in (("X", info.origin.position.x + width / 2),
                       ("Y", info.origin.position.y + height / 2),
                       ("Scale", VIEW_PIXELS / RIM / max(width, height))):
        # The view is the last thing that has these keys; the window has X and Y, too.
        head, views, tail = text.partition("  Views:")
        tail = re.sub(r"(?m)^(      %s: ).*$" % key, r"\g<1>%.6g" % value, tail, count=1)
        text = head + views + tail
    return text


def fitted_file(path, info):
    with open(path, encoding="utf-8") as file:
        text = fitted(file.read(), info)
    # rviz reads it when it has started, so nobody here can take it away.
    with tempfile.NamedTemporaryFile("w", prefix="split_mapf_", suffix=".rviz", delete=False,
                                     encoding="utf-8") as file:
        file.write(text)
    return file.name


def main():
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--plugin")
    parser.add_argument("--fit")
    options, arguments = parser.parse_known_args()
    fault = display_fault()
    command = find_rviz()
    if fault is None and command is None:
        fault = "it is not installed (scripts/install_dependencies rviz)"
    if fault is not None:
        print("rviz is not started: %s. Everything else runs; rviz:=false leaves this out." % fault)
        return 0
    if "-d" in arguments[:-1]:
        place = arguments.index("-d") + 1
        if options.plugin and has_plugin():
            arguments[place] = options.plugin
        elif options.fit:
            info = wait_for_map(options.fit)
            if info is not None:
                arguments[place] = fitted_file(arguments[place], info)
    os.execvp(command[0], command + arguments)
    return 1


if __name__ == "__main__":
    sys.exit(main())
