#!/usr/bin/env python3
"""Prints the angles of the index finger, frame by frame, from a running `barehand track` or from a log.
  angles.py [LINES] [SOURCE]   in either order. SOURCE: a log, an MCAP file, or the live page (ws://HOST:PORT); without
                               one, LCM, whose network LCM_DEFAULT_URL names"""
import itertools
import math
import os
import sys

import barehand


def text(hand):
    angles = hand.joint_angles()
    known = [angles[f"index_{joint}_flex"] for joint in ("mcp", "pip", "dip")] if hand.has_pose and angles else []
    return " ".join([f"frame {hand.frame_number} {hand.handedness} {hand.status}",
                     *(f"{math.degrees(angle):.1f}" for angle in known)])


def main(*arguments):
    lines = [int(argument) for argument in arguments if argument.isdecimal()]
    sources = [argument for argument in arguments if not argument.isdecimal()]
    if len(lines) > 1 or len(sources) > 1:
        sys.exit("usage: angles.py [LINES] [SOURCE]")
    try:
        states = (hand for hands in barehand.hands(*sources) for hand in (*hands, *hands.without_pose))
        for hand in itertools.islice(states, *lines or [None]):
            print(text(hand), flush=True)
    except barehand.Error as error:
        sys.exit(str(error))
    except BrokenPipeError:  # what read the output, such as `head`, has ended
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # Python flushes once more at its end


main(*sys.argv[1:])
