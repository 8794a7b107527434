#!/bin/sh
# Fetches the simulator's hand meshes (left.glb, right.glb: the rigged generic-hand of the npm package
# @webxr-input-profiles/assets, MIT licence) into the cache folder. Needs the network only the first time.
#   deploy/fetch_hand_mesh.sh [ARCHIVE.tgz]     ARCHIVE: a copy of the package that is already here
set -eu

package=@webxr-input-profiles/assets@1.0.20
left=bc67783144944ea1cda54d9247885825ea5fb9d4651469fe7d00be517a5c2b87
right=291790c14f7f88a7f9bd35330c47392ed8e8d395ae6728f4bb7089f1bc1f2b96
hands=${BAREHAND_HANDS:-${XDG_CACHE_HOME:-$HOME/.cache}/barehand/hands}

intact() {  # whether the folder $1 contains both hands with the right checksums
  printf '%s  %s\n%s  %s\n' "$left" "$1/left.glb" "$right" "$1/right.glb" | sha256sum --check --status 2>/dev/null
}

if intact "$hands"; then
  echo "hand meshes are in $hands"
  exit 0
fi

mkdir -p "$hands"
work=$(mktemp -d "$hands/.fetch.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM

archive=${1:-}
if [ -z "$archive" ]; then
  command -v npm >/dev/null || { echo "npm is missing: apt-get install npm, or give a copy of the package: $0 ARCHIVE.tgz" >&2; exit 1; }
  echo "fetching $package (93 MB, once)"
  (cd "$work" && npm pack --silent "$package" >/dev/null) || {
    echo "cannot fetch $package: is the network there? With a copy of the package: $0 ARCHIVE.tgz" >&2
    exit 1
  }
  archive=$(ls "$work"/*.tgz)
fi

tar -xzf "$archive" -C "$work" --strip-components=4 \
  package/dist/profiles/generic-hand/left.glb package/dist/profiles/generic-hand/right.glb
intact "$work" || { echo "$archive: the hand meshes have other checksums than $package" >&2; exit 1; }
mv -f "$work/left.glb" "$work/right.glb" "$hands/"
echo "hand meshes are in $hands"
