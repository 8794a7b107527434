#!/usr/bin/env bash
# Runs clang-tidy over the source files that differ from a branch or commit, with the flags of a configured and built tree.
#   tools/tidy.sh [BASE=main] [BUILD=build/release]
set -euo pipefail
cd "$(dirname "$0")/.."
base=${1:-main} build=${2:-build/release}

# clang cannot read the precompiled headers of g++, but includes what they were made from.
changed=$(git diff --name-only --diff-filter=d "$(git merge-base "$base" HEAD)" -- '*.cpp')
[ -n "$changed" ] || { echo "no source file differs from $base"; exit 0; }
nice run-clang-tidy -quiet -p "$build" -j "$(nproc)" $changed
