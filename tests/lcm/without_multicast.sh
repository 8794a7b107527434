#!/bin/sh
# Runs a command in a network without any route. Exits with 77 (test skipped) if such a network may not be created.
unshare -rn true 2>/dev/null || exit 77
exec unshare -rn sh -c 'ip link set lo up && exec "$@"' sh "$@"
