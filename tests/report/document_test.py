"""The page as a whole: it loads in silence, asks for nothing, and serves keyboards, small screens and both schemes."""
import http.server
import threading

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from page import PageTest


class Document(PageTest):
    def test_loads_without_a_word_and_asks_for_nothing_else(self):
        self.assertEqual(self.driver.title, "Parts of SVGF – Quell")
        for details in self.all("#variants > details"):
            self.js("arguments[0].open = true", details)
        self.choose("images", "Show", "relmse")
        self.wait(lambda: "relmse" in self.js("return document.querySelector('#images').dataset.shown"))
        self.assertEqual(self.browser.said(), [])
        self.assertEqual(self.browser.asked(), [self.address])

    def test_policy_keeps_requests_inside(self):
        asked = []

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                asked.append(self.path)
                self.send_response(204)
                self.end_headers()
            do_POST = do_GET

            def log_message(self, *_):
                pass

        server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        at = f"http://127.0.0.1:{server.server_port}"
        refused = self.driver.execute_async_script("""
            const [at, done] = arguments, refused = new Set();
            addEventListener('securitypolicyviolation', (e) => refused.add(e.effectiveDirective));
            fetch(at + '/fetch').catch(() => {});
            const add = (tag, properties) => document.body.append(Object.assign(document.createElement(tag), properties));
            add('img', { src: at + '/img' });
            add('script', { src: at + '/script' });
            add('script', { textContent: 'document.title = "inline"' });
            add('link', { rel: 'stylesheet', href: at + '/style' });
            try { new WebSocket(at.replace('http', 'ws')); } catch {}
            setTimeout(() => done([...refused]), 500);""", at)
        server.shutdown()
        server.server_close()
        self.assertEqual(asked, [])
        self.assertEqual({"connect-src", "img-src", "script-src-elem", "style-src-elem"} - set(refused), set())
        self.assertNotEqual(self.driver.title, "inline")
        self.browser.said()

    def test_each_variant_has_its_graph_and_its_command(self):
        for place, variant in enumerate(self.expected.results["variants"]):
            details = self.all("#variants > details")[place]
            details.find_element(By.CSS_SELECTOR, "summary").send_keys(Keys.ENTER)
            self.wait(lambda: details.find_elements(By.CSS_SELECTOR, ".graph"))
            self.assertEqual(details.find_element(By.CSS_SELECTOR, ".command code").text, variant["command"])
            marked = self.js("""const root = arguments[0].querySelector('.drawing').shadowRoot;
                return [root.querySelectorAll('g.node, g.weight').length, [...root.querySelectorAll('.changed')].map(
                    (g) => g.querySelector('text').textContent)]""", details)
            self.assertGreater(marked[0], 20)
            text = details.find_element(By.CSS_SELECTOR, ".inside").text
            for node in marked[1]:
                self.assertIn(node, text)
            changes = {"svgf": [], "no_variance": ["level0.by_luminance"], "alpha_0.5": ["blend"]}
            if variant["name"] in changes:
                self.assertEqual(marked[1], changes[variant["name"]])
            if variant["name"] == "three_levels":
                self.assertIn("level9.atrous", text)
            details.find_element(By.CSS_SELECTOR, "summary").click()
        self.assertEqual(self.browser.said(), [])

    def test_marked_node_is_in_view(self):
        details = self.all("#variants > details")[1]
        details.find_element(By.CSS_SELECTOR, "summary").click()
        self.wait(lambda: details.find_elements(By.CSS_SELECTOR, ".graph"))
        inside = """const box = arguments[0].querySelector('.drawing').shadowRoot.querySelector('.changed')
            .getBoundingClientRect(), frame = arguments[0].querySelector('.graph').getBoundingClientRect();
            return box.top >= frame.top && box.bottom <= frame.bottom && box.left >= frame.left && box.right <= frame.right"""
        self.wait(lambda: self.js(inside, details))
        self.js("arguments[0].querySelector('.graph').scrollTo(0, 0)", details)
        details.find_element(By.CSS_SELECTOR, ".changes button").click()
        self.wait(lambda: self.js(inside, details))

    def test_command_is_copied(self):
        self.driver.execute_cdp_cmd("Browser.grantPermissions",
                                    {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]})
        details = self.all("#variants > details")[9]
        details.find_element(By.CSS_SELECTOR, "summary").click()
        self.wait(lambda: details.find_elements(By.CSS_SELECTOR, ".command button"))
        details.find_element(By.CSS_SELECTOR, ".command button").click()
        self.wait(lambda: details.find_element(By.CSS_SELECTOR, ".command [role=status]").text == "Copied")
        copied = self.driver.execute_async_script("navigator.clipboard.readText().then(arguments[0], String)")
        self.assertEqual(copied, self.expected.results["variants"][9]["command"])

    def test_link_of_a_variant_opens_it(self):
        link = self.find("#summary tr:nth-child(10) a")  # the one whose name needs escapes
        self.assertEqual(link.text, "a<b & \"c\"")
        link.click()
        self.wait(lambda: self.js("return document.querySelectorAll('#variants > details')[9].open"))

    def test_all_that_is_operated_has_a_name_and_shows_its_focus(self):
        for details in self.all("#variants > details")[:2]:
            self.js("arguments[0].open = true", details)
        self.wait(lambda: len(self.all(".graph")) == 2)
        controls = self.js("""return [...document.querySelectorAll('a, button, select, input, summary, '
            + '[tabindex]')].filter((e) => e.checkVisibility()).length""")
        self.assertGreater(controls, 80)
        tree = self.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        named = [(node["role"]["value"], node["name"]["value"]) for node in tree if not node["ignored"]
                 and node["role"]["value"] not in ("RootWebArea", "option")
                 and any(p["name"] == "focusable" and p["value"]["value"] for p in node["properties"])]
        self.assertGreaterEqual(len(named), controls)
        self.assertEqual([role for role, name in named if not name.strip()], [])
        # By Tab alone, from the top to the bottom, each is reached and drawn with a ring.
        self.js("""document.activeElement.blur();
            scrollTo(0, 0);
            window.reached = [];
            addEventListener('focusin', ({ target }) => {
              const style = getComputedStyle(target);
              reached.push([target.tagName, [...document.querySelectorAll('*')].indexOf(target),
                style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2]);
            });""")
        for _ in range(controls):
            self.browser.press("Tab", 9)
        reached = self.js("return reached")
        for tag, _, ring in reached:
            self.assertTrue(ring, f"no ring around a focused {tag}")
        order = [place for _, place, _ in reached]
        self.assertEqual(order, sorted(set(order)))
        self.assertGreaterEqual(len(order), controls)


