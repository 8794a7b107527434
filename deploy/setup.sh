#!/usr/bin/env bash
# Prepares a fresh Debian 12 for Barehand: installs packages, fetches the simulator's hand mesh and builds a release.
#   deploy/setup.sh            installs, fetches and builds
#   deploy/setup.sh --tests    also builds the tests and runs them
set -euo pipefail
cd "$(dirname "$0")/.."

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }

lists=(deploy/packages.txt)
[ "${1:-}" != --tests ] || lists+=(deploy/packages_tests.txt)
mapfile -t packages < <(cat "${lists[@]}")
missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done
# npm only fetches the hand mesh and the readers of the tests. It is not installed if a Node.js from another source has
# brought its own npm, with which Debian's would conflict.
command -v npm >/dev/null || missing+=(npm)
if [ ${#missing[@]} -gt 0 ]; then
  as_root apt-get update
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
fi
deploy/fetch_hand_mesh.sh

if [ "${1:-}" = --tests ]; then
  # Programs of other people that read what Barehand writes. Without the network, the tests with them are skipped and say so.
  [ tests/readers/node_modules/.package-lock.json -nt tests/readers/package-lock.json ] ||
    npm ci --prefix tests/readers --ignore-scripts --no-audit --no-fund --prefer-offline ||
    echo "cannot fetch the readers of tests/readers/package.json: is the network there? The tests readers.* will be skipped" >&2
  cmake --preset release -DBAREHAND_TESTS=ON -DBAREHAND_WERROR=ON
  cmake --build --preset release
  # Run the tests of memory and parsing again with sanitizers.
  cmake --preset asan-fast
  cmake --build --preset asan-fast
  ctest --preset asan-fast
  ctest --preset release
else
  cmake --preset release -DBAREHAND_TESTS=OFF -DBAREHAND_WERROR=OFF
  cmake --build --preset release --target barehand barehand_python
fi
