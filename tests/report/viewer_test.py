"""The images: every pixel is right, and sliders, zoom and exposure do what they say."""
import base64

from selenium.webdriver import ActionChains
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.mouse_button import MouseButton
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.keys import Keys

from page import srgb_byte
from viewer import SAMPLE, ViewerTest, magma


class Decoding(ViewerTest):
    def test_every_image_has_the_right_pixels(self):
        seen = set()
        for sequence, known in self.expected.sequences.items():
            self.take(sequence)
            for i, frame in enumerate(known["frames"]):
                self.slide("frame", i)
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
        self.assert_shows_part("#images figure canvas, .stage canvas", zoom, x, y, len(self.expected.variants) + 3)

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

    def test_escape_lets_go_of_a_pane(self):
        canvas = self.find(".stage canvas")
        ActionChains(self.driver).move_to_element_with_offset(canvas, -200, 0).click().perform()
        self.assertNotEqual(self.find("#pixel-x").get_attribute("value"), "")
        canvas.send_keys(Keys.ESCAPE)
        self.assertEqual(self.find("#pixel-x").get_attribute("value"), "")
        self.assertEqual({e.text for e in self.all("#images .value")}, {""})
        self.assertEqual(self.js("return document.activeElement.tagName"), "BODY")

    def test_only_the_first_button_drags(self):
        tile = self.find("#images figure[data-subject='image:svgf'] canvas")
        tile.send_keys("++++")
        shown = "return arguments[0].toDataURL()"
        before = self.js(shown, tile)
        mouse = ActionBuilder(self.driver)
        mouse.pointer_action.move_to(tile).pointer_down(button=MouseButton.RIGHT).move_by(-60, 0)
        mouse.pointer_action.pointer_up(button=MouseButton.RIGHT)
        mouse.perform()
        self.find(".stage canvas").send_keys(Keys.ESCAPE)  # takes the mark of the pixel away
        self.assertEqual(self.js(shown, tile), before)

    def test_panes_out_of_view_wait_and_come_in_time(self):
        self.browser.look(1280, 500, "light")
        self.open()
        self.frame = self.take("room", 6)  # has a reference
        last = "figure[data-subject='reference:'] canvas"
        self.assertEqual(self.js("return document.querySelector(arguments[0]).width", last), 300)  # nothing drawn yet
        self.find(".stage canvas").send_keys("++")
        self.js("document.querySelector(arguments[0]).scrollIntoView()", last)
        self.wait(lambda: self.js("return document.querySelector(arguments[0]).width", last) != 300)
        self.assert_shows_part(last, 2, 0.5, 0.5)

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
        # Its label is that of the slider, not of the number in it.
        self.assertEqual(self.js("return [...document.querySelectorAll('.slide input')].map((i) => i.labels.length)"), [1, 1])
        self.assert_same(self.samples(*self.size)["image:svgf"], self.wanted(self.image("image:svgf", self.frame), 1), 1)

    def test_frames_by_keys(self):
        slider = self.find("#frame")
        slider.send_keys(Keys.HOME)
        self.shown()
        slider.send_keys(Keys.ARROW_RIGHT)
        self.shown()
        frame = self.expected.sequences["room"]["frames"][1]
        self.assertEqual(self.find("#images .slide b").text, str(frame))
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
