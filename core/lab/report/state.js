// Which variants are shown: one choice for plots, the Pareto plot and the images, made in any legend.
import { element } from './element.js';

export class Shown {
  constructor(names) {
    this.names = names;
    this.hidden = new Set();
    this.listeners = [];
  }
  has(name) { return !this.hidden.has(name); }
  visible() { return this.names.filter((name) => this.has(name)); }
  listen(listener) { this.listeners.push(listener); }
  toggle(name) {
    if (!this.hidden.delete(name)) this.hidden.add(name);
    this.tell();
  }
  show_all(yes) {
    this.hidden = new Set(yes ? [] : this.names);
    this.tell();
  }
  tell() { for (const listener of this.listeners) listener(); }
}

// Colours and strokes repeat after eight and three, so that 24 variants differ.
export function look(place) {
  return `colour${place % 8} stroke${Math.floor(place / 8) % 3}`;
}

// A button for each variant; `note(name)` is a text beside its name, asked anew by the returned function.
export function legend(shown, note = () => '') {
  const buttons = shown.names.map((name, i) => {
    const value = element('span', { class: 'note' });
    const swatch = element('span', { class: 'swatch', 'aria-hidden': 'true' });
    const button = element('button', { type: 'button', class: `key ${look(i)}`, 'data-variant': name,
      onclick: () => shown.toggle(name) }, swatch, element('span', {}, name), value);
    return { name, button, value };
  });
  const update = () => {
    for (const { name, button, value } of buttons) {
      button.setAttribute('aria-pressed', String(shown.has(name)));
      value.textContent = note(name);
    }
  };
  shown.listen(update);
  update();
  const all = element('button', { type: 'button', class: 'plain', onclick: () => shown.show_all(true) }, 'All');
  const none = element('button', { type: 'button', class: 'plain', onclick: () => shown.show_all(false) }, 'None');
  const root = element('div', { class: 'legend', role: 'group', 'aria-label': 'Variants shown' },
    element('span', {}, all, none), buttons.map((b) => b.button));
  return { root, update };
}
