#!/usr/bin/env bash
# Joins two recordings of the same motion: OUT has the frames before FRAME from FIRST, and the others from SECOND.
#   tools/measure/join_recordings.sh FIRST SECOND FRAME OUT
set -eu
first=$1 second=$2 frame=$3 out=$4
cp -r "$first" "$out"
chmod -R u+w "$out"
for image in "$second"/{depth,rgb}/*; do
  name=${image##*/}
  ((10#${name%.*} < frame)) || cp "$image" "$out/${image#"$second"/}"
done
