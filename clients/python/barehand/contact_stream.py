"""What the hands touch and how they grasp: messages about contacts, grasps and objects, from a network or a log."""
from .counts import Counts
from .messages import Damaged, Foreign, contact_state_t, decode, grasp_state_t, object_state_t
from .outlets import GRASPS, SEGMENTS
from .receiver import Receiver


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
    group = "grasp" if type_ is grasp_state_t else "contact"
    receiver = Receiver(source, prefix, [name], counts, timeout, also=f"; {group}.enabled must be true in its configuration")
    return _decoded(type_, receiver, counts)


def _decoded(type_, receiver, counts):
    try:
        for channel, data in receiver:
            if channel not in receiver.wanted:
                continue
            try:
                yield decode(type_, data)
            except Foreign:
                counts.foreign += 1
            except Damaged:
                counts.damaged += 1
    finally:
        receiver.close()
