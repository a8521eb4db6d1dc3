// The graph of a variant, drawn by the program, with what the variant changes marked.
import { element } from './element.js';

// The drawing names its styles by class; these replace its own, so that it follows the page's colours.
const STYLE = `
  :host { display: block }
  text { font: 13px system-ui, sans-serif; text-anchor: middle; fill: var(--ink) }
  .below { font-size: 11px; fill: var(--faint) }
  rect { fill: var(--page); stroke: var(--faint) }
  .input rect { stroke: var(--link) } .output rect { stroke: var(--gain) } .weight rect { stroke: var(--loss) }
  path { fill: none; stroke: var(--faint) }
  marker path { fill: var(--faint); stroke: none }
  .carries-weight { stroke: var(--loss) } .delayed { stroke: var(--link); stroke-dasharray: 6 4 }
  .start { stroke-dasharray: 2 3 }
  .changed rect { fill: var(--mark); stroke: var(--ink); stroke-width: 3 }
  .changed text { fill: var(--mark-ink) }`;

function parsed(svg) {
  // Styles inside the drawing would be refused by the page's policy.
  const bare = svg.replace(/<style>[^]*?<\/style>/g, '').replace(/ style="[^"]*"/g, '');
  const root = new DOMParser().parseFromString(bare, 'image/svg+xml').documentElement;
  if (root.localName !== 'svg') throw new Error('the drawing of a graph is no SVG');
  root.querySelector(':scope > rect[width="100%"]')?.remove();
  return document.adoptNode(root);
}

// A frame to scroll, and a function that scrolls to a node.
export function graph_view(name, svg, changed) {
  const host = element('div', { class: 'drawing' });
  const shadow = host.attachShadow({ mode: 'open' });
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(STYLE);
  shadow.adoptedStyleSheets = [sheet];
  const drawing = parsed(svg), boxes = new Map();
  for (const box of drawing.querySelectorAll('g.node, g.weight')) {
    const node = box.querySelector('text').textContent;
    boxes.set(node, box);
    box.classList.toggle('changed', changed.includes(node));
  }
  shadow.append(drawing);
  const root = element('div', { class: 'scroll graph', tabindex: '0', role: 'region', 'aria-label': `Graph of ${name}` },
    host);
  const go = (node) => {
    const box = boxes.get(node)?.getBoundingClientRect(), frame = root.getBoundingClientRect();
    if (!box) return;
    root.scrollBy(box.x + box.width / 2 - frame.x - frame.width / 2, box.y + box.height / 2 - frame.y - frame.height / 2);
  };
  return { root, go, has: (node) => boxes.has(node) };
}
