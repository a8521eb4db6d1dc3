// A canvas that shows a picture, or two with a divider between them, through the common view.
import { element } from './element.js';

export class Pane {
  constructor(view, label) {
    this.view = view;
    this.pictures = [];  // one, or left and right of the divider; undefined where a frame has none
    this.split = 0.5;    // share of the pane that is left of the divider
    this.canvas = element('canvas', { tabindex: '0', role: 'img', 'aria-label': label, 'aria-describedby': 'steering' });
    this.late = null;    // what is to be done once the pane comes near
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    this.nearing = new IntersectionObserver((entries) => {
      if (!entries.at(-1).isIntersecting || !this.late) return;
      const work = this.late;
      this.late = null;
      work();
    }, { rootMargin: '50%' });
  }

  get picture() { return this.pictures.find(Boolean); }

  // Whether it is in view, or would be after scrolling by half a window. A little more than the observer's margin, so
  // that what it calls near is near here too.
  get near() {
    const r = this.canvas.getBoundingClientRect(), more = 0.6 * innerHeight;
    return r.width > 0 && r.bottom > -more && r.top < innerHeight + more;
  }

  // Dozens of panes are slow to fill and few of them are looked at, so those far from view wait.
  when_near(work) {
    this.late = work;
    this.nearing.disconnect();
    this.nearing.observe(this.canvas);  // tells where the pane is now, and when that changes
  }

  // What the pane will show, before it is decoded: nothing moves when it comes.
  shape(width, height) { this.canvas.style.aspectRatio = `${width} / ${height}`; }

  // The pixel under a place in the pane; null beside the image.
  pixel_at(u, v) {
    const { picture } = this;
    if (!picture) return null;
    const x = Math.floor((this.view.x + (u - 0.5) / this.view.zoom) * picture.width);
    const y = Math.floor((this.view.y + (v - 0.5) / this.view.zoom) * picture.height);
    return x >= 0 && y >= 0 && x < picture.width && y < picture.height ? [x, y] : null;
  }

  show(pictures, tone) {
    this.pictures = pictures;
    this.tone = tone;
    this.draw();
  }

  draw() {
    if (!this.near) {
      if (!this.late) this.when_near(() => this.draw());
      return;
    }
    const density = window.devicePixelRatio || 1;
    const width = Math.round(this.canvas.clientWidth * density), height = Math.round(this.canvas.clientHeight * density);
    if (!width || !height) return;
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    // A finger scrolls the page until there is something to pan.
    this.canvas.style.touchAction = this.view.zoom > 1 ? 'none' : 'pan-y';
    const context = this.canvas.getContext('2d');
    context.clearRect(0, 0, width, height);
    if (!this.picture) return;
    const draw_one = (picture, from, to) => {
      if (!picture) return;
      const scale = width / picture.width * this.view.zoom;
      context.save();
      context.beginPath();
      context.rect(from, 0, to - from, height);
      context.clip();
      context.imageSmoothingEnabled = scale < 1;
      context.imageSmoothingQuality = 'high';
      context.drawImage(picture.painted(this.tone), width / 2 - this.view.x * width * this.view.zoom,
        height / 2 - this.view.y * height * this.view.zoom, width * this.view.zoom, height * this.view.zoom);
      context.restore();
    };
    const divider = this.pictures.length > 1 ? Math.round(this.split * width) : width;
    draw_one(this.pictures[0], 0, divider);
    draw_one(this.pictures[1], divider, width);
    this.draw_mark(context, this.picture, width, height, density);
  }

  // A frame around the pixel that is read out, at least eight dots wide, dark and light to show on all.
  draw_mark(context, picture, width, height, density) {
    if (!this.view.pixel) return;
    const scale = width / picture.width * this.view.zoom, size = Math.max(scale, 8 * density);
    const [x, y] = this.view.pixel;
    const left = (x + 0.5 - this.view.x * picture.width) * scale + width / 2 - size / 2;
    const top = (y + 0.5 - this.view.y * picture.height) * scale + height / 2 - size / 2;
    context.lineWidth = density;
    context.strokeStyle = '#000';
    context.strokeRect(left - 1.5 * density, top - 1.5 * density, size + 3 * density, size + 3 * density);
    context.strokeStyle = '#fff';
    context.strokeRect(left - 0.5 * density, top - 0.5 * density, size + density, size + density);
  }
}
