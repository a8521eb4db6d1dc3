// Images as the file carries them, back to halves, and halves to colours that a screen shows.
import { half, srgb_byte } from './numbers.js';

// What the writer did (core/lab/report_pixels.h), backwards: planes of low and high bytes to zigzag residuals, to
// values by the median predictor, to channels from their differences to green.
export function unpack(bytes, width, height, planes) {
  const size = width * height, out = new Uint16Array(size * planes);
  for (let p = 0; p < planes; ++p) {
    const low = p * size, high = planes * size + p * size;
    const plane = out.subarray(p * size, (p + 1) * size);
    for (let y = 0, i = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x, ++i) {
        const left = x ? plane[i - 1] : 0, up = y ? plane[i - width] : 0, corner = x && y ? plane[i - width - 1] : 0;
        const least = Math.min(left, up), most = Math.max(left, up);
        const guess = corner >= most ? least : corner <= least ? most : left + up - corner;
        const code = bytes[low + i] | (bytes[high + i] << 8);
        plane[i] = guess + ((code >> 1) ^ -(code & 1));
      }
    }
  }
  if (planes === 3) {
    for (let i = 0; i < size; ++i) {
      out[i] += out[size + i];
      out[2 * size + i] += out[size + i];
    }
  }
  return out;
}

async function inflated(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// From dark to light, evenly bright to the eye: nine colours of matplotlib's magma, straight between them.
const MAGMA = [[0, 0, 4], [28, 16, 68], [79, 18, 123], [129, 37, 129], [181, 54, 122], [229, 89, 100],
  [251, 135, 97], [254, 194, 135], [252, 253, 191]];

export function map_colour(share) {
  const at = Math.max(0, Math.min(1, share)) * (MAGMA.length - 1), i = Math.min(MAGMA.length - 2, Math.floor(at));
  return MAGMA[i].map((c, k) => Math.round(c + (MAGMA[i + 1][k] - c) * (at - i)));
}

// How halves become colours: the exposure in stops, and for error maps the values at the ends of the colours.
export class Tone {
  constructor(stops, low, high) {
    this.stops = stops;
    this.low = low;
    this.high = low + (high - low) * 2 ** -stops;
    this.name = `${stops} ${low} ${high}`;
  }
  // Of each half the byte of its channel.
  get bytes() {
    this.bytes_ ??= Uint8Array.from(half, (v) => srgb_byte(v * 2 ** this.stops));
    return this.bytes_;
  }
  // Of each half its colour in a map, as three bytes.
  get colours() {
    if (!this.colours_) {
      this.colours_ = new Uint8Array(3 * 65536);
      for (let i = 0; i < 65536; ++i) {
        const share = (half[i] - this.low) / (this.high - this.low);
        this.colours_.set(map_colour(Number.isNaN(share) ? 0 : share), 3 * i);
      }
    }
    return this.colours_;
  }
}

export class Picture {
  constructor(entry, halves) {
    this.width = entry.width;
    this.height = entry.height;
    this.planes = entry.planes;
    this.halves = halves;
  }
  // The values at a pixel, one a plane.
  at(x, y) {
    return Array.from({ length: this.planes }, (_, p) =>
      half[this.halves[(p * this.height + y) * this.width + x]]);
  }
  // A canvas of the image's own size, painted anew only when the tone has changed.
  painted(tone) {
    if (this.tone === tone.name) return this.canvas;
    this.canvas ??= Object.assign(document.createElement('canvas'), { width: this.width, height: this.height });
    const context = this.canvas.getContext('2d'), size = this.width * this.height;
    const image = context.createImageData(this.width, this.height), to = image.data, from = this.halves;
    if (this.planes === 3) {
      const bytes = tone.bytes;
      for (let i = 0, k = 0; i < size; ++i, k += 4) {
        to[k] = bytes[from[i]];
        to[k + 1] = bytes[from[size + i]];
        to[k + 2] = bytes[from[2 * size + i]];
        to[k + 3] = 255;
      }
    } else {
      const colours = tone.colours;
      for (let i = 0, k = 0; i < size; ++i, k += 4) {
        const c = 3 * from[i];
        to[k] = colours[c];
        to[k + 1] = colours[c + 1];
        to[k + 2] = colours[c + 2];
        to[k + 3] = 255;
      }
    }
    context.putImageData(image, 0, 0);
    this.tone = tone.name;
    return this.canvas;
  }
}

// Decoded pictures, as many as fit; those used longest ago go first.
const BUDGET = 256e6;
const decoded = new Map();
let held = 0;

export function picture_of(entry) {
  let known = decoded.get(entry.id);
  if (known) {
    decoded.delete(entry.id);
  } else {
    const text = document.getElementById(entry.id).textContent;
    known = inflated(text).then((bytes) => new Picture(entry, unpack(bytes, entry.width, entry.height, entry.planes)));
    held += bytes_of(entry);
    for (const [id, { entry: old }] of decoded) {
      if (held <= BUDGET) break;
      decoded.delete(id);
      held -= bytes_of(old);
    }
    known = { entry, promise: known };
  }
  decoded.set(entry.id, known);
  return known.promise;
}

// Halves and the canvas.
function bytes_of(entry) {
  return entry.width * entry.height * (2 * entry.planes + 4);
}
