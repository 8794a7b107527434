#!/usr/bin/env bash
# Builds the reference of the public headers; a wrong command, parameter or link in a comment fails. First shows that it
# notices one.
#   reference.sh SOURCE_TREE OUT
set -u
cd "$1" || exit 1

planted=$(mktemp -d)
trap 'rm -rf "$planted"' EXIT
printf '/// \\file\n\n/// Turns.\n/// \\param speed  of the turn\nvoid turn(int angle);\n' >"$planted/planted.h"
reference() { (cat docs/Doxyfile && printf '%s\n' "$@") | doxygen -; }
said=$(reference "INPUT = $planted" "OUTPUT_DIRECTORY = $planted" 2>&1) &&
  { echo "the check itself is broken: it accepts a parameter that does not exist"; exit 1; }
grep -q "'speed'" <<<"$said" || { echo "the check itself is broken: $said"; exit 1; }

mkdir -p "$2" && reference "OUTPUT_DIRECTORY = $2"
