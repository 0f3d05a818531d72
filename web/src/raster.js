// Paints triangles with linearly interpolated colours into the pixels of an ImageData.
// It needs no graphics card, prints, and is fast enough: see docs/decisions.

/**
 * pixels: Uint32Array of width x height; X, Y: pixel positions; V: values scaled to 0..255
 * (NaN = no data); tris: node triples; lut: 256 packed colours; none: colour for "no data".
 */
export function paint(pixels, width, height, X, Y, V, tris, lut, none) {
  for (let t = 0; t < tris.length; t += 3) {
    const a = tris[t];
    const b = tris[t + 1];
    const c = tris[t + 2];
    triangle(pixels, width, height, X[a], Y[a], V[a], X[b], Y[b], V[b], X[c], Y[c], V[c], lut, none);
  }
}

function triangle(pixels, width, height, x0, y0, v0, x1, y1, v1, x2, y2, v2, lut, none) {
  const area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
  if (!(area > 1e-12 || area < -1e-12)) return;
  const first = Math.max(0, Math.ceil(Math.min(y0, y1, y2) - 0.5));
  const last = Math.min(height - 1, Math.floor(Math.max(y0, y1, y2) - 0.5));
  const dvdx = ((v1 - v0) * (y2 - y0) - (v2 - v0) * (y1 - y0)) / area;
  const dvdy = ((v2 - v0) * (x1 - x0) - (v1 - v0) * (x2 - x0)) / area;
  const known = dvdx === dvdx && dvdy === dvdy;
  for (let row = first; row <= last; ++row) {
    const y = row + 0.5;
    let left = Infinity;
    let right = -Infinity;
    if (y0 <= y !== y1 <= y) {
      const x = x0 + ((y - y0) * (x1 - x0)) / (y1 - y0);
      if (x < left) left = x;
      if (x > right) right = x;
    }
    if (y1 <= y !== y2 <= y) {
      const x = x1 + ((y - y1) * (x2 - x1)) / (y2 - y1);
      if (x < left) left = x;
      if (x > right) right = x;
    }
    if (y2 <= y !== y0 <= y) {
      const x = x2 + ((y - y2) * (x0 - x2)) / (y0 - y2);
      if (x < left) left = x;
      if (x > right) right = x;
    }
    const from = Math.max(0, Math.ceil(left - 0.501));
    const to = Math.min(width - 1, Math.floor(right - 0.499));
    let at = row * width + from;
    if (!known) {
      for (let i = from; i <= to; ++i) pixels[at++] = none;
      continue;
    }
    let v = v0 + dvdx * (from + 0.5 - x0) + dvdy * (y - y0);
    for (let i = from; i <= to; ++i, v += dvdx) {
      pixels[at++] = lut[v <= 0 ? 0 : v >= 255 ? 255 : (v + 0.5) | 0];
    }
  }
}
