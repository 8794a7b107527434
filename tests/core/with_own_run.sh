#!/bin/sh
# Runs a command that may fill /run, which nobody else sees. Exit code 77 (skipped) where such a view may not be made.
unshare -rm true 2>/dev/null || exit 77
exec unshare -rm sh -c 'mount -t tmpfs tmpfs /run && exec "$@"' sh "$@"
