"""Tables and plots show what results.json says."""
import math

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from page import PageTest

COLUMNS = ("relmse", "psnr_unbiased", "flicker")


class Tables(PageTest):
    def rows(self, table="#summary"):
        return self.js("""return [...document.querySelectorAll(arguments[0] + ' tbody tr')].map((row) => ({
            key: row.dataset.key, cells: [...row.cells].map((cell) => ({ text: cell.textContent,
            value: cell.dataset.value, number: cell.querySelector('.number')?.textContent ?? null,
            interval: cell.querySelector('.interval')?.textContent ?? null,
            change: cell.querySelector('.change')?.textContent ?? null,
            kind: cell.querySelector('.change')?.className.split(' ')[1] ?? null,
            best: cell.classList.contains('best') && Boolean(cell.querySelector('.star')) })) }))""", table)

    def test_numbers_are_those_of_the_results(self):
        for sequence in (None, *self.expected.sequences):
            self.choose("tables", "Sequence", sequence or "")
            for statistic in ("median", "p95", "mean"):
                self.choose("tables", "Statistic", statistic)
                rows = self.rows()
                self.assertEqual([r["key"] for r in rows], self.expected.variants)
                for row in rows:
                    self.assertEqual(row["cells"][0]["text"], row["key"])
                    for i, metric in enumerate(COLUMNS, 1):
                        summary = self.expected.summary[row["key"], sequence, metric]
                        self.assert_shows(row["cells"][i]["number"], summary[statistic])
                        if statistic == "mean":
                            low, high = row["cells"][i]["interval"].split(" … ")
                            self.assert_shows(low, summary["low"])
                            self.assert_shows(high, summary["high"])
                    self.assert_shows(row["cells"][4]["number"], self.expected.costs[row["key"]])

    def test_best_is_marked(self):
        for sequence in (None, *self.expected.sequences):
            self.choose("tables", "Sequence", sequence or "")
            for i, metric in enumerate(COLUMNS, 1):
                means = {v: self.expected.summary[v, sequence, metric]["mean"] for v in self.expected.variants}
                pick = max if self.expected.metrics[metric]["better"] == "higher" else min
                marked = [r["key"] for r in self.rows() if r["cells"][i]["best"]]
                self.assertEqual(marked, [pick(means, key=means.get)])

    def test_changes_are_against_the_chosen_variant(self):
        self.choose("tables", "Compared with", "gaussian")
        for row in self.rows():
            mean = {m: self.expected.summary[row["key"], None, m]["mean"] for m in COLUMNS}
            base = {m: self.expected.summary["gaussian", None, m]["mean"] for m in COLUMNS}
            if row["key"] == "gaussian":
                self.assertIsNone(row["cells"][1]["change"])
                continue
            percent = float(row["cells"][1]["change"].replace("−", "-").removesuffix(" %"))
            self.assertAlmostEqual(percent, 100 * (mean["relmse"] / base["relmse"] - 1), delta=0.51)
            decibels = float(row["cells"][2]["change"].replace("−", "-").removesuffix(" dB"))
            self.assertAlmostEqual(decibels, mean["psnr_unbiased"] - base["psnr_unbiased"], delta=0.0051)

    def test_changes_tell_gain_from_loss_and_both_from_chance(self):
        seen = set()
        for row in self.rows()[1:]:
            for i, metric in enumerate(COLUMNS, 1):
                summary = self.expected.summary[row["key"], None, metric]
                sign = 1 if self.expected.metrics[metric]["better"] == "higher" else -1
                chance = summary["difference_low"] <= 0 <= summary["difference_high"]
                kind = "same" if chance else "gain" if sign * summary["difference"] > 0 else "loss"
                self.assertEqual(row["cells"][i]["kind"], kind, f"{metric} of {row['key']}")
                seen.add(kind)
        self.assertEqual(seen, {"same", "gain", "loss"})
        # Against any other variant there is only that one's own interval.
        self.choose("tables", "Compared with", "first_level")
        base = self.expected.summary["first_level", None, "relmse"]
        for row in self.rows():
            if row["key"] != "first_level":
                mean = self.expected.summary[row["key"], None, "relmse"]["mean"]
                kind = "same" if base["low"] <= mean <= base["high"] else "gain" if mean < base["mean"] else "loss"
                self.assertEqual(row["cells"][1]["kind"], kind, row["key"])

    def head(self, column, table="#summary"):
        return self.find(f"{table} th[data-column='{column}']")

    def test_sorts_by_click(self):
        means = {v: self.expected.summary[v, None, "psnr_unbiased"]["mean"] for v in self.expected.variants}
        best_first = sorted(means, key=means.get, reverse=True)
        button = self.head("psnr_unbiased").find_element(By.CSS_SELECTOR, "button")
        button.click()
        self.assertEqual(self.head("psnr_unbiased").get_attribute("aria-sort"), "descending")
        self.assertEqual([r["key"] for r in self.rows()], best_first)
        button.click()
        self.assertEqual(self.head("psnr_unbiased").get_attribute("aria-sort"), "ascending")
        self.assertEqual([r["key"] for r in self.rows()], best_first[::-1])

    def test_sorts_by_keys_one_column_at_a_time(self):
        self.head("cost_ms").find_element(By.CSS_SELECTOR, "button").send_keys(Keys.ENTER)
        self.assertEqual([r["key"] for r in self.rows()], sorted(self.expected.costs, key=self.expected.costs.get))
        self.head("variant").find_element(By.CSS_SELECTOR, "button").send_keys(Keys.SPACE)
        self.assertEqual([r["key"] for r in self.rows()][:3], ["a<b & \"c\"", "alpha_0.05", "alpha_0.5"])
        self.assertEqual(len(self.all("#summary th[aria-sort]")), 1)

    def test_a_metric_by_sequence(self):
        self.choose("tables", "Metric", "flicker")
        for row in self.rows("#by-sequence"):
            for cell, sequence in zip(row["cells"][1:], self.expected.sequences):
                self.assert_shows(cell["number"], self.expected.summary[row["key"], sequence, "flicker"]["mean"])
        self.head("room", "#by-sequence").find_element(By.CSS_SELECTOR, "button").click()
        means = {v: self.expected.summary[v, "room", "flicker"]["mean"] for v in self.expected.variants}
        self.assertEqual([r["key"] for r in self.rows("#by-sequence")], sorted(means, key=means.get))


