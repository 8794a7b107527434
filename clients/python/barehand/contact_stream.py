<<<<<<< HEAD
"""What the hands touch: messages about contacts and objects, from a network or a log."""
||||||| 96ff02c
"""What the hands touch: messages about contacts and objects, from a network or a log."""
import os
import time

from . import log
=======
"""What the hands touch and how they grasp: messages about contacts, grasps and objects, from a network or a log."""
import os
import time

from . import log
>>>>>>> grasp
from .counts import Counts
<<<<<<< HEAD
from .messages import Damaged, Foreign, contact_state_t, decode, object_state_t
from .outlets import SEGMENTS
from .receiver import Receiver
||||||| 96ff02c
from .error import Error
from .messages import Damaged, Foreign, contact_state_t, decode, object_state_t
from .network import Network
from .outlets import SEGMENTS
from .page import Page
=======
from .error import Error
from .messages import Damaged, Foreign, contact_state_t, decode, grasp_state_t, object_state_t
from .network import Network
from .outlets import GRASPS, SEGMENTS
from .page import Page
>>>>>>> grasp


def contacts(source=None, prefix="", timeout=None):
    """Iterates over contact_state_t (lcmtypes/contact_state_t.lcm): one for each hand and frame. The arguments are those
    of barehand.hands() with the same names; `utime` and `hand_id` say which hand a message belongs to. Messages of other
    types and damaged ones are left out, with one warning for each kind."""
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
    receiver = Receiver(source, prefix, [name], counts, timeout, also="; contact.enabled must be true in its configuration")
    return _decoded(type_, receiver, counts)


def _decoded(type_, receiver, counts):
    try:
<<<<<<< HEAD
        for channel, data in receiver:
            if channel not in receiver.wanted:
                continue
            try:
                yield decode(type_, data)
            except Foreign:
                counts.foreign += 1
            except Damaged:
                counts.damaged += 1
||||||| 96ff02c
        heard = time.monotonic()
        while True:
            left = None if timeout is None else max(0.0, heard + timeout - time.monotonic())
            message = network.receive(left)
            if message is None:
                raise Error(f"no message on {channel} for {timeout:.0f} s", network.url,
                            "start `barehand track` with the same LCM URL and channel prefix, and contact.enabled: true")
            if message[0] == channel.encode():
                yield message
                heard = time.monotonic()
=======
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
>>>>>>> grasp
    finally:
        receiver.close()
