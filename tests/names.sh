#!/usr/bin/env bash
# Holds that clang-tidy finds nothing in the headers, all of which one file includes: the names are those of CONTRIBUTING.md.
# First shows that it notices a wrong one.
#   names.sh SOURCE_TREE BUILD_TREE FILE_OF_HEADERS
set -u
cd "$1" || exit 1

crooked=$(mktemp --suffix=.cpp)
trap 'rm -f "$crooked"' EXIT
echo 'class Crooked { int member = 0; public: int Get() { return member; } };' >"$crooked"
said=$(clang-tidy --quiet --config-file=.clang-tidy "$crooked" -- -std=c++20 2>/dev/null)
for name in member Get; do
  grep -q "'$name' \[readability-identifier-naming" <<<"$said" || { echo "the check itself is broken: $name passes"; exit 1; }
done

# GCC's warnings, some of which clang does not know, are not looked at here.
clang-tidy --quiet --config-file=.clang-tidy --extra-arg=-Wno-error --extra-arg=-Wno-unknown-warning-option -p "$2" "$3"
