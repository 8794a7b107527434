#!/usr/bin/env bash
# Tests the scripts of deploy/batch on a few simulated logs, one of them broken: a whole run, a resumed run, a run that
# is stopped, and runs that divide the logs among several machines.
#   batch_test.sh BAREHAND SOURCE_TREE
set -u

BAREHAND=$(realpath "$1")
export BAREHAND
tree=$(realpath "$2")
batch=$tree/deploy/batch
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

failed=0
check() {  # WORDS COMMAND...
  local words=$1
  shift
  "$@" || { echo "FAILED: $words"; failed=1; }
}
exits() {  # CODE COMMAND...
  local wanted=$1 code=0
  shift
  "$@" >command.out 2>&1 || code=$?
  [ "$code" = "$wanted" ] || { echo "exit code $code instead of $wanted: $*"; cat command.out; return 1; }
}
simulate() {
  "$BAREHAND" sim fist --set width=160 --set height=120 --out "$@" >sim.out 2>&1 || { cat sim.out; exit 1; }
}
frames() { tail -n +2 "$1" | cut -d, -f1 | sort -u | wc -l; }
finished() { find "$1" -mindepth 1 -maxdepth 1 -type d ! -name .unfinished -printf '%f\n' | sort | paste -sd' '; }

for seed in 1 2; do
  simulate "log$seed.lcmlog" --frames 4 --seed $seed
done
start=(--hand log1.hand.json --init log1.start_pose.json)  # or each run searches for the hand for seconds
cp log2.lcmlog whole.lcmlog
mkdir other
cp log1.lcmlog other
head -c 5000 /dev/urandom >broken.lcmlog
head -c $(($(stat -c %s log1.lcmlog) * 3 / 4)) log1.lcmlog >"cut off.lcmlog"
# Frames of another program, whose intrinsics were not given.
cp "$tree/tests/fuzz/corpus/lcm_log/kinect_raw_rgb" unreadable.lcmlog
printf '%s\n' log1.lcmlog broken.lcmlog "cut off.lcmlog" log2.lcmlog missing.lcmlog unreadable.lcmlog >logs.txt

check "failures are told" exits 1 "$batch/parallel.sh" logs.txt out "${start[@]}"
check "the summary counts" grep -qx "3 of 6 logs are finished" command.out
for log in broken missing unreadable; do
  check "the summary lists $log" grep -q "^not finished: $log.lcmlog: .*$log.lcmlog" command.out
done
check "one without a readable frame is not finished" grep -q "nothing was tracked" out/unreadable.failed.txt
check "the others are finished" test "$(finished out)" = "cut off log1 log2"
check "all frames are tracked" test "$(frames out/log1/result.csv)" = 4
check "states are logged" test -s out/log1/states.lcmlog
check "a damaged log is said" grep -q "damaged or cut off" "out/cut off/report.txt"
check "the broken one says why" grep -q broken.lcmlog out/broken.failed.txt
check "the missing one says why" grep -q missing.lcmlog out/missing.failed.txt
check "the exit codes are kept" test "$(tail -n +2 out/joblog | cut -f7 | sort | paste -sd' ')" = "0 0 0 1 2 2"
check "no drafts are left" test -z "$(ls out/.unfinished)"

before=$(stat -c %i:%Y out/log1/*)
cp whole.lcmlog broken.lcmlog
cp whole.lcmlog missing.lcmlog
check "one without a readable frame is tried again" exits 1 "$batch/one_log.sh" unreadable.lcmlog out "${start[@]}"
cp whole.lcmlog unreadable.lcmlog
check "the second run finishes the rest" exits 0 "$batch/parallel.sh" logs.txt out "${start[@]}"
check "all are finished" test "$(finished out)" = "broken cut off log1 log2 missing unreadable"
check "the summary has nothing to list" exits 0 "$batch/summary.sh" logs.txt out
check "what was finished is left alone" test "$(stat -c %i:%Y out/log1/*)" = "$before"
check "old failures are forgotten" test -z "$(ls out/*.failed.txt 2>/dev/null)"
check "what is finished is not tracked again" exits 0 env BAREHAND=false "$batch/one_log.sh" log1.lcmlog out "${start[@]}"
check "other options need another folder" exits 2 "$batch/one_log.sh" log1.lcmlog out
check "another log of this name needs another folder" exits 2 "$batch/one_log.sh" other/log1.lcmlog out "${start[@]}"
echo other/log1.lcmlog >other.txt
check "the summary does not count it" exits 1 "$batch/summary.sh" other.txt out

# Long enough to be stopped in the middle.
simulate long.lcmlog --frames 60
until_it_tracks() {  # OUT JOB
  until [ -n "$(find "$1" -name result.csv.unfinished -size +0 2>/dev/null)" ]; do
    kill -0 "$2" 2>/dev/null || { echo "FAILED: it ended before it was stopped"; exit 1; }
    sleep 0.02
  done
}
stopped() {  # SIGNAL: starts tracking long.lcmlog, stops it in the middle and returns its exit code
  local code=0
  rm -rf stop
  "$batch/one_log.sh" long.lcmlog stop "${start[@]}" >/dev/null 2>&1 &
  local job=$!
  until_it_tracks stop $job
  kill "-$1" $job
  wait $job 2>/dev/null || code=$?
  return $code
}
check "a stopped one is not finished" exits 130 stopped TERM
check "its output does not count" test "$(finished stop)" = ""
"$batch/one_log.sh" long.lcmlog killed "${start[@]}" >/dev/null 2>&1 &
job=$!
until_it_tracks killed $job
tracker=$(pgrep -P $job barehand)
kill -KILL $job "$tracker"
wait $job 2>/dev/null
check "a killed one is not finished" test "$(finished killed)" = ""
check "it is done again" exits 0 "$batch/one_log.sh" long.lcmlog killed "${start[@]}"
check "completely" test "$(frames killed/long/result.csv)" = 60

# An array job of two elements, as Slurm starts them.
printf '%s\n' log1.lcmlog log2.lcmlog whole.lcmlog >three.txt
element() {  # INDEX
  env BAREHAND_BATCH="$batch" SLURM_ARRAY_TASK_ID="$1" SLURM_ARRAY_TASK_COUNT=2 "$batch/slurm.sh" three.txt array "${start[@]}"
}
check "the first element" exits 0 element 0
check "has its share" test "$(finished array)" = "log1 whole"
check "the second element" exits 0 element 1
check "has the rest" test "$(finished array)" = "log1 log2 whole"
head -c 100 /dev/zero >log1.lcmlog
check "an element whose log is broken fails" exits 2 "$batch/share.sh" 0 2 three.txt fresh "${start[@]}"
for wrong in "2 2" "0 0" "5 1" "x 2"; do
  check "no element $wrong" exits 2 "$batch/share.sh" $wrong three.txt fresh "${start[@]}"
done
check "and goes on" test "$(finished fresh)" = "whole"
exit $failed
