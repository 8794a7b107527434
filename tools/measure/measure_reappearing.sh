#!/usr/bin/env bash
# How soon a hand is tracked as well as ever once what hid it is gone: from frame 20 on, the frames of occlusion level 0
# follow those of the other levels, which show the same motion. Prints the error from that frame on.
#   tools/measure/measure_reappearing.sh BAREHAND RECORDINGS OUT
set -eu
barehand=$1 data=$2 out=$3
first=20
mkdir -p "$out"
judge() {  # FOLDER NAME
  "$barehand" track --source "folder:$1" --hand "$1/hand.json" --no-publish --overwrite --result "$out/$2.csv" >"$out/$2.log" 2>&1
  echo "== $2, from frame $first on"
  "$barehand" eval --truth "$1/truth.csv" --result "$out/$2.csv" --start $first
}
reappearing() {  # NAME LEVEL_0 LEVEL
  local joined=$out/$1.joined
  rm -rf "$joined"
  cp -r "$3" "$joined"
  chmod -R u+w "$joined"
  for image in "$2"/{depth,rgb}/*; do
    local name=${image##*/}
    ((10#${name%.*} < first)) || cp "$image" "$joined/${image#"$2"/}"
  done
  judge "$joined" "$1"
}
for level in 0 1 2 3 4 5 6; do
  rm -rf "$out/simulated_$level"
  "$barehand" sim occlusion_$level --out "$out/simulated_$level" >"$out/sim_$level.log" 2>&1
done
judge "$out/simulated_0" simulated_never_hidden
for level in 1 2 3 4 5 6; do
  reappearing simulated_after_level_$level "$out/simulated_0" "$out/simulated_$level"
done
judge "$data/occlusion_0" recorded_never_hidden
for level in 3 6; do reappearing recorded_after_level_$level "$data/occlusion_0" "$data/occlusion_$level"; done
