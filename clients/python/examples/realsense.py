#!/usr/bin/env python3
"""Sends the images of a RealSense camera to `barehand track --source lcm`. Based on the documentation of pyrealsense2
(pip install pyrealsense2); not run on hardware."""
import pyrealsense2 as rs

import numpy as np

import barehand

pipeline, config, align = rs.pipeline(), rs.config(), rs.align(rs.stream.depth)  # maps colour to depth
config.enable_stream(rs.stream.depth, 640, 480, rs.format.z16, 30)
config.enable_stream(rs.stream.color, 640, 480, rs.format.rgb8, 30)
profile = pipeline.start(config)
unit = profile.get_device().first_depth_sensor().get_depth_scale()
camera = profile.get_stream(rs.stream.depth).as_video_stream_profile().get_intrinsics()

while True:
    frames = align.process(pipeline.wait_for_frames())
    depth, colour = frames.get_depth_frame(), frames.get_color_frame()
    if depth and colour:
        barehand.publish_rgbd(np.asanyarray(depth.get_data()), np.asanyarray(colour.get_data()),
                              (camera.fx, camera.fy, camera.ppx, camera.ppy), depth_unit=unit)
