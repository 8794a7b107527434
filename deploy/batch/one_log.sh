#!/usr/bin/env bash
# Tracks one log, as an element of an array job. If its results exist already, it does nothing.
#   one_log.sh LOG OUT [TRACK OPTIONS]      makes OUT/NAME/ of NAME.lcmlog: states.lcmlog, result.csv, report.txt, command
# The folder gets its name when it is complete and on disk. After a failure, OUT/NAME.failed.txt contains the reason.
# Exit code: 0 if the log is finished, now or before; otherwise that of barehand track: 1 failed while running, or none
# or less than half of the frames could be read; 2 the log or the options cannot be used; 130 stopped before the end.
# Uses one thread unless --threads is given. The environment variable BAREHAND may name another program than that on the
# PATH.
set -u

[ $# -ge 2 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
log=$1 out=$2
shift 2
[[ " $* " == *" --threads"* ]] || set -- --threads 1 "$@"  # one core per log, so that parallel runs do not compete
name=$(basename "$log" .lcmlog)
command=$(printf '%q ' "$(realpath -m "$log")" "$@")
done_already() {
  [ -d "$out/$name" ] || return 1
  [ "$(cat "$out/$name/command")" = "$command" ] && exit 0
  echo "$log: $out/$name is of another log or has other options: give another OUT" >&2
  exit 2
}
done_already

mkdir -p "$out/.unfinished" && draft=$(mktemp -d "$out/.unfinished/$name.XXXXXX") || exit 1
trap 'rm -rf "$draft"' EXIT

"${BAREHAND:-barehand}" track --source "log:$log" --no-publish --result "$draft/result.csv" \
  --states-log "$draft/states.lcmlog" "$@" >"$draft/report.txt" 2>&1 &
child=$!
stopped=
trap 'stopped=yes; kill -TERM $child 2>/dev/null' TERM INT
code=0
wait $child || code=$?
while kill -0 $child 2>/dev/null; do  # a signal ended the wait, but the program is still writing
  wait $child
  code=$?
done
[ -z "$stopped" ] || code=130
if [ $code = 0 ] && ! { [ -s "$draft/result.csv" ] && [ -s "$draft/states.lcmlog" ]; }; then
  echo "error: a result is missing or empty" >>"$draft/report.txt"
  code=1
fi

if [ $code = 0 ]; then
  printf '%s\n' "$command" >"$draft/command"
  chmod 755 "$draft"
  sync "$draft"/* "$draft" || exit 1
  mv -T "$draft" "$out/$name" 2>/dev/null || done_already || { echo "$log: cannot make $out/$name" >&2; exit 1; }
  rm -f "$out/$name.failed.txt"
  exit 0
fi
mv -f "$draft/report.txt" "$out/$name.failed.txt"
echo "$log: exit code $code, see $out/$name.failed.txt" >&2
exit $code
