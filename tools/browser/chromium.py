"""A headless Chromium that is driven through the DevTools protocol, over two pipes. Needs Debian's package chromium."""
import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

FLAGS = ["--headless", "--no-first-run", "--remote-debugging-pipe", "--disable-gpu", "--disable-dev-shm-usage",
         "--disable-background-networking", "--disable-component-update", "--disable-extensions", "--disable-sync",
         "--no-sandbox",  # which root and most containers lack; only our own pages are opened
         "--mute-audio", "--hide-scrollbars", "--force-color-profile=srgb",
         "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]  # WebGL on the processor

KEY_CODES = {"Escape": 27, "ArrowLeft": 37, "ArrowRight": 39}


class BrowserError(Exception):
    """The browser is missing, has ended, or did not do what was waited for."""


def path_of_chromium():
    path = shutil.which("chromium")
    if path is None:
        raise BrowserError("Chromium is missing: apt-get install chromium")
    return path


class Chromium:
    """A running browser with one page. `problems` holds the errors and warnings on its console, and failed requests."""

    def __init__(self, patience=60):
        program = path_of_chromium()
        self.patience = patience  # longest time to wait for anything [s]
        self.problems, self.counted, self.received = [], 0, b""
        self.profile = tempfile.mkdtemp(prefix="chromium")
        to_browser, self.output = os.pipe()
        self.input, from_browser = os.pipe()
        command = [program, *FLAGS, f"--user-data-dir={self.profile}", "about:blank"]
        self.log = open(os.path.join(self.profile, "log"), "w+b")
        self.process = subprocess.Popen(["sh", "-c", f'exec "$0" "$@" 3<&{to_browser} 4>&{from_browser}', *command],
                                        stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log,
                                        pass_fds=(to_browser, from_browser), start_new_session=True,
                                        env={**os.environ, "HOME": self.profile})
        os.close(to_browser)
        os.close(from_browser)
        self.session = None
        try:
            self.attach()
        except BrowserError:
            self.end()
            raise

    def attach(self):
        """Opens the page to which all further calls go."""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def end(self):
        try:
            self.session = None
            self.call("Browser.close")
            self.process.wait(10)
        except (BrowserError, OSError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        for end in (self.output, self.input):
            os.close(end)
        self.log.close()
        shutil.rmtree(self.profile, ignore_errors=True)

    def call(self, method, **parameters):
        """Calls a method of the protocol and returns its result."""
        self.counted += 1
        message = {"id": self.counted, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        try:
            os.write(self.output, json.dumps(message).encode() + b"\0")
        except BrokenPipeError:
            raise BrowserError(self.last_words()) from None
        deadline = time.monotonic() + self.patience
        while True:
            answer = self.receive(deadline, method)
            if answer.get("id") == self.counted:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def last_words(self):
        self.log.seek(0)
        return "Chromium has ended: " + self.log.read().decode(errors="replace")[-2000:]

    def receive(self, deadline, what):
        """The next message; events that report a problem are kept on the way."""
        while b"\0" not in self.received:
            if not select.select([self.input], [], [], max(0, deadline - time.monotonic()))[0]:
                raise BrowserError(f"{what}: no answer within {self.patience} s")
            piece = os.read(self.input, 1 << 20)
            if not piece:
                raise BrowserError(self.last_words())
            self.received += piece
        text, _, self.received = self.received.partition(b"\0")
        message = json.loads(text)
        self.note(message.get("method"), message.get("params", {}))
        return message

    def note(self, event, about):
        if event == "Runtime.exceptionThrown":
            details = about["exceptionDetails"]
            self.problems.append(details.get("exception", {}).get("description", details["text"]))
        elif event == "Runtime.consoleAPICalled" and about["type"] in ("error", "warning", "assert"):
            self.problems.append(" ".join(str(a.get("value", a.get("description"))) for a in about["args"]))
        elif event == "Log.entryAdded" and about["entry"]["level"] in ("error", "warning"):
            if "GL Driver Message (OpenGL, Performance" in about["entry"]["text"]:
                return  # taking a picture of the page makes it
            self.problems.append(f"{about['entry']['text']} {about['entry'].get('url', '')}")

    def size(self, width, height, phone=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=phone)

    def theme(self, name):
        """`name`: "light" or "dark", what the system asks pages for."""
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": name}])

    def open(self, url):
        self.call("Page.navigate", url=url)

    def value(self, expression):
        """The value of a JavaScript expression in the page; promises are awaited."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise BrowserError(f"{expression}: {result['exceptionDetails']['exception'].get('description')}")
        return result["result"].get("value")

    def wait_for(self, expression):
        """Waits until an expression is true, and returns its value. It may fail while the page is being loaded."""
        deadline, last = time.monotonic() + self.patience, ""
        while time.monotonic() < deadline:
            try:
                found = self.value(f"new Promise((done) => setTimeout(done, 30)).then(() => ({expression}))")
            except BrowserError as error:
                if self.process.poll() is not None:
                    raise
                found, last = None, error
            if found:
                return found
        raise BrowserError(f"not within {self.patience} s: {expression} {last}")

    def key(self, key, shift=False):
        """Presses and releases a key."""
        more = {"text": key} if len(key) == 1 else {"windowsVirtualKeyCode": KEY_CODES[key]}
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, modifiers=8 if shift else 0, **more)

    def picture(self, path=None):
        """The visible page as PNG bytes; also written to `path`."""
        png = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if path:
            with open(path, "wb") as file:
                file.write(png)
        return png
