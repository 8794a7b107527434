#!/usr/bin/env bash
# Tracks one element's share of a list of logs: the lines INDEX, INDEX + COUNT, INDEX + 2 COUNT ..., one process each.
#   share.sh INDEX COUNT LIST OUT [TRACK OPTIONS]      INDEX: 0 .. COUNT-1; LIST: a file with the path of a log a line
# With COUNT = number of lines each element has one log. Exit code: 0 all finished, else the last failure's.
set -u

[ $# -ge 4 ] || { sed -n '2,4s/^# \{0,1\}//p' "$0" >&2; exit 2; }
index=$1 count=$2 list=$3 out=$4
shift 4
here=$(dirname "$(realpath "$0")")
[ -r "$list" ] || { echo "$list: cannot be read" >&2; exit 2; }
mapfile -t logs <"$list"
code=0 child=
trap 'kill -TERM $child 2>/dev/null; wait $child; exit 130' TERM INT
for ((i = index; i < ${#logs[@]}; i += count)); do
  [ -n "${logs[i]}" ] || continue
  "$here/one_log.sh" "${logs[i]}" "$out" "$@" &
  child=$!
  wait $child || code=$?
done
exit $code
