#!/usr/bin/env python3
"""Sends the images of an Azure Kinect to `barehand track --source lcm`. Based on the source code of pyk4a (pip install
pyk4a); not run on hardware. Lens distortion of the depth camera is not removed."""
from pyk4a import CalibrationType, ColorResolution, Config, DepthMode, ImageFormat, PyK4A

import barehand

camera = PyK4A(Config(color_resolution=ColorResolution.RES_720P, color_format=ImageFormat.COLOR_BGRA32,
                      depth_mode=DepthMode.NFOV_UNBINNED, synchronized_images_only=True))
camera.start()
(fx, _, cx), (_, fy, cy), _ = camera.calibration.get_camera_matrix(CalibrationType.DEPTH)

while True:
    capture = camera.get_capture()
    colour = capture.transformed_color  # the BGRA image, registered to depth
    if colour is not None:
        barehand.publish_rgbd(capture.depth, colour[:, :, 2::-1], (fx, fy, cx, cy))  # depth in millimetres
