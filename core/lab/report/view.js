// The part of the image that all panes show, and the pixel that all read out: one state, moved from any pane.

const STEP = Math.SQRT2, MOST = 64;

export class View {
  constructor() {
    this.zoom = 1;    // 1: the whole image
    this.x = 0.5;     // what stands in the middle, as a share of the image's size
    this.y = 0.5;
    this.pixel = null;  // [x, y]
    this.listeners = [];
  }
  listen(listener) { this.listeners.push(listener); }
  tell() { for (const listener of this.listeners) listener(); }
  move(x, y, zoom = this.zoom) {
    this.zoom = Math.max(1, Math.min(MOST, zoom));
    const edge = 0.5 / this.zoom;
    this.x = Math.max(edge, Math.min(1 - edge, x));
    this.y = Math.max(edge, Math.min(1 - edge, y));
    this.tell();
  }
  pan(dx, dy) { this.move(this.x + dx, this.y + dy); }
  // What is at (u, v), shares of the pane, stays there.
  zoom_at(u, v, factor) {
    const zoom = Math.max(1, Math.min(MOST, this.zoom * factor));
    const x = this.x + (u - 0.5) / this.zoom, y = this.y + (v - 0.5) / this.zoom;
    this.move(x - (u - 0.5) / zoom, y - (v - 0.5) / zoom, zoom);
  }
  zoom_in() { this.zoom_at(0.5, 0.5, STEP); }
  zoom_out() { this.zoom_at(0.5, 0.5, 1 / STEP); }
  fit() { this.move(0.5, 0.5, 1); }
  read(pixel) {
    if (String(pixel) === String(this.pixel)) return;
    this.pixel = pixel;
    this.tell();
  }
}

const KEYS = {
  '+': (v) => v.zoom_in(), '=': (v) => v.zoom_in(), '-': (v) => v.zoom_out(), '0': (v) => v.fit(),
  ArrowLeft: (v) => v.pan(-0.1 / v.zoom, 0), ArrowRight: (v) => v.pan(0.1 / v.zoom, 0),
  ArrowUp: (v) => v.pan(0, -0.1 / v.zoom), ArrowDown: (v) => v.pan(0, 0.1 / v.zoom),
};

// Pointer, pinch, wheel and keys on a pane move the view. The wheel scrolls the page until the pane was clicked or
// tabbed to, so that a page full of panes can be scrolled past.
export function steer(canvas, view, pixel_at) {
  const down = new Map();
  const share = (event) => {
    const r = canvas.getBoundingClientRect();
    return [(event.clientX - r.left) / r.width, (event.clientY - r.top) / r.height];
  };
  canvas.addEventListener('pointerdown', (event) => {
    down.set(event.pointerId, share(event));
    canvas.setPointerCapture(event.pointerId);
    view.read(pixel_at(...share(event)));
  });
  canvas.addEventListener('pointermove', (event) => {
    const now = share(event), before = down.get(event.pointerId);
    if (!before) {
      if (event.pointerType === 'mouse') view.read(pixel_at(...now));
      return;
    }
    if (down.size === 2) {
      const [other] = [...down].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      const length = (a) => Math.hypot(a[0] - other[0], a[1] - other[1]) || 1e-6;
      view.zoom_at((now[0] + other[0]) / 2, (now[1] + other[1]) / 2, length(now) / length(before));
    }
    view.pan((before[0] - now[0]) / view.zoom / down.size, (before[1] - now[1]) / view.zoom / down.size);
    down.set(event.pointerId, now);
  });
  for (const end of ['pointerup', 'pointercancel']) {
    canvas.addEventListener(end, (event) => down.delete(event.pointerId));
  }
  canvas.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && document.activeElement !== canvas) return;
    event.preventDefault();
    view.zoom_at(...share(event), Math.exp(-event.deltaY / 300));
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || !KEYS[event.key]) return;
    event.preventDefault();
    KEYS[event.key](view);
  });
}
