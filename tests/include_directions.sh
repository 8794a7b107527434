#!/usr/bin/env bash
# Checks the directions of includes between folders. A folder may include those to its right:
#   app -> pipeline -> tracking -> person -> stages, drivers -> evaluation -> io, observe -> hand, object, sensor ->
#   math -> core
# A stage never includes another stage, a driver never another driver, io and observe never each other. Headers of an
# SDK are included in one folder only. First checks that violations are found.
#   include_directions.sh SOURCE_TREE
set -u

violations() {  # ROOT: prints every forbidden include
  cd "$1" || return
  forbid() {  # FOLDER PATTERN
    [ -d "$1" ] && grep -rnE --include='*.h' --include='*.cpp' "#include [\"<]($2)" "$1"
  }

  # A folder may not include those to its left.
  local above='app/|pipeline/|tracking/|person/'
  forbid src/pipeline 'app/'
  forbid src/tracking 'app/|pipeline/'
  forbid src/person 'app/|pipeline/|tracking/'
  forbid stages "$above|drivers/"
  forbid drivers "$above|stages/"
  above="$above|stages/|drivers/"
  forbid src/evaluation "$above"
  above="$above|evaluation/"
  forbid src/io "$above|observe/"
  forbid src/observe "$above|io/"
  above="$above|io/|observe/"
  forbid src/hand "$above"
  forbid src/object "$above|hand/|sensor/"
  forbid src/sensor "$above|hand/"
  above="$above|hand/|sensor/"
  forbid src/math "$above"
  forbid src/core "$above|math/"

  # Folders between the same two arrows may not include each other.
  local folder
  for folder in stages/* drivers/*; do
    [ -d "$folder" ] && forbid "$folder" "${folder%%/*}/" | grep -v "#include \"$folder/"
  done

  # Libraries that only one folder may use.
  for folder in src/core src/math src/sensor src/hand src/observe src/person stages/segment_tracker stages/fusion \
                stages/refinement stages/prediction stages/search stages/pose_prior stages/known_object src/object; do
    forbid "$folder" 'opencv2/|lcm/|assimp/|yaml-cpp/|nlohmann/'
  done
  forbid drivers 'opencv2/|yaml-cpp/'
  for folder in src stages drivers; do
    forbid "$folder" 'EGL/|GLES' | grep -v '^src/observe/egl/'
    forbid "$folder" 'libav|libsw' | grep -v '^src/io/video/'
    forbid "$folder" 'OpenNI|Oni|openni2/|libusb' | grep -vE '^drivers/(openni2|usb)/|"drivers/openni2/'
    forbid "$folder" 'civetweb' | grep -v '^src/io/web/'
    forbid "$folder" 'fastcdr' | grep -v '^src/io/ros/'
    forbid "$folder" 'opencv2/dnn|oneapi/|onnx/' | grep -v '^stages/detection/'
  done
}

example=$(mktemp -d)
trap 'rm -rf "$example"' EXIT
mkdir -p "$example"/{src/core,src/person,src/tracking,src/sensor,stages/fusion,drivers/lcm}
echo '#include "hand/profile.h"' >"$example/src/core/a.h"
echo '#include "stages/publish/publisher.h"' >"$example/stages/fusion/b.cpp"
echo '#include <opencv2/core.hpp>' >"$example/drivers/lcm/c.cpp"
echo '#include <EGL/egl.h>' >"$example/src/core/d.h"
echo '#include <OpenNI.h>' >"$example/src/core/e.h"
echo '#include <libavcodec/avcodec.h>' >"$example/src/core/f.h"
echo '#include "tracking/hand_tracker.h"' >"$example/src/person/g.h"
echo '#include "pipeline/pipeline.h"' >"$example/src/tracking/h.h"
echo '#include "hand/profile.h"' >"$example/src/sensor/i.h"
echo '#include <oneapi/dnnl/dnnl.hpp>' >"$example/src/tracking/j.cpp"
echo '#include <civetweb.h>' >"$example/src/core/k.h"
echo '#include <fastcdr/Cdr.h>' >"$example/src/core/l.h"
found=$(violations "$example" | wc -l)
[ "$found" = 12 ] || { echo "the check itself is broken: it found $found of 12 planted violations"; exit 1; }

found=$(violations "$1")
[ -z "$found" ] || { echo "forbidden includes:"; echo "$found"; exit 1; }

# A folder with too many files to survey at a glance should be divided.
for folder in $(cd "$1" && find src stages drivers -type d); do
  files=$(find "$1/$folder" -maxdepth 1 -type f | wc -l) most=30
  [ "$folder" = src/app ] && most=12
  [ "$files" -le "$most" ] || { echo "$folder holds $files files, at most $most are allowed"; exit 1; }
done