class Plots(PageTest):
    def points(self):
        return self.js("""return [...document.querySelectorAll('#frames-plot .series circle')].map((c) => [
            c.parentNode.dataset.variant, Number(c.dataset.frame), Number(c.dataset.value),
            Number(c.getAttribute('cx')), Number(c.getAttribute('cy'))])""")

    def test_has_the_points(self):
        for sequence, known in self.expected.sequences.items():
            for metric in COLUMNS:
                self.choose("plots", "Sequence", sequence)
                self.choose("plots", "Metric", metric)
                wanted = {(v, f): self.expected.mean_of_seeds(v, sequence, metric, f)
                          for v in self.expected.variants for f in known["frames"]}
                wanted = {key: value for key, value in wanted.items() if value is not None}
                points = self.points()
                self.assertEqual(len(points), len(wanted))
                for variant, frame, value, _, _ in points:
                    self.assertAlmostEqual(value, wanted[variant, frame], delta=1e-12 * abs(value))
                self.assert_on_a_scale([(p[1], p[3]) for p in points], 1)
                log = self.js("return document.querySelector('#plots input[type=checkbox]').checked")
                self.assert_on_a_scale([(math.log(p[2]) if log else p[2], p[4]) for p in points], -1)

    def assert_on_a_scale(self, pairs, sign):
        (low, first), (high, last) = min(pairs), max(pairs)
        slope = (last - first) / (high - low)
        self.assertGreater(sign * slope, 0)
        for value, at in pairs:
            self.assertAlmostEqual(at, first + slope * (value - low), delta=0.2)

    def test_logarithm_can_be_left(self):
        box = self.find("#plots input[type=checkbox]")
        self.assertTrue(box.is_selected())
        box.click()
        self.assert_on_a_scale([(p[2], p[4]) for p in self.points()], -1)

    def test_legend_hides_and_shows_everywhere(self):
        key = self.find("#plots .key[data-variant='no_history']")
        key.click()
        self.assertEqual(key.get_attribute("aria-pressed"), "false")
        self.assertNotIn("no_history", {p[0] for p in self.points()})
        self.assertFalse(self.all("#pareto-plot .point[data-variant='no_history']"))
        self.assertFalse(self.find("#images figure[data-subject='image:no_history']").is_displayed())
        self.find("#pareto .key[data-variant='no_history']").send_keys(Keys.SPACE)
        self.assertIn("no_history", {p[0] for p in self.points()})
        self.assertTrue(self.find("#images figure[data-subject='image:no_history']").is_displayed())

    def test_all_may_be_hidden(self):
        buttons = {b.text: b for b in self.all("#plots .legend .plain")}
        buttons["None"].click()
        self.assertEqual(self.points(), [])
        buttons["All"].click()
        self.assertEqual({p[0] for p in self.points()}, set(self.expected.variants))
        self.assertEqual(self.browser.said(), [])

    def test_keys_read_out_a_frame(self):
        plot = self.find("#frames-plot")
        plot.send_keys(Keys.ARROW_RIGHT)
        plot.send_keys(Keys.ARROW_RIGHT)
        sequence, known = next(iter(self.expected.sequences.items()))
        frame = known["frames"][1]
        self.assertEqual(self.find("#plots .readout").text, f"Frame {frame}")
        for variant in self.expected.variants:
            note = self.js("return document.querySelector(`#plots .key[data-variant='${CSS.escape(arguments[0])}'] .note`)"
                           ".textContent", variant)
            self.assert_shows(note, self.expected.mean_of_seeds(variant, sequence, "relmse", frame))

    def test_escape_lets_go_of_the_frame(self):
        plot = self.find("#frames-plot")
        plot.send_keys(Keys.END)
        self.assertEqual(self.find("#plots .readout").text, f"Frame {self.expected.sequences['room']['frames'][-1]}")
        plot.send_keys(Keys.ESCAPE)
        self.assertIn("arrow keys", self.find("#plots .readout").text)
        notes = "return [...document.querySelectorAll('#plots .key .note')].map((n) => n.textContent).join('')"
        self.assertEqual(self.js(notes), "")

    def test_numbers_stand_beside_the_plot(self):
        self.choose("plots", "Metric", "flicker")
        self.find("#plots details summary").click()
        self.wait(lambda: self.all("#plots details tbody tr"))
        rows = self.js("return [...document.querySelectorAll('#plots details tbody tr')].map("
                       "(r) => [...r.cells].map((c) => c.textContent))")
        sequence, known = next(iter(self.expected.sequences.items()))
        self.assertEqual([int(r[0]) for r in rows], known["frames"])
        for row in rows:
            for variant, text in zip(self.expected.variants, row[1:]):
                value = self.expected.mean_of_seeds(variant, sequence, "flicker", int(row[0]))
                if value is None:
                    self.assertEqual(text, "–")
                else:
                    self.assert_shows(text, value)


