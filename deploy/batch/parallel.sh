#!/usr/bin/env bash
# Tracks every log of a list on this machine with GNU parallel. If it is run again, it tracks the logs that are not
# finished.
#   parallel.sh LIST OUT [TRACK OPTIONS]      LIST: a file with the path of one log per line
# The environment variable JOBS sets how many logs are tracked at once (default: number of cores). Exit code: 0 if all
# logs are finished, 1 if some are not: summary.sh lists them at the end, OUT/NAME.failed.txt contains the reason,
# OUT/joblog contains all exit codes.
set -u

[ $# -ge 2 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 2; }
list=$1 out=$2
shift 2
here=$(dirname "$(realpath "$0")")
command -v parallel >/dev/null || { echo "GNU parallel is missing: apt-get install parallel" >&2; exit 2; }
[ -r "$list" ] || { echo "$list: cannot be read" >&2; exit 2; }
mkdir -p "$out" || exit 2
# Give the trackers 20 s after TERM to finish their files; a second TERM would end them at once.
parallel --quote --no-run-if-empty --jobs "${JOBS:-$(nproc)}" --joblog "$out/joblog" --termseq TERM,20000,KILL \
  --arg-file "$list" "$here/one_log.sh" {} "$out" "$@"
code=$?
"$here/summary.sh" "$list" "$out" && [ $code = 0 ] || exit 1
