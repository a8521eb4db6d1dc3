// Time against error: which variants no other beats in both.
import { at_width, axes, scale, span_of, wants_log } from './axes.js';
import { cursor } from './cursor.js';
import { choice, drawn, element } from './element.js';
import { number_text } from './numbers.js';
import { arrow, better, title_of } from './results.js';
import { legend, look } from './state.js';

// The points that no other point is at least as good as in both and better in one, from cheap to dear.
export function pareto_front(points, metric) {
  const front = [];
  for (const p of points.toSorted((a, b) => a.cost - b.cost || (better(metric, a.error, b.error) ? -1 : 1))) {
    const last = front.at(-1);
    if (!last || better(metric, p.error, last.error) || (p.cost === last.cost && p.error === last.error)) front.push(p);
  }
  return front;
}

// Beside the point where nothing else is written yet; nowhere when all is full (the name is in the point's title).
function place_label(taken, p, box) {
  const wide = p.name.length * 7.2, high = 13;
  for (const [x, y] of [[8, -7], [8, 15], [-8 - wide, 15], [-8 - wide, -7], [-8 - wide, 4], [8, 4]]) {
    const r = { left: p.x + x, right: p.x + x + wide, top: p.y + y - high + 3, bottom: p.y + y + 3 };
    if (r.left < box.left || r.right > box.right || r.top < box.top || r.bottom > box.bottom) continue;
    if (taken.some((t) => r.left < t.right && t.left < r.right && r.top < t.bottom && t.top < r.bottom)) continue;
    taken.push(r);
    return { x: r.left, y: p.y + y };
  }
  return null;
}

export function pareto_section(results, shown) {
  const section = document.getElementById('pareto');
  if (!results.variants.some((v) => results.cost_of(v.name) !== null)) {
    section.append(element('p', {}, 'Nothing was timed, so there is no time to plot against the error.'));
    return;
  }
  const frame = element('div', { class: 'plot', id: 'pareto-plot', tabindex: '0', role: 'group',
    'aria-label': 'Plot of time against error; arrow keys move from cheap variants to dear ones' });
  const readout = element('p', { class: 'readout', 'aria-live': 'polite' }), list = element('p', { class: 'readout' });
  let points = [], ring = null;
  const metric_shown = () => results.metric(pick_metric.select.value);
  const unit_of = (metric) => (metric.unit ? ` ${metric.unit}` : '');
  const said_of = (p, metric) => `${p.name}: ${number_text(p.error)}${unit_of(metric)} in ${number_text(p.cost)} ms`;

  function draw(width) {
    const metric = metric_shown();
    const height = Math.round(Math.min(440, Math.max(280, width * 0.5)));
    const box = { left: 58, top: 26, right: width - 14, bottom: height - 44 };
    points = [];
    for (const name of shown.visible()) {
      const cost = results.cost_of(name, pick_sequence.select.value);
      const error = results.summary_of(name, pick_sequence.select.value, metric.name)?.mean ?? null;
      if (cost !== null && error !== null) points.push({ name, cost, error });
    }
    points.sort((a, b) => a.cost - b.cost);
    const costs = points.map((p) => p.cost), errors = points.map((p) => p.error);
    const x = scale(costs, box.left, box.right, wants_log(costs));
    const y = scale(errors, box.bottom, box.top, wants_log(errors));
    for (const p of points) [p.x, p.y] = [x.at(p.cost), y.at(p.error)];
    const svg = drawn('svg', { width, height, viewBox: `0 0 ${width} ${height}`, role: 'img',
      'aria-label': `${title_of(metric)} against time` });
    const unit = metric.unit ? ` [${metric.unit}]` : '';
    svg.append(axes(box, x, y, 'CPU time [ms a frame] ↓', `${title_of(metric)}${unit} ${arrow(metric)}`));
    const front = pareto_front(points, metric);
    // Steps: between two variants of the front nothing was measured that is better than the cheaper one.
    let path = '';
    front.forEach((p, i) => { path += i ? `H${p.x.toFixed(1)}V${p.y.toFixed(1)}` : `M${p.x.toFixed(1)},${p.y.toFixed(1)}`; });
    if (front.length) svg.append(drawn('path', { class: 'front', d: `${path}H${box.right}` }));
    const taken = points.map((p) => ({ left: p.x - 6, right: p.x + 6, top: p.y - 6, bottom: p.y + 6 }));
    const on_front = new Set(front.map((p) => p.name));
    for (const p of [...front, ...points.filter((q) => !on_front.has(q.name))]) {
      const group = drawn('g', { class: `point ${look(results.place(p.name))}${on_front.has(p.name) ? ' best' : ''}`,
        'data-variant': p.name, 'data-cost': p.cost, 'data-error': p.error },
      drawn('title', {}, said_of(p, metric)),
      drawn('circle', { cx: p.x, cy: p.y, r: on_front.has(p.name) ? 6 : 4.5 }));
      const label = place_label(taken, p, { ...box, right: width });
      if (label) group.append(drawn('text', label, p.name));
      svg.append(group);
    }
    ring = drawn('circle', { class: 'cursor', r: 10 });
    svg.append(ring);
    frame.replaceChildren(svg);
    read.at = null;
    read_out();
    list.textContent = `On the front: ${front.map((p) => p.name).join(', ') || 'nothing'}.`;
  }

  function read_out() {
    const p = points[read.at];
    ring.toggleAttribute('hidden', !p);
    ring.setAttribute('cx', p?.x ?? 0);
    ring.setAttribute('cy', p?.y ?? 0);
    readout.textContent = p ? said_of(p, metric_shown()) : 'Point at a variant, or use the arrow keys, to read its numbers.';
  }

  const read = cursor(frame, {
    nearest(x, y) {
      const distances = points.map((p) => Math.hypot(p.x - x, p.y - y));
      return distances.indexOf(span_of(distances)[0]);
    },
    count: () => points.length,
    moved: read_out,
  });
  const redraw = at_width(frame, draw);
  const pick_sequence = choice('Sequence', results.sequence_choices, redraw);
  const pick_metric = choice('Metric', results.metrics.map((m) => [m.name, title_of(m)]), redraw);
  shown.listen(redraw);
  section.append(element('div', { class: 'bar' }, pick_sequence.root, pick_metric.root), frame, readout, list,
    legend(shown).root);
}
