#!/usr/bin/env python3
"""Prints the angles of the index finger, frame by frame, from a running `barehand track` or from a log.
  angles.py [LINES] [SOURCE]   SOURCE: a log, an MCAP file, or the live page (ws://HOST:PORT); without one, LCM, whose network
                               LCM_DEFAULT_URL names"""
import itertools
import math
import sys

import barehand


def text(hand):
    angles = hand.joint_angles()
    known = [angles[f"index_{joint}_flex"] for joint in ("mcp", "pip", "dip")] if hand.has_pose and angles else []
    return " ".join([f"frame {hand.frame_number} {hand.handedness} {hand.status}",
                     *(f"{math.degrees(angle):.1f}" for angle in known)])


def main(lines=None, source=None):
    try:
        states = (hand for hands in barehand.hands(source) for hand in (*hands, *hands.without_pose))
        for hand in itertools.islice(states, int(lines) if lines else None):
            print(text(hand), flush=True)
    except barehand.Error as error:
        sys.exit(str(error))


main(*sys.argv[1:])