# WCAG 2: contrast of every text with what is behind it; icons and disabled parts left out.
CONTRAST = """
const luminance = ([r, g, b]) => [r, g, b].map((c) => c / 255).map((c) => (c <= 0.04045 ? c / 12.92
  : ((c + 0.055) / 1.055) ** 2.4)).reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
const parse = (colour) => { const n = colour.match(/[\\d.]+/g).map(Number); return n.length < 4 ? [...n, 1] : n; };
const behind = (e) => {
  for (; e; e = e.parentElement) { const c = parse(getComputedStyle(e).backgroundColor); if (c[3] > 0.99) return c; }
  return parse(getComputedStyle(document.documentElement).backgroundColor);
};
const bad = [];
let seen = 0;
for (const e of document.querySelectorAll('body *')) {
  if (e.closest('script, noscript, option, .divider, .star') || !e.checkVisibility()) continue;
  if (![...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim())) continue;
  const style = getComputedStyle(e), svg = e instanceof SVGElement;
  const a = luminance(parse(svg ? style.fill : style.color)), b = luminance(behind(e));
  const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  ++seen;
  if (ratio < 4.5) bad.push([e.tagName, e.className.baseVal ?? e.className, e.textContent.slice(0, 30), ratio]);
}
return [seen, bad];
"""


class Looks(PageTest):
    def test_fits_and_is_legible(self):
        folder = self.expected.folder / "screenshots"
        folder.mkdir(exist_ok=True)
        for width, height in ((1280, 900), (360, 740)):
            for scheme in ("light", "dark"):
                self.browser.look(width, height, scheme)
                self.open()
                details = self.all("#variants > details")[1]
                self.js("arguments[0].open = true", details)
                self.wait(lambda: details.find_elements(By.CSS_SELECTOR, ".graph"))
                self.assertEqual(self.js("return matchMedia('(prefers-color-scheme: dark)').matches"), scheme == "dark")
                self.assertEqual(self.js("return document.documentElement.scrollWidth"), width)
                cut = self.js("""return [...document.querySelectorAll('main *')].filter((e) => e.checkVisibility()
                    && !e.closest('.scroll, svg, .divider, .visually-hidden') && e.getBoundingClientRect().right > innerWidth + 1)
                    .map((e) => e.outerHTML.slice(0, 120))""")
                self.assertEqual(cut, [])
                seen, bad = self.js(CONTRAST)
                self.assertGreater(seen, 300)
                self.assertEqual(bad, [], f"{width} {scheme}")
                small = self.js("""return [...document.querySelectorAll('body *')].filter((e) => e.checkVisibility()
                    && [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim())
                    && parseFloat(getComputedStyle(e).fontSize) < 11).map((e) => e.outerHTML.slice(0, 120))""")
                self.assertEqual(small, [])
                for part in ("tables", "plots", "pareto", "images", "variants"):
                    self.js("document.getElementById(arguments[0]).scrollIntoView()", part)
                    self.driver.save_screenshot(str(folder / f"{part}_{width}_{scheme}.png"))
                self.assertEqual(self.browser.said(), [])
