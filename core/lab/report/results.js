// The study's results as the page reads them: results.json, timings.json and the list of what else the file carries.

function embedded(id) {
  return JSON.parse(document.getElementById(id).textContent);
}

const key = (...parts) => parts.join('\n');

export function read_results() {
  const results = embedded('results'), timings = embedded('timings'), parts = embedded('parts');
  const summary = new Map(), rows = new Map(), costs = new Map();
  for (const s of results.summary) summary.set(key(s.variant, s.sequence ?? '', s.metric), s);
  for (const r of results.rows) {
    const at = key(r.variant, r.sequence, r.metric, r.frame);
    if (!rows.has(at)) rows.set(at, []);
    if (r.value !== null) rows.get(at).push(r.value);
  }
  for (const v of timings?.variants ?? []) costs.set(v.name, { '': v.cost_ms ?? null, ...v.cost_ms_of });
  const pictures = new Map();
  for (const image of parts.images) {
    pictures.set(key(image.kind, image.variant, image.sequence, image.metric, image.frame), image);
  }
  const order = new Map(results.variants.map((v, i) => [v.name, i]));
  return {
    ...results,
    images: parts.images,
    // For summaries: all, then each, unless there is but one.
    sequence_choices: [...(results.sequences.length > 1 ? [['', 'All']] : []),
      ...results.sequences.map((s) => [s.name, s.name])],
    graph: (variant) => parts.graphs.find((g) => g.variant === variant),
    place: (variant) => order.get(variant),
    metric: (name) => results.metrics.find((m) => m.name === name),
    // `sequence` '' means all of them; one alone is all.
    summary_of: (variant, sequence, metric) => summary.get(key(variant, sequence, metric))
      ?? (results.sequences.length === 1 ? summary.get(key(variant, results.sequences[0].name, metric)) : undefined),
    // The mean over seeds; null where there is no number.
    value_at(variant, sequence, metric, frame) {
      const values = rows.get(key(variant, sequence, metric, frame)) ?? [];
      return values.length ? values.reduce((a, b) => a + b, 0) / values.length : null;
    },
    // CPU milliseconds a frame, or null where nothing was timed; `sequence` '' means all of them.
    cost_of: (variant, sequence = '') => costs.get(variant)?.[sequence] ?? costs.get(variant)?.[''] ?? null,
    picture: (kind, variant, sequence, metric, frame) =>
      pictures.get(key(kind, variant, sequence, metric, frame)),
  };
}

export function arrow(metric) {
  return metric.better === 'higher' ? '↑' : '↓';
}

export function title_of(metric) {
  return metric.title ?? metric.name;
}

// The address of a variant's part of the page.
export function link_to(variant) {
  return `#variant-${encodeURIComponent(variant)}`;
}

// Whether `a` is better than `b`.
export function better(metric, a, b) {
  return metric.better === 'higher' ? a > b : a < b;
}
