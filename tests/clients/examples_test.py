#!/usr/bin/env python3
"""The example in each language prints the angles that C++ computed; started by with_multicast.sh.
  examples_test.py WRITE_CLIENT_GOLDEN NODE"""
import math
import os
import subprocess
import sys
import unittest

from barehand import log
from barehand.counts import Counts
from barehand.network import Network
from support import SOURCE, URL, Folder

GOLDEN, NODE = sys.argv.pop(1), sys.argv.pop(1)
CLIENTS = SOURCE / "clients"
ANGLES = CLIENTS / "python/examples/angles.py"
LINES = 10  # two hands in five frames
INDEX_FINGER = {"glove22": (4, 5, 6), "joint_angles": (5, 7, 8)}


class Examples(Folder):
    def setUp(self):
        super().setUp()
        self.log, self.golden = self.golden_states(GOLDEN)

    def heard(self, *command):
        """The lines of a program that listens, while the log is sent again and again until it has enough."""
        program = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ, "LCM_DEFAULT_URL": URL})
        network = Network(URL)
        while program.poll() is None:
            for _, channel, data in log.events(self.log, Counts()):
                network.send(channel.decode(), data)
            try:
                program.wait(0.01)
            except subprocess.TimeoutExpired:
                pass
        network.close()
        self.assertEqual(program.returncode, 0)
        with program.stdout:
            return program.stdout.read().splitlines()

    def check(self, lines, outlet):
        self.assertEqual(len(lines), LINES)
        seen = set()
        for _, frame, side, status, *angles in map(str.split, lines):
            hand = int(frame), side
            seen.add(hand)
            if int(frame) == 4:
                self.assertEqual((status, angles), ("lost", []))
                continue
            expected = [math.degrees(self.golden[hand][outlet][i][0]) for i in INDEX_FINGER[outlet]]
            self.assertEqual(status, "tracking")
            self.assertEqual(len(angles), 3)
            self.assertLess(max(abs(float(a) - e) for a, e in zip(angles, expected)), 0.051, (hand, angles, expected))
        self.assertEqual(len(seen), LINES)

    def test_python_live_and_from_a_log(self):
        self.check(self.heard(sys.executable, "-B", ANGLES, str(LINES)), "joint_angles")
        lines = subprocess.run([sys.executable, "-B", ANGLES, str(LINES), self.log], check=True, capture_output=True, text=True)
        self.check(lines.stdout.splitlines(), "joint_angles")

    def test_python_says_what_is_wrong_in_one_line(self):
        said = subprocess.run([sys.executable, "-B", ANGLES, "1", "none.lcmlog"], capture_output=True, text=True, check=False)
        self.assertEqual((said.returncode, said.stderr), (1, "none.lcmlog: cannot read the log: No such file or directory "
                                                          "(give the name of one log)\n"))

    def test_javascript(self):
        self.check(self.heard(NODE, CLIENTS / "javascript/angles.mjs", str(LINES)), "glove22")

    def test_cpp_built_as_its_first_lines_say(self):
        types = sorted((SOURCE / "lcmtypes").glob("*.lcm"))
        subprocess.run(["lcm-gen", "-x", "--cpp-hpath", self.folder / "types", *types], check=True, stdout=subprocess.DEVNULL)
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "lcm"], check=True, capture_output=True, text=True).stdout
        program = self.folder / "angles"
        subprocess.run(["g++", "-std=c++17", "-isystem", self.folder / "types", CLIENTS / "cpp/angles.cpp", "-o", program,
                        *flags.split()], check=True)
        self.check(self.heard(program, str(LINES)), "glove22")


unittest.main()
