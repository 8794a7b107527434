#!/usr/bin/env python3
"""The live page in a headless Chromium, with hands of the simulator.
  page_test.py BAREHAND"""
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import cv2
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools/browser"))
from chromium import Chromium  # noqa: E402

BAREHAND = sys.argv.pop(1)
LONG = 120  # seconds; never waited for when all is well
SMALL = "width=320,height=240"
HAND = f"sim:grasp_ball,{SMALL},live=true,loop=true"
STAGE = {"light": (230, 234, 237), "dark": (13, 16, 18)}  # background of the view, as in web/style.css


class Program:
    """A running `barehand` that serves the page at `url`."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen([BAREHAND, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.PIPE, text=True)
        said = ""
        for line in self.process.stderr:
            said += line
            if found := re.search(r"open (http://\S+)", line):
                self.url = found[1]
                break
        else:
            raise AssertionError(f"no address of a page: {said}")
        self.reader = threading.Thread(target=self.process.stderr.read)  # so that the program never waits for us
        self.reader.start()

    @property
    def port(self):
        return self.url.rsplit(":", 1)[1]

    def end(self, number=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(number)
        self.process.wait(LONG)
        self.reader.join()
        self.process.stderr.close()
        return self.process.returncode


def text(element):
    return f"document.getElementById('{element}').textContent"


def disabled(element):
    return f"document.getElementById('{element}').disabled"


def hidden(element):
    return f"document.getElementById('{element}').hidden"


def pressed(name, value):
    return f"document.querySelector('[data-{name}={value}]').getAttribute('aria-pressed') === 'true'"


def setUpModule():
    Page.browser = unittest.enterModuleContext(Chromium(LONG))


class Page(unittest.TestCase):
    """Tests of the page in one browser. Each ends with an empty console."""

    browser = None

    def setUp(self):
        self.browser.open("about:blank")
        self.browser.problems.clear()
        self.browser.size(900, 560)
        self.browser.theme("light")

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])

    @classmethod
    def start(cls, *arguments):
        """Starts the program; it ends with the tests of the class."""
        program = Program(*arguments)
        cls.addClassCleanup(program.end)
        return program

    @classmethod
    def track(cls, source, *more):
        return cls.start("track", "--source", source, "--no-publish", "--view=0", *more)

    def wait_for(self, expression):
        return self.browser.wait_for(expression)

    def press(self, key, expected, shift=False):
        self.browser.key(key, shift)
        self.wait_for(expected)

    def open_with_hand(self, program):
        self.browser.open(program.url)
        self.wait_for(f"{text('hands')}.includes('segments seen') && {hidden('notice')}")

    def view(self):
        """What the 3D view shows as RGB, without the buttons and texts over it."""
        left, top, width, height = self.browser.value(
            "(() => { const b = document.getElementById('scene').getBoundingClientRect();"
            " return [b.left, b.top, b.width, b.height].map(Math.round); })()")
        cover = "document.querySelectorAll('#bottom, #frozen, #notice').forEach((e) => { e.style.visibility = '%s'; })"
        self.browser.value(cover % "hidden")
        page = cv2.imdecode(np.frombuffer(self.browser.picture(), np.uint8), cv2.IMREAD_COLOR)[:, :, ::-1].astype(int)
        self.browser.value(cover % "")
        return page[top:top + height, left:left + width]

    def shares(self, theme="light"):
        """The fractions of the view that have the colours of a confident hand (teal), and of the background."""
        view = self.view()
        red, green, blue = view[..., 0], view[..., 1], view[..., 2]
        teal = (green > red + 30) & (blue > red + 25) & (abs(green - blue) < 40)
        ground = (abs(view - STAGE[theme]) <= 2).all(axis=2)
        return teal.mean(), ground.mean()

    def until(self, is_so, what):
        """Looks again and again until something is so: a browser draws when it comes to it."""
        deadline = time.monotonic() + LONG
        while not is_so():
            self.assertLess(time.monotonic(), deadline, what)

    def wait_for_hand(self, theme="light"):
        self.until(lambda: (shares := self.shares(theme))[0] > 0.01 and shares[1] > 0.3, "a hand before the background")


class Live(Page):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.takes = pathlib.Path(folder.name)
        cls.program = cls.track(HAND, "--view-record", folder.name)

    def wait_until_more_is_captured(self):
        captured = "Number(document.querySelector('#health td:nth-child(2)').textContent)"
        self.wait_for(f"{captured} > {self.browser.value(captured)}")

    def test_a_hand_is_seen_and_the_counters_move(self):
        self.open_with_hand(self.program)
        self.wait_for_hand()
        self.assertEqual(self.browser.value("document.querySelectorAll('#hands .skin').length"), 0, "its own skin")
        self.wait_for(f"Number({text('rate')}) > 0 && Number({text('latency')}) > 0")
        self.wait_until_more_is_captured()

    def test_a_system_that_is_dark_gets_a_dark_page(self):
        self.browser.theme("dark")
        self.open_with_hand(self.program)
        self.wait_for_hand("dark")
        self.press("t", "document.documentElement.dataset.theme === 'light'")
        self.wait_for_hand("light")

    def test_the_page_follows_the_system_until_the_user_chooses_a_theme(self):
        shown = "document.documentElement.dataset.theme === '%s'"
        self.open_with_hand(self.program)
        self.browser.theme("dark")
        self.wait_for(shown % "dark")
        self.wait_for_hand("dark")
        self.browser.theme("light")
        self.wait_for(shown % "light")
        self.press("t", shown % "dark")
        self.browser.theme("dark")
        self.browser.theme("light")
        self.wait_for("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))")
        self.assertTrue(self.browser.value(shown % "dark"))

    def test_the_grasp_is_said_in_words(self):
        self.open_with_hand(self.program)
        self.wait_for("/(Grasp: |No grasp)/.test(document.getElementById('hands').textContent)")

    def test_a_phone_shows_all_in_its_width(self):
        self.browser.size(360, 740, phone=True)
        self.open_with_hand(self.program)
        self.wait_for_hand()
        self.assertLessEqual(self.browser.value("document.documentElement.scrollWidth"), 360)
        outside = ("[...document.querySelectorAll('%s')].filter((e) => e.offsetParent &&"
                   " (e.getBoundingClientRect().right > 360 || e.getBoundingClientRect().left < 0)).map((e) => e.outerHTML)")
        self.assertEqual(self.browser.value(outside % "button:not(#tools *), canvas"), [])
        for element in ("help", "latency"):
            self.wait_for(f"document.getElementById('{element}').offsetParent !== null")

        # The buttons over the view are one row, whose last one can be scrolled to.
        self.assertLess(self.browser.value("document.getElementById('tools').clientHeight"), 60)
        self.browser.value("document.getElementById('tools').scrollLeft = 10000")
        self.assertEqual(self.browser.value(outside % "#screenshot"), [])

    def test_a_phone_on_its_side_shows_view_and_panels_beside_each_other(self):
        self.open_with_hand(self.program)
        for width, height in ((844, 390), (667, 375)):
            self.browser.size(width, height, phone=True)
            self.wait_for(f"innerWidth === {width} && innerHeight === {height}")
            box = "document.querySelector('%s').getBoundingClientRect()"
            scene, tools, legend, panels = (self.browser.value(f"{box % which}.toJSON()")
                                            for which in ("#scene", "#tools", "#legend", "aside"))
            self.assertGreater(scene["width"], 0.55 * width)
            self.assertGreater(scene["height"], 0.85 * height)
            self.assertLessEqual(scene["right"], panels["left"])
            self.assertLessEqual(panels["right"], width)
            self.assertLessEqual(panels["bottom"], height)

            # The buttons are one row at the bottom, whose last one can be scrolled to; the hand has the space above.
            self.assertLess(tools["height"], 45)
            self.assertLess(legend["bottom"], 0.25 * height)
            self.browser.value("document.getElementById('tools').scrollLeft = 10000")
            self.assertLessEqual(self.browser.value(f"{box % '#screenshot'}.right"), scene["right"])

    def test_a_small_screen_has_all_buttons_in_one_row(self):
        self.open_with_hand(self.program)
        for width in (1200, 1280, 1440):
            self.browser.size(width, 800)
            self.wait_for("(() => { document.querySelectorAll('#tools button').forEach((button) => { button.hidden = false; });"
                          f" return innerWidth === {width} && document.getElementById('tools').clientHeight < 40; }})()")

    def test_the_pose_of_the_frame_is_shown_unless_the_smoothed_one_is_asked_for(self):
        self.open_with_hand(self.program)
        self.assertFalse(self.browser.value(pressed("toggle", "smoothed")))
        self.press("m", pressed("toggle", "smoothed"))

    def test_the_keyboard_does_what_the_buttons_do(self):
        self.open_with_hand(self.program)
        self.wait_for_hand()
        _, ground = self.shares()
        self.press("c", pressed("cloud", "scene"))
        for key, expected in [("2", pressed("view", "orbit")), ("3", pressed("view", "camera")),
                              ("1", pressed("view", "follow")), ("e", pressed("toggle", "ellipsoids")),
                              ("m", pressed("toggle", "smoothed")), ("p", pressed("picture", "depth")),
                              ("?", "document.getElementById('shortcuts').open"),
                              ("Escape", "!document.getElementById('shortcuts').open")]:
            self.press(key, expected)
        self.until(lambda: self.shares()[1] < 0.8 * ground, "the whole scene covers more of the view")

    def test_a_frozen_page_stands_still(self):
        self.open_with_hand(self.program)
        self.wait_for_hand()
        self.press("f", f"!{hidden('frozen')}")
        self.until(lambda: (self.view() == self.view()).all(), "it stands still")
        still = self.view()
        self.wait_until_more_is_captured()
        self.assertTrue((self.view() == still).all())
        self.wait_for(f"{text('rate')} === '0'")  # frames come, but none is shown
        self.press("f", hidden("frozen"))
        self.until(lambda: (self.view() != still).any(), "it moves again")

    def test_the_button_records(self):
        self.open_with_hand(self.program)
        self.press("v", "document.getElementById('record').getAttribute('aria-pressed') === 'true'")
        self.wait_for(f"/[1-9]/.test({text('recording')})")
        self.press("v", "document.getElementById('record').getAttribute('aria-pressed') === 'false'")
        self.wait_for(f"!{hidden('recording')} && /lcmlog/.test({text('recording')})")
        self.assertEqual([path.suffix for path in self.takes.iterdir()], [".lcmlog"])


class Trouble(Page):
    def test_no_hand(self):
        self.browser.open(self.track(f"sim:empty_desk,{SMALL},live=true,loop=true").url)
        self.wait_for(f"{text('notice')}.includes('No hand in view') && Number({text('rate')}) > 0")
        self.press("c", pressed("cloud", "scene"))
        self.press("c", pressed("cloud", "none"))
        self.until(lambda: self.shares()[1] > 0.99, "nothing is drawn")

    def test_nobody_sends(self):
        self.browser.open(self.start("view", "--lcm", "--lcm-url", "memq://", "--port", "0").url)
        self.wait_for(f"{text('notice')}.includes('No tracker has sent states')")

    def test_no_connection_and_again_by_itself(self):
        program = self.track(HAND)
        self.open_with_hand(program)
        program.end()
        self.wait_for(f"{text('notice')}.includes('No connection to Barehand')")
        self.assertEqual(self.browser.value(text("connection")), "no connection")
        self.start("track", "--source", HAND, "--no-publish", f"--view={program.port}")
        self.wait_for(f"{text('connection')} === 'connected' && {text('hands')}.includes('segments seen') && {hidden('notice')}")
        self.wait_for_hand()
        refused = [problem for problem in self.browser.problems if "WebSocket" in problem]
        self.assertEqual(refused, self.browser.problems)
        self.browser.problems.clear()


    def test_a_scan_that_holds_up_a_recording_is_named(self):
        program = self.track(f"sim:grasp_ball,{SMALL}")
        self.browser.open(program.url)
        self.wait_for(f"{text('notice')}.includes('hand is being scanned from the frames so far')")
        self.assertEqual(program.end(signal.SIGINT), 130)
        self.wait_for(f"{text('notice')}.includes('Barehand was stopped before the end of the simulation.')")
        self.wait_for(f"{text('connection')} === 'ended' && {text('hands')}.includes('segments seen')")

    def test_the_end_of_a_recording_is_said_and_the_last_picture_stays(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as config:
            config.write("tracker:\n  shape_fit:\n    scans: 0\n")
            config.flush()
            program = self.track(f"sim:grasp_ball,{SMALL},frames=200", "--config", config.name)
            self.browser.open(program.url)
            self.wait_for(f"{text('notice')}.startsWith('The simulation has ended; 200 frames were tracked. The page')")
            self.assertEqual(program.process.wait(LONG), 0)
        self.wait_for_hand()
        self.assertIn("segments seen", self.browser.value(text("hands")))

        # The page does not try to connect again, which the console would show within a second.
        self.browser.value("new Promise((done) => setTimeout(done, 1500))")

    def test_the_end_of_a_live_source_is_said(self):
        program = self.track(f"sim:grasp_ball,{SMALL},live=true,frames=300")
        self.browser.open(program.url)
        self.wait_for(f"{text('notice')}.startsWith('The simulation has ended; ') && {text('connection')} === 'ended'")
        self.assertEqual(program.process.wait(LONG), 0)

    def test_a_program_without_a_place_for_the_page_says_so(self):
        program = self.track(HAND)
        others = [socket.create_connection(("localhost", int(program.port))) for _ in range(32)]
        for other in others:
            self.addCleanup(other.close)
            other.sendall(b"GET /live HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                          b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")
            self.assertIn(b" 101 ", other.recv(4096))
        self.browser.open(program.url)
        self.wait_for(f"{text('notice')}.includes('Barehand serves 32 pages and viewers already')")
        others[0].close()
        self.wait_for(f"{text('connection')} === 'connected' && {text('hands')}.includes('segments seen')")

    def test_a_program_that_stands_still_is_noticed(self):
        program = self.track(HAND)
        self.open_with_hand(program)
        program.process.send_signal(signal.SIGSTOP)
        self.wait_for(f"{text('notice')}.includes('Nothing has come for 10 s')")
        program.process.send_signal(signal.SIGCONT)
        self.wait_for(f"{text('connection')} === 'connected' && {text('hands')}.includes('segments seen')")
        self.browser.problems[:] = [problem for problem in self.browser.problems if "WebSocket" not in problem]


class Contacts(Page):
    def test_the_button_shows_and_hides_them(self):
        self.open_with_hand(self.track(HAND))
        self.wait_for(pressed("toggle", "touches"))
        self.press("k", "!(" + pressed("toggle", "touches") + ")")
        self.press("k", pressed("toggle", "touches"))

    def test_the_button_is_not_pressed_while_they_are_off(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        config = pathlib.Path(folder.name, "no_contacts.yaml")
        config.write_text("contact:\n  enabled: false\n")
        self.open_with_hand(self.track(HAND, "--config", str(config)))
        contacts = pressed("toggle", "touches")
        self.assertFalse(self.browser.value(contacts))
        self.press("k", f"!{hidden('notice')} && {text('notice')}.includes('contact.enabled: true')")
        self.assertFalse(self.browser.value(contacts))


class Log(Page):
    """A log in which the hand leaves the view three times."""

    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        states, take = f"{folder.name}/states.lcmlog", f"{folder.name}/take.lcmlog"
        scene = f"sim:returns,{SMALL},noise=kinect,speed=4,frames=60"
        for command in (["track", "--source", scene, "--no-publish", "--states-log", states],
                        ["record", "--source", scene, "--out", take]):
            subprocess.run([BAREHAND, *command], check=True, capture_output=True, timeout=LONG)
        self.program = self.start("view", states, take, "--port", "0")
        self.states, self.take = states, take

    def frame(self):
        return int(re.match(r"frame (\d+) of 60", self.browser.value(text("log_time")))[1])

    def at(self, frame):
        return f"{text('log_time')}.startsWith('frame {frame} of 60')"

    def test_the_time_line_plays_steps_and_jumps(self):
        self.browser.open(self.program.url)

        # It plays by itself, and pauses.
        self.wait_for(f"!{hidden('timeline')} && {text('log_time')}.startsWith('frame ') && !{self.at(1)}")
        self.press(" ", f"{text('play')} === '▶'")
        self.wait_for(self.at(self.log()["position"] + 1))
        here = self.frame()

        # Steps, and a jump to the beginning, where there is a hand.
        self.press("ArrowLeft" if here == 60 else "ArrowRight", f"!{self.at(here)}")
        self.assertEqual(abs(self.frame() - here), 1)
        self.browser.value("(() => { const p = document.getElementById('position'); p.value = 9; p.oninput(); })()")
        self.wait_for(f"{self.at(10)} && {hidden('notice')}")
        self.wait_for_hand()

        # Jumps to frames without a hand, forwards and backwards.
        self.press("ArrowRight", f"{text('notice')} === 'No hand in this frame of the log.'", shift=True)
        first = self.frame()
        self.assertLess(self.shares()[0], 0.001, "no hand is drawn")
        self.press("ArrowRight", f"!{self.at(first)}", shift=True)
        self.assertGreater(self.frame(), first + 1)
        self.press("ArrowLeft", self.at(first), shift=True)
        self.wait_for(f"{disabled('lost_before')} && !{disabled('lost_next')}")

        # Other speeds, and playing on.
        self.browser.value("(() => { const s = document.getElementById('speed'); s.value = '4'; s.onchange(); })()")
        self.press(" ", f"{self.at(60)} && {text('play')} === '▶'")


    def log(self):
        """What the program tells of the log, which the page may show later."""
        return self.browser.value(
            "new Promise((done) => { const socket = new WebSocket(`ws://${location.host}/live`); socket.onmessage ="
            " ({data}) => { if (typeof data === 'string') { socket.close(); done(JSON.parse(data).log); } }; })")

    def lost(self):
        """The numbers, from 1, of the frames without a hand."""
        return [frame + 1 for first, last in self.log()["lost"] for frame in range(first, last + 1)]

    def test_all_texts_are_about_the_frame_that_is_shown(self):
        self.browser.open(self.program.url)
        self.wait_for(f"{self.at(60)} && {text('play')} === '▶'")
        self.browser.value(
            "(() => { window.seen = []; const look = () => { window.seen.push([" + text("log_time") + ", "
            + text("hands") + ", " + hidden("notice") + "]); requestAnimationFrame(look); }; look(); })()")
        self.press(" ", f"!{self.at(60)}")
        self.wait_for(f"{self.at(60)} && {text('play')} === '▶'")
        lost, seen = self.lost(), self.browser.value("window.seen")
        self.assertGreater(len(lost), 5)
        for line, hands, unnoticed in seen:
            frame = int(re.match(r"frame (\d+) of 60", line)[1])
            self.assertEqual(("No pose." in hands, unnoticed), (frame in lost, frame not in lost), line)

    def test_the_time_line_marks_frames_where_its_knob_is(self):
        self.browser.open(self.program.url)
        self.wait_for(f"{self.at(60)}")
        is_red = self.browser.value(
            "(() => { const line = document.getElementById('position').getBoundingClientRect();"
            " const marks = document.getElementById('lost_marks'), left = marks.getBoundingClientRect().left;"
            " const row = marks.getContext('2d').getImageData(0, 5, marks.width, 1).data;"
            " return Array.from({length: 60}, (_, frame) => { const knob = line.left + 8 + (line.width - 16) * frame / 59;"
            " const x = Math.min(marks.width - 1, Math.max(0, Math.floor(knob - left)));"
            " return row[4 * x] > row[4 * x + 1]; }); })()")
        self.assertEqual([frame + 1 for frame in range(60) if is_red[frame]], self.lost())

    def test_the_page_says_whose_skin_is_drawn(self):
        self.browser.open(self.program.url)
        self.wait_for(f"{text('hands')}.includes('The log does not hold the person')")
        hand = f"{pathlib.Path(self.take).parent}/anna.json"
        subprocess.run([BAREHAND, "track", "--source", f"sim:grasp_ball,{SMALL},frames=3", "--no-publish", "--save-hand", hand],
                       check=True, capture_output=True, timeout=LONG)
        self.browser.open(self.start("view", self.states, "--port", "0", "--hand", hand).url)
        self.wait_for(f"{text('hands')}.includes('Drawn with the skin of {hand}.')")

    def test_a_log_of_images_alone_says_that_it_holds_no_states(self):
        self.browser.open(self.start("view", self.take, "--port", "0").url)
        self.wait_for(f"{text('notice')}.includes('holds no states of hands')")
        self.wait_for(f"{text('log_time')}.endsWith('no states of hands')")
        self.assertTrue(self.browser.value(f"{disabled('lost_before')} && {disabled('lost_next')}"))


class Calibration(Page):
    def test_what_is_still_to_be_shown_and_what_was_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            program = self.start("calibrate", "--source", "sim:scan,width=160,height=120,live=true", "--out",
                                 f"{folder}/hand.json", "--view=0")
            self.browser.open(program.url)

            # While the hand is shown: what is missing, and bars that fill.
            self.wait_for(f"!{hidden('scan')} && parseInt({text('scan_state')}) > 20")
            self.assertEqual(self.browser.value("document.querySelectorAll('#scan .cell').length"), 16)
            self.assertRegex(self.browser.value("document.querySelector('#scan .advice').textContent"), "^Show|^Bend")
            self.wait_for("[...document.querySelectorAll('#scan .cell b')].some((bar) => bar.style.width !== '0%')")

            # After Ctrl-C the lengths are measured. The program ends, and the page keeps the result.
            program.end(signal.SIGINT)
            self.wait_for(f"{text('scan_state')} === 'done' && {text('notice')}.includes('The calibration is done')")
            self.assertEqual(self.browser.value("document.querySelectorAll('#scan tr').length"), 17)
            self.assertTrue(pathlib.Path(folder, "hand.json").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
