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
  // What is at `from`, shares of the pane, comes to stand at `to`, magnified by `factor`, as far as the image reaches.
  carry(from, to, factor = 1) {
    const zoom = Math.max(1, Math.min(MOST, this.zoom * factor)), edge = 0.5 / zoom;
    const within = (middle) => Math.max(edge, Math.min(1 - edge, middle));
    this.x = within(this.x + (from[0] - 0.5) / this.zoom - (to[0] - 0.5) / zoom);
    this.y = within(this.y + (from[1] - 0.5) / this.zoom - (to[1] - 0.5) / zoom);
    this.zoom = zoom;
    this.tell();
  }
  // By shares of the pane.
  pan(right, down) { this.carry([0.5 + right, 0.5 + down], [0.5, 0.5]); }
  zoom_at(place, factor) { this.carry(place, place, factor); }
  zoom_in() { this.zoom_at([0.5, 0.5], STEP); }
  zoom_out() { this.zoom_at([0.5, 0.5], 1 / STEP); }
  fit() { this.zoom_at([0.5, 0.5], 1 / MOST); }
  read(pixel) {
    if (String(pixel) === String(this.pixel)) return;
    this.pixel = pixel;
    this.tell();
  }
}
