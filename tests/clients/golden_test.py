#!/usr/bin/env python3
"""Compares the outlets (conversions for other consumers) with what C++ computes and with the documentation's table.
  golden_test.py WRITE_CLIENT_GOLDEN"""
import re
import sys
import unittest

import numpy as np

import barehand
from barehand import outlets
from support import SOURCE, Folder

PROGRAM = sys.argv.pop(1)


class Golden(Folder):
    def setUp(self):
        super().setUp()
        self.log, self.table = self.golden_states(PROGRAM)

    def test_both_hands_equal_the_golden_vectors_to_1e_6(self):
        compared = 0
        for hands in (*barehand.hands(self.log), *barehand.hands(self.folder / "hands.mcap")):
            for hand in hands:
                golden = self.table[hand.frame_number, hand.handedness]
                joints = hand.openxr26()
                got = {"openxr26": np.column_stack(joints[:3]), "mano21": hand.mano21(),
                       "glove22": hand.glove22()[:, None], "joint_angles": np.array([[*hand.joint_angles().values()]]).T}
                self.assertEqual(set(got), set(golden))
                for outlet, values in got.items():
                    np.testing.assert_allclose(values, golden[outlet], rtol=0, atol=1e-6, err_msg=outlet)
                np.testing.assert_array_equal(np.column_stack(hand.webxr25()), np.column_stack(joints)[1:])
                compared += 1
        self.assertEqual(compared, 16)

    def test_a_difference_of_2e_6_is_noticed(self):
        hand = next(barehand.hands(self.log)).left
        golden = np.array(self.table[0, "left"]["mano21"])
        golden[20, 1] += 2e-6
        with self.assertRaises(AssertionError):
            np.testing.assert_allclose(hand.mano21(), golden, rtol=0, atol=1e-6)

    def test_the_last_frame_has_no_hand(self):
        *_, last = barehand.hands(self.log)
        self.assertEqual((len(last), [hand.status for hand in last.without_pose]), (0, ["lost", "lost"]))

    def test_mano_frame_leads_back_to_the_camera(self):
        for hand in next(barehand.hands(self.log)):
            T = hand.mano_frame()
            self.assertAlmostEqual(np.linalg.det(T[:3, :3]), 1)
            back = hand.mano21() @ T[:3, :3].T + T[:3, 3]
            np.testing.assert_allclose(back, np.array(hand.joints.position)[list(outlets.LANDMARKS_21)], atol=1e-12)

            # The z axis points along the hand, x out of the palm, y towards a right hand's thumb and away from a left
            # hand's.
            wrist = outlets.rotation_of(hand.joints.orientation[1])
            self.assertGreater(min(T[:3, 2] @ -wrist[:, 2], T[:3, 0] @ -wrist[:, 1], T[:3, 1] @ -wrist[:, 0]), 0.9)

    def test_names_and_flags(self):
        hand = next(barehand.hands(self.log)).right
        flags = dict(zip(barehand.OPENXR_JOINTS, hand.openxr26().flags))
        self.assertEqual((flags["wrist"], flags["little_tip"]), (15, 3))
        self.assertEqual(dict(zip(barehand.SEGMENTS, hand.seen()))["little_distal"], False)
        channels = dict(zip(barehand.GLOVE_CHANNELS, hand.glove22()))
        self.assertEqual(channels["index_pij"], hand.joint_angles()["index_pip_flex"])
        unobservable = [name for name, value in channels.items() if np.isnan(value)]
        self.assertEqual(unobservable, ["palm_arch", "wrist_pitch", "wrist_yaw"])


def numbers(cell):
    return [float(number) for number in re.findall(r"-?\d+\.?\d*", cell)]


class Documentation(unittest.TestCase):
    """The table of outlets in docs/frames_and_units.md, row by row."""

    def setUp(self):
        text = (SOURCE / "docs/frames_and_units.md").read_text(encoding="utf-8")
        section = text.split("## Outlets")[1].split("\n## ")[0]
        rows = [line.strip("|").split("|") for line in section.split("\n") if line.startswith("| `")]
        self.rows = {re.match(r"`([^`]+)`", cells[0].strip())[1]: [numbers(cell) for cell in cells[-2:]] for cells in rows}

        # A right hand whose wrist is the vector and whose knuckles lie before it.
        self.position, self.quaternion = self.rows["hand_joints_t"]
        R = outlets.rotation_of(self.quaternion)
        joints = barehand.hand_joints_t()
        joints.handedness, joints.status = barehand.hand_state_t.RIGHT, barehand.hand_state_t.TRACKING
        joints.orientation = [self.quaternion] * 26
        offsets = {7: [-0.02, 0, -0.09], 12: [0, 0, -0.09]}  # knuckles of index and middle finger in the wrist's frame
        joints.position = [list(np.array(self.position) + R @ np.array(offsets.get(i, [0, 0, 0]))) for i in range(26)]
        self.hand = barehand.Hand(joints=joints)

    def expect(self, row, position, orientation):
        np.testing.assert_allclose(position, self.rows[row][0], rtol=0, atol=1e-6, err_msg=row)
        np.testing.assert_allclose(orientation, self.rows[row][1], rtol=0, atol=1e-6, err_msg=row)

    def test_every_row_holds(self):
        for row, joints in (("openxr26()", self.hand.openxr26()), ("openxr26(numpy.eye(4))", self.hand.openxr26(np.eye(4)))):
            self.expect(row, joints.position[1], joints.orientation[1])
        webxr = self.hand.webxr25()
        self.expect("webxr25()", webxr.position[0], webxr.orientation[0])
        T = self.hand.mano_frame()
        q = outlets.quaternion_of(T[:3, :3])
        self.expect("mano_frame()", T[:3, 3], q if q[0] > 0 else -q)
        self.expect("mano21()", self.hand.mano21()[9], [])
        self.assertEqual(len(self.rows), 6)

    def test_a_room_is_one_matrix(self):
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = [[0, 0, 1], [-1, 0, 0], [0, -1, 0]], [1, 2, 3]  # z up, x forward
        joints = self.hand.openxr26(T)
        np.testing.assert_allclose(joints.position[1], [1 + 0.5, 2 - 0.1, 3 - 0.2])
        R = outlets.rotation_of(np.roll(joints.orientation[1], 1))
        np.testing.assert_allclose(R, T[:3, :3] @ outlets.rotation_of(self.quaternion), atol=1e-12)
        for wrong in (np.diag([1, 1, -1, 1]), 2 * np.eye(4), np.eye(3)):
            with self.assertRaises(ValueError):
                self.hand.openxr26(wrong)


unittest.main()
