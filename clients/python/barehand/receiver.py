"""The messages of an LCM network, a live page or a log, with warnings about silence and about what is left out."""
import os
import time

from . import log
from .error import Error, warn
from .network import Network
from .page import Page

_SILENCE = 5.0  # seconds without a message after which a warning says what to check


class Receiver:
    """Iterates over (channel, data), both bytes, of all messages from a source (hands() in stream.py says of which).
    `wanted` holds the channels whose silence is reported, as bytes; `network` is None for a log."""

    def __init__(self, source, prefix, names, counts, timeout=None, newest=False, also=""):
        """Opens the source; `names` are those of the wanted channels without the prefix, `also` is a further thing to do if
        nothing comes. Raises Error if the source cannot be opened."""
        url = "" if source is None else os.fspath(source)
        self.is_page = url.startswith(("ws://", "wss://", "http://", "https://"))
        self.prefix = "" if self.is_page else prefix  # a live page has none
        self.wanted = {(self.prefix + name).encode() for name in names}
        self.timeout, self.network, self._also = timeout, None, also
        self._what, self._where, self._counts, self._warned = self.prefix + names[0], url, counts, set()
        if self.is_page:
            self.network = Page(url, counts, newest, timeout)
        elif source is None or "://" in url:
            self.network = Network(source, counts)
            self._where = self.network.url
        else:
            self._events = log.events(url, counts)

    def __iter__(self):
        for message in self._live() if self.network else self._logged():
            self.warn_of_trouble()
            yield message
        self.warn_of_trouble()

    def _logged(self):
        for _, channel, data in self._events:
            yield channel, data

    def _live(self):
        silence = 0.0  # without the time that the consumer takes
        while True:
            begin = time.monotonic()
            rest = _SILENCE if self.timeout is None else max(0, self.timeout - silence)
            message = self.network.receive(min(rest, _SILENCE))
            if message is None and self.network.ended:
                return
            silence += time.monotonic() - begin
            if message and message[0] in self.wanted:
                silence = 0.0
            else:
                self._report(silence)
            if message:
                yield message

    def arrived(self):
        """Iterates over the messages of a network that can be had without waiting."""
        while message := self.network.receive(0):
            yield message

    def warn_of_trouble(self):
        """Warns of each kind of trouble in the counts, once."""
        for kind in ("lost", "fragments", "damaged", "foreign", "incomplete"):
            if getattr(self._counts, kind) and kind not in self._warned:
                self._warned.add(kind)
                warn(f"left out so far: {self._counts.trouble()} (further ones are counted in `counts`)", self._where)

    def _report(self, silence):
        said, remedy = f"no message on {self._what} for {silence:.0f} s", self.network.remedy + self._also
        if self.timeout is not None and silence >= self.timeout:
            raise Error(said, self._where, remedy)
        if silence >= _SILENCE and "silence" not in self._warned:
            self._warned.add("silence")
            warn(f"{said} ({remedy})", self._where)

    def close(self):
        if self.network:
            self.network.close()
