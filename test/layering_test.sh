#!/usr/bin/env bash
# Checks who includes and links whom, as docs and headers promise: the rooms below, each of which may
#   include what its line names. Only ros, rviz and node know ROS, only rviz knows Qt and Ogre, only one
#   wrapper in the ILP solver knows GLPK, only one in a node MQTT, only one in workers NATS, public headers include no private
#   ones, and the core library links none of them.
# The checker first has to find violations that are planted in small trees of its own.
#
# usage: test/layering_test.sh [REPOSITORY]
set -euo pipefail

# Rooms that a room may include, besides itself. A room of `ros` is a folder of src/ros; what is
# public of ros, include/split_mapf/ros, belongs to ros/convert, and include/split_mapf/client.h to
# ros/client. The room `python` is the folder python.
readonly ground='core solvability parallel'
readonly files="$ground roadmap io generate"
readonly searches="$ground search solver"
readonly planning="$files search solver split plugin portfolio improve pipeline fleet"
declare -rA allowed=(
  [core]=''
  [solvability]='core'
  [parallel]='core'
  [roadmap]='core'
  [io]='core roadmap'
  [generate]='core solvability roadmap io'
  [search]='core parallel'
  [solver]="$ground search"
  [split]='core solvability'
  [plugin]="$ground solver split"
  [portfolio]="$searches split"
  [improve]="$searches split portfolio"
  [pipeline]="$files $searches split portfolio improve"
  [fleet]="$files $searches split portfolio improve pipeline"
  [workers]="$files $searches split portfolio improve pipeline"
  [tool]="$planning workers"
  [python]="$planning"
  [ros/convert]="$planning"
  [ros/client]='core'
  [ros/server]="$planning workers ros/convert"
  [ros/replay]="$planning ros/convert"
  [ros/fleet]="$planning ros/convert"
  [ros/scene]="$planning ros/convert"
  [rviz]="$planning ros/convert ros/replay ros/scene"
  [node]="$planning workers ros/convert ros/server ros/replay ros/fleet"
)
readonly ros_packages='actionlib|catkin|diagnostic_updater|dynamic_reconfigure|interactive_markers|message_filters|nodelet|pluginlib|ros|rosbag|roscpp|rosconsole|rviz|tf|tf2|tf2_ros|tf2_[a-z_]*|[a-z_]*_msgs'

# One line for each violation in the tree $1; nothing for a clean one.
violations() {
  include_violations "$1"
  link_violations "$1"
}

