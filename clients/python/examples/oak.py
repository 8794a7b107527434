#!/usr/bin/env python3
"""Sends the images of an OAK-D camera to `barehand track --source lcm`. Based on the examples of depthai 3 (pip install
depthai) for cameras of the second generation (RVC2); not run on hardware."""
import depthai as dai

import barehand

with dai.Pipeline() as pipeline:
    # Depth is registered to the colour camera, whose image is undistorted.
    colour = pipeline.create(dai.node.Camera).build(dai.CameraBoardSocket.CAM_A).requestOutput(
        size=(640, 480), type=dai.ImgFrame.Type.RGB888i, fps=30, enableUndistortion=True)
    stereo, sync = pipeline.create(dai.node.StereoDepth), pipeline.create(dai.node.Sync)
    for socket, side in ((dai.CameraBoardSocket.CAM_B, stereo.left), (dai.CameraBoardSocket.CAM_C, stereo.right)):
        pipeline.create(dai.node.Camera).build(socket).requestOutput(size=(640, 400), fps=30).link(side)
    stereo.setExtendedDisparity(True)  # for near objects, such as hands
    colour.link(stereo.inputAlignTo)
    colour.link(sync.inputs["colour"])
    stereo.depth.link(sync.inputs["depth"])
    pairs = sync.out.createOutputQueue()

    pipeline.start()
    while pipeline.isRunning():
        pair = pairs.get()
        (fx, _, cx), (_, fy, cy), _ = pair["colour"].getTransformation().getIntrinsicMatrix()
        barehand.publish_rgbd(pair["depth"].getFrame(), pair["colour"].getFrame(), (fx, fy, cx, cy))  # millimetres
