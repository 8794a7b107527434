"""Finds the simulator's hand mesh."""
import argparse
import os
from pathlib import Path


def add_hands_option(parser: argparse.ArgumentParser) -> None:
    """Adds the option --hands, the folder with the mesh."""
    cache = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
    default = Path(os.environ.get("BAREHAND_HANDS", cache / "barehand/hands"))
    parser.add_argument("--hands", type=Path, default=default, metavar="FOLDER",
                        help="folder with right.glb, as deploy/fetch_hand_mesh.sh makes it (default: %(default)s)")


def right_hand(folder: Path) -> Path:
    """The path of the mesh. If it is missing, the program exits with a message that says what to do."""
    path = folder / "right.glb"
    if not path.is_file():
        raise SystemExit(f"{path} is missing: run deploy/fetch_hand_mesh.sh, or name its folder with --hands")
    return path
