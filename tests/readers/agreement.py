#!/usr/bin/env python3
"""Other people's programs read what Barehand writes for them: an MCAP file with @mcap/core, and the live topics with
@foxglove/ws-protocol under both names of the protocol, decoded with @foxglove/rosmsg2-serialization. Joint states, transforms,
images and intrinsics must equal the LCM states and the recording. First shows that a change is noticed.
  agreement.py BAREHAND LCMTYPES CONFIG NODE"""
import base64
import json
import os
import re
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../mcap"))
import agreement  # noqa: E402  of tests/mcap

FRAMES = 6
SKIPPED = 77


def restored(value):
    if not isinstance(value, dict) or "base64" not in value:
        return value
    return base64.b64decode(value["base64"])


class Printed:
    """What a reader in JavaScript printed, in the form of ros_mcap.McapFile."""

    def __init__(self, lines):
        self.lines = [json.loads(line, object_hook=restored) for line in lines.splitlines()]

    def of_topic(self, topic):
        return ((line["time"], line["sequence"], line["message"]) for line in self.lines if line["topic"] == topic)

    def topics(self):
        return {line["topic"]: ("", line["metadata"]) for line in self.lines}


def node(program, *arguments):
    return subprocess.run([NODE, os.path.join(HERE, program), *map(str, arguments)], stdout=subprocess.PIPE, text=True,
                          check=False)


def read_file(path):
    done = node("read_mcap.mjs", path)
    assert done.returncode == 0, f"@mcap/core does not read {path}"
    return Printed(done.stdout)


def read_live(barehand, here, logs, subprotocol):
    """The topics of the states and the images in these logs, served by `barehand view`."""
    server = subprocess.Popen([barehand, "view", *logs, "--port", "0"], cwd=here, stderr=subprocess.PIPE, text=True)
    try:
        port = re.search(r"http://[^ ]*:(\d+)", server.stderr.readline())[1]
        done = node("read_live.mjs", port, subprotocol, FRAMES)
        assert done.returncode == 0, f"no viewer can be connected as {subprotocol}"
        return Printed(done.stdout)
    finally:
        server.terminate()
        server.wait()
        server.stderr.close()


def check_that_changes_are_noticed(file, states, gloves, folder):
    """Small changes of one message of each kind."""
    def problems():
        return [*agreement.disagreements(file, states, gloves), *agreement.image_disagreements(file, folder)]

    def message(topic):
        return next(line["message"] for line in file.lines if line["topic"] == topic)

    before = len(problems())
    side = next(side for (_, side), state in states.items() if state.has_pose)
    transform = next(t for t in message("/tf")["transforms"] if t["child_frame_id"] == f"{side}_palm")["transform"]
    depth = message("/camera/depth")
    for place, key, change in ((message(f"/{side}_hand/joint_states")["position"], 3, lambda x: x + 2e-6),
                               (transform["translation"], "y", lambda x: x + 2e-6),
                               (transform["rotation"], "x", lambda x: x - 2e-6),
                               (message("/camera/camera_info")["k"], 0, lambda x: x + 2e-6),
                               (depth, "data", lambda x: bytes([x[0] ^ 1]) + x[1:]),
                               (message("/camera/colour"), "data", lambda x: x[:-100] + bytes(100))):
        right, place[key] = place[key], change(place[key])
        assert len(problems()) == before + 1, f"the check itself is broken: it does not notice a change of {key}"
        place[key] = right


def check_damage(path):
    """@mcap/core must notice a changed byte in the middle of a chunk, or the check sums are not compared."""
    with open(path, "rb") as file:
        data = bytearray(file.read())
    data[len(data) // 2] ^= 0xFF
    with open(path + ".damaged", "wb") as file:
        file.write(data)
    assert subprocess.run([NODE, os.path.join(HERE, "read_mcap.mjs"), path + ".damaged"], stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, check=False).returncode != 0, "damage is not noticed"


def main(barehand, lcmtypes, config):
    if not os.path.exists(os.path.join(HERE, "node_modules/.package-lock.json")):
        print("not tested: reading with @mcap/core, @foxglove/ws-protocol and @foxglove/rosmsg2-serialization\n"
              "They are not installed. With a network: npm ci --prefix tests/readers")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as here:
        states, gloves = agreement.track(barehand, lcmtypes, config, here, FRAMES)
        for recording in ("take.lcmlog", "take.mcap"):
            subprocess.run([barehand, "convert", "take", recording], check=True, cwd=here, stdout=subprocess.DEVNULL,
                           stderr=subprocess.PIPE)
        file = read_file(here + "/hands.mcap")
        check_that_changes_are_noticed(file, states, gloves, here + "/take")
        check_damage(here + "/hands.mcap")

        problems = [*agreement.disagreements(file, states, gloves),
                    *agreement.image_disagreements(file, here + "/take")]
        for logs in (["states.lcmlog", "take.lcmlog"], ["states.lcmlog", "take.mcap"], ["hands.mcap"]):
            for subprotocol in ("foxglove.sdk.v1", "foxglove.websocket.v1"):
                live = read_live(barehand, here, logs, subprotocol)
                found = [*agreement.disagreements(live, states, gloves),
                         *agreement.image_disagreements(live, here + "/take", live=True)]
                problems += [f"{subprotocol}, {logs}: {problem}" for problem in found]
        print("\n".join(problems) or
              f"{len(states)} states and {FRAMES} frames agree, in the file and live under both names")
        sys.exit(1 if problems else 0)


NODE = sys.argv.pop()
main(*sys.argv[1:])
