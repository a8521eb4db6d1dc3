// A metric over the frames of a sequence, a line a variant.
import { at_width, axes, scale } from './axes.js';
import { choice, drawn, element } from './element.js';
import { number_text } from './numbers.js';
import { arrow, title_of } from './results.js';
import { legend, look } from './state.js';

// Breaks the line where there is no number; a lone number is still a dot.
function path_of(points) {
  let path = '', down = false;
  for (const p of points) {
    if (p) path += `${down ? 'L' : 'M'}${p[0].toFixed(1)},${p[1].toFixed(1)}`;
    down = Boolean(p);
  }
  return path;
}

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
  let cursor = null;  // index of the frame that is read out
  const sequence = () => results.sequences.find((s) => s.name === pick_sequence.select.value);
  const metric = () => results.metric(pick_metric.select.value);
  let x = null;

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
    if (warm - box.left > 54) {
      svg.append(drawn('text', { class: 'warm-up', x: box.left + 5, y: box.top + 14 }, 'warm-up'));
    }
    if (cursor !== null) {
      const at = x.at(frames[cursor]);
      svg.append(drawn('line', { class: 'cursor', x1: at, x2: at, y1: box.top, y2: box.bottom }));
    }
    for (const line of all) {
      const points = line.values.map((v, i) => (v === null ? null : [x.at(frames[i]), y.at(v)]));
      const group = drawn('g', { class: `series ${look(results.place(line.name))}`, 'data-variant': line.name },
        drawn('path', { d: path_of(points) }));
      points.forEach((p, i) => p && group.append(drawn('circle', { cx: p[0].toFixed(1), cy: p[1].toFixed(1), r: 2.6,
        'data-frame': frames[i], 'data-value': line.values[i] },
      drawn('title', {}, `${line.name}, frame ${frames[i]}: ${number_text(line.values[i])}`))));
      svg.append(group);
    }
    frame.replaceChildren(svg);
    keys.update();
    readout.textContent = cursor === null ? 'Point at a frame, or use the arrow keys, to read the numbers in the legend.'
      : `Frame ${frames[cursor]}`;
    table.replaceChildren();
    if (numbers.open) fill_table();
  }

  function fill_table() {
    const names = shown.visible();
    table.replaceChildren(element('table', {},
      element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, 'Frame'),
        names.map((n) => element('th', { scope: 'col' }, n)))),
      element('tbody', {}, sequence().frames.map((f) => element('tr', {}, element('th', { scope: 'row' }, f),
        names.map((n) => element('td', {}, number_text(results.value_at(n, sequence().name, metric().name, f)))))))));
  }

  const redraw = at_width(frame, draw);
  const changed = () => { cursor = null; log.checked = wants_log(); redraw(); };
  const pick_sequence = choice('Sequence', results.sequences.map((s) => [s.name, s.name]), changed);
  const pick_metric = choice('Metric', results.metrics.map((m) => [m.name, title_of(m)]), changed);
  const log = element('input', { type: 'checkbox', onchange: redraw });
  // Errors that span more than a decade are told apart only by their logarithm.
  function wants_log() {
    const values = lines(results, shown, sequence(), metric()).flatMap((l) => l.values.filter((v) => v !== null));
    return values.length > 0 && Math.min(...values) > 0 && Math.max(...values) > 10 * Math.min(...values);
  }
  const keys = legend(shown, (name) => (cursor === null ? ''
    : number_text(results.value_at(name, sequence().name, metric().name, sequence().frames[cursor]))));
  const table = element('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'Numbers of the plot' });
  const numbers = element('details', { ontoggle: () => { if (numbers.open) fill_table(); } },
    element('summary', {}, 'Numbers of this plot'), table);
  log.checked = wants_log();

  frame.addEventListener('pointermove', (event) => {
    if (!x) return;
    const at = event.clientX - frame.getBoundingClientRect().left;
    const distances = sequence().frames.map((f) => Math.abs(x.at(f) - at));
    const nearest = distances.indexOf(Math.min(...distances));
    if (nearest !== cursor) { cursor = nearest; redraw(); }
  });
  frame.addEventListener('keydown', (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const last = sequence().frames.length - 1;
    cursor = cursor === null ? (step > 0 ? 0 : last) : Math.max(0, Math.min(last, cursor + step));
    redraw();
  });
  shown.listen(redraw);
  section.append(element('div', { class: 'bar' }, pick_sequence.root, pick_metric.root,
    element('label', { class: 'check' }, log, 'logarithmic')), frame, readout, keys.root, numbers);
}
