"""The images: every pixel is right, and sliders, zoom and exposure do what they say."""
import base64

from selenium.webdriver import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.keys import Keys

from page import PageTest, srgb_byte

# The colour that a pane shows at the middle of each of its image's pixels, the whole image being in view.
SAMPLE = """
function sample(canvas, width, height) {
  const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  let out = '';
  for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) {
    const at = 4 * (Math.floor((y + 0.5) * canvas.height / height) * canvas.width + Math.floor((x + 0.5) * canvas.width / width));
    out += String.fromCharCode(data[at], data[at + 1], data[at + 2]);
  }
  return btoa(out);
}
"""
# matplotlib's magma at nine places, straight between.
MAGMA = [(0, 0, 4), (28, 16, 68), (79, 18, 123), (129, 37, 129), (181, 54, 122), (229, 89, 100), (251, 135, 97),
         (254, 194, 135), (252, 253, 191)]


def magma(share):
    at = min(1.0, max(0.0, share)) * 8
    i = min(7, int(at))
    return [a + (b - a) * (at - i) for a, b in zip(MAGMA[i], MAGMA[i + 1])]


class ViewerTest(PageTest):
    def slide(self, element, value):
        """Moves a range and waits until its picture is there."""
        self.js("""const input = document.getElementById(arguments[0]);
            input.value = arguments[1];
            input.dispatchEvent(new Event('input'));""", element, value)
        self.shown()

    def shown(self):
        # Whatever was asked for last bears the state of all controls once it is drawn.
        self.wait(lambda: self.js("""const images = document.getElementById('images');
            const select = (label) => [...images.querySelectorAll('label')].find(
                (l) => l.firstChild.textContent === label).querySelector('select').value;
            const frame = images.querySelector('.slide output').textContent;
            return images.dataset.shown === [select('Sequence'), select('Show'), frame,
                document.getElementById('exposure').value].join(' ')
                && Number(document.getElementById('frame').value) === arguments[0].indexOf(Number(frame));""",
            self.expected.sequences[self.sequence]["frames"]))

    def take(self, sequence, frame_index=0):
        self.sequence = sequence
        self.choose("images", "Sequence", sequence)
        self.slide("frame", frame_index)
        return self.expected.sequences[sequence]["frames"][frame_index]

    def samples(self, width, height):
        """Of each pane in view: bytes of all of its image's pixels."""
        found = self.js(SAMPLE + """return [...document.querySelectorAll('#images figure:not([hidden])')].map(
            (f) => [f.dataset.subject, sample(f.querySelector('canvas'), arguments[0], arguments[1])])""", width, height)
        return {subject: base64.b64decode(text) for subject, text in found}

    def image(self, subject, frame):
        return self.expected.images[subject, self.sequence, frame]

    def wanted(self, image, stops=0.0):
        size = image.width * image.height
        bytes_of = {v: srgb_byte(v * 2.0 ** stops) for v in set(image.values)}
        return bytes(bytes_of[image.values[p * size + i]] for i in range(size) for p in range(3))

    def assert_same(self, got, wanted, slack=0, what=""):
        self.assertEqual(len(got), len(wanted), what)
        worst = max((abs(a - b) for a, b in zip(got, wanted)), default=0)
        self.assertLessEqual(worst, slack, what)


