#!/usr/bin/env bash
# Checks how many shared libraries the program loads when it starts, and that those for videos are not among them.
#   libraries.sh PROGRAM VIDEO_MODULE
set -euo pipefail

most=59
unwanted='libav|libsw|libx26|libgdal|opencv_(imgcodecs|videoio|highgui)'

loaded=$(ldd "$1")
count=$(wc -l <<<"$loaded")
grep -q libopencv_core <<<"$loaded" || { echo "the check itself is broken: the program's own libraries are not seen"; exit 1; }
video=$(ldd "$2")
grep -qE "$unwanted" <<<"$video" || { echo "the check itself is broken: the video module loads no libav"; exit 1; }
[ "$count" -le $most ] || { echo "$loaded"; echo "$count libraries, at most $most are expected"; exit 1; }
if grep -E "$unwanted" <<<"$loaded"; then echo "these are for videos or other image formats"; exit 1; fi
echo "$count libraries"
