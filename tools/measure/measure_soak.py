#!/usr/bin/env python3
"""Tracks a simulated hand at 30 Hz for a long time within 512 MB of memory, publishes on LCM, and prints the table of
docs/reliability.md: memory, open files and frames over time. The frames come from the virtual OpenNI2 sensor, which
renders them in advance, so that each one arrives in time.
  tools/measure/measure_soak.py BUILD [MINUTES]    BUILD: a build folder with tests (build/release); MINUTES: default 60
Runs in its own network namespace (unshare) and with its own control group for the memory limit (needs root). The exit
code is 1 if memory, open files or threads grow, or if a frame fails or is unaccounted for."""
import os
import re
import sys
import tempfile
import time

from measure_faults import Sensor
from measure_service import Program, URL, in_own_network

LIMIT_MB = 512
ROWS = 12


class MemoryGroup:
    """A control group with a memory limit (version 2 if children of the root group can have one, otherwise version
    1)."""

    def __init__(self):
        with open("/proc/self/cgroup") as file:
            own = {line.split(":")[1]: line.strip().split(":")[2] for line in file}
        for parent, limit in [("/sys/fs/cgroup", "memory.max"),
                              ("/sys/fs/cgroup/memory" + own.get("memory", "/none"), "memory.limit_in_bytes")]:
            self.folder = f"{parent}/barehand_soak_{os.getpid()}"
            try:
                os.mkdir(self.folder)
            except OSError:
                continue
            if os.path.exists(f"{self.folder}/{limit}"):
                self.write(limit, LIMIT_MB << 20)
                return
            os.rmdir(self.folder)
        sys.exit("no control groups for memory here")

    def write(self, file, value):
        with open(f"{self.folder}/{file}", "w") as out:
            out.write(str(value))


def usage(pid):
    """Resident memory [MB], number of open files and number of threads of a process."""
    with open(f"/proc/{pid}/status") as file:
        status = dict(re.findall(r"^(VmRSS|Threads):\s+(\d+)", file.read(), re.M))
    return int(status["VmRSS"]) / 1024, len(os.listdir(f"/proc/{pid}/fd")), int(status["Threads"])


def soak(build, seconds, folder):
    group = MemoryGroup()
    os.environ["BAREHAND_VIRTUAL_OPENNI2"] = Sensor(folder).path
    os.environ["LD_LIBRARY_PATH"] = os.path.join(build, "tests/openni2/sdk")
    program = Program(build, ["track", "--source", "openni2", "--lcm-url", URL, "--health"])
    group.write("cgroup.procs", program.process.pid)
    program.wait_for("opened")
    time.sleep(5)
    print("| time [min] | captured | published | dropped | failed | memory [MB] | files | threads |\n" + "|---" * 8 + "|")
    begin, samples = time.time(), []
    for i in range(ROWS + 1):
        while time.time() < begin + i * seconds / ROWS:
            time.sleep(0.5)
            if program.process.poll() is not None:
                sys.exit("it ended:\n" + "\n".join(line for _, line in program.said[-20:]))
        samples.append(usage(program.process.pid))
        memory, files, threads = samples[-1]
        print(f"| {i * seconds / ROWS / 60:.1f} | " + " | ".join(str(n) for n in program.counts()[-1][1:]) +
              f" | {memory:.1f} | {files} | {threads} |", flush=True)
    program.stop()
    os.rmdir(group.folder)
    return program, samples


def judge(program, samples):
    found = [re.match(r"(\d+) frames in .*: (\d+) published, (\d+) dropped, (\d+) failed", line) for _, line in program.said]
    captured, published, dropped, failed = map(int, next(m for m in reversed(found) if m).groups())
    unaccounted = captured - published - dropped - failed
    settled = samples[len(samples) // 4:]  # without the first quarter, in which buffers grow to their final size
    growth = settled[-1][0] - settled[0][0]
    print(f"\n{captured} frames captured = {published} published + {dropped} dropped + {failed} failed"
          f"{'' if unaccounted == 0 else f', {unaccounted} UNACCOUNTED FOR'}; exit code {program.process.returncode}; peak "
          f"{program.peak_mb:.0f} MB; after the first quarter memory grew by {growth:+.1f} MB, open files by "
          f"{settled[-1][1] - settled[0][1]:+d}, threads by {settled[-1][2] - settled[0][2]:+d}")
    flat = growth < 5 and settled[-1][1] <= settled[0][1] and settled[-1][2] <= settled[0][2]
    return flat and unaccounted == 0 and failed == 0 and program.process.returncode == 0


def main():
    in_own_network()
    build, minutes = os.path.abspath(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 60
    with tempfile.TemporaryDirectory() as folder:
        sys.exit(0 if judge(*soak(build, 60 * minutes, folder)) else 1)


if __name__ == "__main__":
    main()
