#!/bin/sh
# Runs a command in a network of its own whose loopback carries multicast, so that nothing leaves the machine and no
# other test is heard. Where such a network may not be made (some containers), it runs in the surrounding one.
if unshare -rn true 2>/dev/null; then
  exec unshare -rn sh -c 'ip link set lo up && ip route add 224.0.0.0/4 dev lo && exec "$@"' sh "$@"
fi
exec "$@"
