#!/usr/bin/env python3
"""Tests the error message in a network without any route. To be started by without_multicast.sh."""
import unittest

import numpy as np

import barehand


class NoRoute(unittest.TestCase):
    def test_connecting_fails_and_says_how_to_mend_it(self):
        for connect in (barehand.hands, lambda: barehand.publish_rgbd(np.zeros((2, 2)), None, (1, 1, 1, 1))):
            with self.assertRaisesRegex(barehand.Error, "udpm://239.255.76.67:7667.*ip route add 224.0.0.0/4 dev lo"):
                connect()


unittest.main()
