// Each variant: what it changes, its graph with the changes marked, and the command that makes it again.
import { breakable, element } from './element.js';
import { graph_view } from './graph.js';
import { link_to } from './results.js';
import { look } from './state.js';

// "set history.alpha = 0.1" and the like, a line an edit.
function edits_of(edits = {}) {
  const pairs = (object = {}) => Object.entries(object);
  const text = (value) => (typeof value === 'string' ? value : JSON.stringify(value));
  return [
    ...pairs(edits.set).map(([name, value]) => `set ${name} = ${text(value)}`),
    ...pairs(edits.swap).map(([node, type]) => `swap ${node} for ${text(type)}`),
    ...pairs(edits.wire).map(([port, wire]) => `wire ${port} to ${text(wire)}`),
    ...(edits.bypass ?? []).map((node) => `bypass ${node}`),
  ];
}

function command_line(command) {
  const code = element('code', {}, command), done = element('span', { role: 'status' });
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(command);
      done.textContent = 'Copied';
    } catch {
      // Where the browser gives no clipboard to pages from files: chosen, so that Ctrl+C copies.
      getSelection().selectAllChildren(code);
      done.textContent = document.execCommand('copy') ? 'Copied' : 'Selected';
    }
    setTimeout(() => { done.textContent = ''; }, 2000);
  };
  return element('div', { class: 'command' }, element('pre', { tabindex: '0', 'aria-label': 'Command' }, code),
    element('button', { type: 'button', onclick: copy }, 'Copy'), done);
}

function variant_details(results, variant, place) {
  const graph = results.graph(variant.name), edits = edits_of(variant.edits);
  const inside = element('div', { class: 'inside' });
  const fill = () => {
    if (!details.open || inside.firstChild) return;
    if (edits.length) inside.append(element('ul', { class: 'edits' }, edits.map((e) => element('li', {}, element('code', {}, e)))));
    const facts = [variant.baseline ? 'baseline' : null, variant.nodes !== undefined ? `${variant.nodes} nodes` : null,
      variant.own_nodes !== undefined ? `${variant.own_nodes} shared with no other variant` : null,
      variant.fingerprint ? `fingerprint ${variant.fingerprint}` : null].filter(Boolean).join(', ');
    if (facts) inside.append(element('p', { class: 'hint' }, facts));
    if (variant.command) inside.append(command_line(variant.command));
    if (!graph) return;
    const view = graph_view(variant.name, graph.svg, graph.changed);
    const jump = (node) => (view.has(node)
      ? element('button', { type: 'button', class: 'plain', onclick: () => view.go(node) }, node)
      : element('code', {}, node));
    const line = (what, nodes) => (nodes.length
      ? element('p', { class: 'changes' }, element('span', {}, `${what}:`), nodes.map(jump)) : null);
    inside.append(...[line('Marked in the graph', graph.changed), line('Not in this graph', graph.removed)].filter(Boolean),
      view.root);
    if (graph.changed.length) view.go(graph.changed[0]);
  };
  const details = element('details', { id: `variant-${variant.name}`, class: look(place), ontoggle: fill },
    element('summary', {}, element('span', { class: 'swatch', 'aria-hidden': 'true' }), element('strong', {}, breakable(variant.name)),
      variant.about ? element('span', { class: 'note' }, variant.about) : null), inside);
  return details;
}

export function variants_section(results) {
  const list = results.variants.map((variant, place) => variant_details(results, variant, place));
  document.getElementById('variants').append(...list);
  // A link to a variant opens it.
  const open = () => {
    const details = list[results.variants.findIndex((v) => link_to(v.name) === location.hash)];
    if (!details) return;
    details.open = true;
    details.scrollIntoView();
  };
  addEventListener('hashchange', open);
  open();
}
