// Time against error: which variants no other beats in both.
import { at_width, axes, scale } from './axes.js';
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
  const frame = element('div', { class: 'plot', id: 'pareto-plot' });
  const list = element('p', { class: 'readout' });

  function draw(width) {
    const metric = results.metric(pick_metric.select.value);
    const height = Math.round(Math.min(440, Math.max(280, width * 0.5)));
    const box = { left: 58, top: 26, right: width - 14, bottom: height - 44 };
    const points = [];
    for (const name of shown.visible()) {
      const cost = results.cost_of(name);
      const error = results.summary_of(name, pick_sequence.select.value, metric.name)?.mean ?? null;
      if (cost !== null && error !== null) points.push({ name, cost, error });
    }
    const spread = (values) => Math.min(...values) > 0 && Math.max(...values) > 10 * Math.min(...values);
    const costs = points.map((p) => p.cost), errors = points.map((p) => p.error);
    const x = scale(costs, box.left, box.right, spread(costs));
    const y = scale(errors, box.bottom, box.top, spread(errors));
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
      drawn('title', {}, `${p.name}: ${number_text(p.error)}${unit} in ${number_text(p.cost)} ms`),
      drawn('circle', { cx: p.x, cy: p.y, r: on_front.has(p.name) ? 6 : 4.5 }));
      const label = place_label(taken, p, { ...box, right: width });
      if (label) group.append(drawn('text', label, p.name));
      svg.append(group);
    }
    frame.replaceChildren(svg);
    list.textContent = `On the front: ${front.map((p) => p.name).join(', ') || 'nothing'}.`;
  }

  const redraw = at_width(frame, draw);
  const pick_sequence = choice('Sequence', results.sequence_choices, redraw);
  const pick_metric = choice('Metric', results.metrics.map((m) => [m.name, title_of(m)]), redraw);
  shown.listen(redraw);
  section.append(element('div', { class: 'bar' }, pick_sequence.root, pick_metric.root), frame, list,
    legend(shown).root);
}
