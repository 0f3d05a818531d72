// The faces of deformed bodies in space on a canvas: orthographic, shaded, coloured by a field.
import { BAR, someFrames } from './camera.js';
import { visible } from './bodies.js';
import { colourMap } from './colour.js';
import { distances, section } from './cut.js';
import { drawLabels, nodeNumber } from './labels.js';
import { num } from './format.js';
import { chains, fillVirtual } from './mesh.js';
import { clear, line, overlay, target, triangle } from './space_raster.js';
import { css } from './theme.js';
import { colourBar, colourRange, scaleBar } from './view.js';

const levels = 24; // of brightness

export function createSpaceView(canvas, body) {
  const { total } = body.topo;
  const array = () => new Float32Array(total);
  return {
    canvas, body, ctx: canvas.getContext('2d'),
    x: [array(), array(), array()], // deformed coordinates
    X: array(), Y: array(), Z: array(), V: array(), // pixels, depth, value as 0..255
    azimuth: -0.9, elevation: 0.45, centre: [0, 0, 0], px: 0, py: 0, k: 1, dpr: 1, W: 0, H: 0,
  };
}

/** Sizes the canvas in CSS pixels. */
export function resizeSpace(view, width, height) {
  view.dpr = Math.min(2, devicePixelRatio || 1);
  const W = Math.round(width * view.dpr);
  const H = Math.round(height * view.dpr);
  if (W === view.W && H === view.H) return;
  const image = new ImageData(W, H);
  Object.assign(view, { W, H, image, front: null, target: target(W, H, new Uint32Array(image.data.buffer)) });
  Object.assign(view.canvas, { width: W, height: H });
  view.canvas.style.height = `${height}px`;
}

/** Rows of the rotation: to the right, upwards, towards the eye. z is up. */
function axes({ azimuth, elevation }) {
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
  return [[-sa, ca, 0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
}

/** The direction towards the eye. */
export const towardsEye = (view) => axes(view)[2];

/** Turns the picture by a drag of so many pixels. */
export function turn(view, dx, dy) {
  view.moved = true;
  view.azimuth -= (0.008 * dx) / view.dpr;
  view.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, view.elevation + (0.008 * dy) / view.dpr));
}

export function look(view, azimuth, elevation) {
  Object.assign(view, { azimuth, elevation });
}

export function shift(view, dx, dy) {
  view.moved = true;
  view.px += dx;
  view.py += dy;
}

export function zoomSpace(view, factor, px = view.W / 2, py = view.H / 2) {
  view.moved = true;
  view.px = px - view.W / 2 - factor * (px - view.W / 2 - view.px);
  view.py = py - view.H / 2 - factor * (py - view.H / 2 - view.py);
  view.k *= factor;
}

/** Shows all that is no endless surface, wherever it is in (up to 41 of) all frames, with room for the colour bar. */
export function fitSpace(view, state) {
  view.moved = false;
  const rows = axes(view);
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const box = { low: [...low], high: [...high] };
  const { points, frames, whole } = view.body;
  for (const f of someFrames(frames.length)) {
    const u = frames[f].u();
    for (const i of whole) {
      const p = [0, 1, 2].map((k) => points[3 * i + k] + state.scale * u[3 * i + k]);
      p.forEach((v, k) => {
        low[k] = Math.min(low[k], v);
        high[k] = Math.max(high[k], v);
      });
      rows.forEach((row, k) => {
        const v = row[0] * p[0] + row[1] * p[1] + row[2] * p[2];
        box.low[k] = Math.min(box.low[k], v);
        box.high[k] = Math.max(box.high[k], v);
      });
    }
  }
  if (!(low[0] <= high[0])) return;
  view.centre = low.map((v, k) => (v + high[k]) / 2);
  const free = view.W - BAR * view.dpr;
  const size = Math.max(view.body.size, 1e-300);
  view.k = Math.min((free * 0.86) / Math.max(box.high[0] - box.low[0], 1e-3 * size),
    (view.H * 0.8) / Math.max(box.high[1] - box.low[1], 1e-3 * size));
  const middle = rows.map((row) => row.reduce((s, v, k) => s + v * view.centre[k], 0));
  view.px = (middle[0] - (box.low[0] + box.high[0]) / 2) * view.k - (BAR * view.dpr) / 2;
  view.py = ((box.low[1] + box.high[1]) / 2 - middle[1]) * view.k;
}

function deform(view, frame, scale) {
  const { body, x } = view;
  const u = body.frames[frame].u();
  for (let k = 0; k < 3; ++k) {
    for (let i = 0; i < body.n; ++i) x[k][i] = body.points[3 * i + k] + scale * u[3 * i + k];
    fillVirtual(body.topo, x[k]);
  }
}

