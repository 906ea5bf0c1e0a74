# shellcheck shell=bash disable=SC2154
# Sourced by scripts/test and scripts/analyse: runs their stages (functions run_NAME), one after the
# other, and sums up. The last line is 'N passed, N failed'; a stage without tests of its own counts
# as one. The script that sources this one lists its stages in all_stages. From SPLIT_MAPF_LAST_BEGIN on
# (seconds since 1970; unset: never) no stage begins any more.

readonly not_run=77 # exit status of a stage whose tool this system does not have
readonly build=$SPLIT_MAPF_ROOT/build

need_tool() {
  if ! command -v "$1" > /dev/null; then
    echo "$1 is not in this distribution"
    exit "$not_run"
  fi
}

# Runs ctest in a build directory, one test a processor, and notes how many passed and failed.
count_ctest() {
  local directory=$1 status=0 counted
  shift
  (cd "$directory" && ctest --output-on-failure -j"$(nproc)" "$@") |
    tee "$directory/ctest.log" || status=$?
  counted=$(grep -E 'tests passed, [0-9]+ tests failed out of [0-9]+' "$directory/ctest.log") ||
    fail "ctest ran no test in $directory"
  read -r failed total <<< "$(sed -E 's/.*, ([0-9]+) tests.* ([0-9]+)$/\1 \2/' <<< "$counted")"
  echo "$((total - failed)) $failed" > "$counts"
  return "$status"
}

# Runs one stage, in a subshell at the repository's root; adds to passed, failed and summary.
run_stage() {
  local name=$1 status=0 began=$SECONDS stage_passed=0 stage_failed=0 verdict
  printf '\n=== %s ===\n' "$name"
  if [[ -n ${SPLIT_MAPF_LAST_BEGIN:-} && $(date +%s) -gt $SPLIT_MAPF_LAST_BEGIN ]]; then
    summary+=("$(printf '%-10s %5d s   not run: too late to begin' "$name" 0)")
    echo "=== $name: not run, as it is too late to begin ==="
    return
  fi
  : > "$counts"
  set +e
  (
    set -e
    cd "$SPLIT_MAPF_ROOT"
    "run_$name"
  )
  status=$?
  set -e
  if [[ $status -eq $not_run ]]; then
    verdict='not run'
  else
    if ! read -r stage_passed stage_failed < "$counts"; then
      stage_passed=$((status == 0))
      stage_failed=0
    fi
    if [[ $status -ne 0 && $stage_failed -eq 0 ]]; then
      stage_failed=1
    fi
    verdict="$stage_passed passed, $stage_failed failed"
  fi
  passed=$((passed + stage_passed))
  failed=$((failed + stage_failed))
  summary+=("$(printf '%-10s %5d s   %s' "$name" $((SECONDS - began)) "$verdict")")
  echo "=== $name: $verdict ($((SECONDS - began)) s) ==="
}

# The whole of such a script: its arguments are names of stages, none means all of them.
run_stages() {
  local -a stages=() summary=()
  local argument passed=0 failed=0
  for argument in "$@"; do
    case $argument in
      -h | --help) print_help && exit ;;
      *)
        [[ " ${all_stages[*]} " == *" $argument "* ]] ||
          fail "'$argument' is no stage: one of ${all_stages[*]} expected"
        stages+=("$argument")
        ;;
    esac
  done
  if [[ ${#stages[@]} -eq 0 ]]; then
    stages=("${all_stages[@]}")
  fi
  "$SPLIT_MAPF_ROOT/scripts/install_dependencies" build run test
  mkdir -p "$build"
  counts=$(mktemp)
  trap 'rm -f "$counts"' EXIT

  for argument in "${stages[@]}"; do
    run_stage "$argument"
  done
  printf '\n=== Summary ===\n'
  printf '%s\n' "${summary[@]}"
  printf '%-10s %5d s\n\n' total "$SECONDS"
  echo "$passed passed, $failed failed"
  [[ $failed -eq 0 ]]
}
