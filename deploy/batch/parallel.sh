#!/usr/bin/env bash
# Tracks every log of a list on this machine with GNU parallel. Run again, it does what is not finished.
#   parallel.sh LIST OUT [TRACK OPTIONS]      LIST: a file with the path of a log a line; JOBS=N at a time (default: cores)
# Exit code: 0 all finished, 1 some are not: summary.sh lists them at the end, OUT/NAME.failed.txt says why, OUT/joblog
# has all exit codes.
set -u

[ $# -ge 2 ] || { sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 2; }
list=$1 out=$2
shift 2
here=$(dirname "$(realpath "$0")")
command -v parallel >/dev/null || { echo "GNU parallel is missing: apt-get install parallel" >&2; exit 2; }
[ -r "$list" ] || { echo "$list: cannot be read" >&2; exit 2; }
mkdir -p "$out" || exit 2
# A second TERM would kill the trackers outright, so they get a while for writing what they have.
parallel --quote --no-run-if-empty --jobs "${JOBS:-$(nproc)}" --joblog "$out/joblog" --termseq TERM,20000,KILL \
  --arg-file "$list" "$here/one_log.sh" {} "$out" "$@"
code=$?
"$here/summary.sh" "$list" "$out" && [ $code = 0 ] || exit 1
