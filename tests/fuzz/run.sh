#!/usr/bin/env bash
# Runs the fuzz targets, starting from the corpus, by default with a million inputs each.
#   run.sh BUILD [EXECUTIONS [TARGET ..]]
# First build them:
#   cmake --preset fuzz && cmake --build --preset fuzz && tests/fuzz/run.sh build/fuzz
# Stops at the first failure, whose input is stored in BUILD/fuzz/TARGET. Prints a line for each target: the number of
# executions and the speed.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd)
executions=${2:-1000000}
targets=("${@:3}")
[ ${#targets[@]} -gt 0 ] || mapfile -t targets < <(ls "$here/corpus")
export ASAN_OPTIONS=detect_odr_violation=0:quarantine_size_mb=16:malloc_context_size=6 UBSAN_OPTIONS=print_stacktrace=1  # the middle two: speed

for target in "${targets[@]}"; do
  work=$build/fuzz/$target
  mkdir -p "$work/found"
  cd "$work"
  largest=$(find "$here/corpus/$target" -type f -printf '%s\n' | sort -n | tail -n 1)
  # An input also fails if it takes 10 s or allocates 512 MiB at once. The decoders' messages are discarded.
  if ! "$build/tests/fuzz/${target}_fuzz" -runs="$executions" -max_len=$((2 * largest)) -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=512 -close_fd_mask=3 \
      -print_final_stats=1 -seed=1 found "$here/corpus/$target" >log 2>&1; then
    sed -n '/ERROR\|runtime error/,$p' log | head -n 40
    echo "$target: a finding, see $work"
    exit 1
  fi
  awk -v target="$target" '/number_of_executed_units/ {n = $2} /average_exec_per_sec/ {rate = $2}
    /slowest_unit_time_sec/ {slowest = $2} /peak_rss_mb/ {peak = $2}
    END {printf "%-14s %8d inputs, %6d a second, slowest %d s, peak %d MiB\n", target, n, rate, slowest, peak}' log
done
