#!/usr/bin/env python3
"""Tests the reading of whole, truncated and damaged logs, and of files that are no logs.
  log_test.py WRITE_CLIENT_GOLDEN"""
import sys
import unittest
import warnings

import barehand
from barehand import log
from barehand.counts import Counts
from support import Folder, messages_of

PROGRAM = sys.argv.pop(1)
FRAMES = 5


class Logs(Folder):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "take.lcmlog"
        self.ends = []
        with open(self.path, "wb") as file:
            for frame in range(FRAMES):
                for channel, data in messages_of(frame):
                    log.write_event(file, len(self.ends), frame, channel, data)
                    self.ends.append(file.tell())

    def read(self):
        """The frames of the log and the counts of messages. A damaged log must cause warnings."""
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            stream = barehand.hands(str(self.path))
            frames = [hands.frame_number for hands in stream]
        self.assertEqual(bool(stream.counts.trouble()), bool(said))
        return frames, stream.counts

    def test_every_event_of_a_whole_log_is_read(self):
        self.assertEqual(self.read(), ([0, 1, 2, 3, 4], Counts(messages=3 * FRAMES)))
        stamps = [stamp for stamp, _, _ in log.events(self.path, Counts())]
        self.assertEqual(stamps, [frame for frame in range(FRAMES) for _ in range(3)])

    def test_a_log_cut_short_anywhere_gives_what_is_whole(self):
        whole = self.path.read_bytes()
        for size in range(1, len(whole), 997):
            self.path.write_bytes(whole[:size])
            counts, events = Counts(), 0
            try:
                for _ in log.events(self.path, counts):
                    events += 1
            except barehand.Error:
                self.assertEqual(events, 0)
            self.assertEqual(events, sum(end <= size for end in self.ends), size)
            self.assertEqual(counts.damaged, size not in self.ends, size)

    def test_a_hand_whose_last_message_is_cut_off_has_nan_there(self):
        self.path.write_bytes(self.path.read_bytes()[:-1])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            stream = barehand.hands(self.path)
            *_, last = stream
        self.assertEqual((last.frame_number, stream.counts.damaged, stream.counts.incomplete), (4, 1, 1))
        joints = last.right.openxr26()
        self.assertTrue((joints.position != joints.position).all() and (joints.flags == 0).all())
        self.assertTrue((last.right.mano21() != last.right.mano21()).all())
        self.assertEqual(last.right.glove22()[0], 0.5)

    def test_damage_in_the_middle_costs_that_event_alone(self):
        whole = bytearray(self.path.read_bytes())
        whole[self.ends[5] + 24:self.ends[5] + 28] = b"\x7f\xff\xff\xff"  # the length of frame 2's state
        self.path.write_bytes(whole)
        frames, counts = self.read()
        self.assertEqual((frames, counts.damaged, counts.incomplete), ([0, 1, 2, 3, 4], 1, 1))

    def test_an_event_that_was_torn_does_not_swallow_what_was_written_later(self):
        whole = self.path.read_bytes()
        self.path.write_bytes(whole[:self.ends[2] + 100] + whole[self.ends[2]:])
        frames, counts = self.read()
        self.assertEqual((frames, counts.damaged, counts.incomplete), ([0, 1, 2, 3, 4], 1, 0))

    def test_foreign_and_damaged_messages_are_counted(self):
        with open(self.path, "ab") as file:
            for channel, data in [(b"HAND_STATE", messages_of(9)[1][1]), (b"HAND_JOINTS", messages_of(9)[2][1][:-8]),
                                  (b"GLOVE_STATE", messages_of(9)[1][1] + b"\0"), (b"HEALTH", b"anything")]:
                log.write_event(file, 0, 9, channel, data)
        frames, counts = self.read()
        self.assertEqual((frames, counts.foreign, counts.damaged), ([0, 1, 2, 3, 4], 1, 2))

    def test_what_is_no_log_of_hands_is_said(self):
        other = self.folder / "other.lcmlog"
        with open(other, "wb") as file:
            log.write_event(file, 0, 0, b"RGBD_FRAME", b"data")
        (self.folder / "empty.lcmlog").touch()
        (self.folder / "text.lcmlog").write_text("no log\n" * 100)
        for name, words in [("none.lcmlog", "cannot read the log: No such file"), ("empty.lcmlog", "the log is empty"),
                            ("text.lcmlog", "holds no LCM event"), ("", "cannot read the log: Is a directory"),
                            ("other.lcmlog", "no hand states on HAND_STATE.*--states-log")]:
            with self.assertRaisesRegex(barehand.Error, words), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                list(barehand.hands(str(self.folder / name)))


