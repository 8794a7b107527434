"""Skips the tests of tools/training, with a message, if PyTorch is missing. All of them import this module first."""
import importlib.util
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TRAINING = ROOT / "tools/training"
sys.path.insert(0, str(TRAINING))

for module, package in (("torch", "python3-torch"), ("cv2", "python3-opencv")):
    if importlib.util.find_spec(module) is None:
        print(f"skipped: no {'PyTorch' if module == 'torch' else 'OpenCV'} (Debian package {package})")
        sys.exit(77)

HANDS = Path(os.environ.get("BAREHAND_HANDS", Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "barehand/hands"))
