#!/usr/bin/env bash
# Tests the container image of deploy/Containerfile, which is built unless one is given: runs `barehand doctor`, an
# element of the Kubernetes job as in a pod, and a service, which must publish on LCM and stop in time.
#   tests/package/container.sh [IMAGE]    as root; needs podman and, to build, a registry with debian:12-slim
# PODMAN: the podman command with its options. PODMAN_BUILD: options of `podman build`. BAREHAND_HANDS: as for
# clean_install.sh.
set -euo pipefail

here=$(dirname "$(realpath "$0")") image=${1:-} podman=${PODMAN:-podman}
hands=${BAREHAND_HANDS:-${XDG_CACHE_HOME:-$HOME/.cache}/barehand/hands}
[ -f "$hands/right.glb" ] || { echo "$hands/right.glb is not there: run deploy/fetch_hand_mesh.sh" >&2; exit 2; }
command -v "${podman%% *}" >/dev/null || { echo "podman is missing: apt-get install podman" >&2; exit 2; }
work=$(mktemp -d)
trap '$podman rm --force barehand_test >/dev/null 2>&1; rm -rf "$work"' EXIT

say() { echo "== $*"; }
die() { echo "FAILED: $*" >&2; exit 1; }
run() { $podman run --rm --volume "$hands:/hands:ro" --env BAREHAND_HANDS=/hands "$@"; }

if [ -z "$image" ]; then
  say "the image"
  image=barehand
  $podman build ${PODMAN_BUILD:-} -f "$here/../../deploy/Containerfile" -t $image "$here/../.." >"$work/log" 2>&1 ||
    { tail -30 "$work/log" >&2; die "it does not build"; }
fi

say "barehand doctor"
run --network host "$image" | tee "$work/doctor" || die "doctor finds a problem"
grep -q 'configuration default.yaml: /usr/share/barehand/' "$work/doctor" || die "it does not find its own files"

say "the Kubernetes job"
mkdir "$work/recordings"
chown 1000:1000 "$work/recordings"
for log in a b c; do
  run --network none --volume "$work/recordings:/recordings" "$image" \
    sim fist --frames 3 --out /recordings/$log.lcmlog >/dev/null 2>&1 || die "sim writes no log"
  echo $log.lcmlog >>"$work/recordings/logs.txt"
done
line=$(sed -n 's/^ *args: \["\(.*\)"\]$/\1/p' "$here/../../deploy/batch/kubernetes.yaml")
for index in 0 1; do
  run --network none --read-only --cap-drop ALL --security-opt no-new-privileges --user 1000:1000 \
    --volume "$work/recordings:/recordings" --workdir /recordings --env COUNT=2 --env JOB_COMPLETION_INDEX=$index \
    --entrypoint /bin/sh "$image" -c "$line" || die "element $index fails"
done
for log in a b c; do [ -s "$work/recordings/out/$log/result.csv" ] || die "$log was not tracked"; done

say "a service"
# Use a private network whose loopback interface carries multicast, so that no message leaves the machine.
unshare --net sh -c '
  ip link set lo up && ip route add 224.0.0.0/4 dev lo || exit 1
  podman=$1 hands=$2 image=$3 heard=$4
  $podman run --detach --name barehand_test --network host --volume "$hands:/hands:ro" --env BAREHAND_HANDS=/hands \
    "$image" track --source sim:fist,live=true,loop=true >/dev/null || exit 1
  timeout 30 $podman run --rm --network host "$image" listen >"$heard" 2>&1 &
  for second in $(seq 30); do grep -q "hand 1  tracking" "$heard" && break; sleep 1; done
  date +%s%N >"$heard.stop"
  $podman stop --time 10 barehand_test >/dev/null
  date +%s%N >>"$heard.stop"' sh "$podman" "$hands" "$image" "$work/heard" || die "it does not run"
grep -q "hand 1  tracking" "$work/heard" || die "its hand states are not heard"
[ "$($podman inspect barehand_test --format '{{.State.ExitCode}}')" = 0 ] || die "it stops with another exit code than 0"
took=$(awk 'NR == 1 {start = $1} END {printf "%d", ($1 - start) / 1e6}' "$work/heard.stop")
[ "$took" -lt 2000 ] || die "it stops after $took ms"
echo "stopped after $took ms"
echo "passed"
