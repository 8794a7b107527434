#!/usr/bin/env bash
# Is the stated uncertainty right? Prints the tables of docs/accuracy.md: the sequences that its constants were chosen
# on, and others.
#   tools/measure/measure_uncertainty.sh BAREHAND RECORDINGS OUT
set -eu
barehand=$1 data=$2 out=$3
adult=$(dirname "$0")/../../configs/hands/adult_right.json
mkdir -p "$out"
simulated() {  # NAME SEQUENCE OPTIONS...
  local name=$1
  shift
  [ -d "$out/$name" ] || "$barehand" sim "$@" --out "$out/$name" >"$out/$name.log" 2>&1
}
judge() {  # TITLE HAND FOLDER...: HAND is own, or a profile for all
  local title=$1 hand=$2 pairs=() folder log
  shift 2
  for folder in "$@"; do
    log="$out/$(basename "$folder").$(basename "$hand" .json).lcmlog"
    "$barehand" track --source "folder:$folder" --no-publish --overwrite --states-log "$log" \
      --hand "$([ "$hand" = own ] && echo "$folder/hand.json" || echo "$hand")" >"$log.txt" 2>&1
    pairs+=(--truth "$folder/truth.csv" --states "$log")
  done
  echo "== $title"
  "$barehand" eval "${pairs[@]}" --overwrite --plots "$out/$title"
}
larger="scale=1.12 thickness=1.1 index=1.08 middle=1.08 ring=1.08"
simulated fist fist
simulated fist_kinect fist --noise kinect
simulated fist_larger fist --set $larger
simulated fist_smaller fist --set scale=0.88 thickness=0.92
for n in 1 2 3 4 5 6; do simulated occlusion_$n occlusion_$n; done
for thing in ball mug pliers; do simulated grasp_$thing grasp_$thing; done
s=$out
judge chosen_on own $s/fist $s/fist_kinect $s/fist_larger $s/occlusion_2 $s/occlusion_4 $s/occlusion_6 $s/grasp_ball \
  $s/grasp_mug "$data/fist_twice"
judge unseen_simulated own $s/fist_smaller $s/occlusion_1 $s/occlusion_3 $s/occlusion_5 $s/grasp_pliers
judge unseen_recordings own "$data/occlusion_3" "$data/occlusion_6" "$data/grasp_ball" "$data/tz19_kinect"
judge mean_hand_chosen_on "$adult" $s/fist $s/fist_kinect $s/fist_larger $s/occlusion_2 $s/occlusion_4 $s/grasp_ball
judge mean_hand_unseen "$adult" "$data/fist_twice" "$data/grasp_ball" "$data/tz19_kinect"
