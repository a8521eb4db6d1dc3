"""Results unlike most: no images, nothing timed, odd numbers and odd names; and many variants over many frames."""
import json
import re
import tempfile
from pathlib import Path

from selenium.webdriver.common.keys import Keys

from page import PageTest

NAMES = ["base", "größe=½ 雪/山", "\"it's\" </script> &amp;", "long_" * 20, "%41#1"]
METRICS = [
    {"name": "signed", "title": "MSE, unbiased", "better": "lower", "unit": "", "perfect": 0},
    {"name": "tiny", "better": "lower", "unit": "", "perfect": 0},
    {"name": "huge", "title": "Huge", "better": "higher", "unit": "cd", "perfect": None},
]
# Of each metric the variants' means; None where no frame had a number.
MEANS = {"signed": [-0.00123456, 0.002, 0, None, -0.5], "tiny": [1.2345e-12, 0, None, 6e-8, 0.00012344],
         "huge": [2.5e30, 999999.4, 12345.678, -3e9, None]}


def results(names, metrics, means, frames):
    """Those of one sequence; each frame has the mean."""
    rows, summary = [], []
    for v, name in enumerate(names):
        for metric in metrics:
            mean = means[metric["name"]][v]
            rows += [{"variant": name, "sequence": "<i>room", "seed": None, "frame": f, "metric": metric["name"],
                      "value": mean} for f in frames]
            numbers = dict.fromkeys(("mean", "median", "p95", "low", "high", "difference", "difference_low",
                                     "difference_high"), mean)
            summary.append({"variant": name, "sequence": "<i>room", "metric": metric["name"],
                            "frames": 0 if mean is None else len(frames), **numbers})
    return {"quell_results": 1, "name": "Odd & <b>bold</b>", "about": None, "quell": "0.1.0", "simd": "scalar",
            "warm_up": 0, "metrics": metrics,
            "variants": [{"name": n, "about": n, "baseline": False, "edits": {}, "command": f"quell run '{n}'",
                          "nodes": 3, "own_nodes": 0} for n in names],
            "sequences": [{"name": "<i>room", "path": "room", "size": [4, 3], "frames": frames, "seeds": []}],
            "images": [], "summary": summary, "rows": rows}


class Odd(PageTest):
    def show(self, results, timings=None):
        """The page, of other results."""
        text = (self.expected.folder / "report.html").read_text()
        for name, value in (("results", results), ("timings", timings), ("parts", {"images": [], "graphs": []})):
            # As the writer has it: < stands in texts only.
            text = re.sub(f'(<script type="[^"]*" id="{name}">).*?(</script>)', lambda m: m[1] + json.dumps(value).replace(
                "<", "\\u003c") + m[2], text, count=1, flags=re.DOTALL)
        text = re.sub('<script type="text/plain".*?</script>\n', "", text, flags=re.DOTALL)
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "report.html"
            page.write_text(text)
            self.open(page.as_uri())

    def tearDown(self):
        self.assertEqual(self.browser.said(), [])

    def test_numbers_and_names_of_any_kind(self):
        self.browser.look(390, 844, "light")
        self.show(results(NAMES, METRICS, MEANS, [7]))
        self.assertEqual(self.find("h1").text, "Odd & <b>bold</b>")
        self.assertIn("carries no images", self.find("#images").text)
        self.assertIn("Nothing was timed", self.find("#pareto").text)
        shown = self.js("""return [...document.querySelectorAll('#summary tbody tr')].map((row) => [row.cells[0].textContent,
            ...[...row.querySelectorAll('.number')].map((n) => n.textContent)])""")
        self.assertEqual(shown, [
            [NAMES[0], "-0.001235", "1.235e-12", "2.500e+30"],
            [NAMES[1], "0.002000", "0", "999999"],
            [NAMES[2], "0", "–", "12346"],
            [NAMES[3], "–", "6.000e-8", "-3.000e+9"],
            [NAMES[4], "-0.5000", "0.0001234", "–"],
        ])
        # A share of what may be negative says nothing.
        changes = self.js("""return [...document.querySelectorAll('#summary tbody tr')].map((row) => [...row.cells].map(
            (cell) => cell.querySelector('.change')?.textContent ?? null))""")
        self.assertEqual([row[1] for row in changes], [None, "+0.003235", "+0.001235", None, "−0.4988"])
        self.assertEqual([row[2] for row in changes], [None, "−100 %", None, "×48603", "×9.999e+7"])
        for column, order in ((1, [4, 0, 2, 1, 3]), (3, [0, 1, 2, 3, 4])):
            for _ in "there", "back":
                self.js("document.querySelectorAll('#summary thead button')[arguments[0]].click()", column)
                keys = self.js("return [...document.querySelectorAll('#summary tbody tr')].map((r) => r.dataset.key)")
                self.assertEqual(keys, [NAMES[i] for i in order])
                order = order[-2::-1] + order[-1:]  # without a number: last either way
        self.assertEqual(self.js("return document.documentElement.scrollWidth"), 390)
        # Each name leads to its variant, also one that looks like an escape.
        for place, name in enumerate(NAMES):
            link = self.js("return [...document.querySelectorAll('#summary a')].find((a) => a.textContent === arguments[0])",
                           name)
            self.js("arguments[0].click()", link)
            self.wait(lambda: self.js("return document.querySelectorAll('#variants > details')[arguments[0]].open", place))
        self.assertEqual(self.find("#variants details:nth-of-type(3) code").text, f"quell run '{NAMES[2]}'")

    def test_one_frame_is_a_dot_and_many_are_lines(self):
        self.show(results(NAMES, METRICS, MEANS, [7]))
        self.choose("plots", "Metric", "huge")
        dots = self.js("return [...document.querySelectorAll('#frames-plot circle:not(.cursor)')].map((c) => c.dataset.value)")
        self.assertEqual([float(d) for d in dots], MEANS["huge"][:-1])
        frames = list(range(0, 3000, 2))
        many = results([f"alpha={i}" for i in range(90)], METRICS[:1], {"signed": [i / 90 for i in range(90)]}, frames)
        self.show(many, {"variants": [{"name": v["name"], "cost_ms": 1 + i} for i, v in enumerate(many["variants"])]})
        self.assertEqual(len(self.js("return document.querySelector('#frames-plot .series path').getAttribute('d')")
                             .split("L")), len(frames))
        self.assertEqual(self.all("#frames-plot .series circle"), [])
        # What is read out changes without the lines being drawn again.
        self.js("document.querySelector('#frames-plot .series').dataset.same = 'yes'")
        self.find("#frames-plot").send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.assertEqual(self.find("#plots .readout").text, "Frame 2")
        self.assertEqual(len(self.all("#frames-plot .series[data-same]")), 1)
        # A long table has its head in view wherever one is in it.
        region = self.find("#summary .scroll")
        top = self.js("""arguments[0].scrollTo(0, 2000);
            return document.querySelector('#summary thead th').getBoundingClientRect().top
                - arguments[0].getBoundingClientRect().top""", region)
        self.assertLess(abs(top), 3)
        self.assertLess(self.js("return document.querySelector('#plots .legend').clientHeight"), 300)
