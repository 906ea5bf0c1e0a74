#!/usr/bin/env bash
# Checks who includes and links whom, as docs and headers promise:
#   core at the ground; roadmap, solver, split side by side above it, never seeing each other; io
#   above core and roadmap; then pipeline; then ros and tool; node on top of ros. Only ros and node know ROS, only one wrapper in
#   the ILP solver knows GLPK, only one in a node MQTT, public headers include no private ones, and the core library links neither.
# The checker first has to find violations that are planted in small trees of its own.
#
# usage: test/layering_test.sh [REPOSITORY]
set -euo pipefail

# Layers that a layer may include.
declare -rA allowed=(
  [core]="core"
  [roadmap]="core roadmap"
  [io]="core roadmap io"
  [solver]="core solver"
  [split]="core split"
  [pipeline]="core roadmap io solver split pipeline"
  [ros]="core roadmap io solver split pipeline ros"
  [tool]="core roadmap io solver split pipeline tool"
  [node]="core roadmap io solver split pipeline ros node"
)
readonly ros_packages='actionlib|catkin|diagnostic_updater|dynamic_reconfigure|interactive_markers|message_filters|nodelet|pluginlib|ros|rosbag|roscpp|rosconsole|rviz|tf|tf2|tf2_ros|tf2_[a-z_]*|[a-z_]*_msgs'

# One line for each violation in the tree $1; nothing for a clean one.
violations() {
  include_violations "$1"
  link_violations "$1"
}

