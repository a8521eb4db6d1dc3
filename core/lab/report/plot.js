// A metric over the frames of a sequence, a line a variant.
import { at_width, axes, scale, span_of, wants_log } from './axes.js';
import { cursor } from './cursor.js';
import { breakable, choice, drawn, element } from './element.js';
import { number_text } from './numbers.js';
import { arrow, title_of } from './results.js';
import { legend, look } from './state.js';

// Breaks the line where there is no number; a lone number is still a dot, as wide as the stroke.
function path_of(points) {
  return points.map((p, i) => {
    if (!p) return '';
    const lone = !points[i - 1] && !points[i + 1];
    return `${points[i - 1] ? 'L' : 'M'}${p[0].toFixed(1)},${p[1].toFixed(1)}${lone ? 'h0' : ''}`;
  }).join('');
}

const APART = 6;  // CSS pixels between frames that have a dot each; closer together dots hide the lines

function lines(results, shown, sequence, metric) {
  return shown.visible().map((name) => ({ name,
    values: sequence.frames.map((f) => results.value_at(name, sequence.name, metric.name, f)) }));
}

export function plots_section(results, shown) {
  const section = document.getElementById('plots');
  if (!results.sequences.length) return;
  const frame = element('div', { class: 'plot', id: 'frames-plot', tabindex: '0', role: 'group',
    'aria-label': 'Plot over the frames; arrow keys move through the frames' });
  const readout = element('p', { class: 'readout', 'aria-live': 'polite' });
  const sequence = () => results.sequences.find((s) => s.name === pick_sequence.select.value);
  const metric = () => results.metric(pick_metric.select.value);
  let x = null, mark = null;

  function draw(width) {
    const height = Math.round(Math.min(420, Math.max(260, width * 0.45)));
    const box = { left: 58, top: 26, right: width - 14, bottom: height - 44 };
    const all = lines(results, shown, sequence(), metric());
    const values = all.flatMap((l) => l.values.filter((v) => v !== null));
    log.disabled = values.some((v) => v <= 0);
    const y = scale(values, box.bottom, box.top, log.checked);
    const frames = sequence().frames;
    x = scale(frames, box.left, box.right, false);
    x.ticks = x.ticks.filter((t) => Number.isInteger(t));
    const svg = drawn('svg', { width, height, viewBox: `0 0 ${width} ${height}`, role: 'img',
      'aria-label': `${title_of(metric())} over the frames of ${sequence().name}` });
    // Up to half way between the last frame of the warm-up and the first that counts.
    const first = Math.min(results.warm_up, frames.length - 1);
    const warm = first > 0 ? (x.at(frames[first - 1]) + x.at(frames[first])) / 2 : box.left;
    if (first > 0) {
      svg.append(drawn('rect', { class: 'warm-up', x: box.left, y: box.top, width: Math.max(0, warm - box.left),
        height: box.bottom - box.top }, drawn('title', {}, 'warm-up: not in the tables')));
    }
    const unit = metric().unit ? ` [${metric().unit}]` : '';
    svg.append(axes(box, x, y, 'frame', `${title_of(metric())}${unit} ${arrow(metric())}`));
    mark = drawn('line', { class: 'cursor', y1: box.top, y2: box.bottom });
    svg.append(mark);
    const dots = x.at(frames.at(-1)) - x.at(frames[0]) >= APART * (frames.length - 1);
    for (const line of all) {
      const points = line.values.map((v, i) => (v === null ? null : [x.at(frames[i]), y.at(v)]));
      const group = drawn('g', { class: `series ${look(results.place(line.name))}`, 'data-variant': line.name },
        drawn('path', { d: path_of(points) }));
      points.forEach((p, i) => dots && p && group.append(drawn('circle', { cx: p[0].toFixed(1), cy: p[1].toFixed(1), r: 2.6,
        'data-frame': frames[i], 'data-value': line.values[i] },
      drawn('title', {}, `${line.name}, frame ${frames[i]}: ${number_text(line.values[i])}`))));
      svg.append(group);
    }
    if (warm - box.left > 54) {
      svg.append(drawn('text', { class: 'warm-up', x: box.left + 5, y: box.top + 14 }, 'warm-up'));
    }
    frame.replaceChildren(svg);
    read_out();
    table.replaceChildren();
    if (numbers.open) fill_table();
  }

  // Only this changes with the cursor: to draw all anew would lag behind a pointer where there are many variants.
  function read_out() {
    const at = read.at === null ? null : sequence().frames[read.at];
    mark.toggleAttribute('hidden', at === null);
    mark.setAttribute('x1', x.at(at ?? 0));
    mark.setAttribute('x2', x.at(at ?? 0));
    keys.update();
    readout.textContent = at === null ? 'Point at a frame, or use the arrow keys, to read the numbers in the legend.'
      : `Frame ${at}`;
  }

  function fill_table() {
    const names = shown.visible();
    table.replaceChildren(element('table', {},
      element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, 'Frame'),
        names.map((n) => element('th', { scope: 'col' }, breakable(n))))),
      element('tbody', {}, sequence().frames.map((f) => element('tr', {}, element('th', { scope: 'row' }, f),
        names.map((n) => element('td', {}, number_text(results.value_at(n, sequence().name, metric().name, f)))))))));
  }

  const read = cursor(frame, {
    nearest(at) {
      const distances = sequence().frames.map((f) => Math.abs(x.at(f) - at));
      return distances.indexOf(span_of(distances)[0]);
    },
    count: () => (x ? sequence().frames.length : 0),
    moved: () => read_out(),
  });
  const redraw = at_width(frame, draw);
  const changed = () => { read.at = null; log.checked = in_decades(); redraw(); };
  const pick_sequence = choice('Sequence', results.sequences.map((s) => [s.name, s.name]), changed);
  const pick_metric = choice('Metric', results.metrics.map((m) => [m.name, title_of(m)]), changed);
  const log = element('input', { type: 'checkbox', onchange: redraw });
  function in_decades() {
    return wants_log(lines(results, shown, sequence(), metric()).flatMap((l) => l.values.filter((v) => v !== null)));
  }
  const keys = legend(shown, (name) => (read.at === null ? ''
    : number_text(results.value_at(name, sequence().name, metric().name, sequence().frames[read.at]))));
  const table = element('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Numbers of the plot' });
  const numbers = element('details', { ontoggle: () => { if (numbers.open) fill_table(); } },
    element('summary', {}, 'Numbers of this plot'), table);
  log.checked = in_decades();

  shown.listen(redraw);
  section.append(element('div', { class: 'bar' }, pick_sequence.root, pick_metric.root,
    element('label', { class: 'check' }, log, 'logarithmic')), frame, readout, keys.root, numbers);
}
