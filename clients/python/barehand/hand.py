"""One hand, and the hands of one frame."""
import numpy as np

from . import outlets
from .messages import hand_state_t

STATUS = ("searching", "tracking", "holding", "lost")


class Hand:
    """One hand in one frame. Metres and radians; the camera frame has x right, y down, z forward.

    All values of a hand without a pose (`has_pose` is false) are NaN, never zero, and so are the values from a message
    that did not arrive. The messages themselves are `state`, `glove` and `joints`, each None if it did not arrive;
    lcmtypes/*.lcm describe their fields.
    """

    def __init__(self, state=None, glove=None, joints=None):
        self.state, self.glove, self.joints = state, glove, joints
        self._header = state or glove or joints

    utime = property(lambda self: self._header.utime, doc="Time of the depth image, microseconds since the epoch.")
    frame_number = property(lambda self: self._header.frame_number, doc="Number of the frame.")
    sensor = property(lambda self: self._header.sensor, doc="Name of the sensor.")
    id = property(lambda self: self._header.hand_id, doc="Stays with one hand for as long as it is tracked.")

    @property
    def handedness(self):
        """"right" or "left"."""
        return "left" if self._header.handedness == hand_state_t.LEFT else "right"

    @property
    def status(self):
        """"searching", "tracking", "holding" (the hand is out of sight and its last pose is kept) or "lost"."""
        number = self._header.status
        return STATUS[number] if 0 <= number < len(STATUS) else f"unknown status {number}"

    @property
    def tracked(self):
        """True if the pose was measured in this frame; false if the last pose is kept or there is no pose."""
        return self.status == "tracking"

    @property
    def has_pose(self):
        """True while tracking and holding."""
        return self.status in ("tracking", "holding")

    def openxr26(self, T=outlets.T_XR_CAMERA):
        """The 26 joints of OpenXR (outlets.OPENXR_JOINTS), smoothed: outlets.Joints with quaternions (x, y, z, w).

        T (4x4) maps camera coordinates to the frame of the result. By default, that frame has its origin at the camera
        and OpenXR's axes: x right, y up, z backward. With `numpy.eye(4)`, the joints stay in the camera frame. Joint
        frames of both hands: -z along the bone, +y out of the back of the hand.
        """
        if not self.joints:
            return outlets.joints_in(T, np.full((26, 3), np.nan), np.full((26, 4), np.nan), np.full(26, np.nan),
                                     np.zeros(26, int))
        return outlets.joints_in(T, *(np.array(getattr(self.joints, name))
                                      for name in ("position", "orientation", "radius", "flags")))

    def webxr25(self, T=outlets.T_XR_CAMERA):
        """The 25 joints of WebXR (outlets.WEBXR_JOINTS): as openxr26(), without the palm."""
        return outlets.Joints(*(part[1:] for part in self.openxr26(T)))

    def mano21(self):
        """(21, 3): landmarks in the order of MediaPipe (wrist, then thumb to little finger, each from root to tip) relative
        to the wrist, in MANO's wrist frame: the input that dex-retargeting expects, as from its hand detector. z points
        from the wrist to the middle knuckle, x out of the palm, y towards the thumb of a right hand and away from the
        thumb of a left hand. Metres, smoothed."""
        landmarks = self._landmarks()
        return (landmarks - landmarks[0]) @ self._mano_rotation(landmarks)

    def mano_frame(self):
        """4x4, T_camera_mano: maps coordinates of mano21() to the camera frame."""
        landmarks, T = self._landmarks(), np.eye(4)
        T[:3, :3], T[:3, 3] = self._mano_rotation(landmarks), landmarks[0]
        return T

    def glove22(self, raw=False):
        """(22,): the channels of a CyberGlove (outlets.GLOVE_CHANNELS) in radians, of the smoothed pose or the raw one.
        Channels that cannot be observed are NaN; palm_arch, wrist_pitch and wrist_yaw always are. `glove.channel_flag`
        says which angles are inferred."""
        return self._of_glove("channel_raw" if raw else "channel", 22)

    def joint_angles(self, raw=False):
        """{name: radians} of 21 joint angles, such as index_pip_flex: 0 in the flat hand; flexion positive towards the
        palm, abduction (_abd) positive towards the thumb. NaN without a pose; empty if the message did not arrive."""
        if not self.glove:
            return {}
        return dict(zip(self.glove.joint_name, self.glove.joint_angle_raw if raw else self.glove.joint_angle))

    def confidence(self):
        """(16,): for each segment (outlets.SEGMENTS) the probability that both its ends are within 10 mm; NaN without a
        pose."""
        return np.array([s.confidence for s in self.state.segments]) if self.state else np.full(16, np.nan)

    def seen(self):
        """(16,) of bool: segments that were estimated from data; the others are inferred from structure and motion."""
        return np.array([s.seen for s in self.state.segments]) if self.state else np.zeros(16, bool)

    def _landmarks(self):
        """(21, 3) in the camera frame."""
        return np.array(self.joints.position if self.joints else np.full((26, 3), np.nan))[list(outlets.LANDMARKS_21)]

    def _mano_rotation(self, landmarks):
        return outlets.mano_rotation(landmarks, self.handedness)

    def _of_glove(self, name, size):
        return np.array(getattr(self.glove, name)) if self.glove else np.full(size, np.nan)

    def __repr__(self):
        return f"<{self.handedness} hand {self.id}, {self.status}, frame {self.frame_number}>"


class Hands(tuple):
    """The hands of one frame that have a pose. The others, which are searched for or lost, are in `without_pose`."""

    def __new__(cls, hands):
        self = super().__new__(cls, [hand for hand in hands if hand.has_pose])
        self.without_pose = tuple(hand for hand in hands if not hand.has_pose)
        self.utime, self.frame_number, self.sensor = hands[0].utime, hands[0].frame_number, hands[0].sensor
        return self

    @property
    def right(self):
        """The right hand, or None if none has a pose."""
        return next((hand for hand in self if hand.handedness == "right"), None)

    @property
    def left(self):
        """The left hand, or None if none has a pose."""
        return next((hand for hand in self if hand.handedness == "left"), None)
