#!/usr/bin/env python3
"""Tests the clients with the program and with liblcm over UDP on the loopback interface. To be started by
with_multicast.sh.
  network_test.py BAREHAND"""
import socket
import subprocess
import sys
import threading
import unittest
import warnings
import zlib
from types import SimpleNamespace
from unittest import mock

import numpy as np

import barehand
from barehand import log, receiver
from barehand.counts import Counts
from barehand.messages import decode
from barehand.network import Network, parse_url
from support import URL, Folder, messages_of

BAREHAND = sys.argv.pop(1)
LONG = 250  # seconds: a timeout that is reached only by failing tests
START = 1_700_000_000_000_000  # microseconds
CAMERA = (260.0, 260.0, 159.5, 119.5)


def image(number):
    """Depth and colour of a slanted wall. They differ for every number, and LCM must split them into fragments."""
    chance = np.random.default_rng(number)
    depth = 500 + np.add.outer(np.arange(240), np.arange(320)) // 4 + chance.integers(0, 2, (240, 320))
    return depth.astype(np.uint16), chance.integers(0, 255, (240, 320, 3), np.uint8)


class Live(Folder):
    def test_the_program_is_heard_as_it_logs(self):
        path = str(self.folder / "states.lcmlog")
        with barehand.hands(URL, timeout=LONG) as live:
            track = subprocess.Popen([BAREHAND, "track", "--source", "sim:fist,frames=4", "--hand", "both", "--lcm-url", URL,
                                      "--states-log", path], stdout=subprocess.DEVNULL)
            heard = [next(live) for _ in range(4)]
            self.assertEqual(track.wait(LONG), 0)
        for hands, logged in zip(heard, barehand.hands(path), strict=True):
            both, both_logged = (hands.right, *hands.without_pose), (logged.right, *logged.without_pose)
            self.assertEqual([hand.handedness for hand in both], ["right", "left"])
            for hand, as_logged in zip(both, both_logged, strict=True):
                for part in ("state", "glove", "joints"):
                    self.assertEqual(getattr(hand, part).encode(), getattr(as_logged, part).encode())
        self.assertEqual((live.counts.trouble(), live.counts.messages), ("", 24))

    def test_published_images_are_what_the_program_records(self):
        path = str(self.folder / "take.lcmlog")
        record = subprocess.Popen([BAREHAND, "record", "--source", "lcm", "--lcm-url", URL, "--frames", "3", "--out", path,
                                   "--depth", "zlib", "--colour", "raw"], stdout=subprocess.DEVNULL)
        self.addCleanup(record.kill)
        number = 0
        while record.poll() is None and number < 1000:  # the first images may be lost while the program starts
            barehand.publish_rgbd(*image(number), CAMERA, utime=START + 33_333 * number, url=URL, sensor="test")
            number += 1
            try:
                record.wait(0.03)
            except subprocess.TimeoutExpired:
                pass
        self.assertEqual(record.returncode, 0)
        got = [decode(barehand.rgbd_frame_t, data) for _, _, data in log.events(path, Counts())]
        self.assertEqual(len(got), 3)
        for frame in got:
            depth, colour = image((frame.utime - START) // 33_333)
            self.assertEqual((frame.width, frame.height, frame.fx, frame.sensor, frame.depth_unit),
                             (320, 240, 260.0, "test", 0.001))
            self.assertEqual(zlib.decompress(frame.depth), depth.tobytes())
            self.assertEqual(frame.colour, colour.tobytes())

    def test_fragments_of_liblcm_come_together(self):
        path = str(self.folder / "large.lcmlog")
        sent = [np.random.default_rng(i).bytes(size) for i, size in enumerate([100, 70_000, 300_000, 1_000_000])]
        with open(path, "wb") as file:
            for i, data in enumerate(sent):
                log.write_event(file, i, 100_000 * i, b"LARGE", data)
        counts = Counts()
        network = Network(URL, counts)
        player = subprocess.Popen(["lcm-logplayer", "-l", URL, path], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        got = []
        while len(got) < len(sent) and (message := network.receive(LONG)):
            if message[0] == b"LARGE":  # liblcm tests itself with messages of its own
                got.append(message[1])
        self.assertEqual(player.wait(LONG), 0)
        network.close()
        self.assertTrue(got == sent)
        self.assertEqual((counts.damaged, counts.fragments), (0, 0))

    def test_the_newest_frame_is_handed_out(self):
        sender = Network(URL)
        with barehand.hands(URL, timeout=LONG, newest=True) as live:
            for frame in range(10):
                for channel, data in messages_of(frame):
                    sender.send(channel.decode(), data)
            self.assertEqual((next(live).frame_number, live.counts.superseded), (9, 9))
        sender.close()

    def test_a_frame_under_way_when_the_stream_begins_is_left_out(self):
        sender = Network(URL)
        with barehand.hands(URL, timeout=LONG) as live:
            for channel, data in [*messages_of(0)[1:], *messages_of(1), *messages_of(2)[1:], *messages_of(3)]:
                sender.send(channel.decode(), data)
            frames = [(next(live).frame_number, live.counts.incomplete) for _ in range(3)]
        sender.close()
        self.assertEqual(frames, [(1, 0), (2, 1), (3, 1)])


class Trouble(unittest.TestCase):
    def test_silence_is_an_error_where_a_timeout_is_given(self):
        with barehand.hands(URL, prefix="DESK_", timeout=0.01) as live:
            with self.assertRaisesRegex(barehand.Error, "no message on DESK_HAND_STATE .*start `barehand track`"):
                next(live)

    def test_no_wait_goes_beyond_the_timeout(self):
        waits, clock = [], [0.0]

        def receive(seconds):
            waits.append(seconds)
            clock[0] += seconds

        waiting = receiver.Receiver(URL, "", ["HAND_STATE"], Counts(), timeout=7)
        waiting.close()
        waiting.network = SimpleNamespace(receive=receive, ended=False, remedy="")
        with mock.patch.object(receiver, "time", SimpleNamespace(monotonic=lambda: clock[0])):
            with warnings.catch_warnings(), self.assertRaisesRegex(barehand.Error, "for 7 s"):
                warnings.simplefilter("ignore")
                next(iter(waiting))
        self.assertEqual(waits, [5, 2])

    def test_contacts_are_waited_for_as_hands_are(self):
        with warnings.catch_warnings(record=True) as said, mock.patch.object(receiver, "_SILENCE", 0.01):
            warnings.simplefilter("always")
            with self.assertRaisesRegex(barehand.Error, "no message on CONTACT_STATE .*contact.enabled must be true"):
                next(barehand.contacts(URL, timeout=0.05))
        self.assertEqual([one.filename for one in said], [__file__])
        self.assertIn("no message on CONTACT_STATE", str(said[0].message))

    def test_contacts_that_cannot_be_used_are_said(self):
        sender, contacts = Network(URL), barehand.contacts(URL, timeout=LONG)
        contact = barehand.contact_state_t().encode()
        for data in (contact[:-1], messages_of()[0][1], contact):
            sender.send("CONTACT_STATE", data)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            self.assertEqual(next(contacts).encode(), contact)
        self.assertEqual([one.filename for one in said], [__file__] * 2)
        self.assertIn("1 damaged, 1 foreign", str(said[-1].message))
        contacts.close()
        sender.close()

    def test_other_channels_are_no_sign_of_life(self):
        network, done = Network(URL), threading.Event()

        def chatter():
            while not done.wait(0.001):
                network.send("HEALTH", b"data")

        sender = threading.Thread(target=chatter)
        sender.start()
        with barehand.hands(URL, timeout=0.05) as live, self.assertRaisesRegex(barehand.Error, "no message on HAND_STATE"):
            next(live)
        done.set()
        sender.join()
        network.close()

    def test_the_time_that_a_consumer_takes_is_no_silence(self):
        clock = [0.0]
        with mock.patch.object(receiver, "time", SimpleNamespace(monotonic=lambda: clock[0])):
            sender = Network(URL)
            self.addCleanup(sender.close)
            with barehand.hands(URL, timeout=LONG) as live:
                for frame in range(3):
                    sender.send("HEALTH", b"data")
                    for channel, data in messages_of(frame):
                        sender.send(channel.decode(), data)
                for frame in range(3):
                    self.assertEqual(next(live).frame_number, frame)
                    clock[0] += 2 * LONG

    def test_foreign_lost_and_damaged_messages_are_counted_with_a_warning(self):
        sender = Network(URL)
        self.addCleanup(sender.close)
        with barehand.hands(URL, timeout=LONG) as live, warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            for data in (b"", messages_of()[1][1], messages_of()[0][1][:-1]):
                sender.send("HAND_STATE", data)
            sender._number += 2
            for frame in (0, 1):
                for channel, data in messages_of(frame):
                    sender.send(channel.decode(), data)
            self.assertEqual(next(live).frame_number, 0)
        self.assertEqual((live.counts.foreign, live.counts.damaged, live.counts.lost), (2, 1, 2))
        self.assertEqual(len(said), 3)
        self.assertIn("2 lost, 1 damaged, 2 foreign", str(said[-1].message))

    def test_a_port_that_is_not_shared_is_said(self):
        group, port, *_ = parse_url(URL)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as selfish:
            selfish.bind(("", port + 1))
            with self.assertRaisesRegex(barehand.Error, "port is taken .*ss -ulpn"):
                barehand.hands(f"udpm://{group}:{port + 1}")

    def test_addresses_that_are_none_are_said(self):
        for url in ("tcpq://localhost:7700", "udpm://10.0.0.1:7667", "udpm://nowhere:7667",
                    *("udpm://239.255.76.67:" + end for end in ("99999", "7667?ttl=x", "7667?ttl=300"))):
            with self.assertRaisesRegex(barehand.Error, "URLs look like"):
                barehand.hands(url)
        network = Network(URL)
        self.addCleanup(network.close)
        for name in ("", "c" * 64, "a\0b"):
            with self.assertRaisesRegex(barehand.Error, "1 to 63 bytes"):
                network.send(name, b"")


unittest.main()
