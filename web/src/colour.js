// Colour maps that are perceptually uniform by construction: paths in the OKLab space
// (B. Ottosson, 2020), walked at constant speed.

function oklabToRgb(L, a, b) {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
}

/** The OKLab point of lightness, chroma and hue (degrees), chroma reduced until sRGB holds it. */
function inGamut(L, chroma, hue) {
  const angle = (hue * Math.PI) / 180;
  let c = chroma;
  for (;;) {
    const lab = [L, c * Math.cos(angle), c * Math.sin(angle)];
    if (c < 1e-3 || oklabToRgb(...lab).every((v) => v >= -1e-4 && v <= 1.0001)) return lab;
    c -= 0.004;
  }
}

function toByte(linear) {
  const v = Math.min(1, Math.max(0, linear));
  return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
}

/** Rounds the corners that staying within sRGB leaves (they would show as lines in a field). */
function smoothed(points, reach) {
  if (!reach) return points;
  let list = points;
  for (let pass = 0; pass < 2; ++pass) {
    const before = list;
    list = before.map((_, i) => {
      const r = Math.min(reach, i, before.length - 1 - i);
      const sum = [0, 0, 0];
      for (let j = i - r; j <= i + r; ++j) before[j].forEach((v, c) => { sum[c] += v; });
      return sum.map((v) => v / (2 * r + 1));
    });
  }
  return list;
}

/** 256 colours [r, g, b] along `path(t)` (OKLab), equally spaced in perceived difference. */
function uniform(path, smoothing) {
  const fine = 512;
  const points = smoothed(Array.from({ length: fine + 1 }, (_, i) => path(i / fine)), smoothing);
  const length = [0];
  for (let i = 1; i <= fine; ++i) {
    const step = Math.hypot(...points[i].map((v, k) => v - points[i - 1][k]));
    length.push(length[i - 1] + step);
  }
  const map = [];
  for (let k = 0, i = 0; k < 256; ++k) {
    const wanted = (length[fine] * k) / 255;
    while (i < fine - 1 && length[i + 1] < wanted) ++i;
    const t = (wanted - length[i]) / (length[i + 1] - length[i]);
    const lab = points[i].map((v, c) => v + t * (points[i + 1][c] - v));
    map.push(oklabToRgb(...lab).map(toByte));
  }
  return map;
}

const paths = {
  sequential: (t) => inGamut(0.37 + 0.56 * t, 0.14 + 0.03 * t, 300 - 200 * t),
  diverging: (t) => {
    const side = Math.abs(2 * t - 1);
    return inGamut(0.96 - 0.51 * side, 0.19 * side, t < 0.5 ? 255 : 28);
  },
};

const cache = {};

/** 256 [r, g, b] of `sequential` or `diverging`; `bands` > 0 gives that many flat colours. */
export function colourMap(name, bands = 0) {
  const key = `${name}/${bands}`;
  if (!cache[key]) {
    const smooth = (cache[`${name}/0`] ??= uniform(paths[name], name === 'sequential' ? 48 : 0));
    cache[key] = bands ? smooth.map((_, i) => {
      const band = Math.min(bands - 1, Math.floor((i / 256) * bands));
      return smooth[Math.round((band / (bands - 1)) * 255)];
    }) : smooth;
  }
  return cache[key];
}

/** The map as packed pixels of a little-endian ImageData. */
export function packed(map) {
  return Uint32Array.from(map, ([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0);
}

export function cssColour([r, g, b]) {
  return `rgb(${r},${g},${b})`;
}
