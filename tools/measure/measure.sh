#!/usr/bin/env bash
# Tracks the recordings of a folder and prints the figures of docs/accuracy.md.
#   tools/measure/measure.sh BAREHAND RECORDINGS OUT
set -u
barehand=$1 data=$2 out=$3
mkdir -p "$out"
row() {  # NAME RECORDING CONFIG EXTRA...
  local name=$1 recording=$2 config=$3
  shift 3
  "$barehand" track --source "folder:$data/$recording" --config "$config" --no-publish --overwrite --result "$out/$name.csv" "$@" \
    >"$out/$name.log" 2>&1 || echo "$name: track failed, see $out/$name.log"
}
judge() {  # TITLE RECORDING NAME EXTRA...
  local title=$1 recording=$2 name=$3
  shift 3
  echo "== $recording, $title"
  "$barehand" eval --overwrite --truth "$data/$recording/truth.csv" --result "$out/$name.csv" "$@"
}
for recording in fist_twice occlusion_0 occlusion_3 occlusion_6 grasp_ball tz19_kinect; do
  own=$data/$recording/hand.json
  for config in ${CONFIGS:-default paper}; do
    name=$recording.$config
    row $name $recording $config --hand "$own"
    judge $config $recording $name --hand "$own" --json "$out/$name.json" --plots "$out/$name"
  done
done

adult=$(dirname "$0")/../../configs/hands/adult_right.json
"$barehand" track --print-config | sed 's/scans: 3/scans: 0/' >"$out/no_scan.yaml"
"$barehand" track --print-config=all | sed '/shape_fit:/,/every:/s/enabled: true/enabled: false/' >"$out/not_fitted.yaml"
for recording in fist_twice grasp_ball tz19_kinect; do
  own=$data/$recording/hand.json
  row $recording.no_scan $recording "$out/no_scan.yaml" --hand "$own"
  judge "without the scan" $recording $recording.no_scan
  for step in 2 3; do
    row $recording.step_$step $recording default --hand "$own" --step $step
    judge "one frame of $step" $recording $recording.step_$step --step $step
  done
  mean=$recording.mean_hand
  row $mean $recording default --hand "$adult" --save-hand "$out/$recording.hand.json"
  judge "mean hand fitted and scanned while tracking" $recording $mean
  judge "the same after the first 60 frames" $recording $mean --start 60
  row $mean.no_scan $recording "$out/no_scan.yaml" --hand "$adult"
  judge "mean hand fitted, without the scan" $recording $mean.no_scan
  row $mean.not_fitted $recording "$out/not_fitted.yaml" --hand "$adult"
  judge "mean hand, not fitted" $recording $mean.not_fitted
done

"$barehand" calibrate --source "folder:$data/fist_twice" --hand "$data/fist_twice/hand.json" --overwrite --out "$out/mine.json" \
  >"$out/calibrate.log" 2>&1 || echo "calibrate failed, see $out/calibrate.log"
for recording in fist_twice occlusion_0 occlusion_3 occlusion_6 grasp_ball; do
  row $recording.scanned $recording default --hand "$out/mine.json"
  judge "with the skin scanned from fist_twice" $recording $recording.scanned
done

row kinect2_person kinect2_person default --hand "$adult"
echo "== kinect2_person"
"$barehand" eval --fingertips "$data/kinect2_person/fingertips_2d.csv" --recording "$data/kinect2_person" \
  --hand "$adult" --result "$out/kinect2_person.csv"

row uvr_forwards uvr_sphere default --hand "$adult" --start 326 --step 1
row uvr_backwards uvr_sphere default --hand "$adult" --start 326 --step -1
row uvr_all uvr_sphere default --hand "$adult"
for way in forwards backwards all; do
  echo "== uvr_sphere $way"
  "$barehand" eval --fingertips "$data/uvr_sphere/fingertips_2d.csv" --recording "$data/uvr_sphere" --hand "$adult" \
    --result "$out/uvr_$way.csv"
done