class McapFiles(Folder):
    def setUp(self):
        super().setUp()
        self.lcm, _ = self.golden_states(PROGRAM)
        self.path = self.folder / "hands.mcap"
        self.whole = self.path.read_bytes()

    def read(self):
        """The events and the counts."""
        counts = Counts()
        return list(log.events(self.path, counts)), counts

    def test_they_hold_what_the_lcm_log_holds(self):
        events, counts = self.read()
        self.assertEqual(events, list(log.events(self.lcm, Counts())))
        self.assertEqual((len(events), counts), (30, Counts()))

    def test_cut_short_or_changed_anywhere_they_give_nothing_that_is_wrong(self):
        right, _ = self.read()
        for at in range(len(log.mcap.MAGIC), len(self.whole), 211):
            for damaged in (self.whole[:at], self.whole[:at] + bytes([self.whole[at] ^ 0x55]) + self.whole[at + 1:]):
                self.path.write_bytes(damaged)
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    events, counts = self.read()
                if damaged != self.whole[:at] and not counts.damaged:  # it was in the index or a name, which are not read
                    continue
                self.assertTrue(all(event in right for event in events), at)

    def records(self):
        """(what is before the chunk, the chunk, what follows up to the end of the data, the rest)."""
        ends, at = {}, len(log.mcap.MAGIC)
        for kind, content in log.mcap._records(self.whole, at):
            at += 9 + len(content)
            ends.setdefault(kind, (at - 9 - len(content), at))
        (start, end), (_, data_end) = ends[6], ends[15]
        return self.whole[:start], self.whole[start:end], self.whole[end:data_end], self.whole[data_end:]

    def test_damage_costs_one_chunk_and_is_described(self):
        (right, _), (head, chunk, rest, summary) = self.read(), self.records()
        lz4 = chunk.replace(b"\4\0\0\0zstd", b"\4\0\0\0lz4f", 1)
        for words, middle, chunks in (
                (f"{len(chunk)} bytes are damaged or cut off", chunk[:8] + b"\x7f" + chunk[9:], 2),
                ("5 bytes are damaged or cut off", b"\6\0\1\2\3", 2),
                ("a chunk is left out, damaged", chunk[:-1] + bytes([chunk[-1] ^ 1]), 2),
                ("a chunk is left out, packed with lz4f, which is not read: repack the file with `mcap", lz4, 2),
                ("2 chunks are left out, packed with lz4f", lz4 + lz4, 2),
                ("a chunk is left out, which would take more than 256 MiB", chunk[:32] + b"\x7f" + chunk[33:], 2),
                ("it was not finished, as by a recorder that was killed; every complete chunk is used", None, 1)):
            self.path.write_bytes(head + chunk + middle + chunk + rest + summary if middle else head + chunk)
            with self.assertWarnsRegex(RuntimeWarning, f"^barehand: {self.path}: {words}") as said:
                events, counts = self.read()
            self.assertEqual((events, counts.damaged), (right * chunks, 2 if "2 chunks" in words else 1), words)
            self.assertEqual(said.filename, __file__)

    def test_damage_before_the_chunks_costs_nothing_of_a_finished_file(self):
        (right, _), (head, chunk, rest, summary) = self.read(), self.records()
        for at in range(len(log.mcap.MAGIC), len(head), 7):
            damaged = head[:at] + bytes([head[at] ^ 0x55]) + head[at + 1:]
            self.path.write_bytes(damaged + chunk + rest + summary)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self.assertEqual(self.read()[0], right, at)

    def test_a_file_without_hands_is_said(self):
        self.path.write_bytes(self.whole[:100])
        with self.assertRaisesRegex(barehand.Error, "no hand states"), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            list(barehand.hands(self.path))


class GraspsInLogs(Folder):
    def test_grasps_come_in_order_and_have_names(self):
        path = self.folder / "take.lcmlog"
        with open(path, "wb") as file:
            for frame, state in enumerate((-1, 0, 12, 17)):
                grasp = barehand.grasp_state_t()
                grasp.utime, grasp.grasp = frame, state
                log.write_event(file, frame, frame, b"GRASP_STATE", grasp.encode())
                log.write_event(file, frame, frame, b"GRASP_STATE", grasp.encode()[:-1])
        grasps = list(barehand.grasps(path))
        self.assertEqual([grasp.utime for grasp in grasps], [0, 1, 2, 3])
        self.assertEqual([barehand.grasp_name(grasp) for grasp in grasps], ["unknown", "none", "pinch", "writing_tripod"])
        self.assertEqual(list(barehand.contacts(path)), [])

    def test_names_are_those_of_the_constants(self):
        for number, name in enumerate(barehand.GRASPS):
            self.assertEqual(getattr(barehand.grasp_state_t, name.upper()), number)


class ContactsInLogs(Folder):
    def test_contacts_and_objects_come_in_order_and_others_are_left_out(self):
        path = self.folder / "take.lcmlog"
        with open(path, "wb") as file:
            for frame in range(3):
                contact, thing = barehand.contact_state_t(), barehand.object_state_t()
                contact.utime = thing.utime = frame
                contact.object[9].state = barehand.contact_state_t.TOUCHING
                thing.object_id = 7
                for channel, data in (*messages_of(frame), (b"CONTACT_STATE", contact.encode()),
                                      (b"OBJECT_STATE", thing.encode()), (b"CONTACT_STATE", contact.encode()[:-1]),
                                      (b"DESK_CONTACT_STATE", contact.encode())):
                    log.write_event(file, frame, frame, channel, data)
        with self.assertWarnsRegex(RuntimeWarning, "take.lcmlog: left out so far: 1 damaged"):
            contacts = list(barehand.contacts(path))
        self.assertEqual([contact.utime for contact in contacts], [0, 1, 2])
        self.assertEqual([name for name, _ in barehand.touched(contacts[0].object)], ["middle_distal"])
        self.assertEqual(barehand.touched(contacts[0].own), [])
        self.assertEqual([thing.object_id for thing in barehand.objects(path)], [7, 7, 7])
        self.assertEqual(len(list(barehand.contacts(path, prefix="DESK_"))), 3)


unittest.main()
