#!/usr/bin/env bash
# Makes a recording of the first frames of one recording, and of those of another from then on. Both show one motion.
#   tools/measure/join_recordings.sh FIRST SECOND FRAME OUT
set -eu
first=$1 second=$2 frame=$3 out=$4
cp -r "$first" "$out"
chmod -R u+w "$out"
for image in "$second"/{depth,rgb}/*; do
  name=${image##*/}
  ((10#${name%.*} < frame)) || cp "$image" "$out/${image#"$second"/}"
done
