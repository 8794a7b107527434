#!/usr/bin/env python3
"""Exposes the program to those faults of docs/reliability.md that concern a service (network, disk, signals,
configuration, commands), and prints the table.
  tools/measure/measure_service.py BUILD [CYCLES]    BUILD: a build folder, for example build/release; CYCLES: starts
Runs in its own network and mount namespaces (unshare), so that the rest of the system is not affected."""
import csv
import os
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))
URL = "udpm://239.255.76.67:7667?ttl=0"
HAND = "sim:grasp_ball,noise=kinect,live=true,loop=true"
FAULT_SECONDS = 5.0


class Program:
    """A running `barehand`, with all lines of its output and their times in `said`."""

    def __init__(self, build, arguments):
        self.process = subprocess.Popen([os.path.join(build, "src/app/barehand"), *arguments], stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.said = []
        self.listener = threading.Thread(target=self.listen)
        self.listener.start()

    def listen(self):
        for line in self.process.stdout:
            self.said.append((time.time(), line.strip()))

    def wait_for(self, text, since=0.0):
        while True:
            for t, line in self.said:
                if t >= since and text in line:
                    return t
            if self.process.poll() is not None:
                sys.exit(f"ended while waiting for '{text}':\n" + "\n".join(line for _, line in self.said))
            time.sleep(0.01)

    def stop(self, number=signal.SIGTERM):
        start = time.time()
        self.process.send_signal(number)
        _, status, usage = os.wait4(self.process.pid, 0)
        self.process.returncode = os.waitstatus_to_exitcode(status)
        self.listener.join()
        self.peak_mb = usage.ru_maxrss / 1024
        return time.time() - start

    def counts(self):
        found = [(t, *map(int, m.groups())) for t, line in self.said
                 if (m := re.match(r"captured (\d+), published (\d+), dropped (\d+), failed (\d+)", line))]
        return found


def row(fault, meanwhile, recovered):
    print(f"| {fault} | {meanwhile} | {recovered} |", flush=True)


def tracked_times(table):
    with open(table) as file:
        return sorted({float(line["timestamp"]) for line in csv.DictReader(file)})


def longest_gap(times, begin, end):
    inside = [t for t in times if begin - 0.5 <= t <= end]
    return max((b - a for a, b in zip(inside, inside[1:])), default=0)


def start_and_stop(build, folder, cycles):
    stops, codes = [], set()
    for cycle in range(cycles):
        program = Program(build, ["track", "--source", HAND, "--no-publish", "--states-log", folder + "/states.lcmlog"])
        program.wait_for("info: tracking")
        time.sleep(0.02 * (cycle % 50))
        stops.append(program.stop())
        codes.add(program.process.returncode)
    row(f"{cycles} starts and SIGTERMs, 0 to 1 s after the start", f"exit codes {sorted(codes)}",
        f"stopped after {sorted(stops)[len(stops) // 2]:.2f} s in the median, {max(stops):.2f} s at most")


def configuration(build, folder):
    config, table = folder + "/config.yaml", folder + "/config.csv"
    with open(os.path.join(HERE, "../../configs/default.yaml")) as file:
        text = file.read()
    with open(config, "w") as file:
        file.write(text)
    program = Program(build, ["track", "--source", HAND, "--no-publish", "--config", config, "--result", table])
    program.wait_for("info: tracking")
    time.sleep(5)
    marks = []
    for name, new, answer in [("broken", text + "nonsense: 1\n", "not reloaded"),
                              ("changed (levels: 5)", re.sub(r" levels: \d+", " levels: 5", text), "reloaded, 1")]:
        with open(config, "w") as file:
            file.write(new)
        begin = time.time()
        program.process.send_signal(signal.SIGHUP)
        answered = program.wait_for(answer, begin) - begin
        time.sleep(4)
        marks.append((name, begin, time.time(), answered))
    program.stop()
    times = tracked_times(table)
    usual = longest_gap(times, marks[0][1] - 3, marks[0][1])
    for name, begin, end, answered in marks:
        row(f"SIGHUP with a {name} configuration", f"{sum(begin <= t < end for t in times)} frames tracked in 4 s",
            f"answered after {answered:.2f} s; longest time without a tracked frame {longest_gap(times, begin, end):.2f} s "
            f"({usual:.2f} s before)")


def network(build):
    program = Program(build, ["track", "--source", HAND, "--lcm-url", URL, "--health"])
    program.wait_for("captured ")
    time.sleep(3)
    subprocess.run("ip route del 224.0.0.0/4 dev lo", shell=True, check=True)
    begin = time.time()
    said = program.wait_for("LCM cannot publish", begin) - begin
    time.sleep(FAULT_SECONDS)
    subprocess.run("ip route add 224.0.0.0/4 dev lo", shell=True, check=True)
    end = time.time()
    time.sleep(3)
    program.stop()
    before = [c for c in program.counts() if c[0] > end][0][2]
    again = next(t for t, _, published, _, _ in program.counts() if t > end and published > before) - end
    failed = program.counts()[-1][4]
    row("multicast route gone for 5 s", f"nothing; {failed} frames counted as failed; said after {said:.2f} s",
        f"published again after {again:.1f} s or less (health once a second)")


def no_network_at_start(build):
    subprocess.run("ip route del 224.0.0.0/4 dev lo", shell=True, check=True)
    program = Program(build, ["track", "--source", HAND, "--lcm-url", URL])
    program.wait_for("trying again")
    time.sleep(3)
    subprocess.run("ip route add 224.0.0.0/4 dev lo", shell=True, check=True)
    end = time.time()
    started = program.wait_for("info: tracking", end) - end
    program.stop()
    row("no multicast route at the start", "nothing; the error and its remedy are said",
        f"tracking after {started:.1f} s")


def reset_command():
    with open(os.path.join(HERE, "../../tests/golden/lcm/command_t.bin"), "rb") as file:
        fingerprint = file.read(8)
    return (fingerprint + struct.pack(">q", 0) + struct.pack(">I", 1) + b"\0" + struct.pack(">ib", -1, 1) +
            bytes(16 * 7 * 8) + struct.pack(">I", 1) + b"\0")


def flood(build, folder):
    config, table = folder + "/commands.yaml", folder + "/commands.csv"
    with open(os.path.join(HERE, "../../configs/default.yaml")) as file:
        text = file.read().replace("commands: false", "commands: true")
    with open(config, "w") as file:
        file.write(text)
    program = Program(build, ["track", "--source", HAND, "--lcm-url", URL, "--config", config, "--result", table])
    program.wait_for("info: tracking")
    time.sleep(5)
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    message, sent, begin = reset_command(), 0, time.time()
    while time.time() < begin + 2 * FAULT_SECONDS:
        for _ in range(20):
            sender.sendto(struct.pack(">II", 0x4c433032, sent) + b"COMMAND\0" + message, ("239.255.76.67", 7667))
            sent += 1
        time.sleep(0.002)
    end = time.time()
    time.sleep(3)
    lines = len(program.said)
    program.stop()
    times = tracked_times(table)
    followed = sum("command: forget" in line for _, line in program.said)
    row(f"{sent} reset commands in 10 s", f"{sum(begin <= t < end for t in times)} frames tracked "
        f"({followed} commands followed, {lines} lines said)",
        f"peak memory {program.peak_mb:.0f} MB")


def disk_full(build, folder):
    disk = folder + "/disk"
    os.mkdir(disk)
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=60m", "tmpfs", disk], check=True)
    program = Program(build, ["record", "--source", HAND, "--out", disk + "/take.lcmlog"])
    program.wait_for(" frames")
    ballast = disk + "/ballast"
    subprocess.run(["dd", "if=/dev/zero", "of=" + ballast, "bs=1M"], stderr=subprocess.DEVNULL)
    begin = time.time()
    said = program.wait_for("No space left", begin) - begin
    time.sleep(FAULT_SECONDS)
    os.remove(ballast)
    end = time.time()
    again = program.wait_for("writing again", end) - end
    program.stop()
    last = program.said[-1][1]
    lost = re.search(r"(\d+) lost", last).group(1)
    row("disk full for 5 s while recording", f"nothing recorded, {lost} frames counted as lost; said after {said:.2f} s",
        f"recorded again after {again:.2f} s, exit code {program.process.returncode}")
    subprocess.run(["umount", disk], check=True)


def disk_full_while_tracking(build, folder):
    disk = folder + "/disk_of_results"
    os.mkdir(disk)
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=20m", "tmpfs", disk], check=True)
    table, ballast = disk + "/result.csv", disk + "/ballast"
    program = Program(build, ["track", "--source", HAND, "--no-publish", "--result", table, "--states-log",
                              disk + "/states.lcmlog", "--health"])
    program.wait_for("captured ")
    time.sleep(5)
    subprocess.run(["dd", "if=/dev/zero", "of=" + ballast, "bs=1k"], stderr=subprocess.DEVNULL)
    begin = time.time()
    said = program.wait_for("No space left", begin) - begin
    time.sleep(FAULT_SECONDS)
    os.remove(ballast)
    end = time.time()
    again = max(program.wait_for(name + " works again", end) for name in ["states log", "result table"]) - end
    time.sleep(3)
    program.stop()
    times = tracked_times(table)
    lines = sum("No space left" in line for _, line in program.said)
    row("disk full for 5 s while tracking with --result and --states-log", f"{sum(begin <= t < end for t in times)} "
        f"frames written; said after {said:.2f} s, {lines} lines",
        f"written again after {again:.2f} s ({sum(t >= end for t in times)} frames in 3 s), exit code "
        f"{program.process.returncode}")
    subprocess.run(["umount", disk], check=True)


def killed(build, folder):
    log, barehand = folder + "/killed.lcmlog.unfinished", os.path.join(build, "src/app/barehand")
    torn = []
    for i in range(20):
        program = Program(build, ["record", "--source", HAND, "--out", folder + "/killed.lcmlog"])
        while not os.path.exists(log) or os.path.getsize(log) < 2_000_000 + 100_000 * i:
            time.sleep(0.001)
        program.stop(signal.SIGKILL)
        copy = subprocess.run([barehand, "convert", log, folder + "/copy.lcmlog", "--overwrite"], stderr=subprocess.PIPE,
                              text=True, check=True).stderr
        cut = re.search(r"(\d+) bytes are damaged", copy)
        torn.append(int(cut.group(1)) if cut else 0)
        os.remove(log)
    row("kill -9 while recording, 20 times", f"every whole frame replays; {sum(t > 0 for t in torn)} logs end in an "
        f"incomplete frame, of {max(torn)} bytes at most", "the next recording starts as ever")


def memory(build):
    program = Program(build, ["track", "--source", HAND, "--lcm-url", URL, "--health"])
    program.wait_for("captured ")
    time.sleep(60)
    program.stop()
    row("memory of 640x480 tracking with the default configuration, 60 s", "tracked", f"peak {program.peak_mb:.0f} MB")


def in_own_network():
    """Restarts the script in its own network and mount namespaces, unless it already runs there."""
    if os.environ.get("BAREHAND_OWN_NETWORK") is None:
        os.environ["BAREHAND_OWN_NETWORK"] = "1"
        os.execvp("unshare", ["unshare", "-rnm", "sh", "-c", "ip link set lo up && ip route add 224.0.0.0/4 dev lo && "
                              "exec \"$@\"", "sh", sys.executable, *sys.argv])


def main():
    in_own_network()
    build = os.path.abspath(sys.argv[1])
    cycles = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    print("| fault | meanwhile | recovery |\n|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        network(build)
        no_network_at_start(build)
        configuration(build, folder)
        flood(build, folder)
        disk_full(build, folder)
        disk_full_while_tracking(build, folder)
        killed(build, folder)
        memory(build)
        start_and_stop(build, folder, cycles)


if __name__ == "__main__":
    main()
