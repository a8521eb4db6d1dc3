"""A phone: one finger scrolls or pans, two pinch, and the sliders and plots follow a finger."""
import time

from viewer import ViewerTest


class Touch(ViewerTest):
    width, height, touch = 390, 844, True

    def setUp(self):
        super().setUp()
        self.frame = self.take("room", 3)
        self.size = self.expected.sequences["room"]["size"]

    def box(self, selector):
        """Left, top, width and height of an element that is brought to the middle of the screen."""
        return self.js("""const e = document.querySelector(arguments[0]);
            e.scrollIntoView({ block: 'center' });
            const r = e.getBoundingClientRect();
            return [r.x, r.y, r.width, r.height]""", selector)

    def at(self, box, u, v):
        return box[0] + u * box[2], box[1] + v * box[3]

    def move(self, *paths):
        """Fingers that go down one after the other, move together, each from its first place to its second, and lift."""
        for i in range(len(paths)):
            self.browser.touch("touchStart", *(a for a, _ in paths[:i + 1]))
        for step in range(1, 9):
            self.browser.touch("touchMove", *((a[0] + (b[0] - a[0]) * step / 8, a[1] + (b[1] - a[1]) * step / 8)
                                              for a, b in paths))
        # Held before they lift, so that nothing goes on by itself.
        time.sleep(0.1)
        self.browser.touch("touchMove", *((b[0], b[1] + 0.5) for _, b in paths))
        self.browser.touch("touchEnd")

    def tap(self, place):
        self.browser.touch("touchStart", place)
        self.browser.touch("touchEnd")

    def state(self):
        """Zoom, divider and the pixel that is read out."""
        return self.js("""return [document.querySelector('.zoom output').textContent,
            document.querySelector('.divider').getAttribute('aria-valuenow'),
            ...['x', 'y'].map((k) => document.getElementById(`pixel-${k}`).value)]""")

    def scrolled(self):
        return self.js("return Math.round(scrollY)")

    def assert_scrolls(self, box, u, v, far=200):
        """That a finger from this place up scrolls the page and does nothing else."""
        before, state, place = self.scrolled(), self.state(), self.at(box, u, v)
        self.move((place, (place[0], place[1] - far)))
        at = [before]
        self.wait(lambda: at.append(self.scrolled()) or at[-1] == at[-2] > before + far / 2)
        self.assertEqual(self.state(), state)

    def test_one_finger_scrolls_until_there_is_something_to_pan(self):
        for selector in (".stage canvas", "figure[data-subject='image:gaussian'] canvas"):
            self.assert_scrolls(self.box(selector), 0.3, 0.9)
        box = self.box(".stage canvas")
        self.move((self.at(box, 0.3, 0.5), self.at(box, 0.1, 0.5)), (self.at(box, 0.4, 0.5), self.at(box, 0.8, 0.5)))
        self.assertEqual(self.state()[0], "×7.0")
        before = self.scrolled()
        self.move((self.at(box, 0.3, 0.9), self.at(box, 0.3, 0.2)))
        self.assertEqual(self.scrolled(), before)
        # Beside the image and on the handle it still scrolls.
        self.assert_scrolls(box, 0.5, 0.9)
        self.assert_scrolls(self.box("figure[data-subject='image:gaussian'] figcaption"), 0.5, 0.5)

    def test_two_fingers_hold_what_is_under_them_in_every_image(self):
        box = self.box(".stage canvas")
        # Aslant, so that what is wide and what is high must be scaled alike; the second finger on the divider.
        a, b = ((0.3, 0.4), (0.2, 0.2)), ((0.5, 0.6), (0.7, 0.9))
        self.move(*((self.at(box, *p), self.at(box, *q)) for p, q in (a, b)))
        apart = [((p[0][0] - q[0][0]) * box[2], (p[0][1] - q[0][1]) * box[3]) for p, q in
                 [((a[0],), (b[0],)), ((a[1],), (b[1],))]]
        zoom = (apart[1][0] ** 2 + apart[1][1] ** 2) ** 0.5 / (apart[0][0] ** 2 + apart[0][1] ** 2) ** 0.5
        middle = [[(p + q) / 2 for p, q in zip(a[i], b[i])] for i in (0, 1)]
        x, y = (p - (q - 0.5) / zoom for p, q in zip(*middle))
        self.assertEqual(self.state(), [f"×{zoom:.1f}", "50", "", ""])
        for pane in (".stage canvas", "figure[data-subject='input:'] canvas", "figure[data-subject='image:gaussian'] canvas"):
            self.box(pane)
            self.wait(lambda: self.js("return document.querySelector(arguments[0]).width > 300", pane))
            self.assert_shows_part(pane, zoom, x, y)
        # One finger carries what it touched, on any image; two bring all back.
        box = self.box("figure[data-subject='image:gaussian'] canvas")
        self.move((self.at(box, 0.6, 0.6), self.at(box, 0.4, 0.5)))
        x, y = x + 0.2 / zoom, y + 0.1 / zoom
        self.assert_shows_part("figure[data-subject='image:gaussian'] canvas", zoom, x, y)
        self.move((self.at(box, 0.1, 0.5), self.at(box, 0.45, 0.5)), (self.at(box, 0.9, 0.5), self.at(box, 0.55, 0.5)))
        self.assert_shows_part("figure[data-subject='image:gaussian'] canvas", 1, 0.5, 0.5)

    def test_a_tap_reads_a_pixel(self):
        self.assertEqual(self.state()[2:], ["", ""])
        box = self.box(".stage canvas")
        self.tap(self.at(box, 20.5 / self.size[0], 9.5 / self.size[1]))
        self.assertEqual(self.state()[2:], ["20", "9"])
        self.assert_scrolls(box, 0.8, 0.8)

    def test_divider_follows_a_finger(self):
        box, handle = self.box(".stage canvas"), self.box(".divider")
        # Taken at its edge it does not jump.
        start = self.at(handle, 0.9, 0.3)
        self.move((start, (start[0] + 0.3 * box[2], start[1])))
        self.assertEqual(self.state(), ["×1.0", "80", "", ""])
        self.assert_scrolls(self.box(".divider"), 0.5, 0.5)

    def test_a_touch_that_the_system_takes_away_leaves_nothing_behind(self):
        box = self.box(".stage canvas")
        self.browser.touch("touchStart", self.at(box, 0.3, 0.5), self.at(box, 0.7, 0.5))
        self.browser.touch("touchCancel")
        self.assert_scrolls(self.box(".stage canvas"), 0.3, 0.9)

    def test_plots_are_read_by_tapping_and_by_drawing_a_finger_along(self):
        frames = self.expected.sequences["room"]["frames"]
        box = self.box("#frames-plot")
        at = self.js("""const r = document.querySelector('#frames-plot').getBoundingClientRect();
            return [...document.querySelectorAll('#frames-plot .series')][0].querySelectorAll('circle').values().map(
                (c) => r.x + Number(c.getAttribute('cx'))).toArray()""")
        read = lambda: self.find("#plots .readout").text
        self.tap((at[3], box[1] + 60))
        self.wait(lambda: read() == f"Frame {frames[3]}")
        self.move(((at[3], box[1] + 60), (at[12], box[1] + 70)))
        self.wait(lambda: read() == f"Frame {frames[12]}")
        self.assert_scrolls(box, 0.5, 0.8)
        box = self.box("#pareto-plot")
        x, y = self.js("""const c = document.querySelector(".point[data-variant='gaussian'] circle");
            return [Number(c.getAttribute('cx')), Number(c.getAttribute('cy'))]""")
        self.tap((box[0] + x + 3, box[1] + y - 3))
        self.wait(lambda: self.find("#pareto .readout").text.startswith("gaussian: "))

    def test_fits_a_phone_and_says_what_fingers_do(self):
        self.assertIn("Two fingers", self.find("#steering").text)
        self.assertNotIn("wheel", self.find("#steering").text)
        small = self.js("""return [...document.querySelectorAll('button, select, input')].filter((e) => e.checkVisibility()
            && e.getBoundingClientRect().height < 32 && e.type !== 'checkbox').map((e) => e.outerHTML.slice(0, 120))""")
        self.assertEqual(small, [])
        # What is turned while one looks at images stays in sight, and leaves room for them.
        self.box("figure[data-subject='image:gaussian']")
        time.sleep(0.1)
        for control in ("#frame", "#exposure", ".zoom button"):
            top, bottom = self.js("""const r = document.querySelector(arguments[0]).getBoundingClientRect();
                return [r.top, r.bottom]""", control)
            self.assertTrue(0 <= top and bottom <= 140, f"{control} from {top} to {bottom}")
        # Held sideways, an image leaves room to scroll beside it.
        self.browser.look(844, 390, "light", True)
        self.assertLess(self.box(".stage")[3], 300)
        self.assertEqual(self.js("return document.documentElement.scrollWidth"), 844)
        self.browser.look(390, 844, "light", True)
