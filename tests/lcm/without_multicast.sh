#!/bin/sh
# Runs a command in a network without any route. Exit code 77 (skipped) where such a network may not be made.
unshare -rn true 2>/dev/null || exit 77
exec unshare -rn sh -c 'ip link set lo up && exec "$@"' sh "$@"
