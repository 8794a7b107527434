"""What the hands touch and how they grasp: messages about contacts, grasps and objects, from a network or a log."""
import os
import time

from . import log
from .counts import Counts
from .error import Error
from .messages import Damaged, Foreign, contact_state_t, decode, grasp_state_t, object_state_t
from .network import Network
from .outlets import GRASPS, SEGMENTS
from .page import Page


def contacts(source=None, prefix="", timeout=None):
    """Iterates over contact_state_t (lcmtypes/contact_state_t.lcm): one for each hand and frame. The arguments are those
    of barehand.hands() with the same names; `utime` and `hand_id` say which hand a message belongs to. Messages of other types and damaged
    ones are left out."""
    return _messages(contact_state_t, "CONTACT_STATE", source, prefix, timeout)


def grasps(source=None, prefix="", timeout=None):
    """Iterates over grasp_state_t (lcmtypes/grasp_state_t.lcm): one for each hand and frame. The arguments are those of
    barehand.hands() with the same names."""
    return _messages(grasp_state_t, "GRASP_STATE", source, prefix, timeout)


def grasp_name(grasp):
    """The name of the class that a grasp_state_t states: "none", "wrap" ..., or "unknown"."""
    return GRASPS[grasp.grasp] if 0 <= grasp.grasp < len(GRASPS) else "unknown"


def objects(source=None, prefix="", timeout=None):
    """Iterates over object_state_t (lcmtypes/object_state_t.lcm): one for each object and frame. The arguments are those
    of barehand.hands() with the same names."""
    return _messages(object_state_t, "OBJECT_STATE", source, prefix, timeout)


def touched(segments):
    """The segments that touch something, [(name, segment_contact_t)]. `segments` is one of the three lists of a
    contact_state_t: `object`, `own` or `other_hand`."""
    return [(name, contact) for name, contact in zip(SEGMENTS, segments) if contact.state == contact_state_t.TOUCHING]


def _messages(type_, name, source, prefix, timeout):
    counts = Counts()
    if source is not None and os.fspath(source).startswith(("ws://", "wss://")):
        prefix = ""  # a live page has none
        received = _live(Page(source, counts), name, timeout)
    elif source is None or "://" in os.fspath(source):
        received = _live(Network(source, counts), prefix + name, timeout)
    else:
        received = ((channel, data) for _, channel, data in log.events(source, counts))
    return _decoded(type_, (prefix + name).encode(), received)


def _live(network, channel, timeout):
    try:
        heard = time.monotonic()
        while True:
            left = None if timeout is None else max(0.0, heard + timeout - time.monotonic())
            message = network.receive(left)
            if message is None:
                raise Error(f"no message on {channel} for {timeout:.0f} s", network.url,
                            "start `barehand track` with the same LCM URL and channel prefix, and "
                            f"{'grasp' if channel.endswith('GRASP_STATE') else 'contact'}.enabled: true")
            if message[0] == channel.encode():
                yield message
                heard = time.monotonic()
    finally:
        network.close()


def _decoded(type_, wanted, received):
    for channel, data in received:
        if channel != wanted:
            continue
        try:
            yield decode(type_, data)
        except (Damaged, Foreign):
            continue