class Decoding(ViewerTest):
    def test_every_image_has_the_right_pixels(self):
        seen = set()
        for sequence, known in self.expected.sequences.items():
            for i, _ in enumerate(known["frames"]):
                frame = self.take(sequence, i)
                for subject, got in self.samples(*known["size"]).items():
                    if (subject, sequence, frame) not in self.expected.images:
                        self.assertEqual(subject, "reference:")
                        self.assertFalse(any(got), "a pane without an image shows another one's")
                        continue
                    seen.add((subject, sequence, frame))
                    # In double the last bit of a power may differ between the browser and Python.
                    self.assert_same(got, self.wanted(self.image(subject, frame)), 1, f"{subject} {sequence} {frame}")
        self.assertEqual(seen, {key for key in self.expected.images if not key[0].startswith("map:")})

    def test_every_error_map_has_the_right_colours(self):
        seen = set()
        for sequence, known in self.expected.sequences.items():
            self.take(sequence)
            self.choose("images", "Show", "relmse")
            maps = [m for (s, q, _), m in self.expected.images.items() if s.startswith("map:") and q == sequence]
            # The middle of what all but a hundredth of each map keep below.
            high = sorted(sorted(m.values)[int((len(m.values) - 1) * 0.99)] for m in maps)[(len(maps) - 1) // 2]
            for i, frame in enumerate(known["frames"]):
                self.slide("frame", i)
                for subject, got in self.samples(*known["size"]).items():
                    subject = subject.replace("image:", "map:")
                    seen.add((subject, sequence, frame))
                    wanted = [c for v in self.image(subject, frame).values for c in magma(v / high)]
                    self.assert_same(got, wanted, 0.51, f"{subject} {sequence} {frame}")
            scale = self.js("return [...document.querySelectorAll('.colour-scale span')].map((s) => s.textContent)")
            self.assertEqual(scale[0], "0")
            self.assert_shows(scale[1].removeprefix("≥ "), high)
            self.choose("images", "Show", "")
        self.assertEqual(seen, {key for key in self.expected.images if key[0].startswith("map:")})

    def test_pixels_are_read_out(self):
        for sequence, known in self.expected.sequences.items():
            frame = self.take(sequence, 6)
            width, height = known["size"]
            # The first row has halves of all exponents and both signs.
            for x, y in [*((x, 0) for x in range(0, width, 3)), (width - 1, height - 1), (3, height // 2)]:
                texts = self.js("""for (const [id, value] of [['pixel-x', arguments[0]], ['pixel-y', arguments[1]]]) {
                      const input = document.getElementById(id);
                      input.value = value;
                      input.dispatchEvent(new Event('input'));
                    }
                    return [...document.querySelectorAll('#images figure')].map(
                        (f) => [f.dataset.subject, f.querySelector('.value').textContent])""", x, y)
                self.assertEqual(len(texts), len(self.expected.variants) + 2)
                for subject, text in texts:
                    values = self.image(subject, frame).at(x, y)
                    shown = text.split()
                    self.assertEqual(len(shown), 3)
                    for part, value in zip(shown, values):
                        self.assert_shows(part, value)


class Controls(ViewerTest):
    def setUp(self):
        super().setUp()
        self.frame = self.take("room", 3)
        self.size = self.expected.sequences["room"]["size"]

    def stage(self):
        return base64.b64decode(self.js(SAMPLE + "return sample(document.querySelector('.stage canvas'), "
                                        "arguments[0], arguments[1])", *self.size))

    def assert_divided_at(self, share):
        """That the stage is the input left of the share and svgf right of it."""
        width, height = self.size
        left, right = (self.wanted(self.image(s, self.frame)) for s in ("input:", "image:svgf"))
        got = self.stage()
        for y in range(height):
            for x in range(width):
                if abs((x + 0.5) / width - share) < 0.03:
                    continue  # under the divider's own line
                wanted = left if (x + 0.5) / width < share else right
                at = 3 * (y * width + x)
                self.assert_same(got[at:at + 3], wanted[at:at + 3], 1, f"at {x}, {y}, divided at {share}")

    def test_divider_is_dragged(self):
        handle, canvas = self.find(".divider"), self.find(".stage canvas")
        self.assertEqual(handle.get_attribute("aria-valuenow"), "50")
        self.assert_divided_at(0.5)
        self.js("document.querySelector('.stage').scrollIntoView({ block: 'center' })")
        move = round(0.3 * canvas.size["width"])
        ActionChains(self.driver).click_and_hold(handle).move_by_offset(move, 0).release().perform()
        self.assertEqual(handle.get_attribute("aria-valuenow"), "80")
        self.assert_divided_at(0.8)
        self.assertEqual(self.find("#pixel-x").get_attribute("value"), "")  # the image under it was not touched

    def test_divider_is_moved_by_keys(self):
        handle = self.find(".divider")
        for key, now in [(Keys.ARROW_LEFT, "48"), (Keys.ARROW_RIGHT, "50"), (Keys.PAGE_UP, "60"), (Keys.HOME, "0"),
                         (Keys.ARROW_LEFT, "0"), (Keys.END, "100"), (Keys.PAGE_DOWN, "90")]:
            handle.send_keys(key)
            self.assertEqual(handle.get_attribute("aria-valuenow"), now)
        self.assert_divided_at(0.9)

    def test_error_maps_stand_beside_each_other(self):
        self.choose("images", "After", "image:gaussian")
        self.choose("images", "Show", "relmse")
        self.shown()
        chosen = "return [...document.querySelectorAll('.stage')].map((s) => [...s.previousSibling.querySelectorAll("\
                 "'select')].map((e) => [e.value, e.options.length]))[0]"
        count = len(self.expected.variants)
        self.assertEqual(self.js(chosen), [["image:svgf", count], ["image:gaussian", count]])
        self.find(".divider").send_keys(Keys.HOME)
        tile = self.samples(*self.size)["image:gaussian"]
        self.assert_same(self.stage()[9:288], tile[9:288])
        self.choose("images", "Show", "")
        self.shown()
        self.assertEqual(self.js(chosen), [["image:svgf", count + 2], ["image:gaussian", count + 2]])

    def test_before_and_after_are_chosen(self):
        self.choose("images", "Before", "reference:")
        self.choose("images", "After", "image:gaussian")
        self.find(".divider").send_keys(Keys.END)
        reference, gaussian = (self.wanted(self.image(s, self.frame)) for s in ("reference:", "image:gaussian"))
        self.wait(lambda: max(abs(a - b) for a, b in zip(self.stage()[:-600], reference)) <= 1)
        self.find(".divider").send_keys(Keys.HOME)
        self.assert_same(self.stage()[9:288], gaussian[9:288], 1)

    def assert_all_show(self, zoom, x, y):
        """That every pane shows the part of its image around (x, y), shares of its size, magnified."""
        shown = self.js("""return [...document.querySelectorAll('#images figure canvas, .stage canvas')].map((canvas) => {
            const context = canvas.getContext('2d'), out = [];
            for (let v = 0.05; v < 1; v += 0.1) for (let u = 0.05; u < 1; u += 0.1) out.push([u, v,
              ...context.getImageData(Math.floor(u * canvas.width), Math.floor(v * canvas.height), 1, 1).data]);
            const figure = canvas.closest('figure');
            return [figure ? figure.dataset.subject : 'stage', canvas.width, canvas.height, out];
          })""")
        self.assertEqual(len(shown), len(self.expected.variants) + 3)
        checked = 0
        for subject, wide, high, points in shown:
            for u, v, *colour in points:
                name = ("input:" if u < 0.5 else "image:svgf") if subject == "stage" else subject
                image = self.image(name, self.frame)
                # The middle of the dot that was read.
                across = (x + ((int(u * wide) + 0.5) / wide - 0.5) / zoom) * image.width
                down = (y + ((int(v * high) + 0.5) / high - 0.5) / zoom) * image.height
                if min(across % 1, 1 - across % 1, down % 1, 1 - down % 1) < 0.02:
                    continue  # on the edge between two pixels
                wanted = [srgb_byte(value) for value in image.at(int(across), int(down))]
                self.assert_same(colour[:3], wanted, 1, f"{subject} at {u}, {v}, zoom {zoom}")
                checked += 1
        self.assertGreater(checked, 900)

    def test_zoom_is_the_same_everywhere(self):
        tile = self.find("#images figure[data-subject='image:gaussian'] canvas")
        self.assert_all_show(1, 0.5, 0.5)
        tile.send_keys("++++")
        self.assertEqual(self.find(".zoom output").text, "×4.0")
        self.assert_all_show(4, 0.5, 0.5)
        tile.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_UP)
        self.assert_all_show(4, 0.55, 0.475)
        self.find(".stage canvas").send_keys("-")
        self.assert_all_show(2 * 2 ** 0.5, 0.55, 0.475)
        tile.send_keys("0")
        self.assert_all_show(1, 0.5, 0.5)

    def test_zoom_buttons(self):
        for label, zoom in [("Zoom in", 2 ** 0.5), ("Zoom in", 2), ("Zoom out", 2 ** 0.5), ("Show the whole image", 1)]:
            self.find(f"button[aria-label='{label}']").click()
            self.assert_all_show(zoom, 0.5, 0.5)

    def test_wheel_zooms_where_a_pane_has_focus_and_scrolls_the_page_elsewhere(self):
        canvas = self.find(".stage canvas")
        self.js("arguments[0].scrollIntoView({ block: 'center' })", canvas)
        before = self.js("return scrollY")
        ActionChains(self.driver).scroll_from_origin(self.origin(canvas), 0, 120).perform()
        self.wait(lambda: self.js("return scrollY") > before)
        self.assertEqual(self.find(".zoom output").text, "×1.0")
        self.js("arguments[0].scrollIntoView({ block: 'center' }); arguments[0].focus()", canvas)
        before = self.js("return scrollY")
        ActionChains(self.driver).scroll_from_origin(self.origin(canvas), 0, -300).perform()
        self.wait(lambda: self.find(".zoom output").text != "×1.0")
        self.assertEqual(self.js("return scrollY"), before)

    def origin(self, canvas):
        return ScrollOrigin.from_element(canvas, x_offset=-200)  # beside the divider

    def test_dragging_pans(self):
        tile = self.find("#images figure[data-subject='image:svgf'] canvas")
        self.js("arguments[0].scrollIntoView({ block: 'center' })", tile)
        tile.send_keys("++++")
        wide = tile.size["width"]
        ActionChains(self.driver).move_to_element_with_offset(tile, 0, 0).click_and_hold().move_by_offset(
            -round(wide / 4), 0).release().perform()
        # The mark of the pixel that was pressed would cover what is compared.
        self.js("document.activeElement.blur()")
        shown = self.js("return document.querySelector('.zoom output').textContent")
        self.assertEqual(shown, "×4.0")
        got = self.js("""const canvas = document.querySelector("figure[data-subject='image:gaussian'] canvas");
            const y = Math.floor(0.9 * canvas.height), context = canvas.getContext('2d');
            return [0.1, 0.3, 0.6, 0.9].map((u) => [u, canvas.width, canvas.height, ...context.getImageData(
              Math.floor(u * canvas.width), y, 1, 1).data])""")
        image = self.image("image:gaussian", self.frame)
        for u, width, height, *colour in got:
            across = (0.5 + round(wide / 4) / wide / 4 + ((int(u * width) + 0.5) / width - 0.5) / 4) * image.width
            down = (0.5 + ((int(0.9 * height) + 0.5) / height - 0.5) / 4) * image.height
            self.assert_same(colour[:3], [srgb_byte(v) for v in image.at(int(across), int(down))], 1, f"at {u}")

    def test_exposure_acts_on_halves(self):
        for stops in (-8, -2.5, 3, 8):
            self.slide("exposure", stops)
            for subject, got in self.samples(*self.size).items():
                self.assert_same(got, self.wanted(self.image(subject, self.frame), stops), 1, f"{subject} at {stops} EV")

    def test_exposure_by_keys(self):
        slider = self.find("#exposure")
        for _ in range(10):
            slider.send_keys(Keys.ARROW_RIGHT)
        self.shown()
        self.assertEqual(slider.get_attribute("value"), "1")
        self.assertIn("+1.0 EV", self.find("#images").text)
        self.assert_same(self.samples(*self.size)["image:svgf"], self.wanted(self.image("image:svgf", self.frame), 1), 1)

    def test_frames_by_keys(self):
        slider = self.find("#frame")
        slider.send_keys(Keys.HOME)
        self.shown()
        slider.send_keys(Keys.ARROW_RIGHT)
        self.shown()
        frame = self.expected.sequences["room"]["frames"][1]
        self.assertEqual(self.find("#images .slide output").text, str(frame))
        self.assert_same(self.samples(*self.size)["image:svgf"], self.wanted(self.image("image:svgf", frame)), 1)

    def test_scrubbing_ends_at_the_last_frame_asked_for(self):
        for i in (0, 9, 4, 15, 2, 12):
            self.js("""const input = document.getElementById('frame');
                input.value = arguments[0];
                input.dispatchEvent(new Event('input'));""", i)
        self.shown()
        frame = self.expected.sequences["room"]["frames"][12]
        self.assert_same(self.samples(*self.size)["image:svgf"], self.wanted(self.image("image:svgf", frame)), 1)

    def test_number_of_the_frame_stands_by_each_image(self):
        for metric in ("relmse", "psnr_unbiased"):
            self.choose("images", "Number", metric)
            title = self.expected.metrics[metric]["title"]
            for variant in ("svgf", "unfiltered"):
                value = self.expected.mean_of_seeds(variant, "room", metric, self.frame)
                note = lambda: self.find(f"figure[data-subject='image:{variant}'] .note").text
                self.wait(lambda: note().startswith(title))
                self.assert_shows(note().removeprefix(title).removesuffix("dB").strip(), value)
