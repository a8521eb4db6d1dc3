"""What tests of the images share: which picture is shown, and the pixels that it must have."""
import base64

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
    height = 4000  # all images in view at once: those that are not wait to be drawn

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
            const frame = images.querySelector('.slide b').textContent;
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

    def assert_shows_part(self, panes, zoom, x, y, count=1):
        """That these panes show the part of their image around (x, y), shares of its size, magnified."""
        shown = self.js("""return [...document.querySelectorAll(arguments[0])].map((canvas) => {
            const context = canvas.getContext('2d'), out = [];
            for (let v = 0.05; v < 1; v += 0.1) for (let u = 0.05; u < 1; u += 0.1) out.push([u, v,
              ...context.getImageData(Math.floor(u * canvas.width), Math.floor(v * canvas.height), 1, 1).data]);
            const figure = canvas.closest('figure');
            return [figure ? figure.dataset.subject : 'stage', canvas.width, canvas.height, out];
          })""", panes)
        self.assertEqual(len(shown), count)
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
        self.assertGreater(checked, 60 * count)
