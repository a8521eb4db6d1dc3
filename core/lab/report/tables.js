// The tables of the report: all metrics of a sequence, one metric over the sequences.
import { breakable, choice, element } from './element.js';
import { beside, number_text } from './numbers.js';
import { arrow, better, link_to, title_of } from './results.js';
import { sortable_table } from './table.js';

const STATISTICS = [['mean', 'Mean'], ['median', 'Median'], ['p95', '95th percentile']];

function variant_link(variant) {
  return element('a', { href: link_to(variant.name), title: variant.about || undefined },
    breakable(variant.name));
}

// Whether the interval of the difference holds 0, where the results have one: it is against the first variant, frame by
// frame. Else whether the mean lies in the other's interval.
function may_be_chance(summary, base, paired) {
  if (paired && summary.difference_low !== undefined && summary.difference_low !== null) {
    return summary.difference_low <= 0 && summary.difference_high >= 0;
  }
  return base.low <= summary.mean && summary.mean <= base.high;
}

// The number, its confidence interval (of means) and how it stands to the variant that all are compared with.
function number_cell(metric, summary, statistic, base, paired) {
  const value = summary?.[statistic] ?? null;
  const content = [element('span', { class: 'number', title: value === null ? 'no number' : String(value) },
    number_text(value))];
  if (statistic === 'mean' && value !== null && summary.low !== null && summary.low !== undefined) {
    content.push(element('span', { class: 'interval', title: '95 % confidence interval' },
      `${number_text(summary.low)} … ${number_text(summary.high)}`));
  }
  const other = base?.[statistic] ?? null;
  if (base && base !== summary && value !== null && other !== null) {
    const chance = value === other || (statistic === 'mean' && may_be_chance(summary, base, paired));
    const kind = chance ? 'same' : better(metric, value, other) ? 'gain' : 'loss';
    content.push(element('span', { class: `change ${kind}` }, beside(value, other, metric.unit)));
  }
  return { value, content };
}

function mark_best(rows, column, is_better) {
  const values = rows.map((row) => row.cells[column].value).filter((v) => v !== null);
  if (values.length < 2) return;
  const best = number_text(values.reduce((a, b) => (is_better(b, a) ? b : a)));
  // What reads the same is equally good.
  for (const row of rows) if (number_text(row.cells[column].value) === best) row.cells[column].best = true;
}

function metric_column(metric) {
  return { name: metric.name, title: `${title_of(metric)}${metric.unit ? ` [${metric.unit}]` : ''} ${arrow(metric)}`,
    hint: `${metric.better} is better; sort`, first: metric.better === 'higher' ? 'descending' : 'ascending' };
}

const VARIANT = { name: 'variant', title: 'Variant', hint: 'Sort by name' };

function summary_table(results, sequence, statistic, compared) {
  const timed = results.variants.some((v) => results.cost_of(v.name) !== null);
  const columns = [VARIANT, ...results.metrics.map(metric_column)];
  if (timed) columns.push({ name: 'cost_ms', title: 'Time [ms] ↓', hint: 'CPU time a frame, as if run alone; sort' });
  columns.push({ name: 'nodes', title: 'Nodes', hint: 'Nodes of the graph; sort' });
  const rows = results.variants.map((variant) => {
    const cells = [{ value: variant.name, content: variant_link(variant) }];
    for (const metric of results.metrics) {
      cells.push(number_cell(metric, results.summary_of(variant.name, sequence, metric.name), statistic,
        results.summary_of(compared, sequence, metric.name), compared === results.variants[0].name));
    }
    if (timed) {
      const cost = results.cost_of(variant.name, sequence), base = results.cost_of(compared, sequence);
      const change = variant.name === compared ? '' : beside(cost, base, 'ms');
      const kind = Math.abs(cost / base - 1) < 0.01 ? 'same' : cost < base ? 'gain' : 'loss';
      cells.push({ value: cost, content: [element('span', { class: 'number' }, number_text(cost)),
        change ? element('span', { class: `change ${kind}` }, change) : null] });
    }
    cells.push({ value: variant.nodes ?? null, content: shown_count(variant.nodes) });
    return { key: variant.name, cells };
  });
  results.metrics.forEach((metric, i) => mark_best(rows, i + 1, (a, b) => better(metric, a, b)));
  const name = STATISTICS.find(([k]) => k === statistic)[1];
  const frames = results.warm_up ? `frames after the first ${results.warm_up}` : 'frames';
  return sortable_table(`${name} over the ${frames}, ${sequence || 'all sequences'}`, columns, rows);
}

function shown_count(count) {
  return count === undefined || count === null ? '–' : String(count);
}

function sequence_table(results, metric, statistic) {
  const columns = [VARIANT, ...results.sequences.map((s) => ({ ...metric_column(metric), name: s.name,
    title: s.name }))];
  const rows = results.variants.map((variant) => ({
    key: variant.name,
    cells: [{ value: variant.name, content: variant_link(variant) }, ...results.sequences.map((s) =>
      number_cell(metric, results.summary_of(variant.name, s.name, metric.name), statistic))],
  }));
  results.sequences.forEach((_, i) => mark_best(rows, i + 1, (a, b) => better(metric, a, b)));
  return sortable_table(`${metric_column(metric).title}, by sequence`, columns, rows);
}

export function tables_section(results) {
  const section = document.getElementById('tables');
  const sequences = results.sequence_choices;
  const frame = element('div', { id: 'summary' }), by_sequence = element('div', { id: 'by-sequence' });
  const draw = () => frame.replaceChildren(
    summary_table(results, sequence.select.value, statistic.select.value, compared.select.value));
  const sequence = choice('Sequence', sequences, draw);
  const statistic = choice('Statistic', STATISTICS, draw);
  const compared = choice('Compared with', [['', 'nothing'], ...results.variants.map((v) => [v.name, v.name])], draw,
    results.variants[0]?.name ?? '');
  section.append(element('div', { class: 'bar' }, sequence.root, statistic.root, compared.root), frame);
  draw();
  if (results.sequences.length > 1) {
    const again = () => by_sequence.replaceChildren(
      sequence_table(results, results.metric(metric.select.value), 'mean'));
    const metric = choice('Metric', results.metrics.map((m) => [m.name, title_of(m)]), again);
    section.append(element('h3', {}, 'By sequence'), element('div', { class: 'bar' }, metric.root), by_sequence);
    again();
  }
}
