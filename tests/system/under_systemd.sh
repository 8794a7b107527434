#!/bin/bash
# Tests the service of deploy/systemd with a real systemd: starts it, reloads it, lets it hang, stops it.
#   under_systemd.sh PROGRAM SOURCE_TREE
# systemd runs as a user's manager with a private /run. Settings that only the system's manager supports (another user,
# closed devices) are removed. Exits with 77 (test skipped) where this is not possible.
program=$1 tree=$2
manager=/lib/systemd/systemd
if [ -z "${IN_OWN_RUN-}" ]; then
  [ -x $manager ] && [ "$(id -u)" = 0 ] && unshare -m true 2>/dev/null || exit 77
  IN_OWN_RUN=1 exec unshare -m --propagation private "$0" "$@"
fi
set -u
mount -t tmpfs tmpfs /run || exit 77
export XDG_RUNTIME_DIR=/run/user/0 XDG_CONFIG_HOME=/run/config
mkdir -p /run/systemd/system /run/config/systemd/user $XDG_RUNTIME_DIR && chmod 700 $XDG_RUNTIME_DIR
units=/run/config/systemd/user
cp "$tree/configs/default.yaml" /run/config.yaml

# The remaining settings of the unit determine how it is started, watched, reloaded and restarted. The watchdog's time
# is shortened.
sed -E -e "s#/usr/bin/barehand#$program#" -e 's#^\[Service\]#&\nStandardError=append:/run/service.log#' \
  -e 's/^WatchdogSec=.*/WatchdogSec=10/' -e 's/^RestartSec=.*/RestartSec=0.2/' \
  -e '/^(Dynamic|Supplementary|State|Working|Device|Capability|Lock|NoNew|Private|Protect|Restrict(A|N|R|S)|System|Memory|Tasks)/d' \
  -e 's/^EnvironmentFile=.*/Environment="BAREHAND_SOURCE=sim:fist,live=true,loop=true,width=160,height=120" "BAREHAND_OPTIONS=--no-publish --config \/run\/config.yaml"/' \
  "$tree/deploy/systemd/barehand.service" >$units/barehand.service

log=/run/manager.log
SYSTEMD_LOG_TARGET=console $manager --user --unit=basic.target >$log 2>&1 &
manager_pid=$!
trap 'kill $manager_pid; wait $manager_pid' EXIT
is() { [ "$(systemctl --user show -P "$1" barehand.service 2>/dev/null)" = "$2" ]; }
wait_until() {  # TEXT COMMAND...: for a minute at most
  local text=$1
  shift
  for _ in $(seq 300); do "$@" && return; sleep 0.2; done
  echo "never happened: $text"
  systemctl --user status barehand.service --no-pager
  cat $log /run/service.log
  exit 1
}
log_says() { grep -q "$1" /run/service.log; }
status_says() { systemctl --user show -P StatusText barehand.service | grep -q "$1"; }

wait_until "the manager runs" systemctl --user --quiet is-active basic.target 2>/dev/null
systemctl --user start barehand.service || wait_until "the service starts" false
wait_until "the service is ready" is ActiveState active
wait_until "the status line tells of frames" status_says published

systemctl --user reload barehand.service
wait_until "the configuration is reloaded" log_says "configuration reloaded"
echo "nonsense: 1" >>/run/config.yaml
systemctl --user reload barehand.service
wait_until "a wrong configuration is refused" log_says "configuration not reloaded"
wait_until "it goes on with the old one" is ActiveState active
cp "$tree/configs/default.yaml" /run/config.yaml

sleep 11  # longer than the watchdog's time, so the service must have notified it
is NRestarts 0 || wait_until "it was not started again while it worked" false
kill -STOP "$(systemctl --user show -P MainPID barehand.service)"  # hangs
wait_until "the watchdog bites and the service starts again" is NRestarts 1
wait_until "it works again" status_says published

systemctl --user stop barehand.service
wait_until "it stops" is ActiveState inactive
is Result success || wait_until "it stops in order" false
