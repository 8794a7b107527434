#!/usr/bin/env bash
# Installs the packages into a fresh, minimal Debian 12 tree, runs them there as an ordinary user, and removes them again.
#   tests/package/clean_install.sh barehand_VERSION.deb [MIRROR]    as root; needs mmdebstrap and a Debian mirror
# The packages barehand-video and python3-barehand of the same version must be in the same folder.
# The simulator's hand meshes are downloaded by deploy/fetch_hand_mesh.sh, or taken from the folder BAREHAND_HANDS.
set -euo pipefail

package=$(realpath "$1") mirror=${2:-http://deb.debian.org/debian}
video=${package%/*}/barehand-video_${package##*/barehand_}
python=$(echo "${package%/*}"/python3-barehand_*_all.deb)
hands=${BAREHAND_HANDS:-${XDG_CACHE_HOME:-$HOME/.cache}/barehand/hands}
for hand in left right; do
  [ -f "$hands/$hand.glb" ] || { echo "$hands/$hand.glb is not there: run deploy/fetch_hand_mesh.sh" >&2; exit 2; }
done
command -v mmdebstrap >/dev/null || { echo "mmdebstrap is missing: apt-get install mmdebstrap" >&2; exit 2; }
work=$(mktemp -d)
chmod 755 "$work"
trap 'rm -rf "$work"' EXIT
root=$work/root

say() { echo "== $*"; }
die() { echo "FAILED: $*" >&2; exit 1; }
# Runs a command in the tree, with its own /proc and with a private network whose loopback interface carries multicast.
inside() {
  unshare --net --mount --pid --fork sh -c '
    ip link set lo up && ip route add 224.0.0.0/4 dev lo &&
    mount -t proc proc "$0/proc" && exec chroot "$0" setpriv --reuid=nobody --regid=nogroup --clear-groups \
      env -i PATH=/usr/bin:/bin HOME=/tmp BAREHAND_HANDS=/opt/hands "$@"' "$root" "$@"
}

say "a minimal Debian 12 with $(basename "$package")"
mmdebstrap --quiet --variant=minbase --aptopt='APT::Install-Recommends "false"' \
  --customize-hook="copy-in '$package' '$video' '$python' /opt" \
  --customize-hook="chroot \"\$1\" dpkg-query -W -f='\${Package}\n' | sort >'$work/before'" \
  --customize-hook="chroot \"\$1\" apt-get install --yes /opt/$(basename "$package")" \
  --customize-hook="chroot \"\$1\" dpkg-query -W -f='\${Package}\n' | sort >'$work/after'" \
  --customize-hook="chroot \"\$1\" apt-get install --yes --download-only /opt/$(basename "$video")" \
  --customize-hook="chroot \"\$1\" apt-get install --yes --download-only /opt/$(basename "$python")" \
  --skip=cleanup/apt \
  bookworm "$root" "$mirror" >"$work/log" 2>&1 || { tail -30 "$work/log" >&2; die "it does not install"; }
say "$(comm -13 "$work/before" "$work/after" | wc -l) packages came with it"
mkdir -p "$root/opt/hands"
cp "$hands"/{left,right}.glb "$root/opt/hands"
chroot "$root" dpkg --verify barehand || die "files differ from the package"
missing=$(chroot "$root" ldd /usr/bin/barehand | grep 'not found' || true)
[ -z "$missing" ] || die "libraries are missing: $missing"

say "barehand doctor"
inside barehand doctor | tee "$work/doctor" || die "doctor finds a problem"
grep -q 'configuration default.yaml: /usr/share/barehand/' "$work/doctor" || die "it does not find its own files"

say "barehand track"
inside barehand track --source sim:fist,frames=10 --result /tmp/fist.csv --states-log /tmp/fist.lcmlog |
  tee "$work/track"
grep -q "): 10 published" "$work/track" || die "not 10 frames published"
[ -s "$root/tmp/fist.csv" ] && [ -s "$root/tmp/fist.lcmlog" ] || die "nothing is written"
inside barehand track --config paper --print-config >/dev/null || die "it does not find paper.yaml"

# The loader chooses the library built for AVX2 if the processor supports it. Here it is told that it does not, so that
# the other one is tested, too.
say "the program for processors without AVX2"
older=(env GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2)
inside "${older[@]}" barehand doctor >"$work/doctor_older" || die "it does not run"
grep -q 'the program uses neither AVX2' "$work/doctor_older" || die "the loader took the program for AVX2"
inside "${older[@]}" barehand track --source sim:fist,frames=10 --no-publish --result /tmp/older.csv >/dev/null
if grep -q 'the program uses AVX2' "$work/doctor"; then
  paste -d, "$root/tmp/fist.csv" "$root/tmp/older.csv" | awk -F, 'NR > 1 {
    for (i = 4; i <= 9; ++i) { apart = $i - $(i + 10); sum += apart < 0 ? -apart : apart; ++n } }
    END { printf "%.3f mm apart in the mean\n", 1e3 * sum / n; exit !(n > 0 && sum / n < 0.0005) }' ||
    die "its hand poses differ"
fi

say "videos"
video_of_fist() { inside barehand track --source sim:fist,frames=10 --no-publish --overlay /tmp/fist.mp4; }
video_of_fist >"$work/video" 2>&1 && die "it writes a video without its module"
grep -q 'install the package barehand-video' "$work/video" || die "it does not say what a video needs"
# Installs a package file with dpkg, then its dependencies with apt, which would not install a file without downloads.
add() {
  { chroot "$root" dpkg --unpack "/opt/$(basename "$1")" &&
    chroot "$root" apt-get install --fix-broken --yes --no-download; } >"$work/log" 2>&1 ||
    { tail -30 "$work/log" >&2; die "$(basename "$1") does not install"; }
}
add "$video"
video_of_fist >"$work/video" 2>&1 || { cat "$work/video" >&2; die "it writes no video"; }
[ -s "$root/tmp/fist.mp4" ] || die "there is no video"

say "Python"
add "$python"
angles=/usr/share/barehand/clients/python/examples/angles.py
inside "$angles" 10 /tmp/fist.lcmlog | tee "$work/angles"
grep -qE '^frame 9 right tracking( -?[0-9.]+){3}$' "$work/angles" || die "it does not read the log"
inside sh -c "barehand track --source sim:fist,frames=200 >/dev/null 2>&1 & $angles 3" | tee "$work/angles"
[ "$(grep -c tracking "$work/angles")" = 3 ] || die "it does not hear the tracker"

for file in share/barehand/lcmtypes/hand_state_t.lcm share/barehand/configs/hands/adult_right.json \
            share/doc/barehand/copyright share/doc/barehand/docs/lcm.md lib/udev/rules.d/60-barehand-sensors.rules \
            share/barehand/deploy/batch/one_log.sh share/barehand/clients/javascript/angles.mjs; do
  [ -f "$root/usr/$file" ] || die "/usr/$file is not installed"
done

say "array job"
inside barehand sim fist --frames 3 --out /tmp/a.lcmlog >/dev/null 2>&1
inside /usr/share/barehand/deploy/batch/one_log.sh /tmp/a.lcmlog /tmp/out || die "one_log.sh fails"
[ -s "$root/tmp/out/a/result.csv" ] || die "one_log.sh makes nothing"

say "removed again"
chroot "$root" dpkg --purge python3-barehand barehand-video barehand >/dev/null
left=$(find "$root/usr" "$root/etc" "$root/lib" -iname '*barehand*')
[ -z "$left" ] || die "left behind: $left"
echo "passed"
