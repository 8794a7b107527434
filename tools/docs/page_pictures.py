#!/usr/bin/env python3
"""Makes the pictures of docs/view.md: the live page, its time line and its calibration, with hands of the simulator in a
headless Chromium (Debian package chromium).
  tools/docs/page_pictures.py [BAREHAND]"""
import base64
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tools/browser"))
from chromium import Chromium  # noqa: E402

IMAGES = ROOT / "docs/images"
BAREHAND = str(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/src/app/barehand").resolve())


class Page:
    """The page of a running command; it ends with the block."""

    def __init__(self, browser, *arguments, folder=None):
        self.program = subprocess.Popen([BAREHAND, *arguments], cwd=folder, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.PIPE, text=True)
        for line in self.program.stderr:
            if found := re.search(r"open (http://\S+)", line):
                break
        else:
            sys.exit(f"{' '.join(arguments)}: no page")
        browser.open(found[1])
        browser.wait_for("document.getElementById('hands').textContent.includes('segments seen')")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.program.kill()
        self.program.wait()
        self.program.stderr.close()


def save(browser, name):
    picture = browser.call("Page.captureScreenshot", format="jpeg", quality=85)["data"]
    (IMAGES / name).write_bytes(base64.b64decode(picture))
    print(IMAGES / name)


def main():
    with Chromium(300) as browser, tempfile.TemporaryDirectory() as folder:
        browser.size(1200, 800)

        # Show live tracking; wait until ten seconds of motion fill the plots.
        with Page(browser, "track", "--source", "sim:grasp_ball,live=true,loop=true", "--no-publish", "--view=0"):
            browser.wait_for("performance.now() > 12000")
            save(browser, "view.jpg")

        # Show a calibration in which part of the hand was seen.
        browser.theme("dark")
        with Page(browser, "calibrate", "--source", "sim:scan,live=true", "--out", f"{folder}/hand.json", "--view=0"):
            browser.wait_for("document.querySelectorAll('#scan .cell.complete').length >= 3")
            save(browser, "view_calibration.jpg")

        # Show a log that has frames without a hand.
        browser.theme("light")
        browser.size(1200, 640)
        scene = "sim:returns,speed=2,frames=240"
        for arguments in (["track", "--source", scene, "--no-publish", "--states-log", f"{folder}/states.lcmlog"],
                          ["record", "--source", scene, "--out", f"{folder}/take.lcmlog"]):
            subprocess.run([BAREHAND, *arguments], check=True, capture_output=True)
        with Page(browser, "view", "states.lcmlog", "take.lcmlog", "--port", "0", folder=folder):
            browser.key(" ")
            browser.value("(() => { const p = document.getElementById('position'); p.value = 75; p.oninput(); })()")
            browser.wait_for("document.getElementById('log_time').textContent.startsWith('frame 76 ')")
            browser.wait_for("performance.now() > 5000")
            save(browser, "view_log.jpg")


main()
