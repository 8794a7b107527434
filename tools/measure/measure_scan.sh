#!/usr/bin/env bash
# What a scan of a hand is worth (docs/accuracy.md): three simulated hands are scanned, from the mean hand and from their
# measured profiles, and tracked in other sequences; four more are scanned from the mean hand.
#   tools/measure/measure_scan.sh BAREHAND OUT
set -eu
barehand=$1 out=$2
adult=$(dirname "$0")/../../configs/hands/adult_right.json
mkdir -p "$out"
"$barehand" track --print-config | sed 's/scans: 3/scans: 0/' >"$out/no_scan.yaml"
"$barehand" track --print-config=all | sed '/shape_fit:/,/every:/s/enabled: true/enabled: false/' >"$out/not_fitted.yaml"
figures() {  # TITLE FOLDER EXTRA...: of the last run
  printf '%-54s' "$1"
  "$barehand" eval --truth "$2/truth.csv" --result "$out/result.csv" "${@:3}" | awk '
    /lost/ && !lost {lost = $6} $1 == "frame" && $2 + 0 {printf "mean %s, median %s, max %s mm, lost %s\n", $3, $4, $10, lost}'
}
judge() {  # TITLE FOLDER HAND EXTRA...
  "$barehand" track --source "folder:$2" --hand "$3" --no-publish --overwrite --result "$out/result.csv" "${@:4}" \
    >"$out/track.log" 2>&1
  figures "$1" "$2"
}
simulated() {  # NAME SEQUENCE OPTIONS...
  local name=$1
  shift
  [ -d "$out/$name" ] || "$barehand" sim "$@" --out "$out/$name" >"$out/$name.log" 2>&1
}
scan_from_mean() {  # NAME OPTIONS...: a hand of that name
  local name=$1
  shift
  simulated "scan_$name" scan "$@"
  simulated "fist_$name" fist "$@"
  "$barehand" calibrate --source "folder:$out/scan_$name" --overwrite --out "$out/$name.mean.json" \
    >"$out/calibrate_$name.mean.log" 2>&1
}
scanned() {  # NAME OPTIONS...
  scan_from_mean "$@"
  local name=$1 own="$out/fist_$1/hand.json" from_mean="$out/$1.mean.json" from_own="$out/$1.own.json"
  "$barehand" calibrate --source "folder:$out/scan_$name" --hand "$own" --overwrite --out "$from_own" \
    >"$out/calibrate_$name.own.log" 2>&1
  judge "$name: mean hand, not fitted" "$out/fist_$name" "$adult" --config "$out/not_fitted.yaml"
  judge "$name: mean hand, without the scan" "$out/fist_$name" "$adult" --config "$out/no_scan.yaml"
  judge "$name: mean hand" "$out/fist_$name" "$adult"
  figures "$name: the same after the first 60 frames" "$out/fist_$name" --start 60
  judge "$name: scanned from the mean hand" "$out/fist_$name" "$from_mean"
  judge "$name: measured profile, without the scan" "$out/fist_$name" "$own" --config "$out/no_scan.yaml"
  judge "$name: measured profile" "$out/fist_$name" "$own" --save-hand "$out/$name.way.json"
  figures "$name: the same after the first 60 frames" "$out/fist_$name" --start 60
  judge "$name: scanned from the measured profile" "$out/fist_$name" "$from_own"
}
another() {  # NAME OPTIONS...
  scan_from_mean "$@"
  judge "$1: scanned from the mean hand" "$out/fist_$1" "$out/$1.mean.json"
}
scanned as_in_file
scanned larger --set scale=1.12 thickness=1.1 index=1.08 middle=1.08 ring=1.08
scanned smaller --set scale=0.88 thickness=0.92
scanned kinect --noise kinect
another slender --set scale=1.05 thickness=0.9 index=1.1 ring=1.05 little=0.95
another stout --set scale=0.95 thickness=1.15 thumb=1.08 middle=0.95
another narrow --set scale=1.08 thickness=0.95 index=0.95 little=1.08 thumb=1.05
another broad --set scale=0.92 thickness=1.08 middle=1.06 thumb=0.94 ring=1.03
for sequence in occlusion_{0,1,2,3,4,5,6} grasp_{mug,ball,pliers}; do
  simulated $sequence $sequence
  judge "$sequence: measured profile" "$out/$sequence" "$out/$sequence/hand.json"
  for start in mean own way; do judge "$sequence: scanned, $start" "$out/$sequence" "$out/as_in_file.$start.json"; done
done
