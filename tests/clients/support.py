"""Functions that several tests of the clients use."""
import csv
import math
import os
import pathlib
import subprocess
import tempfile
import unittest
from collections import defaultdict

import barehand

SOURCE = pathlib.Path(os.environ["BAREHAND_SOURCE"])
#: Every process uses another port, so that tests that run at the same time do not receive each other's messages.
URL = f"udpm://239.255.76.67:{20000 + os.getpid() % 40000}?ttl=0"


def golden_bytes(name):
    """The message of this type that is stored in tests/golden."""
    return (SOURCE / "tests/golden/lcm" / f"{name}.bin").read_bytes()


class Folder(unittest.TestCase):
    """Base of tests that need a temporary folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def golden_states(self, program):
        """(log, table) of write_client_golden; table[frame, side][outlet] is a list of rows of floats."""
        subprocess.run([program, self.folder], check=True)
        table = defaultdict(lambda: defaultdict(list))
        with open(self.folder / "golden.csv", newline="", encoding="utf-8") as file:
            for row, outlet, _, *values in csv.reader(file):
                side = "left" if int(row) % 2 else "right"
                table[int(row) // 2, side][outlet].append([float(value) for value in values])
        return str(self.folder / "states.lcmlog"), table


def messages_of(frame=0, side=1, status=1, hand_id=1, sensor=""):
    """The three messages of a hand as pairs (channel, bytes). All numbers are NaN if the status means that there is no
    pose."""
    known = status in (1, 2)
    number = 0.5 if known else math.nan
    state, glove, joints = barehand.hand_state_t(), barehand.glove_state_t(), barehand.hand_joints_t()
    for message in (state, glove, joints):
        message.utime, message.frame_number, message.sensor = 1_700_000_000_000_000 + 16_667 * frame, frame, sensor
        message.hand_id, message.handedness, message.status = hand_id, side, status
    state.has_pose = known
    for segment in state.segments:
        segment.confidence = number
    glove.joint_name = [f"joint_{i}" for i in range(21)]
    glove.joint_angle, glove.channel = [number] * 21, [number] * 22
    joints.position = [[number * i, number + 0.01 * i * i, number] for i in range(26)]
    joints.orientation = [[number] * 4] * 26
    joints.radius = [number] * 26
    return [(b"HAND_STATE", state.encode()), (b"GLOVE_STATE", glove.encode()), (b"HAND_JOINTS", joints.encode())]