class Pareto(PageTest):
    def test_points_and_front(self):
        for metric in COLUMNS:
            self.choose("pareto", "Metric", metric)
            points = {p[0]: p[1:] for p in self.js(
                """return [...document.querySelectorAll('#pareto-plot .point')].map((g) => [g.dataset.variant,
                Number(g.dataset.cost), Number(g.dataset.error), g.classList.contains('best')])""")}
            self.assertEqual(list(sorted(points)), sorted(self.expected.variants))
            sign = -1 if self.expected.metrics[metric]["better"] == "higher" else 1
            place = {}
            for variant, (cost, error, _) in points.items():
                self.assertEqual(cost, self.expected.costs[variant])
                self.assertEqual(error, self.expected.summary[variant, None, metric]["mean"])
                place[variant] = (cost, sign * error)
            for variant, (cost, error) in place.items():
                beaten = any(c <= cost and e <= error and (c, e) != (cost, error) for c, e in place.values())
                self.assertEqual(points[variant][2], not beaten, f"{variant} by {metric}")
            self.assertTrue(self.find("#pareto-plot .front").get_attribute("d"))

    def test_keys_read_out_the_variants_from_cheap_to_dear(self):
        plot, read = self.find("#pareto-plot"), []
        for _ in self.expected.variants:
            plot.send_keys(Keys.ARROW_RIGHT)
            read.append(self.find("#pareto .readout").text)
        cheap = sorted(self.expected.variants, key=self.expected.costs.get)
        self.assertEqual([self.expected.costs[text.split(":")[0]] for text in read],
                         [self.expected.costs[v] for v in cheap])
        name, number = read[-1].split(" in ")[0].split(": ")
        self.assert_shows(number, self.expected.summary[name, None, "relmse"]["mean"])
        plot.send_keys(Keys.ESCAPE)
        self.assertIn("arrow keys", self.find("#pareto .readout").text)
