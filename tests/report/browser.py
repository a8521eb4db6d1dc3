"""A headless Chromium for tests of pages from files, with all that it said and asked for."""
import json
import shutil
import sys
import tempfile

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
except ImportError:
    webdriver = None

SKIPPED = 77  # what ctest takes as skipped


def require():
    """Ends the program as skipped, saying why, where there is no browser to test in."""
    missing = [name for name in ("chromium", "chromedriver") if not shutil.which(name)]
    if webdriver is None:
        missing.append("selenium")
    if missing:
        print(f"skipped: no {', '.join(missing)}; apt-get install chromium chromium-driver python3-selenium")
        sys.exit(SKIPPED)


class Browser:
    """One window; `driver` is Selenium's. What is on its screen is for look() to say."""

    def __init__(self):
        self.profile = tempfile.TemporaryDirectory(prefix="quell_report_")
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for argument in ("--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--hide-scrollbars",
                         "--disable-background-networking", "--disable-component-update", "--disable-sync",
                         "--disable-dev-shm-usage", f"--user-data-dir={self.profile.name}"):
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.driver.set_script_timeout(240)
        # What the browser's own first page asks for is not the report's doing.
        self.driver.get("about:blank")
        self.asked()

    def look(self, width, height, scheme, touch=False):
        """A screen of this size in CSS pixels, light or dark; one that is touched has two dots a pixel."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 2 if touch else 1,
                                     "mobile": width < 600})
        self.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": touch, "maxTouchPoints": 5})
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                    {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def touch(self, kind, *points):
        """touchStart, touchMove, touchEnd or touchCancel: all fingers that are down, as places in CSS pixels."""
        self.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {
            "type": kind, "touchPoints": [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]})

    def press(self, key, code):
        """A key on its way through the window: it goes to whatever has the focus."""
        for kind in ("rawKeyDown", "keyUp"):
            self.driver.execute_cdp_cmd("Input.dispatchKeyEvent", {"type": kind, "key": key, "code": key,
                                                                   "windowsVirtualKeyCode": code})

    def said(self):
        """Messages on the console, errors and refusals among them, since the last call."""
        return [entry["message"] for entry in self.driver.get_log("browser")]

    def asked(self):
        """Addresses that were requested since the last call."""
        events = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [e["params"]["request"]["url"] for e in events if e["method"] == "Network.requestWillBeSent"]

    def close(self):
        self.driver.quit()
        self.profile.cleanup()
