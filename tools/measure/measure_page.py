#!/usr/bin/env python3
"""Measures how many pictures a second a headless Chromium without a GPU draws of the live page, while a simulated hand is
tracked at 640x480 and 30 Hz beside it, and the processor time of all its processes for one picture.
  measure_page.py --json FILE [--seconds 20]      `barehand` is taken from PATH; needs Debian's package chromium"""
import argparse
import contextlib
import glob
import json
import os
import pathlib
import re
import subprocess
import sys
import threading
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
    """Processor time so far of the processes of a session, and of their children that have ended."""
    total = 0
    for path in glob.glob("/proc/[0-9]*/stat"):
        try:
            with open(path, encoding="ascii", errors="replace") as file:
                fields = file.read().rsplit(")", 1)[1].split()
        except (FileNotFoundError, ProcessLookupError):  # it has just ended
            continue
        if int(fields[3]) == session:
            total += sum(map(int, fields[11:15]))
    return total / os.sysconf("SC_CLK_TCK")


@contextlib.contextmanager
def tracked_hand():
    """A tracker of a simulated hand; gives the address of its page."""
    command = ["barehand", "track", "--source", "sim:grasp_ball,live=true,loop=true", "--no-publish", "--view=0"]
    tracker = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               start_new_session=True)
    said = ""
    for line in tracker.stderr:
        said += line
        if found := re.search(r"open (http://\S+)", line):
            break
    else:
        sys.exit(f"the tracker did not start: {said}")
    reader = threading.Thread(target=tracker.stderr.read)  # so that the tracker never waits for us
    reader.start()
    try:
        yield found[1]
    finally:
        tracker.terminate()
        tracker.wait()
        reader.join()


def measured(url, seconds):
    """Pictures a second of the page at `url`, and the processor time of the browser for one [ms]."""
    with Chromium(300) as browser:
        # Wait until the hand is drawn.
        browser.size(1280, 800)
        browser.call("Page.addScriptToEvaluateOnNewDocument", source=COUNT)
        browser.open(url)
        browser.wait_for("document.getElementById('hands').textContent.includes('segments seen') && window.drawn > 50")

        # Measure.
        drawn, busy, begin = browser.value("window.drawn"), seconds_of_session(browser.process.pid), time.monotonic()
        time.sleep(seconds)
        drawn = browser.value("window.drawn") - drawn
        busy, wall = seconds_of_session(browser.process.pid) - busy, time.monotonic() - begin
        if browser.problems:
            sys.exit("the page has problems: " + "; ".join(browser.problems))
    return {"drawn": drawn / wall, "browser": 1e3 * busy / max(drawn, 1)}


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", required=True, metavar="FILE", help="file to write")
    parser.add_argument("--seconds", type=float, default=20, help="default 20")
    options = parser.parse_args(words)
    with tracked_hand() as url:
        figures = measured(url, options.seconds)
    with open(options.json, "w", encoding="utf-8") as file:
        json.dump({"viewers": figures}, file, indent=1)
    print(json.dumps(figures, indent=1))


main(sys.argv[1:])
