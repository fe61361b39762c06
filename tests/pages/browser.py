# SPDX-License-Identifier: GPL-2.0-or-later
"""A page in Debian's chromium without a window, driven by selenium, with its console messages and network requests.

Exits with 77, which ctest calls skipped, where chromium or selenium is not installed (tools/setup --tests installs them).
"""
import json
import os
import sys

try:
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
except ImportError:
    print("python3-selenium is not installed")
    sys.exit(77)


class Browser:
    def __init__(self, width=1200, height=900, dark=False):
        for program, package in (("chromedriver", "chromium-driver"), ("chromium", "chromium")):
            if not os.path.exists("/usr/bin/" + program):
                print(package, "is not installed")
                sys.exit(77)
        options = Options()
        for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"):
            options.add_argument(argument)
        options.binary_location = "/usr/bin/chromium"
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.set_script_timeout(60)
        self.resize(width, height)
        self.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.errors, self.requests = [], []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def command(self, name, **arguments):
        return self.driver.execute_cdp_cmd(name, arguments)

    def resize(self, width, height):
        self.command("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 600)

    def open(self, path):
        self.driver.get("file://" + os.path.abspath(path))
        self.rest()

    def run(self, script, *arguments):
        """The value of a JavaScript function's body, which may await."""
        body = "const done = arguments[arguments.length - 1]; const given = [...arguments];" \
               "(async () => {" + script + "})().then(done, (error) => done({failed: String(error && error.stack)}));"
        value = self.driver.execute_async_script(body, *arguments)
        if isinstance(value, dict) and "failed" in value:
            raise AssertionError(value["failed"])
        return value

    def rest(self):
        """Waits until the page is painted in full after a movement: the machine may be busy."""
        self.run("const q = window.qmorph, views = q ? (q.view ? [q.view] : Object.values(q.panes).map((pane) => pane.view)) : [];"
                 "do await new Promise((resolve) => setTimeout(resolve, 50)); while (!views.every((view) => view.settled));")

    def click(self, x, y):
        """At a place of the window."""
        for kind in ("mousePressed", "mouseReleased"):
            self.command("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def drag(self, x, y, dx, dy, button="left", modifiers=0):
        """Modifiers: 8 for shift."""
        held = {"left": 1, "right": 2}[button]
        event = lambda kind, step, **more: self.command("Input.dispatchMouseEvent", type=kind, x=x + step * dx, y=y + step * dy, button=button,
                                                        modifiers=modifiers, **more)
        event("mousePressed", 0, clickCount=1)
        for step in (0.5, 1):
            event("mouseMoved", step, buttons=held)
        event("mouseReleased", 1, clickCount=1)

    def wheel(self, x, y, delta):
        self.command("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=delta)

    def key(self, key, code=0):
        text = {"text": key} if len(key) == 1 else {}
        self.command("Input.dispatchKeyEvent", type="keyDown", key=key, windowsVirtualKeyCode=code, **text)
        self.command("Input.dispatchKeyEvent", type="keyUp", key=key, windowsVirtualKeyCode=code)

    def pixel(self, canvas, x, y):
        """Of a canvas, by its id, at a place in CSS pixels."""
        return self.run("const c = document.getElementById(given[0]), k = c.width / c.clientWidth;"
                        "return [...c.getContext('2d').getImageData(Math.floor(given[1] * k), Math.floor(given[2] * k), 1, 1).data].slice(0, 3);",
                        canvas, x, y)

    def complaints(self):
        """Errors on the console, and addresses that were asked for besides the page itself."""
        self.errors += [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                url = message["params"]["request"]["url"]
                if not url.startswith("data:"):
                    self.requests.append(url)
        return self.errors, [url for url in self.requests[1:]]


class Checks:
    """Counts the checks that hold, and prints those that do not."""

    def __init__(self):
        self.failed = 0

    def that(self, holds, what):
        print(("ok    " if holds else "FAILS ") + what, flush=True)
        self.failed += not holds

    def status(self):
        return 1 if self.failed else 0
