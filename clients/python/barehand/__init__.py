"""Barehand in Python: receives the states of the hands from the tracker, and sends images to it.

    import barehand
    for hands in barehand.hands():                    # live over LCM; see below for other sources
        for hand in hands:                            # the hands with a pose; hands.without_pose holds the others
            print(hand.handedness, hand.status, hand.joint_angles()["index_pip_flex"])

    barehand.hands("ws://localhost:8765")             # live from barehand track --view
    barehand.hands("states.lcmlog")                   # from a log

    for contact in barehand.contacts():               # contact_state_t, one for each hand and frame
        print([segment for segment, _ in barehand.touched(contact.object)])

    for grasp in barehand.grasps():                   # grasp_state_t, one for each hand and frame
        print(barehand.grasp_name(grasp), grasp.probability)

    barehand.publish_rgbd(depth, colour, (fx, fy, cx, cy))   # for barehand track --source lcm

Units are metres, seconds and radians. The camera frame has x right, y down, z forward. Unknown values are NaN, never 0.
"""
import sys

try:
    import numpy  # noqa: F401
except ModuleNotFoundError as error:
    if error.name != "numpy":
        raise
    raise ModuleNotFoundError(f"barehand needs NumPy, which {sys.executable} lacks: install python3-numpy and use Debian's "
                              "/usr/bin/python3, or pip install numpy for this one", name="numpy") from None

from .contact_stream import contacts, grasp_name, grasps, objects, touched
from .counts import Counts
from .error import Error
from .hand import STATUS, Hand, Hands
from .messages import (command_t, contact_state_t, glove_state_t, grasp_state_t, hand_joints_t, hand_state_t, health_t,
                       object_state_t, queue_health_t, rgbd_frame_t, segment_contact_t, segment_state_t, stage_health_t)
from .outlets import (GLOVE_CHANNELS, GRASPS, LANDMARKS_21, OPENXR_JOINTS, OPERATOR2MANO, SEGMENTS, T_XR_CAMERA, WEBXR_JOINTS,
                      Joints)
from .rgbd import RgbdPublisher, publish_rgbd
from .stream import HandStream, hands
