#!/usr/bin/env python3
"""Tests LCM's datagrams: messages are decoded as they were encoded; missing and damaged ones are counted, and no wrong
message is delivered."""
import random
import subprocess
import sys
import unittest

from barehand.counts import Counts
from barehand.datagrams import LARGEST_MESSAGE, Assembler, encode

ADDRESS, OTHER = ("127.0.0.1", 4000), ("127.0.0.1", 4001)
LARGE = bytes(range(256)) * 800  # four datagrams


class Import(unittest.TestCase):
    def test_a_python_without_numpy_is_told_what_to_install(self):
        script = "import sys; sys.modules['numpy'] = None; import barehand"
        said = subprocess.run([sys.executable, "-B", "-c", script], stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(said.returncode, 1)
        self.assertRegex(said.stderr.splitlines()[-1], "^ModuleNotFoundError: barehand needs NumPy.*python3-numpy")


class Protocol(unittest.TestCase):
    def setUp(self):
        self.counts = Counts()
        self.assembler = Assembler(self.counts)

    def add(self, datagrams, address=ADDRESS):
        return [message for datagram in datagrams if (message := self.assembler.add(datagram, address))]

    def test_messages_of_every_size_come_out_as_they_went_in(self):
        limit = 65507 - 8 - 2
        sizes = [0, 1, limit, limit + 1, 65487, 2 * 65487 - 2, 2 * 65487 - 1, 1 << 20, LARGEST_MESSAGE]
        for number, size in enumerate(sizes):
            data = random.Random(size).randbytes(size)
            datagrams = encode(b"A", data, number)
            self.assertLessEqual(max(map(len, datagrams)), 65507)
            self.assertEqual(len(datagrams) == 1, size <= limit, size)
            self.assertEqual(self.add(datagrams), [(b"A", data)], size)
        self.assertEqual(self.counts, Counts())

    def test_the_bytes_are_those_of_the_specification(self):
        self.assertEqual(encode(b"CH", b"xy", 7), [b"LC02\0\0\0\7CH\0xy"])
        first, second, *_, last = encode(b"CH", LARGE, 7)
        self.assertEqual(first[:24], b"LC03\0\0\0\7" + len(LARGE).to_bytes(4, "big") + b"\0\0\0\0\0\0\0\4CH\0\0")
        self.assertEqual(second[12:16], (65487 - 3).to_bytes(4, "big"))
        self.assertEqual(last[16:20], b"\0\3\0\4")

    def test_fragments_come_in_any_order_and_twice(self):
        datagrams = encode(b"A", LARGE, 0)
        for seed in range(10):
            self.setUp()
            self.assertEqual(self.add(random.Random(seed).sample(datagrams * 2, 8)), [(b"A", LARGE)])
            self.assertEqual(self.add(encode(b"A", LARGE, 1)), [(b"A", LARGE)])
            self.assertEqual(self.counts, Counts())

    def test_senders_do_not_mix(self):
        mine, others = encode(b"A", LARGE, 0), encode(b"B", LARGE[::-1], 0)
        got = [message for pair in zip(mine, others)
               for message in self.add(pair[:1]) + self.add(pair[1:], OTHER)]
        self.assertEqual(got, [(b"A", LARGE), (b"B", LARGE[::-1])])

    def test_a_message_without_one_of_its_fragments_is_left_out_and_counted(self):
        for missing in range(4):
            self.setUp()
            datagrams = encode(b"A", LARGE, 0)
            del datagrams[missing]
            self.assertEqual(self.add(datagrams + encode(b"A", LARGE, 1)), [(b"A", LARGE)])
            self.assertEqual((self.counts.fragments, self.counts.damaged), (1, 0))

    def test_lost_messages_are_counted_by_their_numbers(self):
        for number in [5, 6, 9, 0xFFFFFFFF, 0, 1]:  # 7 and 8 are lost; after the large jump, a sender was restarted
            self.add(encode(b"A", b"", number))
        self.assertEqual(self.counts.lost, 2)
        self.add(encode(b"A", b"", 3), OTHER)
        self.assertEqual(self.counts.lost, 2)

    def test_an_overtaken_message_is_no_loss(self):
        for number in [5, 4, 5, 6]:
            self.assertEqual(len(self.add(encode(b"A", b"x", number))), 1)
        self.assertEqual(self.counts.lost, 0)

    def test_datagrams_that_are_none_of_lcm_are_counted(self):
        first, second, *_ = encode(b"A", LARGE, 0)
        long_name, huge = b"c" * 64, b"\xff" * 4
        bad = [b"", b"LC02", b"GET / HTTP/1.1\r\n", b"LC02\0\0\0\0no end of the channel",
               b"LC02\0\0\0\0" + long_name + b"\0", first[:19], first[:18] + b"\0\0" + first[20:],
               first[:8] + huge + first[12:], first[:8] + b"\0" * 4 + first[12:], first[:20] + long_name + first[22:],
               second[:12] + huge + second[16:]]
        self.assertEqual(self.add(bad), [])
        self.assertEqual(self.counts.damaged, len(bad))

    def test_fragments_that_leave_a_hole_are_no_message(self):
        datagrams = encode(b"A", LARGE, 0)
        datagrams[1] = datagrams[1][:-1]
        self.assertEqual((self.add(datagrams), self.counts.damaged), ([], 1))

    def test_no_damage_is_believed_or_raises(self):
        chance = random.Random(2)
        pool = encode(b"A", LARGE, 0) + encode(b"A", b"short", 1)
        for _ in range(20_000):
            datagram = bytearray(chance.choice(pool)[:chance.choice([20, 30, 70_000])])
            for _ in range(chance.randint(1, 4)):
                datagram[chance.randrange(min(24, len(datagram)))] = chance.randrange(256)
            self.add([bytes(datagram)], ("127.0.0.1", chance.randrange(1000)))
        self.assertGreater(self.counts.damaged, 1000)
        self.assertLessEqual(len(self.assembler._senders), 64)


unittest.main()
