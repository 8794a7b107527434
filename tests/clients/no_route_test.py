#!/usr/bin/env python3
"""Tests the error messages in a network without any route. To be started by without_multicast.sh.
  no_route_test.py NODE"""
import subprocess
import sys
import unittest

import numpy as np

import barehand
from support import SOURCE

NODE = sys.argv.pop(1)


class NoRoute(unittest.TestCase):
    def test_connecting_fails_and_says_how_to_mend_it(self):
        for connect in (barehand.hands, lambda: barehand.publish_rgbd(np.zeros((2, 2)), None, (1, 1, 1, 1))):
            with self.assertRaisesRegex(barehand.Error, "udpm://239.255.76.67:7667.*ip route add 224.0.0.0/4 dev lo"):
                connect()

    def test_the_example_in_javascript_says_it_in_a_line(self):
        for url, words in (("", "cannot connect to udpm://.*ip route add 224.0.0.0/4 dev lo"), ("udp://x", "udp://x is no LCM network")):
            said = subprocess.run([NODE, SOURCE / "clients/javascript/angles.mjs", "1"], env={"LCM_DEFAULT_URL": url},
                                  stderr=subprocess.PIPE, text=True, check=False)
            self.assertRegex(said.stderr, f"^{words}.*\n$")
            self.assertEqual(said.returncode, 1)


unittest.main()
