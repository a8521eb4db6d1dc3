"""A study that ran: its page says what results.json, table.tex and timings.json say."""
import re

from page import PageTest, number_of

# $24.1 \pm 0.3$, bold or not; the interval may lack.
CELL = re.compile(r"(-?[\d.]+)")


class Study(PageTest):
    place = "study"
    height = 4000  # all images in view at once

    def latex(self):
        """Of each variant the numbers of its row, as they are written."""
        rows = {}
        for line in (self.expected.folder / "table.tex").read_text().splitlines():
            cells = line.split("\\\\")[0].split(" & ")
            name = cells[0].replace("\\texttt{", "").replace("}", "").replace("\\", "").strip()
            if name in self.expected.variants:
                rows[name] = [CELL.findall(cell)[0] for cell in cells[1:]]
        return rows

    def test_numbers_agree_wherever_they_stand(self):
        metrics = [m["name"] for m in self.expected.results["metrics"]]
        latex = self.latex()
        self.assertEqual(list(latex), self.expected.variants)
        shown = self.js("""return [...document.querySelectorAll('#summary tbody tr')].map((row) => [row.dataset.key,
            [...row.querySelectorAll('.number')].map((n) => n.textContent)])""")
        self.assertEqual([name for name, _ in shown], self.expected.variants)
        for name, texts in shown:
            values = [self.expected.summary[name, "room", m]["mean"] for m in metrics] + [self.expected.costs[name]]
            self.assertEqual(len(texts), len(values))
            self.assertEqual(len(latex[name]), len(values))
            for text, written, value in zip(texts, latex[name], values):
                self.assert_shows(text, value)
                number, slack = number_of(written)
                self.assertLessEqual(abs(number - value), slack, f"{name}: {written} in table.tex")

    def test_shows_images_maps_and_graphs(self):
        images = self.expected.results["images"]
        self.assertEqual({i["kind"] for i in images}, {"output", "input", "reference", "map"})
        self.js("""for (const [id, value] of [['pixel-x', 20], ['pixel-y', 30]]) {
              const input = document.getElementById(id);
              input.value = value;
              input.dispatchEvent(new Event('input'));
            }""")
        read = lambda: dict(self.js("""return [...document.querySelectorAll('#images figure:not([hidden])')].map(
            (f) => [f.dataset.subject, f.querySelector('.value').textContent])"""))
        outputs = [f"image:{v}" for v in self.expected.variants]
        self.assertEqual(list(read()), ["input:", *outputs, "reference:"])
        self.assertTrue(all(len(text.split()) == 3 for text in read().values()), read())
        self.assertEqual(read()["image:unfiltered"], read()["input:"])
        self.assertNotEqual(read()["image:base"], read()["image:faster"])
        for metric in {i["metric"] for i in images if i["kind"] == "map"}:
            self.choose("images", "Show", metric)
            self.wait(lambda: metric in self.js("return document.querySelector('#images').dataset.shown"))
            self.assertEqual(list(read()), outputs)
            self.assertTrue(all(len(text.split()) == 1 for text in read().values()), read())
        marked = {}
        for details, name in zip(self.all("#variants > details"), self.expected.variants):
            self.js("arguments[0].open = true", details)
            self.wait(lambda: self.js("return arguments[0].querySelector('.drawing') !== null", details))
            marked[name] = self.js("""return [...arguments[0].querySelector('.drawing').shadowRoot.querySelectorAll(
                '.changed')].map((g) => g.querySelector('text').textContent)""", details)
        self.assertEqual(marked["base"], [])
        self.assertIn("blend", marked["faster"])
        self.assertEqual(self.browser.said(), [])
        self.assertEqual(self.browser.asked(), [self.address])