include_violations() {
  local root=$1 file line header layer
  while IFS=: read -r file line header; do
    file=${file#"$root"/}
    layer=
    if [[ $file =~ ^(include/split_mapf|src)/([^/]+)/ ]]; then layer=${BASH_REMATCH[2]}; fi
    if [[ -z $layer || -z ${allowed[$layer]:-} ]]; then
      echo "$file:$line: lies in no layer"
      continue
    fi
    judge_include "$file:$line" "$layer" "$header"
  done < <(includes_of "$root")
}

# FILE:LINE:HEADER of every include directive; HEADER keeps its quotes or brackets.
includes_of() {
  local folder
  for folder in "$1/include" "$1/src"; do
    [[ -d $folder ]] || continue
    grep -rnE '^[[:space:]]*#[[:space:]]*include' "$folder" |
      sed -E 's/^([^:]*:[0-9]+:)[[:space:]]*#[[:space:]]*include[[:space:]]*(["<][^">]*[">]).*/\1\2/'
  done
}

judge_include() {
  local place=$1 layer=$2 header=${3:1:-1} target
  if [[ $layer != ros && $layer != node ]] &&
    [[ $header =~ ^($ros_packages)/ || $header =~ ^split_mapf/[A-Z] ]]; then
    echo "$place: $layer includes the ROS header $header"
    return
  fi
  if [[ $header == glpk.h && $place != src/solver/ilp/glpk_model.cpp:* ]]; then
    echo "$place: only the wrapper src/solver/ilp/glpk_model.cpp may include $header"
    return
  fi
  if [[ $header == mosquitto.h && $place != src/node/mqtt_client.cpp:* ]]; then
    echo "$place: only src/node/mqtt_client.cpp may include $header"
    return
  fi
  if [[ $place == include/* && $3 == \"* && $header != split_mapf/* ]]; then
    echo "$place: a public header includes the private header $header"
    return
  fi
  target=${header#split_mapf/}
  [[ $target == */* ]] || return 0
  target=${target%%/*}
  [[ -n ${allowed[$target]:-} && $3 == \"* ]] || return 0
  [[ " ${allowed[$layer]} " == *" $target "* ]] || echo "$place: $layer includes $target: $header"
}

link_violations() {
  local root=$1 statement
  while IFS= read -r statement; do
    case $statement in
      link_libraries\(* | *include_directories\(*catkin_INCLUDE_DIRS*)
        [[ $statement == target_include_directories\(split_mapf_ros* ||
          $statement == target_include_directories\(*_test* ]] ||
          echo "CMake: for every target, or for one without ROS: $statement"
        ;;
      target_link_libraries\(split_mapf_core* | target_link_libraries\(split_mapf[[:space:]]*)
        [[ ! $statement =~ catkin|roscpp|actionlib|split_mapf_ros ]] ||
          echo "CMake: a target without ROS links it: $statement"
        ;;
    esac
    case $statement in
      target_link_libraries\(split_mapf_ilp[[:space:]]*) ;;
      target_link_libraries\(*)
        [[ ! ${statement,,} =~ glpk ]] ||
          echo "CMake: only split_mapf_ilp may link GLPK: $statement"
        ;;
    esac
  done < <(cmake_statements "$root")
}

# Every CMake statement on a line of its own, without comments.
cmake_statements() {
  local file
  for file in "$1/CMakeLists.txt" "$1"/cmake/*.cmake; do
    [[ -f $file ]] || continue
    sed -E 's/(^|[[:space:]])#.*$//' "$file" | tr '\n' ' ' | sed -E 's/\)/)\n/g' |
      sed -E 's/^[[:space:]]+//; s/[[:space:]]+/ /g; s/[[:space:]]*\([[:space:]]*/(/'
    echo
  done
}

# --- Self-test: a small clean tree, into which one violation at a time is planted. ---

write_clean_tree() {
  local root=$1 layer
  rm -rf "$root"
  for layer in "${!allowed[@]}"; do
    mkdir -p "$root/include/split_mapf/$layer" "$root/src/$layer"
    printf '#pragma once\n#include <vector>\n#include "split_mapf/core/grid.h"\n' \
      > "$root/include/split_mapf/$layer/room.h"
    printf '#include "split_mapf/%s/room.h"\n#include "%s/private_room.h"\n' "$layer" "$layer" \
      > "$root/src/$layer/room.cpp"
  done
  printf '#include <ros/ros.h>\n#include <split_mapf/PlanPathsAction.h>\n' > "$root/src/ros/server.cpp"
  mkdir -p "$root/src/solver/ilp" "$root/cmake"
  echo '#include <glpk.h>' > "$root/src/solver/ilp/glpk_model.cpp"
  cat > "$root/cmake/libraries.cmake" << 'CMAKE'
add_library(split_mapf_core ${SOURCES})  # links no catkin_LIBRARIES
target_link_libraries(split_mapf_core
  PUBLIC Threads::Threads)
target_link_libraries(split_mapf_ros PUBLIC split_mapf_core ${catkin_LIBRARIES})
target_link_libraries(split_mapf_ilp PRIVATE ${GLPK_LIBRARIES})
CMAKE
}

# Plants the line $2 in the file $1 and requires that something is found.
require_found() {
  write_clean_tree "$scratch/tree"
  echo "$2" >> "$scratch/tree/$1"
  if [[ -z $(violations "$scratch/tree") ]]; then
    echo "layering_test: the checker overlooks '$2' in $1" >&2
    exit 1
  fi
}

# shellcheck disable=SC2016 # CMake's variables, not the shell's
test_the_checker() {
  write_clean_tree "$scratch/tree"
  local found
  found=$(violations "$scratch/tree")
  if [[ -n $found ]]; then
    echo "layering_test: the checker objects to a clean tree:" >&2
    echo "$found" >&2
    exit 1
  fi
  require_found src/core/room.cpp '#include "split_mapf/solver/room.h"'
  require_found src/core/room.cpp '#include "solver/private_room.h"'
  require_found src/core/room.cpp '#  include  "split_mapf/io/room.h" // indented'
  require_found src/solver/ilp/glpk_model.cpp '#include "split_mapf/split/room.h"'
  require_found src/split/room.cpp '#include "split_mapf/solver/room.h"'
  require_found src/io/room.cpp '#include "split_mapf/split/room.h"'
  require_found src/roadmap/room.cpp '#include "split_mapf/io/room.h"'
  require_found src/solver/room.cpp '#include "split_mapf/roadmap/room.h"'
  require_found src/core/room.cpp '#include "split_mapf/roadmap/room.h"'
  require_found include/split_mapf/io/room.h '#include "split_mapf/pipeline/room.h"'
  require_found src/pipeline/room.cpp '#include "split_mapf/ros/room.h"'
  require_found src/tool/room.cpp '#include "split_mapf/ros/room.h"'
  require_found src/ros/room.cpp '#include "tool/private_room.h"'
  require_found src/core/room.cpp '#include <ros/ros.h>'
  require_found src/tool/room.cpp '#include <nav_msgs/OccupancyGrid.h>'
  require_found src/pipeline/room.cpp '#include <tf2_geometry_msgs/tf2_geometry_msgs.h>'
  require_found src/io/room.cpp '#include <split_mapf/PlanPathsAction.h>'
  require_found src/pipeline/room.cpp '#include <glpk.h>'
  require_found src/solver/room.cpp '#include "glpk.h"'
  require_found src/solver/ilp/master.cpp '#include <glpk.h>'
  require_found src/ros/room.cpp '#include <mosquitto.h>'
  require_found include/split_mapf/core/room.h '#include "core/private_room.h"'
  require_found src/stray.cpp '#include <vector>'
  require_found cmake/libraries.cmake 'target_link_libraries(split_mapf_core PUBLIC ${catkin_LIBRARIES})'
  require_found cmake/libraries.cmake 'target_link_libraries( split_mapf_core roscpp )'
  require_found cmake/libraries.cmake 'target_link_libraries(split_mapf PRIVATE ${catkin_LIBRARIES})'
  require_found cmake/libraries.cmake 'target_link_libraries(split_mapf_core PRIVATE glpk)'
  require_found cmake/libraries.cmake 'link_libraries(${catkin_LIBRARIES})'
  require_found cmake/libraries.cmake 'include_directories(${catkin_INCLUDE_DIRS})'
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
test_the_checker

repository=${1:-$(dirname -- "${BASH_SOURCE[0]}")/..}
if [[ ! -d $repository/include/split_mapf/core || ! -d $repository/src/core ]]; then
  echo "layering_test: $repository is not this package's source tree" >&2
  exit 1
fi
found=$(violations "$repository")
if [[ -n $found ]]; then
  echo "layering_test: who may include and link whom is written at the top of this script" >&2
  echo "$found" >&2
  exit 1
fi
echo "layering_test: clean"
