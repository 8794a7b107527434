#!/usr/bin/env bash
# Holds who may include whom: app -> stages, drivers -> observe -> hand -> math -> core; io beside observe; stages and
# drivers never include another of their kind; SDKs stay in their folders. First shows that it notices violations.
#   include_directions.sh SOURCE_TREE
set -u

violations() {  # ROOT: prints every forbidden include
  cd "$1" || return
  forbid() {  # FOLDER PATTERN
    [ -d "$1" ] && grep -rnE --include='*.h' --include='*.cpp' "#include [\"<]($2)" "$1"
  }
  local outer='app/|stages/|drivers/'
  forbid src/core "math/|hand/|observe/|io/|$outer"
  forbid src/math "hand/|observe/|io/|$outer"
  forbid src/hand "observe/|io/|$outer"
  forbid src/observe "io/|$outer"
  forbid src/io "observe/|$outer"
  forbid stages 'app/|drivers/'
  forbid drivers 'app/|stages/'
  local folder
  for folder in stages/* drivers/*; do
    [ -d "$folder" ] && forbid "$folder" "${folder%%/*}/" | grep -v "#include \"$folder/"
  done
  for folder in src/core src/math src/hand src/observe stages/segment_tracker stages/fusion stages/refinement \
                stages/prediction; do
    forbid "$folder" 'opencv2/|lcm/|assimp/|yaml-cpp/|nlohmann/'
  done
  forbid drivers 'opencv2/|yaml-cpp/'
  for folder in src stages drivers; do
    forbid "$folder" 'EGL/|GLES' | grep -v '^src/observe/egl/'
    forbid "$folder" 'libav|libsw' | grep -v '^src/io/video/'
    forbid "$folder" 'OpenNI|Oni|openni2/|libusb' | grep -vE '^drivers/(openni2|usb)/'
  done
}

example=$(mktemp -d)
trap 'rm -rf "$example"' EXIT
mkdir -p "$example"/{src/core,stages/fusion,drivers/lcm}
echo '#include "hand/profile.h"' >"$example/src/core/a.h"
echo '#include "stages/publish/publisher.h"' >"$example/stages/fusion/b.cpp"
echo '#include <opencv2/core.hpp>' >"$example/drivers/lcm/c.cpp"
echo '#include <EGL/egl.h>' >"$example/src/core/d.h"
echo '#include <OpenNI.h>' >"$example/src/core/e.h"
echo '#include <libavcodec/avcodec.h>' >"$example/src/core/f.h"
found=$(violations "$example" | wc -l)
[ "$found" = 6 ] || { echo "the check itself is broken: it found $found of 6 planted violations"; exit 1; }

found=$(violations "$1")
[ -z "$found" ] || { echo "forbidden includes:"; echo "$found"; exit 1; }
