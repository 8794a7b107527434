#!/usr/bin/env python3
"""Measures how many pictures a second a headless Chromium without a GPU draws of the live page, while a simulated hand is
tracked at 640x480 and 30 Hz beside it, and the processor time of all its processes for one picture.
  measure_page.py --json FILE [--seconds 20]      `barehand` is taken from PATH; needs Debian's package chromium"""
import argparse
import glob
import json
import os
import pathlib
import re
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "browser"))
from chromium import Chromium  # noqa: E402

# Every picture of the 3D view begins with one call of clear().
COUNT = """window.drawn = 0;
for (const kind of [WebGLRenderingContext, WebGL2RenderingContext]) {
  const clear = kind.prototype.clear;
  kind.prototype.clear = function (bits) { ++window.drawn; return clear.call(this, bits); };
}"""


def seconds_of_session(session):
    """Processor time so far of the processes of a session."""
    total = 0
    for path in glob.glob("/proc/[0-9]*/stat"):
        try:
            with open(path, encoding="ascii", errors="replace") as file:
                fields = file.read().rsplit(")", 1)[1].split()
        except (FileNotFoundError, ProcessLookupError):  # it has just ended
            continue
        if int(fields[3]) == session:
            total += int(fields[11]) + int(fields[12])
    return total / os.sysconf("SC_CLK_TCK")


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", required=True, metavar="FILE", help="file to write")
    parser.add_argument("--seconds", type=float, default=20, help="default 20")
    options = parser.parse_args(words)
    tracker = subprocess.Popen(["barehand", "track", "--source", "sim:grasp_ball,live=true,loop=true", "--no-publish", "--view=0"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)
    try:
        url = next(found[1] for line in tracker.stderr if (found := re.search(r"open (http://\S+)", line)))
        with Chromium(300) as browser:
            browser.size(1280, 800)
            browser.call("Page.addScriptToEvaluateOnNewDocument", source=COUNT)
            browser.open(url)
            browser.wait_for("document.getElementById('hands').textContent.includes('segments seen') && window.drawn > 50")
            drawn, busy, begin = browser.value("window.drawn"), seconds_of_session(browser.process.pid), time.time()
            time.sleep(options.seconds)
            drawn = browser.value("window.drawn") - drawn
            busy, wall = seconds_of_session(browser.process.pid) - busy, time.time() - begin
    finally:
        tracker.terminate()
        tracker.wait()
    figures = {"drawn": drawn / wall, "browser": 1e3 * busy / max(drawn, 1)}
    with open(options.json, "w", encoding="utf-8") as file:
        json.dump({"viewers": figures}, file, indent=1)
    print(json.dumps(figures, indent=1))


main(sys.argv[1:])
