# shellcheck shell=bash disable=SC2034
# Sourced by the scripts beside it: where the repository stands, and an environment in which the
# system's own python comes first, since rospy and the message generators exist for no other.

SPLIT_MAPF_ROOT=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
readonly SPLIT_MAPF_ROOT
readonly SPLIT_MAPF_NOETIC=/opt/ros/noetic
export PATH=/usr/bin:/bin:$PATH:/usr/sbin:/sbin

# Sources a setup file of catkin; those read variables that need not be set.
source_setup() {
  set +u
  # shellcheck disable=SC1090
  source "$1"
  set -u
}

if [[ -f $SPLIT_MAPF_NOETIC/setup.bash ]]; then
  source_setup "$SPLIT_MAPF_NOETIC/setup.bash"
fi

# Prints what is wrong and ends the script.
fail() {
  echo "${0##*/}: $*" >&2
  exit 1
}

# The comment block at the top of a script is its help text.
print_help() {
  sed -n '2,/^[^#]/{/^#/s/^# \{0,1\}//p}' "$0"
}
