#!/usr/bin/env bash
# Tracks the logs of one element of an array job: those in the lines INDEX, INDEX + COUNT, INDEX + 2 COUNT ... of a list
# (the first line is line 0), each in its own process.
#   share.sh INDEX COUNT LIST OUT [TRACK OPTIONS]      INDEX: 0 to COUNT - 1; LIST: a file, one path of a log per line
# If COUNT is the number of lines, each element has one log. Exit code: 0 if all are finished, otherwise that of the
# last failure.
set -u

[ $# -ge 4 ] || { sed -n '2,6s/^# \{0,1\}//p' "$0" >&2; exit 2; }
index=$1 count=$2 list=$3 out=$4
shift 4
here=$(dirname "$(realpath "$0")")
if ! [[ $index =~ ^[0-9]+$ && $count =~ ^[0-9]+$ ]] || ((10#$index >= 10#$count)); then
  echo "INDEX is $index and COUNT is $count: give INDEX from 0 to COUNT - 1" >&2
  exit 2
fi
[ -r "$list" ] || { echo "$list: cannot be read" >&2; exit 2; }
mapfile -t logs <"$list"
code=0 child=
trap 'kill -TERM $child 2>/dev/null; wait $child; exit 130' TERM INT
for ((i = 10#$index; i < ${#logs[@]}; i += 10#$count)); do
  [ -n "${logs[i]}" ] || continue
  "$here/one_log.sh" "${logs[i]}" "$out" "$@" &
  child=$!
  wait $child || code=$?
done
exit $code
