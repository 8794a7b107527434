#!/usr/bin/env python3
"""Tests a training of a few steps: the loss falls, OpenCV and PyTorch give the same output, and the program reads the
folder.
  smoke_test.py BAREHAND"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import surroundings  # first: skips without PyTorch

LEAST_FALL = 0.85  # largest ratio of the loss on unseen scenes after the last step to that before the first
TOLERANCE = 1e-3  # largest difference of outputs


def run(*command: str) -> str:
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    output = done.stdout + done.stderr
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{output}")
    return output


def main(barehand: str) -> None:
    with tempfile.TemporaryDirectory() as work:
        folder = Path(work) / "nets"
        said = run(sys.executable, "-B", str(surroundings.TRAINING / "train.py"), str(folder), "--smoke", "--check",
                   "--version", "smoke", "--hands", str(surroundings.HANDS))
        print(said)

        falls = re.findall(r"(\w+): loss on unseen scenes from ([\d.]+) to ([\d.]+)", said)
        assert [name for name, *_ in falls] == ["crop", "full"], "a network was not trained"
        for name, before, after in falls:
            assert float(after) < LEAST_FALL * float(before), f"{name}: the loss only fell from {before} to {after}"
        figures = json.loads((folder / "evaluation.json").read_text())
        for name, values in figures.items():
            assert values["greatest difference in OpenCV"] < TOLERANCE, f"{name}: OpenCV's outputs differ: {values}"

        # The program loads the networks to detect hands; it would report an error if it could not.
        config = Path(work) / "config.yaml"
        track = [barehand, "track", "--source", "sim:open,noise=kinect,frames=2", "--no-publish", "--config", str(config)]
        config.write_text(f"detection:\n  networks: {folder}\n")
        assert "networks of version smoke" in run(*track), "the program does not use the networks"
        (folder / "crop.onnx").write_bytes(b"no network")
        assert "checksum" in run(*track), "this check cannot fail"
    print("the loss falls, the export is right, and the program reads it")


if __name__ == "__main__":
    main(sys.argv[1])
