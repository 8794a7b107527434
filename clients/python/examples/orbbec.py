#!/usr/bin/env python3
"""Sends the images of an Orbbec camera to `barehand track --source lcm`. Based on the examples of pyorbbecsdk (pip
install pyorbbecsdk2); not run on hardware. Lens distortion of the colour camera is not removed."""
import numpy as np
from pyorbbecsdk import AlignFilter, Config, OBFormat, OBSensorType, OBStreamType, Pipeline

import barehand

pipeline, config, align = Pipeline(), Config(), AlignFilter(align_to_stream=OBStreamType.COLOR_STREAM)  # depth to colour
colours = pipeline.get_stream_profile_list(OBSensorType.COLOR_SENSOR)
config.enable_stream(colours.get_video_stream_profile(640, 480, OBFormat.RGB, 30))
config.enable_stream(pipeline.get_stream_profile_list(OBSensorType.DEPTH_SENSOR).get_default_video_stream_profile())
pipeline.start(config)


def image(frame, kind, *channels):
    return np.frombuffer(frame.get_data(), kind).reshape(frame.get_height(), frame.get_width(), *channels)


while True:
    frames = pipeline.wait_for_frames(1000)
    frames = align.process(frames) if frames and frames.get_depth_frame() and frames.get_color_frame() else None
    if frames:
        frames, camera = frames.as_frame_set(), pipeline.get_camera_param().rgb_intrinsic
        depth, colour = frames.get_depth_frame(), frames.get_color_frame()
        barehand.publish_rgbd(image(depth, np.uint16), image(colour, np.uint8, 3),
                              (camera.fx, camera.fy, camera.cx, camera.cy),
                              depth_unit=depth.get_depth_scale() / 1000)  # the scale is in mm per unit of depth
