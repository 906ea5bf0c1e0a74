#!/usr/bin/env bash
# Installs the package from a build directory to a temporary prefix, then builds and runs another
# catkin package against nothing but that prefix.
#
# usage: downstream_test.sh BUILD_DIRECTORY
set -euo pipefail
export PATH=/usr/bin:/bin:$PATH

build=$1
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build" --prefix "$scratch/install" > "$scratch/install.log"
# What the package was built with must not be found by way of the build directory's environment.
export CMAKE_PREFIX_PATH=$scratch/install${ROS_ROOT:+:${ROS_ROOT%/share/ros}}
export LD_LIBRARY_PATH=${ROS_ROOT:+${ROS_ROOT%/share/ros}/lib}
cmake -S "$here" -B "$scratch/build"
cmake --build "$scratch/build"

program=$scratch/build/devel/lib/split_mapf_downstream/plan_two_robots
linked=$(ldd "$program")
if [[ $linked != *"$scratch/install/lib/libsplit_mapf_core"* ]]; then
  printf 'the program was not linked with the installed library:\n%s\n' "$linked" >&2
  exit 1
fi
# GLPK is GPL-3: only who asks for split_mapf_ilp gets it.
if [[ $linked == *libglpk* ]]; then
  printf 'the program was linked with GLPK unasked:\n%s\n' "$linked" >&2
  exit 1
fi
"$program" | tee "$scratch/output"
grep -qx 'planned 2 robots, makespan [2-9]' "$scratch/output"

"$scratch/install/lib/split_mapf/split_mapf" --version
"$scratch/install/lib/split_mapf/split_mapf" solvers \
  --solver-plugins "$scratch/build/devel/lib/libsplit_mapf_downstream_plugins.so" | grep -x one_by_one

# The installed client finds the installed command, by which it reads files.
printf 'height 1\nwidth 2\nmap\nE@\n' > "$scratch/a.map"
printf '0 a.map 2 1 0 0 0 0 0\n' > "$scratch/a.scen"
PYTHONPATH=$scratch/install/lib/python3/dist-packages:${ROS_ROOT:+${ROS_ROOT%/share/ros}/lib/python3/dist-packages} \
  python3 -B - "$scratch" <<'END'
import importlib.util
import runpy
import sys

scratch = sys.argv[1]
sys.argv = [scratch + "/install/lib/split_mapf/plan_client.py",
            "--map", scratch + "/a.map", "--scen", scratch + "/a.scen"]
client = runpy.run_path(sys.argv[0], run_name="client")
files = importlib.import_module("split_mapf.ros.files")
assert files.__file__.startswith(scratch), files.__file__
assert files.find_command() == scratch + "/install/lib/split_mapf/split_mapf"
grid, ways = client["read_instance"](client["parse_arguments"](sys.argv[1:]))
assert (list(grid.data), ways) == ([0, 100], [[0, 0, 0, 0]]), (grid, ways)
print("the client has read a map by the command beside it")
if importlib.util.find_spec("split_mapf._core") and importlib.util.find_spec("numpy"):
    import split_mapf
    result = split_mapf.plan([[0, 0, 0], [0, 0, 0]], [(0, 0), (2, 0)], [(2, 0), (0, 0)])
    assert result.makespan == 4, result
    print("the installed module has planned:", result)
END
