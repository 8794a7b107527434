#!/usr/bin/env bash
# Checks that every source file is formatted by clang-format. First checks that it finds a file that is not.
#   format.sh SOURCE_TREE
set -u

crooked=$(mktemp --suffix=.cpp)
trap 'rm -f "$crooked"' EXIT
echo 'int  main( ){return 0 ;}' >"$crooked"
clang-format --style="file:$1/.clang-format" --dry-run --Werror "$crooked" 2>/dev/null &&
  { echo "the check itself is broken: it accepts a file that is not formatted"; exit 1; }

find "$1"/src "$1"/stages "$1"/drivers "$1"/tests -name '*.cpp' -o -name '*.h' |
  xargs clang-format --style="file:$1/.clang-format" --dry-run --Werror
