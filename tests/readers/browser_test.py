#!/usr/bin/env python3
"""The JavaScript of the example for browsers, in Node.js against the real server: what it shows are the angles that C++
computed, and a hand without a pose has none.
  browser_test.py WRITE_CLIENT_GOLDEN BAREHAND NODE"""
import json
import math
import os
import re
import subprocess
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../clients"))
from support import Folder  # noqa: E402

if not os.path.exists(os.path.join(HERE, "node_modules/.package-lock.json")):
    print("not tested: the example for browsers, which needs the package ws in Node.js\n"
          "It is not installed. With a network: npm ci --prefix tests/readers")
    sys.exit(77)
GOLDEN, BAREHAND, NODE = (sys.argv.pop(1) for _ in range(3))
FRAMES = 5
LONG = 250  # seconds; never waited for when all is well


class BrowserExample(Folder):
    def run_example(self, *options):
        """What the example printed, and its complaints; the table of what C++ computed."""
        log, table = self.golden_states(GOLDEN)
        server = subprocess.Popen([BAREHAND, "view", log, "--port", "0", *options], stderr=subprocess.PIPE, text=True)
        port = re.search(r"http://[^ ]*:(\d+)", server.stderr.readline())[1]
        try:
            done = subprocess.run([NODE, os.path.join(HERE, "browser_example.mjs"), port, str(FRAMES)], capture_output=True,
                                  text=True, check=False)
        finally:
            server.terminate()
            server.communicate()
        return [json.loads(line) for line in done.stdout.splitlines()], done.stderr, table

    def test_it_shows_the_angles_of_both_hands(self):
        shown, complaints, table = self.run_example("--origin", "http://localhost:8000")
        self.assertEqual((complaints, len(shown)), ("", FRAMES))
        for frame, one in enumerate(shown[:-1]):
            self.assertEqual(one["rows"][0], ["", "right, tracking", "left, tracking"])
            self.assertEqual(len(one["rows"]), 1 + 21)
            for hand in one["hands"]:
                golden = [math.degrees(value) for value, in table[frame, hand["side"]]["joint_angles"]]
                for angle, expected in zip(hand["angles"].values(), golden, strict=True):
                    self.assertAlmostEqual(angle, expected, delta=1e-6)
                column = one["rows"][0].index(f"{hand['side']}, tracking")
                self.assertEqual([float(row[column]) for row in one["rows"][1:]],
                                 [float(f"{angle:.1f}") for angle in hand["angles"].values()])

        # In the last frame both hands are lost.
        self.assertEqual(shown[-1]["rows"], [["", "right, lost", "left, lost"]])

    def test_a_page_that_is_not_invited_is_told_so(self):
        shown, complaints, _ = self.run_example()
        self.assertEqual(shown, [])
        self.assertIn("--view-origin", complaints)

    def test_a_server_that_is_full_silent_or_of_another_version_is_noticed(self):
        said = subprocess.check_output([NODE, os.path.join(HERE, "bad_server.mjs")], text=True, timeout=LONG)
        self.assertEqual(said.splitlines(), [
            "It is full.", "Nothing has come for 10 s.",
            "Messages are left out: GLOVE_STATE: it is no glove_state_t of this version.", ""])


unittest.main()
