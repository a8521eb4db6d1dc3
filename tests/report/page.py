"""The report in a browser, and what it must show."""
import atexit
import json
import math
import os
import struct
import time
import unittest
from functools import cached_property
from pathlib import Path

from selenium.webdriver.common.by import By

from browser import Browser


class Expected:
    """What make_report left beside the report."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.results = json.loads((self.folder / "results.json").read_text())
        self.timings = json.loads((self.folder / "timings.json").read_text())
        self.variants = [v["name"] for v in self.results["variants"]]
        self.metrics = {m["name"]: m for m in self.results["metrics"]}
        self.sequences = {s["name"]: s for s in self.results["sequences"]}
        self.summary = {(s["variant"], s["sequence"], s["metric"]): s for s in self.results["summary"]}
        self.costs = {v["name"]: v["cost_ms"] for v in self.timings["variants"]}

    def mean_of_seeds(self, variant, sequence, metric, frame):
        values = [r["value"] for r in self.results["rows"]
                  if (r["variant"], r["sequence"], r["metric"], r["frame"]) == (variant, sequence, metric, frame)
                  and r["value"] is not None]
        return sum(values) / len(values) if values else None

    @cached_property
    def images(self):
        """By subject as the page names it, sequence and frame: (width, height, planes of halves as numbers)."""
        raw = (self.folder / "images.bin").read_bytes()
        images = {}
        for i in json.loads((self.folder / "images.json").read_text()):
            size = i["width"] * i["height"] * i["planes"]
            # e: IEEE 754 binary16, decoded by Python itself.
            values = struct.unpack_from(f"<{size}e", raw, i["offset"])
            subject = ("image:", "reference:", "input:", "map:")[i["kind"]] + i["variant"]
            images[subject, i["sequence"], i["frame"]] = Image(i["width"], i["height"], i["planes"], values)
        return images


class Image:
    def __init__(self, width, height, planes, values):
        self.width, self.height, self.planes, self.values = width, height, planes, values

    def at(self, x, y):
        return [self.values[(p * self.height + y) * self.width + x] for p in range(self.planes)]


def srgb_byte(linear):
    linear = min(1.0, max(0.0, linear))
    encoded = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    return math.floor(255 * encoded + 0.5)


def number_of(text):
    """A number as the page writes it, and how far off rounding may have moved it."""
    text = text.replace("−", "-")
    digits = text.split("e")[0]
    last = 10.0 ** -len(digits.partition(".")[2])
    exponent = int(text.split("e")[1]) if "e" in text else 0
    return float(text), 0.5000001 * last * 10.0 ** exponent


class PageTest(unittest.TestCase):
    """One browser for all tests, as it starts slowly; each begins with a fresh page on the screen of its class."""

    browser = None

    width, height, scheme, touch = 1280, 900, "light", False
    place = ""  # of the report, in the folder that is tested

    @classmethod
    def setUpClass(cls):
        cls.expected = Expected(os.path.join(os.environ["QUELL_TEST_REPORT"], cls.place))
        if not PageTest.browser:
            PageTest.browser = Browser()
            atexit.register(PageTest.browser.close)
        cls.driver = cls.browser.driver

    def setUp(self):
        self.browser.look(self.width, self.height, self.scheme, self.touch)
        self.open()

    def open(self, address=None):
        self.address = address or (self.expected.folder / "report.html").as_uri()
        self.driver.get("about:blank")
        self.browser.said(), self.browser.asked()
        self.driver.get(self.address)
        self.wait(lambda: self.js("""const images = document.getElementById('images');
            return document.documentElement.dataset.ready && (images.dataset.shown || !images.querySelector('canvas'))"""))
        self.js("document.documentElement.style.scrollBehavior = 'auto'")

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def wait(self, true, seconds=60):
        end = time.monotonic() + seconds
        while not true():
            if time.monotonic() > end:
                self.fail("what was waited for did not come")
            time.sleep(0.02)

    def choose(self, section, label, value):
        """Takes an option of the select with this label."""
        self.js("""const field = [...document.querySelectorAll(`#${arguments[0]} label`)].find(
            (l) => l.querySelector('select') && l.firstChild.textContent === arguments[1]);
            const select = field.querySelector('select');
            select.value = arguments[2];
            if (select.value !== arguments[2]) throw new Error('no option ' + arguments[2]);
            select.dispatchEvent(new Event('change'));""", section, label, value)

    def assert_shows(self, text, value):
        """That this text is the value, rounded to at least four digits."""
        if value == 0:
            self.assertEqual(text, "0")
            return
        shown, slack = number_of(text)
        self.assertLessEqual(abs(shown - value), slack, f"{text} is not {value}")
        self.assertLessEqual(slack, abs(value) * 5.1e-4, f"{text} has too few digits of {value}")
