#!/usr/bin/env bash
# Tracks the recordings of a folder and prints the figures of docs/results.md.
#   docs/measure.sh BAREHAND RECORDINGS OUT
set -u
barehand=$1 data=$2 out=$3
mkdir -p "$out"
row() {  # NAME RECORDING CONFIG EXTRA...
  local name=$1 recording=$2 config=$3
  shift 3
  "$barehand" track --source "folder:$data/$recording" --config "$config" --no-publish --result "$out/$name.csv" "$@" \
    >"$out/$name.log" 2>&1 || echo "$name: track failed, see $out/$name.log"
}
for recording in fist_twice occlusion_0 occlusion_3 occlusion_6 grasp_ball tz19_kinect; do
  for config in ${CONFIGS:-default paper}; do
    row "$recording.$config" $recording $config --hand "$data/$recording/hand.json"
    echo "== $recording $config"
    "$barehand" eval --truth "$data/$recording/truth.csv" --result "$out/$recording.$config.csv" \
      --hand "$data/$recording/hand.json" --json "$out/$recording.$config.json" --plots "$out/$recording.$config" 
  done
done
adult=$(dirname "$0")/../configs/hands/adult_right.json
for recording in fist_twice tz19_kinect; do
  row "$recording.mean_hand" $recording default --hand "$adult" --save-hand "$out/$recording.hand.json"
  echo "== $recording, mean hand fitted while tracking"
  "$barehand" eval --truth "$data/$recording/truth.csv" --result "$out/$recording.mean_hand.csv"
done
row uvr_forwards uvr_sphere default --hand "$adult" --start 326 --step 1
row uvr_backwards uvr_sphere default --hand "$adult" --start 326 --step -1
row uvr_all uvr_sphere default --hand "$adult"
for way in forwards backwards all; do
  echo "== uvr_sphere $way"
  "$barehand" eval --fingertips "$data/uvr_sphere/fingertips_2d.csv" --recording "$data/uvr_sphere" --hand "$adult" \
    --result "$out/uvr_$way.csv"
done
