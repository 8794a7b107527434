#!/usr/bin/env python3
"""Tests that the example in each language prints the angles that C++ computed. To be started by with_multicast.sh.
  examples_test.py WRITE_CLIENT_GOLDEN NODE"""
import itertools
import json
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
LINES = 40
INDEX_FINGER = {"glove22": (4, 5, 6), "joint_angles": (5, 7, 8)}


class Examples(Folder):
    def setUp(self):
        super().setUp()
        self.log, self.golden = self.golden_states(GOLDEN)

    def heard(self, *command):
        """The lines that a receiving program prints. The log is sent repeatedly until it has printed enough of them.
        Between the frames, damaged messages and messages of another type are sent."""
        program = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   env={**os.environ, "LCM_DEFAULT_URL": URL})
        network, events = Network(URL), list(log.events(self.log, Counts()))
        for _, channel, data in itertools.cycle(events):
            network.send(channel.decode(), data)
            if channel == b"GLOVE_STATE":
                network.send("GLOVE_STATE", data[:300])
            if channel == b"HAND_JOINTS":  # the last one of a hand
                network.send("GLOVE_STATE", data)
                try:
                    program.wait(0.002)
                    break
                except subprocess.TimeoutExpired:
                    pass
        network.close()
        with program.stdout, program.stderr:
            self.assertRegex(program.stderr.read(), "(?i)left out|decoding")  # each example reports damaged messages
            self.assertEqual(program.returncode, 0)
            return program.stdout.read().splitlines()

    def check(self, lines, outlet):
        """A program may miss the first messages while it starts; all lines that it prints must be right."""
        sides, statuses = set(), set()
        for _, frame, side, status, *angles in map(str.split, lines):
            sides.add(side)
            statuses.add(status)
            if int(frame) == 4:
                self.assertEqual((status, angles), ("lost", []))
                continue
            expected = [math.degrees(self.golden[int(frame), side][outlet][i][0]) for i in INDEX_FINGER[outlet]]
            self.assertEqual((status, len(angles)), ("tracking", 3))
            self.assertLess(max(abs(float(a) - e) for a, e in zip(angles, expected)), 0.051, (frame, side, angles, expected))
        self.assertEqual((len(lines), sides, statuses), (LINES, {"left", "right"}, {"tracking", "lost"}))

    def test_python_live_and_from_a_log(self):
        self.check(self.heard(sys.executable, "-B", ANGLES, str(LINES)), "joint_angles")
        lines = subprocess.check_output([sys.executable, "-B", ANGLES, "100", self.log], text=True).splitlines()
        self.assertEqual(len(lines), 10)
        self.assertEqual(subprocess.check_output([sys.executable, "-B", ANGLES, self.log], text=True).splitlines(), lines)
        other_order = [sys.executable, "-B", ANGLES, self.log, "3"]
        self.assertEqual(subprocess.check_output(other_order, text=True).splitlines(), lines[:3])
        self.check(lines * (LINES // 10), "joint_angles")

    def test_python_says_what_is_wrong_in_one_line(self):
        command = [sys.executable, "-B", ANGLES, "1", "none.lcmlog"]
        said = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((said.returncode, said.stderr), (1, "none.lcmlog: cannot read the log: No such file or directory "
                                                          "(give the name of one log)\n"))

    def test_python_shows_its_usage(self):
        command = [sys.executable, "-B", ANGLES, self.log, self.log]
        said = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((said.returncode, said.stderr), (1, "usage: angles.py [LINES] [SOURCE]\n"))

    def test_javascript(self):
        self.check(self.heard(NODE, CLIENTS / "javascript/angles.mjs", str(LINES)), "glove22")

    def test_javascript_decodes_every_type_and_nothing_else(self):
        script = """
            import fs from "node:fs";
            import {decodeContactState, decodeGloveState, decodeHandState, decodeObjectState} from "SOURCE/web/lcm.js";
            const decoders = {hand: decodeHandState, glove: decodeGloveState, contact: decodeContactState, object: decodeObjectState};
            const errorOf = (decode, bytes) => {
              try { decode(new DataView(Uint8Array.from(bytes).buffer)); } catch (error) { return error.message; }
              return "";
            };
            for (const [name, decode] of Object.entries(decoders)) {
              const good = fs.readFileSync(`SOURCE/tests/golden/lcm/${name}_state_t.bin`);
              const foreign = Buffer.from(good);
              foreign[7] ^= 1;
              const texts = [good, foreign, good.subarray(0, 4), good.subarray(0, -1), Buffer.concat([good, foreign])];
              console.log(JSON.stringify(texts.map((bytes) => errorOf(decode, bytes))));
            }""".replace("SOURCE", str(SOURCE))
        said = subprocess.run([NODE, "--input-type=module"], input=script, capture_output=True, text=True, check=True).stdout
        for name, line in zip(("hand", "glove", "contact", "object"), said.splitlines(), strict=True):
            good, foreign, short, cut, long = json.loads(line)
            self.assertEqual(good, "", name)
            self.assertEqual([foreign, short], [f"it is no {name}_state_t of this version"] * 2)
            self.assertIn("Offset is outside", cut)
            self.assertEqual(long, f"it is too long for a {name}_state_t")

    def test_cpp_built_as_its_first_lines_say(self):
        types = sorted((SOURCE / "lcmtypes").glob("*.lcm"))
        subprocess.check_output(["lcm-gen", "-x", "--cpp-hpath", self.folder / "types", *types])
        flags = subprocess.check_output(["pkg-config", "--cflags", "--libs", "lcm"], text=True)
        program = self.folder / "angles"
        subprocess.run(["g++", "-std=c++17", "-isystem", self.folder / "types", CLIENTS / "cpp/angles.cpp", "-o", program,
                        *flags.split()], check=True)
        self.check(self.heard(program, str(LINES)), "glove22")


unittest.main()
