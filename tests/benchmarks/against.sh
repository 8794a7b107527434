#!/usr/bin/env bash
# Compares the CPU time per frame of two builds of barehand. They run alternately, so that other load on the machine
# affects both. Prints the time of every round and the ratio of the smallest ones. Each build uses the configuration in
# its own source tree.
#   against.sh BAREHAND_BEFORE BAREHAND_AFTER [ARGUMENTS OF bench...]
set -eu
before=$1 after=$2
shift 2

cpu_ms() {  # BAREHAND ARGUMENTS...
  "$1" bench --threads 1 --inline --frames 150 "${@:2}" 2>/dev/null | sed -n '1s/.*, \([0-9.]*\) ms CPU per frame.*/\1/p'
}
for round in 1 2 3; do
  echo "before $(cpu_ms "$before" "$@")"
  echo "after $(cpu_ms "$after" "$@")"
done | awk '{ print; if (!($1 in least) || $2 < least[$1]) least[$1] = $2 }
            END { printf "before / after: %.2f\n", least["before"] / least["after"] }'
