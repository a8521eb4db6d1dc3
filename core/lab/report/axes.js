// Scales, ticks and the frame of a plot, drawn at the width that there is so that text keeps its size.
import { drawn } from './element.js';

// The least and the greatest; a plot may have more values than a function takes arguments.
export function span_of(values) {
  return values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
}

// Whether values are told apart only by their logarithm: positive, and over more than a decade.
export function wants_log(values) {
  const [low, high] = span_of(values);
  return low > 0 && high > 10 * low;
}

// Round steps of 1, 2 or 5 times a power of ten.
export function linear_ticks(low, high, count) {
  const span = high - low || Math.abs(high) || 1;
  const power = 10 ** Math.floor(Math.log10(span / count));
  const step = power * [1, 2, 5, 10].find((s) => span / (power * s) <= count);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) ticks.push(Number((i * step).toPrecision(12)));
  return ticks;
}

// Powers of ten, and between them 2 and 5 where there is room.
export function log_ticks(low, high) {
  const ticks = [];
  const wide = Math.log10(high / low) > 4;
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e) {
    for (const m of wide ? [1] : [1, 2, 5]) {
      const tick = Number(`${m}e${e}`);
      if (tick >= low * 0.999 && tick <= high * 1.001) ticks.push(tick);
    }
  }
  return ticks;
}

// From values to pixels; `log` is heeded where all values are positive.
export function scale(values, from, to, log) {
  let [low, high] = values.length ? span_of(values) : [1, 10];
  if (log && low > 0) {
    const room = (high / low) ** 0.06 * 1.02;
    [low, high] = [low / room, high * room];
    const at = (v) => from + (to - from) * Math.log(v / low) / Math.log(high / low);
    return { at, ticks: log_ticks(low, high), low, high };
  }
  const room = (high - low) * 0.06 || Math.abs(high) * 0.1 || 1;
  [low, high] = [low < 0 || low - room > 0 ? low - room : 0, high + room];
  const at = (v) => from + (to - from) * (v - low) / (high - low);
  return { at, ticks: linear_ticks(low, high, Math.abs(to - from) < 320 ? 4 : 7), low, high };
}

export function tick_text(value) {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return value.toExponential().replace('e+', 'e');
  return String(value);
}

// Grid, ticks and titles. `box` is { left, top, right, bottom }.
export function axes(box, x, y, x_title, y_title) {
  const grid = drawn('g', { class: 'axes' });
  for (const tick of y.ticks) {
    grid.append(drawn('line', { x1: box.left, x2: box.right, y1: y.at(tick), y2: y.at(tick) }),
      drawn('text', { class: 'y', x: box.left - 6, y: y.at(tick) + 4 }, tick_text(tick)));
  }
  for (const tick of x.ticks) {
    grid.append(drawn('line', { x1: x.at(tick), x2: x.at(tick), y1: box.top, y2: box.bottom }),
      drawn('text', { class: 'x', x: x.at(tick), y: box.bottom + 17 }, tick_text(tick)));
  }
  grid.append(drawn('text', { class: 'x title', x: (box.left + box.right) / 2, y: box.bottom + 36 }, x_title),
    drawn('text', { class: 'title', x: 2, y: 13 }, y_title));
  return grid;
}

// Calls draw(width) now and whenever the width of `frame` changes.
export function at_width(frame, draw) {
  let width = 0;
  const again = () => draw(Math.max(260, width));
  new ResizeObserver(([entry]) => {
    const now = Math.floor(entry.contentRect.width);
    if (now === width || now === 0) return;
    width = now;
    again();
  }).observe(frame);
  return again;
}
