// Fingers, mouse, wheel and keys on a pane move the view of all panes.

const KEYS = {
  '+': (v) => v.zoom_in(), '=': (v) => v.zoom_in(), '-': (v) => v.zoom_out(), '0': (v) => v.fit(),
  ArrowLeft: (v) => v.pan(-0.1, 0), ArrowRight: (v) => v.pan(0.1, 0),
  ArrowUp: (v) => v.pan(0, -0.1), ArrowDown: (v) => v.pan(0, 0.1),
};

const TREMBLE = 8;  // CSS pixels that a finger may move and still have tapped

// `surface` is what is touched: the pane's canvas, or what holds it and handles on it. A pointer that goes down on a
// handle drags what `pane.grab` returns for it; a second finger makes a pinch of any two, wherever they are.
export function steer(surface, pane) {
  const { canvas, view } = pane, down = new Map();
  let held = null, tap = null;
  const share = ([x, y]) => {
    const r = canvas.getBoundingClientRect();
    return [(x - r.left) / r.width, (y - r.top) / r.height];
  };
  const place = (event) => [event.clientX, event.clientY];
  const read = (at) => view.read(pane.pixel_at(...share(at)));
  const length = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]) || 1;
  const middle = (a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];

  surface.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    surface.setPointerCapture(event.pointerId);
    down.set(event.pointerId, place(event));
    held = down.size === 1 ? pane.grab?.(event.target, share(place(event))[0]) : null;
    tap = down.size === 1 && !held ? place(event) : null;
    if (tap && event.pointerType !== 'touch') read(tap);
  });
  surface.addEventListener('pointermove', (event) => {
    const before = down.get(event.pointerId), now = place(event);
    if (!before) {
      if (event.pointerType !== 'touch' && event.target === canvas) read(now);
      return;
    }
    if (tap && length(tap, now) > TREMBLE) tap = null;
    const fingers = [...down.keys()].slice(0, 2);
    const other = down.get(fingers.find((id) => id !== event.pointerId));
    if (held) held(share(now)[0]);
    else if (!other) view.carry(share(before), share(now));
    // What is between the fingers stays there, as large as they are apart.
    else if (fingers.includes(event.pointerId)) {
      view.carry(share(middle(before, other)), share(middle(now, other)), length(now, other) / length(before, other));
    }
    down.set(event.pointerId, now);
  });
  // A finger reads where it taps: where it goes down, it may be about to scroll.
  surface.addEventListener('pointerup', (event) => {
    if (tap && event.pointerType === 'touch') read(tap);
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) {
    surface.addEventListener(end, (event) => {
      if (down.delete(event.pointerId)) held = tap = null;
    });
  }

  // The wheel scrolls the page until the pane was clicked or tabbed to, so that a page full of panes can be scrolled past.
  surface.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !surface.contains(document.activeElement)) return;
    event.preventDefault();
    view.zoom_at(share(place(event)), Math.exp(-event.deltaY / 300));
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === 'Escape') {
      view.read(null);
      canvas.blur();
    } else if (KEYS[event.key]) {
      event.preventDefault();
      KEYS[event.key](view);
    }
  });
}