function project(view) {
  const { X, Y, Z, x, centre: c } = view;
  const [right, up, near] = axes(view);
  const along = (row, i) => row[0] * (x[0][i] - c[0]) + row[1] * (x[1][i] - c[1]) + row[2] * (x[2][i] - c[2]);
  for (let i = 0; i < X.length; ++i) {
    X[i] = view.W / 2 + view.px + view.k * along(right, i);
    Y[i] = view.H / 2 + view.py - view.k * along(up, i);
    Z[i] = view.k * along(near, i);
  }
}

/** The colour map at each level of brightness, packed. */
function shades(map) {
  return Array.from({ length: levels }, (_, s) => {
    const bright = 0.62 + (0.38 * s) / (levels - 1);
    return Uint32Array.from(map, (rgb) => {
      const [r, g, b] = rgb.map((v) => Math.round(v * bright));
      return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
    });
  });
}

/** Brightness level of a triangle: how much it faces a lamp beside the eye. Both sides count. */
function levelOf({ X, Y, Z }, a, b, c) {
  const u = [X[b] - X[a], Y[a] - Y[b], Z[b] - Z[a]];
  const v = [X[c] - X[a], Y[a] - Y[c], Z[c] - Z[a]];
  const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const size = Math.hypot(...n) || 1;
  const towards = n[2] < 0 ? -1 : 1;
  const light = (towards * (-0.35 * n[0] + 0.45 * n[1] + 0.82 * n[2])) / size;
  return Math.max(0, Math.min(levels - 1, Math.round(light * (levels - 1))));
}

export function drawSpace(view, state) {
  if (!view.W) return;
  deform(view, state.frame, state.scale);
  project(view);
  const range = colourRange(view, state);
  const map = colourMap(state.map, state.bands ? 10 : 0);
  const values = view.body.frames[state.frame].field(state.field);
  const [low, high] = range;
  const factor = high > low ? 255 / (high - low) : 0;
  for (let i = 0; i < view.body.n; ++i) {
    view.V[i] = factor ? (values[i] - low) * factor : values[i] === values[i] ? 0 : NaN;
  }
  fillVirtual(view.body.topo, view.V);
  clear(view.target);
  view.D = state.cut ? distances(view.x, state.cut) : null;
  const [bright, none, grey] = [map, map.map(() => [176, 176, 176]), map.map(() => [142, 150, 160])].map(shades);
  const bodies = visible(view.body.topo, state.looks);
  const rigid = state.rigid ? visible(view.body.rigidTopo, state.looks) : { tris: [], faint: [] };
  paintFaces(view.target, view, bodies.tris, bright, none);
  if (view.D && view.body.tetrahedra) paintSection(view, state, bright, none);
  paintFaces(view.target, { ...view, D: null }, rigid.tris, grey, grey);
  if (state.lines) meshLines(view, state);
  if (bodies.faint.length + rigid.faint.length) {
    view.front ??= target(view.W, view.H, new Uint32Array(view.W * view.H));
    clear(view.front);
    paintFaces(view.front, view, bodies.faint, bright, none);
    paintFaces(view.front, { ...view, D: null }, rigid.faint, grey, grey);
    overlay(view.target, view.front, 0.3);
  }
  view.ctx.putImageData(view.image, 0, 0);
  if (state.ghost) ghost(view);
  colourBar(view, state, range, map);
  scaleBar(view);
  triad(view);
  drawLabels(view, state);
}

/** What the cut goes through. */
function paintSection(view, state, luts, none) {
  const seen = (body) => (state.looks[body] ?? 'shown') === 'shown';
  const { arrays: [X, Y, Z, V], tris, lines } = section(view.body.tetrahedra(), view.D, [view.X, view.Y, view.Z, view.V], seen);
  const cut = { X, Y, Z, V };
  paintFaces(view.target, cut, tris, luts, none);
  if (state.lines) lineNet(view, lines.map(([a, b]) => ({ a, b, mid: -1 })), cut);
}

function paintFaces(to, view, tris, luts, none) {
  for (let t = 0; t < tris.length; t += 3) {
    const s = levelOf(view, tris[t], tris[t + 1], tris[t + 2]);
    triangle(to, view, tris[t], tris[t + 1], tris[t + 2], luts[s], none[s][0]);
  }
}

/** Lines between elements at places {X, Y, Z, D}, fainter as the elements get smaller, none below 5 pixels. */
function lineNet(view, edges, at) {
  const { X, Y, Z } = at;
  const sample = Math.max(1, Math.floor(edges.length / 200));
  let sum = 0;
  let number = 0;
  for (let i = 0; i < edges.length; i += sample, ++number) {
    const { a, b } = edges[i];
    sum += Math.hypot(X[a] - X[b], Y[a] - Y[b], Z[a] - Z[b]);
  }
  const size = number ? sum / number / view.dpr : 0;
  if (size < 5) return;
  const faces = view.target.pixels.slice();
  const alpha = Math.min(0.6, 0.12 + size / 50);
  for (const { a, b, mid } of edges) {
    for (const [p, q] of mid < 0 ? [[a, b]] : [[a, mid], [mid, b]]) line(view.target, faces, at, p, q, alpha, 1.5 * view.dpr);
  }
}

