// Numbers as people read them, and halves as numbers.

// Four significant digits; plain between 0.0001 and a million.
export function number_text(value) {
  if (value === null || value === undefined) return '–';
  const size = Math.abs(value);
  if (size === 0) return '0';
  if (!(size >= 1e-4 && size < 1e6)) return value.toExponential(3);
  return value.toFixed(Math.max(0, 3 - Math.floor(Math.log10(size))));
}

// What a value is beside another: a share where both are sizes, else, as for logarithms, a difference.
export function beside(value, other, unit) {
  if (value === null || value === undefined || other === null || other === undefined) return '';
  const signed = (x, text) => (x > 0 ? '+' : x < 0 ? '−' : '') + text(Math.abs(x));
  if (unit === 'dB') return `${signed(value - other, (x) => x.toFixed(2))} dB`;
  // Estimates without bias may be negative: a share of those says nothing.
  if (!(value >= 0 && other > 0)) return signed(value - other, number_text) + (unit ? ` ${unit}` : '');
  const percent = (value / other - 1) * 100;
  if (percent >= 1000) return `×${number_text(value / other)}`;
  return `${signed(percent, (x) => x.toFixed(x < 10 ? 1 : 0))} %`;
}

export function bytes(count) {
  if (count < 1e3) return `${count} B`;
  return count < 1e6 ? `${(count / 1e3).toFixed(0)} kB` : `${(count / 1e6).toFixed(1)} MB`;
}

// The value of each of the 65536 halves.
export const half = new Float32Array(65536);
for (let bits = 0; bits < 65536; ++bits) {
  const exponent = (bits >> 10) & 31, fraction = bits & 1023;
  const size = exponent === 0 ? fraction * 2 ** -24
    : exponent === 31 ? (fraction ? NaN : Infinity) : (1 + fraction / 1024) * 2 ** (exponent - 15);
  half[bits] = bits & 0x8000 ? -size : size;
}

// IEC 61966-2-1, from linear in 0…1 to a byte.
export function srgb_byte(linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  return Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
}
