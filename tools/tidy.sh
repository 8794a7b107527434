#!/usr/bin/env bash
# Runs clang-tidy over the source files that differ from a branch or commit. It also finds missing #include lines.
#   tools/tidy.sh [BASE=main]
set -euo pipefail
cd "$(dirname "$0")/.."

changed=$(git diff --name-only --diff-filter=d "$(git merge-base "${1:-main}" HEAD)" -- '*.cpp')
[ -n "$changed" ] || { echo "no source file differs from ${1:-main}"; exit 0; }

# Configure a separate build folder, from which clang-tidy reads the compiler's flags, because clang cannot read the
# precompiled headers of g++.
cmake --preset release -B build/tidy -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null
cmake --build build/tidy --target barehand_lcmtypes_headers >/dev/null
nice run-clang-tidy -quiet -p build/tidy -j "$(nproc)" $changed
