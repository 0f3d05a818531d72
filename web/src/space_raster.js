// Paints shaded triangles and lines with a depth buffer into the pixels of an ImageData. No
// graphics card is needed: see docs/decisions/report-view.md.

/** What is painted into: pixels and, for each, how near it is (larger Z is nearer). */
export function target(width, height, pixels) {
  return { width, height, pixels, depth: new Float32Array(width * height) };
}

export function clear(t) {
  t.pixels.fill(0);
  t.depth.fill(-Infinity);
}

/**
 * The triangle of points a, b, c with interpolated values. `luts`: 256 packed colours for the
 * triangle's brightness; a value that is NaN is painted `none`. With `D` what lies before a cut
 * (D > 0) is left out.
 */
export function triangle(t, { X, Y, Z, V, D }, a, b, c, lut, none) {
  if (D && D[a] > 0 && D[b] > 0 && D[c] > 0) return;
  const area = (X[b] - X[a]) * (Y[c] - Y[a]) - (X[c] - X[a]) * (Y[b] - Y[a]);
  if (!(area > 1e-9 || area < -1e-9)) return;
  const top = Math.max(0, Math.ceil(Math.min(Y[a], Y[b], Y[c]) - 0.5));
  const bottom = Math.min(t.height - 1, Math.floor(Math.max(Y[a], Y[b], Y[c]) - 0.5));
  const slope = (F) => [
    ((F[b] - F[a]) * (Y[c] - Y[a]) - (F[c] - F[a]) * (Y[b] - Y[a])) / area,
    ((F[c] - F[a]) * (X[b] - X[a]) - (F[b] - F[a]) * (X[c] - X[a])) / area];
  const [zx, zy] = slope(Z);
  const [vx, vy] = slope(V);
  const [dx, dy] = D ? slope(D) : [0, 0];
  const known = vx === vx && vy === vy;
  for (let row = top; row <= bottom; ++row) {
    const y = row + 0.5;
    const [left, right] = span(X, Y, a, b, c, y);
    const from = Math.max(0, Math.ceil(left - 0.501));
    const to = Math.min(t.width - 1, Math.floor(right - 0.499));
    let at = row * t.width + from;
    let z = Z[a] + zx * (from + 0.5 - X[a]) + zy * (y - Y[a]);
    let v = V[a] + vx * (from + 0.5 - X[a]) + vy * (y - Y[a]);
    let d = D ? D[a] + dx * (from + 0.5 - X[a]) + dy * (y - Y[a]) : 0;
    for (let i = from; i <= to; ++i, ++at, z += zx, v += vx, d += dx) {
      if (z <= t.depth[at] || d > 0) continue;
      t.depth[at] = z;
      t.pixels[at] = known ? lut[v <= 0 ? 0 : v >= 255 ? 255 : (v + 0.5) | 0] : none;
    }
  }
}

/** Where the row y crosses the triangle. */
function span(X, Y, a, b, c, y) {
  let left = Infinity;
  let right = -Infinity;
  const cross = (p, q) => {
    if ((Y[p] <= y) === (Y[q] <= y)) return;
    const x = X[p] + ((y - Y[p]) * (X[q] - X[p])) / (Y[q] - Y[p]);
    if (x < left) left = x;
    if (x > right) right = x;
  };
  cross(a, b);
  cross(b, c);
  cross(c, a);
  return [left, right];
}

/** Mixes what is in front of the picture into it. */
export function overlay(t, front, alpha) {
  for (let at = 0; at < t.pixels.length; ++at) {
    if (!(front.depth[at] > t.depth[at])) continue;
    const [under, over] = [t.pixels[at], front.pixels[at]];
    if (!under) {
      t.pixels[at] = ((over & 0xffffff) | (Math.round(255 * alpha) << 24)) >>> 0;
      continue;
    }
    const mix = (shift) => (((under >>> shift) & 255) * (1 - alpha) + ((over >>> shift) & 255) * alpha) << shift;
    t.pixels[at] = ((255 << 24) | (mix(16) & 0xff0000) | (mix(8) & 0xff00) | (mix(0) & 0xff)) >>> 0;
  }
}

/** Whether a pixel that was painted is dark. */
const dark = (pixel) => pixel !== 0 && 0.3 * (pixel & 255) + 0.6 * ((pixel >>> 8) & 255) + 0.1 * ((pixel >>> 16) & 255) < 75;

/**
 * A line one pixel wide where nothing is nearer by more than `bias`, mixed with what is there: black
 * on bright colours, white on dark ones; `faces` are the pixels without lines.
 */
export function line(t, faces, { X, Y, Z, D }, a, b, alpha, bias) {
  const steps = Math.ceil(Math.max(Math.abs(X[b] - X[a]), Math.abs(Y[b] - Y[a]), 1));
  if (!(steps < 20000)) return;
  for (let i = 0; i <= steps; ++i) {
    const s = i / steps;
    const x = Math.floor(X[a] + s * (X[b] - X[a]));
    const y = Math.floor(Y[a] + s * (Y[b] - Y[a]));
    if (x < 0 || y < 0 || x >= t.width || y >= t.height) continue;
    const at = y * t.width + x;
    if (Z[a] + s * (Z[b] - Z[a]) + bias < t.depth[at]) continue;
    if (D && D[a] + s * (D[b] - D[a]) > 0) continue;
    const old = t.pixels[at];
    const [red, green, blue] = dark(faces[at]) ? [226, 231, 238] : [20, 26, 34];
    const mix = (from, shift) => (((old >>> shift) & 255) * (1 - alpha) + from * alpha) << shift;
    t.pixels[at] = ((255 << 24) | (mix(blue, 16) & 0xff0000) | (mix(green, 8) & 0xff00) | (mix(red, 0) & 0xff)) >>> 0;
  }
}
