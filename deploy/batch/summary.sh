#!/usr/bin/env bash
# Prints how many logs of a list are finished, and which are not and why. It may be run while jobs run, and after them.
#   summary.sh LIST OUT      LIST: a file with the path of one log per line; OUT: the folder to which one_log.sh wrote
# Exit code: 0 if all are finished, 1 if some are not, 2 if the list cannot be read.
set -u

[ $# = 2 ] || { sed -n '2,4s/^# \{0,1\}//p' "$0" >&2; exit 2; }
list=$1 out=$2
[ -r "$list" ] || { echo "$list: cannot be read" >&2; exit 2; }
mapfile -t logs <"$list"

all=0
unfinished=()
for log in "${logs[@]}"; do
  [ -n "$log" ] || continue
  all=$((all + 1))
  name=$(basename "$log" .lcmlog)
  why="stopped, or not started yet"
  if [ -d "$out/$name" ]; then
    [[ "$(cat "$out/$name/command") " == "$(printf '%q ' "$(realpath -m "$log")")"* ]] && continue
    why="$out/$name is of another log of this name"
  elif [ -f "$out/$name.failed.txt" ]; then
    why=$(grep -E '^(error|barehand track)' "$out/$name.failed.txt" | tail -n 1)
    why=${why:-$(tail -n 1 "$out/$name.failed.txt")}
  fi
  unfinished+=("$log: $why")
done

echo "$((all - ${#unfinished[@]})) of $all logs are finished"
[ ${#unfinished[@]} = 0 ] && exit 0
printf 'not finished: %s\n' "${unfinished[@]}"
exit 1
