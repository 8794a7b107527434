"""Sends the images of a depth camera to `barehand track --source lcm`."""
import functools
import time
import zlib

import numpy as np

from .error import Error
from .messages import rgbd_frame_t
from .network import Network

_WHERE = "publish_rgbd"


def publish_rgbd(depth, colour, intrinsics, depth_unit=0.001, utime=None, url=None, channel="RGBD_FRAME", sensor=""):
    """Sends one frame, so that any camera with a Python SDK can be a source for `barehand track --source lcm`.

    depth: (height, width), along the optical axis, 0 = no measurement. Integer counts of `depth_unit` metres, or
    floating point metres, of which NaN, infinity and values below half a count or above 65,535 counts become 0.
    colour: None; or (height, width, 3) of uint8, RGB, registered to depth (equal pixels are equal rays); or the bytes
    of a JPEG or PNG file of that size.
    intrinsics: (fx, fy, cx, cy) of the depth image in pixels, with pixel centres at integers and no lens distortion.
    utime: time at which the depth image was taken, microseconds since the epoch; None: now.
    url, channel, sensor: the LCM network (as in hands()), the channel and the name of the sensor.

    A message has at most 4 MiB, so send large colour images as JPEG. Raises Error for input that the tracker would
    reject.
    """
    _publisher(url, channel, sensor).publish(depth, colour, intrinsics, depth_unit, utime)


@functools.lru_cache(maxsize=None)
def _publisher(url, channel, sensor):
    return RgbdPublisher(url, channel, sensor)


class RgbdPublisher:
    """The state of publish_rgbd() between two frames: the network and the number of the frame."""

    def __init__(self, url=None, channel="RGBD_FRAME", sensor=""):
        self._network, self._channel, self._sensor, self._seq = Network(url), channel, sensor, 0

    def publish(self, depth, colour, intrinsics, depth_unit=0.001, utime=None):
        """Sends one frame, like publish_rgbd()."""
        message = rgbd_frame_t()
        message.utime = time.time_ns() // 1000 if utime is None else _utime(utime)
        message.seq, message.sensor = self._seq, self._sensor
        counts = _counts(np.asarray(depth), depth_unit)
        message.height, message.width = counts.shape
        message.fx, message.fy, message.cx, message.cy = _intrinsics(intrinsics)
        message.depth_unit, message.depth_encoding = float(depth_unit), rgbd_frame_t.DEPTH_ZLIB
        message.depth = zlib.compress(counts.tobytes(), 1)
        message.depth_size = len(message.depth)
        message.colour_encoding, message.colour = _colour(colour, counts.shape)
        message.colour_size = len(message.colour)
        self._network.send(self._channel, message.encode())
        self._seq += 1


def _utime(utime):
    if not _number(utime) or not 1e15 <= utime < 1e16:
        raise Error(f"utime = {utime!r} is no time from 2001 on", _WHERE,
                    "give microseconds since the epoch, or None for now")
    return int(utime)


def _number(value):
    return isinstance(value, (int, float, np.number)) and np.isfinite(value)


def _counts(depth, depth_unit):
    """Converts depth to little endian counts of 16 bits."""
    if not _number(depth_unit) or not 1e-7 <= depth_unit <= 1:
        raise Error(f"a depth unit of {depth_unit!r} m is none", _WHERE, "give metres a count: 0.001 for millimetres")
    if depth.ndim != 2 or depth.size == 0:
        raise Error(f"depth has the shape {depth.shape}", _WHERE, "give (height, width)")
    if np.issubdtype(depth.dtype, np.floating):
        counts = np.round(depth / depth_unit)
        kept = np.where((counts >= 0) & (counts <= 65535), counts, 0).astype("<u2")  # comparisons with NaN are false
        beyond = [] if kept.any() else depth[np.isfinite(depth) & (counts > 65535)]
        if len(beyond):
            raise Error(f"no pixel of depth is within {65535 * depth_unit:g} m; the first is {beyond[0]:g}", _WHERE,
                        "give floating point depth in metres, or integer counts of depth_unit")
        return kept
    if not np.issubdtype(depth.dtype, np.integer):
        raise Error(f"depth is of the type {depth.dtype}", _WHERE, "give integer counts or floating point metres")
    if depth.dtype != np.uint16 and (depth.min() < 0 or depth.max() > 65535):
        raise Error(f"depth has counts from {depth.min()} to {depth.max()}, 0 to 65535 can be sent", _WHERE,
                    "give a larger depth_unit, and 0 where nothing was measured")
    return np.ascontiguousarray(depth, "<u2")


def _intrinsics(intrinsics):
    intrinsics = tuple(intrinsics)
    if len(intrinsics) != 4 or not all(_number(value) for value in intrinsics):
        raise Error(f"the intrinsics are {intrinsics}", _WHERE, "give the four numbers fx, fy, cx, cy in pixels")
    fx, fy, cx, cy = (float(value) for value in intrinsics)
    if not all(1 <= f <= 1e5 for f in (fx, fy)) or not all(abs(c) <= 1e5 for c in (cx, cy)):
        raise Error(f"no camera has fx, fy, cx, cy = {fx}, {fy}, {cx}, {cy}", _WHERE, "give pixels, in this order")
    return fx, fy, cx, cy


def _colour(colour, shape):
    """(encoding, bytes) of a colour image for the message."""
    if colour is None:
        return rgbd_frame_t.COLOUR_NONE, b""
    if isinstance(colour, (bytes, bytearray, memoryview)):
        for start, encoding in ((b"\xFF\xD8", rgbd_frame_t.COLOUR_JPEG), (b"\x89PNG", rgbd_frame_t.COLOUR_PNG)):
            if bytes(colour[:len(start)]) == start:
                return encoding, bytes(colour)
        raise Error("colour is bytes that are no JPEG and no PNG", _WHERE, "give an array (height, width, 3) of uint8, RGB")
    colour = np.asarray(colour)
    if colour.dtype != np.uint8 or colour.shape != (*shape, 3):
        raise Error(f"colour is {colour.dtype} {colour.shape}, depth is {shape}", _WHERE,
                    "give (height, width, 3) of uint8, RGB, registered to depth, or None")
    return rgbd_frame_t.COLOUR_RAW_RGB, np.ascontiguousarray(colour).tobytes()
