#!/usr/bin/env bash
# Makes docs/images/grasp.webp, the first image of README: the overlay of a simulated hand that grasps and turns a ball.
# Needs ffmpeg (Debian package ffmpeg).
#   tools/docs/moving_picture.sh [BAREHAND]
set -euo pipefail
cd "$(dirname "$0")/../.."
barehand=${1:-build/release/src/app/barehand}
command -v ffmpeg >/dev/null || { echo "ffmpeg is missing: apt-get install ffmpeg" >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$barehand" track --source sim:grasp_ball,focal=1000 --no-publish --overlay "$work/grasp.mkv"

# Cut both images to the hand and put them side by side, at 10 instead of 30 frames per second. The first frames, in
# which no hand is tracked yet, are left out.
parts="select='gte(n,10)',fps=10,split[a][b];[a]crop=440:440:150:0[colour];[b]crop=440:440:790:0[depth]"
ffmpeg -v error -y -i "$work/grasp.mkv" -filter_complex "[0]$parts;[colour][depth]hstack,scale=800:-2:flags=lanczos" \
  -c:v libwebp_anim -quality 65 -compression_level 4 -loop 0 "$work/grasp.webp"
mv "$work/grasp.webp" docs/images/grasp.webp
ls -l docs/images/grasp.webp
