#!/usr/bin/env python3
"""Starts rviz with the arguments given where a display is there; else says what to do instead.

Without a display rviz itself ends with an abort of Qt, in the middle of the output of the planner.
"""

import ctypes
import os
import shutil
import subprocess
import sys


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


def main():
    fault = display_fault()
    command = find_rviz()
    if fault is None and command is None:
        fault = "it is not installed (scripts/install_dependencies rviz)"
    if fault is not None:
        print("rviz is not started: %s. Everything else runs; rviz:=false leaves this out." % fault)
        return 0
    os.execvp(command[0], command + sys.argv[1:])
    return 1


if __name__ == "__main__":
    sys.exit(main())
