#!/usr/bin/env python3
"""Tests how messages become hands: decoding, frames with one and two hands, and lost hands."""
import unittest

import numpy as np

import barehand
from barehand.counts import Counts
from barehand.messages import Damaged, Foreign, decode
from barehand.stream import _Frames
from support import golden_bytes, messages_of

TYPES = ("command_t", "contact_state_t", "glove_state_t", "grasp_state_t", "hand_joints_t", "hand_state_t", "health_t",
         "object_state_t", "rgbd_frame_t")


def places(data):
    """About 500 byte positions in a message: few enough for the tests to take only a second."""
    return range(0, len(data), 1 + len(data) // 500)


class Decoding(unittest.TestCase):
    def test_golden_messages_of_the_program_come_out_as_they_went_in(self):
        for name in TYPES:
            self.assertEqual(decode(getattr(barehand, name), golden_bytes(name)).encode(), golden_bytes(name), name)

    def test_truncations_are_errors(self):
        for name in TYPES:
            data = golden_bytes(name)
            for size in places(data):
                with self.assertRaises(Damaged if size >= 8 else Foreign):
                    decode(getattr(barehand, name), data[:size])
            with self.assertRaises(Damaged):
                decode(getattr(barehand, name), data + b"\0")

    def test_no_damaged_byte_raises_anything_else(self):
        for name in TYPES:
            data = bytearray(golden_bytes(name))
            for i in places(data):
                for value in (0x00, 0x7F, 0x80, 0xFF):
                    before, data[i] = data[i], value
                    try:
                        decode(getattr(barehand, name), bytes(data))
                    except (Damaged, Foreign):
                        pass
                    data[i] = before


class Frames(unittest.TestCase):
    def setUp(self):
        self.counts = Counts()
        self.frames = _Frames("", self.counts)

    def add(self, messages):
        return [(hands.frame_number, [hand.handedness for hand in hands])
                for channel, data in messages for hands in self.frames.add(channel, data)]

    def test_a_frame_is_complete_with_its_last_message(self):
        self.assertEqual(self.add(messages_of(0)), [])  # the number of hands is known only when the next frame starts
        first, *rest = messages_of(1)
        self.assertEqual(self.add([first]), [(0, ["right"])])
        self.assertEqual(self.add(rest), [(1, ["right"])])
        for frame in range(2, 5):
            self.assertEqual(self.add(messages_of(frame)), [(frame, ["right"])])
        self.assertEqual(self.frames.rest(), [])

    def test_two_hands_come_together(self):
        both = [messages_of(frame, side, hand_id=side) for frame in range(3) for side in (1, 0)]
        self.assertEqual(self.add(message for hand in both for message in hand),
                         [(frame, ["right", "left"]) for frame in range(3)])

    def test_a_second_hand_is_learned_and_forgotten(self):
        def both(frame):
            return messages_of(frame) + messages_of(frame, 0, hand_id=2)
        self.assertEqual(self.add(messages_of(0) + messages_of(1)), [(0, ["right"]), (1, ["right"])])
        self.assertEqual(self.add(both(2)), [(2, ["right"])])
        self.assertEqual(self.add(both(3)), [(2, ["left"])])
        self.assertEqual(self.add(both(4)), [(3, ["right", "left"]), (4, ["right", "left"])])
        self.assertEqual(self.add(messages_of(5) + messages_of(6)), [(5, ["right"]), (6, ["right"])])
        self.assertEqual(self.counts.incomplete, 0)

    def test_a_lost_message_costs_nothing_else(self):
        self.add(messages_of(0) + messages_of(1))
        self.assertEqual(self.add(messages_of(2)[:2]), [])
        self.assertEqual(self.add(messages_of(3)), [(2, ["right"]), (3, ["right"])])
        self.assertEqual(self.counts.incomplete, 1)

    def test_sensors_and_prefixes_keep_apart(self):
        a, b = (lambda frame: messages_of(frame, sensor="a")), (lambda frame: messages_of(frame, sensor="b"))
        self.assertEqual(self.add(a(0) + b(7) + a(1) + b(8)), [(frame, ["right"]) for frame in (0, 1, 7, 8)])
        self.assertEqual(self.add((b"DESK_" + channel, data) for channel, data in a(2)), [])
        self.frames = _Frames("DESK_", Counts())
        self.assertEqual(self.add((b"DESK_" + channel, data) for frame in (0, 1) for channel, data in a(frame)),
                         [(0, ["right"]), (1, ["right"])])


class LostHands(unittest.TestCase):
    def hands(self, status):
        frames = _Frames("", Counts())
        for channel, data in messages_of(status=status):
            frames.add(channel, data)
        hands, = frames.rest()
        return hands

    def test_a_lost_hand_is_withheld_and_nan(self):
        for status, name in ((0, "searching"), (3, "lost"), (9, "unknown status 9")):
            hands = self.hands(status)
            self.assertEqual((len(hands), hands.right, hands.left), (0, None, None))
            hand, = hands.without_pose
            self.assertEqual((hand.status, hand.has_pose, hand.tracked), (name, False, False))
            for values in (*hand.openxr26()[:3], *hand.webxr25()[:3], hand.mano21(), hand.mano_frame()[:3], hand.glove22(),
                           hand.confidence(), np.array(list(hand.joint_angles().values()))):
                self.assertTrue(np.isnan(values).all())
            self.assertTrue((hand.openxr26().flags == 0).all())

    def test_a_held_hand_is_flagged(self):
        self.assertEqual((self.hands(2).right.tracked, self.hands(2).right.has_pose), (False, True))
        self.assertEqual((self.hands(1).right.tracked, self.hands(1).right.status), (True, "tracking"))


unittest.main()
