"""Hands, frame by frame, from a network, a live page or a log."""
from .counts import Counts
from .error import Error
from .hand import Hand, Hands
from .messages import Damaged, Foreign, decode, glove_state_t, hand_joints_t, hand_state_t
from .page import END_OF_FRAME
from .receiver import Receiver

_PARTS = {"HAND_STATE": hand_state_t, "GLOVE_STATE": glove_state_t, "HAND_JOINTS": hand_joints_t}


def hands(source=None, prefix="", timeout=None, newest=False):
    """Iterates over the hands of every frame, from a live tracker or from a log:

        for hands in barehand.hands():
            if hands.right:
                print(hands.right.joint_angles()["index_pip_flex"])

    source: an LCM network, such as udpm://239.255.76.67:7667?ttl=0; the live page of `barehand track --view` or
    `barehand view`, such as ws://localhost:8765; the name of a log that `barehand track --states-log` or `--mcap`,
    `barehand record` or `lcm-logger` wrote; or None for the network in the environment variable LCM_DEFAULT_URL, or LCM's
    default network.
    prefix: the channel prefix of the tracker (`run.channel_prefix`); a live page has none.
    timeout: for a network or a page: seconds without a hand state after which Error is raised; None waits for ever, with
    one warning. A page that ends and comes back is connected to again; one whose recording is over ends the iteration.
    newest: for a network or a page: skips frames if newer ones have arrived, for consumers that are slower than the
    tracker.

    Returns a HandStream. Raises Error if the network, the page or the log cannot be opened, or if a log holds no hand
    states. Damaged and foreign messages are left out, and hands may be incomplete; all of these are counted, with one warning
    for each kind. A network's first frame is left out if it is incomplete: it was under way when the stream began.
    """
    return HandStream(source, prefix, timeout, newest)


class HandStream:
    """An iterator over Hands (hand.py), one for each frame and sensor. `counts` (counts.py) holds the numbers of
    messages that arrived and that were lost."""

    def __init__(self, source, prefix, timeout, newest):
        self.counts = Counts()
        self._source = source
        self._receiver = Receiver(source, prefix, list(_PARTS), self.counts, timeout, newest)
        is_network = self._receiver.network is not None and not self._receiver.is_page
        self._newest = newest and is_network  # a page skips frames itself
        self._frames = _Frames(self._receiver.prefix, self.counts, self._receiver.is_page, joins=is_network)
        self._hands = self._collect()

    def __iter__(self):
        return self

    def __next__(self):
        return next(self._hands)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends the iteration and closes the network or the connection."""
        self._hands.close()
        self._receiver.close()

    def _collect(self):
        for message in self._receiver:
            done = self._frames.add(*message)
            if self._newest and done:
                done = self._newest_of(done)
            self._receiver.warn_of_trouble()
            yield from done

        # A log ends, and so does the page of a recording.
        last = self._frames.rest()
        self._receiver.warn_of_trouble()
        yield from last
        if not self.counts.messages and not self._receiver.is_page:
            raise Error(f"the log holds no hand states on {self._receiver.prefix}HAND_STATE", self._source,
                        "barehand track --source log:FILE --states-log STATES makes them of a recording")

    def _newest_of(self, done):
        """The last one of the frames `done` and of those that have arrived, too, as a list."""
        for message in self._receiver.arrived():
            newer = self._frames.add(*message)
            self.counts.superseded += len(newer)
            done = newer[-1:] or done
        return done


class _Frame:
    def __init__(self, key, late):
        self.key, self.late, self.hands = key, late, {}  # late: a part of the frame was returned before

    def complete(self):
        return all(len(parts) == len(_PARTS) for parts in self.hands.values())


class _Frames:
    """Collects the messages of each frame. The number of hands is assumed to be that of the previous frame, so that a
    frame can be returned as soon as its last message arrives; the first frame is returned when the second one
    begins. `marked`: END_OF_FRAME follows the messages of each frame, and nothing need be assumed. `joins`: a first
    frame may be under way, and is left out if it is incomplete."""

    def __init__(self, prefix, counts, marked=False, joins=False):
        self.prefix, self._counts, self._marked, self._joins = prefix, counts, marked, joins
        self._types = {(prefix + name).encode(): (name, type_) for name, type_ in _PARTS.items()}
        self._open, self._expected, self._last = {}, {}, {}  # by sensor: open frame, expected hands, last frame

    def add(self, channel, data):
        """Adds a message and returns the list of the frames (Hands) that it completes."""
        if (channel, data) == END_OF_FRAME:
            return self.rest()
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
        """Returns the frames that were not returned yet."""
        return [hands for sensor in list(self._open) for hands in self._close(sensor)]

    def _sort(self, name, message):
        sensor, key = message.sensor, (message.utime, message.frame_number)
        done = []
        if sensor in self._open and self._open[sensor].key != key:
            done += self._close(sensor)

        # If the frame has more hands than the previous one, its last hand arrives after the frame was returned. That
        # hand is returned separately, and the number of hands is determined again.
        frame = self._open.setdefault(sensor, _Frame(key, late=self._last.get(sensor) == key))
        frame.hands.setdefault((message.handedness, message.hand_id), {})[name] = message
        if not self._marked and not frame.late and len(frame.hands) == self._expected.get(sensor) and frame.complete():
            done += self._close(sensor)
        return done

    def _close(self, sensor):
        frame, is_first = self._open.pop(sensor), sensor not in self._last
        self._expected[sensor], self._last[sensor] = None if frame.late else len(frame.hands), frame.key
        if self._joins and is_first and not frame.complete():
            return []
        self._counts.incomplete += sum(len(parts) < len(_PARTS) for parts in frame.hands.values())
        return [Hands([Hand(*(parts.get(name) for name in _PARTS)) for parts in frame.hands.values()])]
