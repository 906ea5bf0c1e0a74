#!/usr/bin/env bash
# Runs one rostest outside ctest's own list and exits non-zero unless every test of it passed.
#
# grep reads to the end: with -q it would end first, and tee with it.
#
# usage: soak_rostest.sh SETUP.BASH FILE.test
set -eo pipefail
# shellcheck source=/dev/null
source "$1"
rostest "$2" 2>&1 | tee /dev/stderr | grep 'RESULT: SUCCESS' > /dev/null