function meshLines(view, state) {
  const bodies = visible(view.body.topo, state.looks);
  lineNet(view, [...bodies.inner, ...bodies.outline], view);
  if (!state.rigid) return;
  const rigid = visible(view.body.rigidTopo, state.looks);
  lineNet(view, [...rigid.inner, ...rigid.outline], { ...view, D: null });
}

/** Normals of the undeformed cells (not of unit length), from three corners each. */
function normals({ points, topo }) {
  const { corners } = topo;
  return Array.from({ length: corners.length / 3 }, (_, c) => {
    const [a, b, d] = [0, 1, 2].map((k) => 3 * corners[3 * c + k]);
    const [u, v] = [b, d].map((i) => [0, 1, 2].map((k) => points[i + k] - points[a + k]));
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  });
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const sharp = Math.cos((30 * Math.PI) / 180);

/** Edges that show the shape of the undeformed bodies: ends of faces, sharp edges, and the rim seen from here. */
function shapeEdges(view) {
  const { topo } = view.body;
  const list = (view.normals ??= normals(view.body));
  const near = axes(view)[2];
  return [...topo.outline, ...topo.inner.filter(({ cell, other }) => {
    const [m, n] = [list[cell], list[other]];
    return dot(m, n) < sharp * Math.hypot(...m) * Math.hypot(...n) || dot(m, near) > 0 !== dot(n, near) > 0;
  })];
}

/** The undeformed shape, dashed; also what bodies hide of it. */
function ghost(view) {
  const { ctx, body, dpr, centre: c } = view;
  const [right, up] = axes(view);
  ctx.beginPath();
  for (const chain of chains(shapeEdges(view))) {
    chain.forEach((i, k) => {
      const p = [0, 1, 2].map((d) => body.points[3 * i + d] - c[d]);
      const place = [view.W / 2 + view.px + view.k * dot(right, p), view.H / 2 + view.py - view.k * dot(up, p)];
      if (k) ctx.lineTo(...place);
      else ctx.moveTo(...place);
    });
  }
  ctx.setLineDash([5 * dpr, 4 * dpr]);
  ctx.strokeStyle = css('--muted');
  ctx.lineWidth = 1.2 * dpr;
  ctx.stroke();
  ctx.setLineDash([]);
}

/** Directions of x, y, z in the lower left corner, above the scale bar. */
function triad(view) {
  const { ctx, dpr } = view;
  const rows = axes(view);
  const [left, bottom] = [40 * dpr, view.H - 76 * dpr];
  ctx.font = `600 ${11.5 * dpr}px system-ui, sans-serif`;
  ctx.textAlign = 'center';
  ctx.textBaseline = 'middle';
  ctx.strokeStyle = ctx.fillStyle = css('--ink');
  ctx.lineWidth = 1.5 * dpr;
  ['x', 'y', 'z'].forEach((name, k) => {
    const [dx, dy] = [rows[0][k] * 24 * dpr, -rows[1][k] * 24 * dpr];
    if (Math.hypot(dx, dy) < 3 * dpr) return;
    ctx.beginPath();
    ctx.moveTo(left, bottom);
    ctx.lineTo(left + dx, bottom + dy);
    ctx.stroke();
    ctx.fillText(name, left + dx * 1.35, bottom + dy * 1.35);
  });
}

/** What is under the pointer (canvas pixels): text lines, or null. */
export function probeSpace(view, state, px, py) {
  const { X, Y, Z, body } = view;
  const at = Math.floor(py) * view.W + Math.floor(px);
  const seen = view.target?.depth[at];
  if (!(seen > -Infinity)) return null;
  let best = -1;
  let distance = (18 * view.dpr) ** 2;
  for (const i of body.deformable) {
    if (i >= body.n) continue;
    const d = (X[i] - px) ** 2 + (Y[i] - py) ** 2 + (Z[i] - seen) ** 2;
    if (d < distance) [best, distance] = [i, d];
  }
  if (best < 0) return null;
  const frame = body.frames[state.frame];
  const u = frame.u();
  const list = (of) => [0, 1, 2].map((k) => num(of(3 * best + k), 5)).join(', ');
  return [`${state.field}: ${num(frame.field(state.field)[best], 6)}`, `node ${nodeNumber(body, best)}`,
    `at ${list((i) => body.points[i] + u[i])}`, `u = ${list((i) => u[i])}`];
}