include_violations() {
  local root=$1 file line header layer room
  while IFS=: read -r file line header; do
    file=${file#"$root"/}
    find_room "${file#include/split_mapf/}"
    layer=$room
    if [[ -z $layer ]]; then
      echo "$file:$line: lies in no layer"
      continue
    fi
    judge_include "$file:$line" "$layer" "$header"
  done < <(includes_of "$root")
}

# Sets `room` to the room of a source or header, given with or without src/; to nothing where it lies
# in none.
find_room() {
  local path=${1#src/}
  room=
  if [[ $path == client.h ]]; then
    room=ros/client
  elif [[ $path =~ ^ros/([^/]+)/ ]]; then
    room=ros/${BASH_REMATCH[1]}
  elif [[ $path == ros/* ]]; then
    room=ros/convert
  elif [[ $path == */* ]]; then
    room=${path%%/*}
  fi
  if [[ -n $room && ! -v allowed[$room] ]]; then room=; fi
}

# FILE:LINE:HEADER of every include directive; HEADER keeps its quotes or brackets.
includes_of() {
  local folder
  for folder in "$1/include" "$1/src" "$1/python"; do
    [[ -d $folder ]] || continue
    grep -rnE '^[[:space:]]*#[[:space:]]*include' "$folder" |
      sed -E 's/^([^:]*:[0-9]+:)[[:space:]]*#[[:space:]]*include[[:space:]]*(["<][^">]*[">]).*/\1\2/'
  done
}

judge_include() {
  local place=$1 layer=$2 header=${3:1:-1} target room
  if [[ $layer != ros/* && $layer != node && $layer != rviz ]] &&
    [[ $header =~ ^($ros_packages)/ || $header =~ ^split_mapf/[A-Z] ]]; then
    echo "$place: $layer includes the ROS header $header"
    return
  fi
  if [[ $header == glpk.h && $place != src/solver/ilp/glpk_model.cpp:* ]]; then
    echo "$place: only the wrapper src/solver/ilp/glpk_model.cpp may include $header"
    return
  fi
  if [[ $header == nats/nats.h && $place != src/workers/nats_link.cpp:* ]]; then
    echo "$place: only the wrapper src/workers/nats_link.cpp may include $header"
    return
  fi
  if [[ $header =~ ^(rviz/|Ogre|Q[A-Z]) && $3 == \<* && $layer != rviz ]]; then
    echo "$place: only rviz knows rviz and what it is made of: $header"
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
  [[ $3 == \"* ]] || return 0
  find_room "${header#split_mapf/}"
  target=$room
  [[ -n $target && $target != "$layer" ]] || return 0
  [[ " ${allowed[$layer]} " == *" $target "* ]] || echo "$place: $layer includes $target: $header"
}

link_violations() {
  local root=$1 statement
  while IFS= read -r statement; do
    case $statement in
      link_libraries\(* | *include_directories\(*catkin_INCLUDE_DIRS*)
        [[ $statement == target_include_directories\(\$\{ros_library\}* ||
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
    [[ $layer != ros/* && $layer != python ]] || continue
    mkdir -p "$root/include/split_mapf/$layer" "$root/src/$layer"
    printf '#pragma once\n#include <vector>\n#include "split_mapf/core/grid.h"\n' \
      > "$root/include/split_mapf/$layer/room.h"
    printf '#include "split_mapf/%s/room.h"\n#include "%s/private_room.h"\n' "$layer" "$layer" \
      > "$root/src/$layer/room.cpp"
  done
  mkdir -p "$root/src/solver/ilp" "$root/cmake" "$root/src/ros/server" "$root/src/ros/replay" \
    "$root/include/split_mapf/ros" "$root/src/ros/client" "$root/python"
  printf '#include <ros/ros.h>\n' > "$root/include/split_mapf/client.h"
  printf '#include "split_mapf/client.h"\n#include "split_mapf/core/room.h"\n' \
    > "$root/src/ros/client/room.cpp"
  printf '#include "room.h"\n#include "split_mapf/pipeline/room.h"\n' > "$root/python/room.cpp"
  printf '#include <ros/ros.h>\n#include <split_mapf/PlanPathsAction.h>\n' > "$root/src/ros/server/room.cpp"
  printf '#include "split_mapf/ros/room.h"\n' > "$root/src/ros/replay/room.cpp"
  printf '#include "split_mapf/pipeline/room.h"\n' > "$root/include/split_mapf/ros/room.h"
  echo '#include <glpk.h>' > "$root/src/solver/ilp/glpk_model.cpp"
  cat > "$root/cmake/libraries.cmake" << 'CMAKE'
add_library(split_mapf_core ${SOURCES})  # links no catkin_LIBRARIES
target_link_libraries(split_mapf_core
  PUBLIC Threads::Threads)
target_link_libraries(split_mapf_ros PUBLIC split_mapf_core ${catkin_LIBRARIES})
target_include_directories(${ros_library} SYSTEM PUBLIC ${catkin_INCLUDE_DIRS})
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
  require_found src/pipeline/room.cpp '#include "split_mapf/plugin/room.h"'
  require_found src/io/room.cpp '#include "split_mapf/split/room.h"'
  require_found src/roadmap/room.cpp '#include "split_mapf/io/room.h"'
  require_found src/solver/room.cpp '#include "split_mapf/roadmap/room.h"'
  require_found src/core/room.cpp '#include "split_mapf/roadmap/room.h"'
  require_found include/split_mapf/io/room.h '#include "split_mapf/pipeline/room.h"'
  require_found src/pipeline/room.cpp '#include "split_mapf/ros/room.h"'
  require_found src/tool/room.cpp '#include "split_mapf/ros/room.h"'
  require_found python/room.cpp '#include <ros/ros.h>'
  require_found python/room.cpp '#include "split_mapf/ros/room.h"'
  require_found python/room.cpp '#include "tool/private_room.h"'
  require_found src/ros/client/room.cpp '#include "split_mapf/ros/room.h"'
  require_found src/pipeline/room.cpp '#include "split_mapf/client.h"'
  require_found src/ros/server/room.cpp '#include "tool/private_room.h"'
  require_found src/ros/server/room.cpp '#include "ros/replay/room.h"'
  require_found include/split_mapf/ros/room.h '#include "ros/server/room.h"'
  require_found src/ros/replay/room.cpp '#include "rviz/private_room.h"'
  require_found src/rviz/room.cpp '#include "ros/server/room.h"'
  require_found src/ros/server/room.cpp '#include <rviz/display.h>'
  require_found src/pipeline/room.cpp '#include "ros/server/room.h"'
  require_found src/pipeline/room.cpp '#include "fleet/private_room.h"'
  require_found src/improve/room.cpp '#include "split_mapf/pipeline/room.h"'
  require_found src/search/room.cpp '#include "split_mapf/solver/room.h"'
  require_found src/portfolio/room.cpp '#include "improve/private_room.h"'
  require_found src/core/room.cpp '#include <ros/ros.h>'
  require_found src/tool/room.cpp '#include <nav_msgs/OccupancyGrid.h>'
  require_found src/pipeline/room.cpp '#include <tf2_geometry_msgs/tf2_geometry_msgs.h>'
  require_found src/io/room.cpp '#include <split_mapf/PlanPathsAction.h>'
  require_found src/pipeline/room.cpp '#include <glpk.h>'
  require_found src/solver/room.cpp '#include "glpk.h"'
  require_found src/solver/ilp/master.cpp '#include <glpk.h>'
  require_found src/ros/server/room.cpp '#include <mosquitto.h>'
  require_found src/workers/room.cpp '#include <nats/nats.h>'
  require_found src/pipeline/room.cpp '#include "workers/private_room.h"'
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
