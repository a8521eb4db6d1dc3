// The handle between before and after: dragged, or moved by keys.
import { element } from './element.js';

export function divider(pane) {
  const handle = element('div', { class: 'divider', role: 'slider', tabindex: '0', 'aria-orientation': 'horizontal',
    'aria-label': 'Divider between before and after', 'aria-valuemin': '0', 'aria-valuemax': '100' },
  element('span', { 'aria-hidden': 'true' }, '◂▸'));
  const move = (split) => {
    pane.split = Math.max(0, Math.min(1, split));
    handle.style.left = `${100 * pane.split}%`;
    handle.setAttribute('aria-valuenow', Math.round(100 * pane.split));
    handle.setAttribute('aria-valuetext', `${Math.round(100 * pane.split)} % before`);
    pane.draw();
  };
  // Where the handle was taken it stays under the pointer.
  pane.grab = (target, from) => {
    if (!handle.contains(target)) return null;
    handle.focus({ preventScroll: true });
    const off = from - pane.split;
    return (to) => move(to - off);
  };
  handle.addEventListener('keydown', (event) => {
    const step = event.shiftKey ? 0.1 : 0.02;
    const to = { ArrowLeft: pane.split - step, ArrowDown: pane.split - step, ArrowRight: pane.split + step,
      ArrowUp: pane.split + step, PageDown: pane.split - 0.1, PageUp: pane.split + 0.1, Home: 0, End: 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    move(to);
  });
  move(pane.split);
  return handle;
}
