#!/usr/bin/env bash
# Checks that clang-tidy reports nothing about the headers, mainly that names are as in CONTRIBUTING.md. One file
# includes all headers. First checks that a wrong name is found.
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

# The build's options contain warnings of GCC that clang does not know; these are ignored here.
clang-tidy --quiet --config-file=.clang-tidy --extra-arg=-Wno-error --extra-arg=-Wno-unknown-warning-option -p "$2" "$3"
