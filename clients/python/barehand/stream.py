"""Hands, frame by frame, from a network or a log."""
import os
import time
import warnings

from . import log
from .counts import Counts
from .error import Error
from .hand import Hand, Hands
from .messages import Damaged, Foreign, decode, glove_state_t, hand_joints_t, hand_state_t
from .network import Network

_PARTS = {"HAND_STATE": hand_state_t, "GLOVE_STATE": glove_state_t, "HAND_JOINTS": hand_joints_t}
_SILENCE = 5.0  # seconds without a message after which a warning says what to look at


def hands(source=None, prefix="", timeout=None, newest=False):
    """The hands of every frame, from a live tracker or from a log:

        for hands in barehand.hands():
            if hands.right:
                print(hands.right.joint_angles()["index_pip_flex"])

    source: an LCM network, such as udpm://239.255.76.67:7667?ttl=0; the name of a log that `barehand track --states-log`,
    `barehand record` or `lcm-logger` wrote; or None for the network of the environment's LCM_DEFAULT_URL, or LCM's default.
    prefix: the channel prefix of the tracker (`run.channel_prefix`).
    timeout: live, raises Error after so many seconds without a hand state; None waits for ever, with one warning.
    newest: live, passes over frames while a newer one waits, for consumers that are slower than the tracker.

    Returns a HandStream. Raises Error where the network or the log cannot be opened, and where a log holds no hand states.
    Messages that are damaged, foreign or incomplete are left out, with one warning of each kind, and counted.
    """
    return HandStream(source, prefix, timeout, newest)


class HandStream:
    """An iterator of Hands (hand.py), one a frame and sensor. `counts` (counts.py) says what arrived and what did not."""

    def __init__(self, source, prefix, timeout, newest):
        self.counts = Counts()
        self._source, self._timeout, self._newest = source, timeout, newest
        self._frames = _Frames(prefix, self.counts)
        self._warned = set()
        self._network = None
        if source is None or "://" in os.fspath(source):
            self._network = Network(source, self.counts)
            self._hands = self._live()
        else:
            self._hands = self._logged(log.events(source, self.counts))

    def __iter__(self):
        return self

    def __next__(self):
        return next(self._hands)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Leaves the network."""
        self._hands.close()
        if self._network:
            self._network.close()

    def _live(self):
        heard = time.monotonic()
        while True:
            message = self._network.receive(_SILENCE if self._timeout is None else min(self._timeout, _SILENCE))
            done = self._frames.add(*message) if message else []
            self._warn_of_trouble()
            if message and self._frames.carries_hands(message[0]):
                heard = time.monotonic()
            else:
                self._warn_of_silence(time.monotonic() - heard)

            # Of several frames that wait the last one is handed out.
            while self._newest and done and (message := self._network.receive(0)):
                newer = self._frames.add(*message)
                self.counts.superseded += len(newer)
                done = newer[-1:] or done
            yield from done
            if done:
                heard = time.monotonic()  # the time that the consumer took is no silence

    def _logged(self, events):
        for _, channel, data in events:
            yield from self._frames.add(channel, data)
            self._warn_of_trouble()
        yield from self._frames.rest()
        self._warn_of_trouble()
        if not self.counts.messages:
            raise Error(f"the log holds no hand states on {self._frames.prefix}HAND_STATE", self._source,
                        "barehand track --source log:FILE --states-log STATES makes them of a recording")

    def _warn_of_trouble(self):
        for kind in ("lost", "fragments", "damaged", "foreign", "incomplete"):
            if getattr(self.counts, kind) and kind not in self._warned:
                self._warned.add(kind)
                warnings.warn(f"barehand: left out so far: {self.counts.trouble()} (further ones are counted in `counts`)",
                              RuntimeWarning, stacklevel=4)

    def _warn_of_silence(self, seconds):
        said = f"no message on {self._frames.prefix}HAND_STATE for {seconds:.0f} s"
        remedy = "start `barehand track` with the same LCM URL and channel prefix; `barehand listen` shows what it sends"
        if self._timeout is not None and seconds >= self._timeout:
            raise Error(said, self._network.url, remedy)
        if seconds >= _SILENCE and "silence" not in self._warned:
            self._warned.add("silence")
            warnings.warn(f"barehand: {self._network.url}: {said} ({remedy})", RuntimeWarning, stacklevel=4)


class _Frame:
    def __init__(self, key, late):
        self.key, self.late, self.hands = key, late, {}  # late: a part of the frame is handed out already

    def complete(self):
        return all(len(parts) == len(_PARTS) for parts in self.hands.values())


class _Frames:
    """Gathers the messages of each frame. How many hands a frame has is learned from the frame before, so that it is handed
    out with its last message; the first one waits for the second."""

    def __init__(self, prefix, counts):
        self.prefix, self._counts = prefix, counts
        self._types = {(prefix + name).encode(): (name, type_) for name, type_ in _PARTS.items()}
        self._open, self._expected, self._last = {}, {}, {}  # by sensor

    def carries_hands(self, channel):
        return channel in self._types

    def add(self, channel, data):
        """Takes a message; the list of the Hands that it completes."""
        if channel not in self._types:
            return []
        name, type_ = self._types[channel]
        try:
            message = decode(type_, data)
        except Foreign:
            self._counts.foreign += 1
            return []
        except Damaged:
            self._counts.damaged += 1
            return []
        self._counts.messages += 1
        return self._sort(name, message)

    def rest(self):
        """What was not handed out yet."""
        return [self._close(sensor) for sensor in list(self._open)]

    def _sort(self, name, message):
        sensor, key = message.sensor, (message.utime, message.frame_number)
        done = []
        if sensor in self._open and self._open[sensor].key != key:
            done.append(self._close(sensor))

        # One hand more than before comes late, and how many there are is learned anew.
        frame = self._open.setdefault(sensor, _Frame(key, late=self._last.get(sensor) == key))
        frame.hands.setdefault((message.handedness, message.hand_id), {})[name] = message
        if not frame.late and len(frame.hands) == self._expected.get(sensor) and frame.complete():
            done.append(self._close(sensor))
        return done

    def _close(self, sensor):
        frame = self._open.pop(sensor)
        self._expected[sensor], self._last[sensor] = None if frame.late else len(frame.hands), frame.key
        self._counts.incomplete += sum(len(parts) < len(_PARTS) for parts in frame.hands.values())
        return Hands([Hand(*(parts.get(name) for name in _PARTS)) for parts in frame.hands.values()])
