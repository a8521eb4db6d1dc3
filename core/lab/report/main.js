// Fills the page from the results that it carries.
import { element } from './element.js';
import { bytes } from './numbers.js';
import { pareto_section } from './pareto.js';
import { plots_section } from './plot.js';
import { read_results } from './results.js';
import { Shown } from './state.js';
import { tables_section } from './tables.js';
import { variants_section } from './variants.js';
import { viewer_section } from './viewer.js';

const results = read_results();
const shown = new Shown(results.variants.map((v) => v.name));

document.title = `${results.name} – Quell`;
document.getElementById('name').textContent = results.name;
document.getElementById('about').textContent = results.about ?? '';
const count = (n, what) => `${n} ${what}${n === 1 ? '' : 's'}`;
const packed = results.images.reduce((sum, image) => sum + image.bytes, 0);
document.getElementById('facts').append(...[
  count(results.variants.length, 'variant'), count(results.sequences.length, 'sequence'),
  count(results.metrics.length, 'metric'), `warm-up ${count(results.warm_up, 'frame')}`,
  results.images.length ? `${count(results.images.length, 'image')}, ${bytes(packed)}` : null,
  `Quell ${results.quell}`, results.simd ? `SIMD ${results.simd}` : null,
].filter(Boolean).map((fact) => element('li', {}, fact)));

tables_section(results);
plots_section(results, shown);
pareto_section(results, shown);
viewer_section(results, shown);
variants_section(results);
document.documentElement.dataset.ready = 'yes';
