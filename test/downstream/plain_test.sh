#!/usr/bin/env bash
# Installs the CMake package of what knows no ROS from a build directory to a temporary prefix, then
# builds and runs a project of somebody else that knows nothing but that prefix.
#
# usage: plain_test.sh BUILD_DIRECTORY
set -euo pipefail
export PATH=/usr/bin:/bin:$PATH

build=$1
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build" --component cmake_package --prefix "$scratch/install" > "$scratch/install.log"
if [[ -e $scratch/install/include/split_mapf/ros ]]; then
  echo "headers of ROS were installed with what knows no ROS" >&2
  exit 1
fi
# A prefix may be moved: nothing in it may name the place where it was made.
mv "$scratch/install" "$scratch/moved"
unset CMAKE_PREFIX_PATH LD_LIBRARY_PATH ROS_PACKAGE_PATH
cmake -S "$here/plain" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/moved" \
  -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF > "$scratch/configure.log"
cmake --build "$scratch/build" > "$scratch/build.log"

"$scratch/build/plan_three_robots" | tee "$scratch/output"
grep -Eqx 'planned 3 robots by (ilp|auto), makespan [2-9]' "$scratch/output"
if grep -rqF "$build" "$scratch/moved/lib"*/cmake; then
  echo "the package names the build directory" >&2
  exit 1
fi
