#!/usr/bin/env python3
"""Hands from the live page of the program, and from servers that misbehave.
  page_test.py WRITE_CLIENT_GOLDEN BAREHAND"""
import base64
import hashlib
import json
import re
import socket
import struct
import subprocess
import sys
import threading
import time
import unittest
import warnings
from unittest import mock

import numpy as np

import barehand
from barehand import page
from barehand.websocket import BINARY, TEXT, WebSocket
from support import Folder, messages_of

GOLDEN, BAREHAND = sys.argv.pop(1), sys.argv.pop(1)
LONG = 250  # seconds; never waited for when all is well
GUID = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"


class Server:
    """`barehand` with a live page; `port` is where it is served."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([BAREHAND, *arguments], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        for line in self.process.stderr:
            if found := re.search(r"http://[^ ]*:(\d+)", line):
                self.port = int(found[1])
                break
        self.url = f"ws://localhost:{self.port}"
        self._reader = threading.Thread(target=self.process.stderr.read)  # so that the program can go on writing
        self._reader.start()

    def stop(self):
        self.process.terminate()
        self.process.wait(LONG)
        self._reader.join()
        self.process.stderr.close()


class Live(Folder):
    def serve(self, *arguments):
        server = Server(*arguments)
        self.addCleanup(server.stop)
        return server

    def test_a_live_tracker_is_heard_as_it_logs(self):
        path = str(self.folder / "states.lcmlog")
        server = Server("track", "--source", "sim:fist,frames=4,live=true,loop=true", "--hand", "both", "--no-publish",
                        "--view=0", "--states-log", path)
        with barehand.hands(server.url, timeout=LONG) as live:
            heard = [next(live) for _ in range(3)]
        server.stop()
        self.assertEqual(live.counts.trouble(), "")
        logged = {hands.frame_number: hands for hands in barehand.hands(path)}
        for hands in heard:
            both, as_logged = ([*one, *one.without_pose] for one in (hands, logged[hands.frame_number]))
            self.assertEqual(sorted(hand.handedness for hand in both), ["left", "right"])
            for hand, other in zip(both, as_logged, strict=True):
                for part in ("state", "glove", "joints"):
                    self.assertEqual(getattr(hand, part).encode(), getattr(other, part).encode())
            for hand in hands.without_pose:
                self.assertTrue(np.isnan(hand.openxr26().position).all())
        self.assertTrue(any(hands.without_pose for hands in heard), "no hand was without a pose")

    def test_both_hands_of_a_log_equal_the_golden_vectors_to_1e_6(self):
        log, table = self.golden_states(GOLDEN)
        server = self.serve("view", log, "--port", "0")
        player = WebSocket("localhost", server.port, "/live", LONG)
        player.send(b'{"type": "pause"}')
        compared = 0
        with barehand.hands(server.url, timeout=LONG) as live:
            for number in (0, 1, 2, 3, 4):
                player.send(json.dumps({"type": "seek", "value": number}).encode())
                hands = next(hands for hands in live if hands.frame_number == number)
                self.assertEqual((len(hands), len(hands.without_pose)), (0, 2) if number == 4 else (2, 0))
                for hand in hands:
                    golden, joints = table[number, hand.handedness], hand.openxr26()
                    got = {"openxr26": np.column_stack(joints[:3]), "mano21": hand.mano21(),
                           "glove22": hand.glove22()[:, None], "joint_angles": np.array([[*hand.joint_angles().values()]]).T}
                    for outlet, values in got.items():
                        np.testing.assert_allclose(values, golden[outlet], rtol=0, atol=1e-6, err_msg=outlet)
                    compared += 1
        player.close()
        self.assertEqual((compared, live.counts.trouble()), (8, ""))

    def test_the_status_comes_again_and_again_where_a_log_is_paused(self):
        log, _ = self.golden_states(GOLDEN)
        client = WebSocket("localhost", self.serve("view", log, "--port", "0").port, "/live", LONG)
        self.addCleanup(client.close)
        client.send(b'{"type": "pause"}')
        paused = 0
        while paused < 3:
            kind, status = client.receive(LONG)
            self.assertEqual(kind, TEXT)
            paused += not json.loads(status)["log"]["playing"]

    def test_a_server_that_comes_back_is_connected_to_again(self):
        log, _ = self.golden_states(GOLDEN)
        server = Server("view", log, "--port", "0")
        with barehand.hands(server.url, timeout=LONG) as live:
            next(live)
            server.stop()
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                again = self.serve("view", log, "--port", str(server.port))
                self.assertEqual(again.port, server.port)
                while True:  # frames that came before the end may still be waiting
                    frame = next(live).frame_number
                    if live._receiver.network._reason:
                        break
        self.assertIn(frame, range(5))

    def test_a_server_that_is_gone_is_an_error_after_the_timeout(self):
        log, _ = self.golden_states(GOLDEN)
        server = Server("view", log, "--port", "0")
        with barehand.hands(server.url, timeout=LONG) as live:
            server.stop()
            live._receiver.timeout = 0.1
            with self.assertRaisesRegex(barehand.Error, "no message on HAND_STATE .*the connection ended and is tried again"):
                for _ in range(100):
                    next(live)

    def test_the_newest_frame_is_handed_out(self):
        log, _ = self.golden_states(GOLDEN)
        server = self.serve("view", log, "--port", "0")
        player = WebSocket("localhost", server.port, "/live", LONG)
        player.send(b'{"type": "pause"}')
        with barehand.hands(server.url, timeout=LONG, newest=True) as live:
            next(live)
            for number in (1, 2, 3):  # the status says when each has been shown
                player.send(json.dumps({"type": "seek", "value": number}).encode())
                while json.loads(player.receive(LONG)[1])["log"]["position"] != number:
                    pass
            first = next(live).frame_number
            self.assertIn(3, (first, next(live).frame_number) if first != 3 else (3,))
        player.close()


def shake_hands(listener, answer=None):
    """Accepts a connection, answers the request for a WebSocket, and returns the socket."""
    peer, _ = listener.accept()
    request = b""
    while b"\r\n\r\n" not in request:
        request += peer.recv(4096)
    key = re.search(rb"Sec-WebSocket-Key: (\S+)", request)[1]
    accept = base64.b64encode(hashlib.sha1(key + GUID).digest())
    peer.sendall(answer or b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                 b"Sec-WebSocket-Accept: " + accept + b"\r\n\r\n")
    return peer


class Scripted(unittest.TestCase):
    """Servers that send given bytes after a right handshake."""

    def serve(self, *frames, answer=None):
        listener = socket.create_server(("localhost", 0))
        self.addCleanup(listener.close)

        def run():
            with shake_hands(listener, answer) as peer:
                for frame in frames:
                    peer.sendall(frame)
                self.heard = b""
                while piece := peer.recv(4096):
                    self.heard += piece

        thread = threading.Thread(target=run)
        thread.start()
        self.addCleanup(thread.join)
        return listener.getsockname()[1]

    @staticmethod
    def frame(payload, first=0x80 | BINARY):
        size = len(payload)
        length = bytes([size]) if size < 126 else struct.pack(">BH", 126, size) if size < 1 << 16 else \
            struct.pack(">BQ", 127, size)
        return bytes([first]) + length + payload

    @staticmethod
    def chunks(messages):
        """A frame of the page with these messages among chunks of other kinds."""
        chunk = lambda kind, payload: struct.pack("<cBxxI", kind, 0, len(payload)) + payload + bytes(-len(payload) % 4)
        return chunk(b"F", bytes(64)) + b"".join(chunk(b"L", bytes([len(c)]) + c + data) for c, data in messages) + \
            chunk(b"D", bytes(33)) + chunk(b"Z", b"later version")

    def hands(self, port, **options):
        live = barehand.hands(f"ws://localhost:{port}", **{"timeout": LONG, **options})
        self.addCleanup(live.close)
        return live

    def test_messages_in_pieces_with_pings_between_them_come_together(self):
        whole = self.chunks(messages_of(3) + messages_of(3, side=0, hand_id=2))
        half = len(whole) // 2
        port = self.serve(self.frame(b'{"type": "status", "trouble": ""}', 0x80 | TEXT), self.frame(whole[:half], BINARY),
                          self.frame(b"are you there", 0x89), self.frame(whole[half:], 0x80),
                          self.frame(self.chunks(messages_of(4))))
        live = self.hands(port)
        first, second = next(live), next(live)
        self.assertEqual([(hands.frame_number, len(hands)) for hands in (first, second)], [(3, 2), (4, 1)])
        self.assertEqual(live.counts.trouble(), "")
        live.close()

    def test_every_place_where_a_frame_is_cut_is_survived(self):
        whole = self.chunks(messages_of(3))
        stream = [self.frame(whole[:size]) for size in range(0, len(whole), 501)] + [self.frame(self.chunks(messages_of(9)))]
        live = self.hands(self.serve(*stream))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            while next(live).frame_number != 9:
                pass
        self.assertGreater(live.counts.damaged, len(stream) // 2)
        live.close()

    def test_what_is_no_websocket_is_said(self):
        for answer, words in ((b"HTTP/1.1 403 Forbidden\r\n\r\n", "HTTP/1.1 403 Forbidden"),
                              (b"HTTP/1.1 101 Switching Protocols\r\nSec-WebSocket-Accept: wrong\r\n\r\n", "not a WebSocket"),
                              (b"x" * 100_000, "no answer"), (b"\r\n\r\n", "not a WebSocket")):
            with self.assertRaisesRegex(barehand.Error, f"cannot connect to the live page: .*{words}.*track --view"):
                self.hands(self.serve(answer=answer))

    def test_a_breach_of_the_protocol_ends_the_connection(self):
        good = self.chunks(messages_of(1))
        for breach, words in ((b"\x82\x85abcdefghi", "breaks the WebSocket protocol"), (b"\xf2\x01a", "breaks"),
                              (self.frame(good, 0x80), "breaks"), (struct.pack(">BBQ", 0x82, 127, 1 << 40), "more than"),
                              (self.frame(b"", 0x88), "closed the connection")):
            live = self.hands(self.serve(self.frame(good), breach))
            self.assertEqual(next(live).frame_number, 1)
            live._receiver.timeout = 0.3  # only now, so that a slow machine has time for what comes before
            with self.assertRaisesRegex(barehand.Error, f"tried again: .*{words}"):
                next(live)
            live.close()

    def test_what_the_page_says_is_passed_on(self):
        status = json.dumps({"type": "status", "trouble": "Is the sensor plugged in?"}).encode()
        live = self.hands(self.serve(self.frame(status, 0x80 | TEXT), self.frame(self.chunks(messages_of(1)))))
        next(live)
        live._receiver.timeout = 0.3
        with self.assertRaisesRegex(barehand.Error, "no message on HAND_STATE.*Is the sensor plugged in"):
            next(live)
        live.close()

    def test_a_server_that_never_answers_costs_no_more_than_the_timeout(self):
        with socket.create_server(("localhost", 0)) as listener, mock.patch.object(page, "_PATIENCE", LONG):
            url = f"ws://localhost:{listener.getsockname()[1]}"
            with self.assertRaisesRegex(barehand.Error, "cannot connect to the live page: no answer"):
                barehand.hands(url, timeout=0.1)

            # The same when it came to this later: the connection ends, and the next one is not answered.
            peer = []
            opening = threading.Thread(target=lambda: peer.append(shake_hands(listener)))
            listener.accept()[0].close()  # the connection from above
            opening.start()
            live = barehand.hands(url, timeout=LONG)
            opening.join()
            peer[0].close()
            live._receiver.timeout = 1.5  # longer than until the next attempt
            with self.assertRaisesRegex(barehand.Error, "no message on HAND_STATE .*tried again: no answer"):
                next(live)
            live.close()

    def test_all_addresses_of_a_host_together_have_the_time_that_is_given(self):
        with socket.create_server(("127.0.0.1", 0), backlog=0) as full:
            waiting = [socket.socket() for _ in range(3)]
            for one in waiting:  # so that the system does not answer any more
                self.addCleanup(one.close)
                one.setblocking(False)
                one.connect_ex(full.getsockname())
            silent = (socket.AF_INET, socket.SOCK_STREAM, 0, "", full.getsockname())
            with socket.create_server(("127.0.0.1", 0)) as listener:
                good = (*silent[:4], listener.getsockname())
                with mock.patch.object(socket, "getaddrinfo", lambda *_, **__: [silent, good]):
                    opening = threading.Thread(target=lambda: shake_hands(listener).close())
                    opening.start()
                    begin = time.monotonic()
                    WebSocket("host", 1, "/", 3).close()
                    self.assertLess(time.monotonic() - begin, 3)
                    opening.join()

    def test_the_subprotocol_must_be_agreed_on(self):
        port = self.serve()
        with self.assertRaisesRegex(OSError, 'does not agree on the subprotocol "foxglove'):
            WebSocket("localhost", port, "/", LONG, "foxglove.websocket.v1")

    def test_the_end_of_a_recording_ends_the_iteration(self):
        farewell = self.frame(struct.pack(">H", 1000) + b"The recording has ended.", 0x88)
        live = self.hands(self.serve(self.frame(self.chunks(messages_of(1))), self.frame(self.chunks(messages_of(2))), farewell))
        self.assertEqual([hands.frame_number for hands in live], [1, 2])
        self.assertEqual(list(self.hands(self.serve(farewell))), [])

    def test_the_server_says_why_it_closes(self):
        live = self.hands(self.serve(self.frame(struct.pack(">H", 1013) + b"32 clients are connected", 0x88)))
        live._receiver.timeout = 0.3
        with self.assertRaisesRegex(barehand.Error, "tried again: the server closed the connection: 32 clients are connected"):
            next(live)

    def test_nobody_there_and_addresses_that_are_none_are_said(self):
        with socket.create_server(("localhost", 0)) as free:
            port = free.getsockname()[1]
        with self.assertRaisesRegex(barehand.Error, "Connection refused .*start `barehand track --view`"):
            self.hands(port)
        for url in ("ws://", "ws://localhost:x", "ws://localhost:99999", "wss://localhost:8765"):
            with self.assertRaisesRegex(barehand.Error, "URLs look like ws|no encryption"):
                barehand.hands(url)
        with self.assertRaisesRegex(barehand.Error, "address for browsers.*use ws://localhost:8765"):
            barehand.hands("http://localhost:8765")
        self.assertEqual(page.parse_url("ws://[::1]"), ("::1", 8765, "/live"))


unittest.main()
