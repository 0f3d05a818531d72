// The deformed body on a canvas: fields, mesh lines, rigid lines, colour bar; contact on top.
import { BAR, rigidPoint, toScreen } from './camera.js';
import { visible } from './bodies.js';
import { colourMap, cssColour, packed } from './colour.js';
import { drawContact, legendOf } from './contact_layer.js';
import { drawLabels, nodeNumber } from './labels.js';
import { niceTicks, num, tickLabels } from './format.js';
import { chains, fillVirtual } from './mesh.js';
import { paint } from './raster.js';
import { stateWords } from './states.js';
import { css } from './theme.js';

export function createView(canvas, body) {
  const { total } = body.topo;
  return {
    canvas, body,
    ctx: canvas.getContext('2d'),
    x: new Float64Array(total), y: new Float64Array(total), // deformed coordinates
    X: new Float32Array(total), Y: new Float32Array(total), // pixels
    V: new Float32Array(total),
    cx: 0, cy: 0, k: 1, dpr: 1, W: 0, H: 0, image: null, fitted: false,
  };
}

/** Sizes the canvas in CSS pixels; returns whether anything changed. */
export function resize(view, width, height) {
  view.dpr = Math.min(2, devicePixelRatio || 1);
  const W = Math.round(width * view.dpr);
  const H = Math.round(height * view.dpr);
  if (W === view.W && H === view.H) return;
  Object.assign(view, { W, H, image: new ImageData(W, H) });
  Object.assign(view.canvas, { width: W, height: H });
  view.canvas.style.height = `${height}px`;
  view.pixels = new Uint32Array(view.image.data.buffer);
}

/** Deformed coordinates of all points (virtual ones included). */
function deform(view, frame, scale) {
  const { body, x, y } = view;
  const u = body.frames[frame].u();
  for (let i = 0; i < body.n; ++i) {
    x[i] = body.points[2 * i] + scale * u[2 * i];
    y[i] = body.points[2 * i + 1] + scale * u[2 * i + 1];
  }
  fillVirtual(body.topo, x);
  fillVirtual(body.topo, y);
}

/** Range of colours: whole analysis, this frame, or symmetric about zero for the diverging map. */
export function colourRange(view, state) {
  let [low, high] = view.body.range(state.field);
  if (state.range === 'frame') {
    low = Infinity;
    high = -Infinity;
    for (const v of view.body.frames[state.frame].field(state.field)) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
    if (!(low <= high)) [low, high] = [0, 0];
  }
  if (state.map === 'diverging') {
    high = Math.max(Math.abs(low), Math.abs(high));
    low = -high;
  }
  return [low, high];
}

export function draw(view, state) {
  if (!view.W) return;
  deform(view, state.frame, state.scale);
  const { X, Y, x, y } = view;
  for (let i = 0; i < X.length; ++i) {
    X[i] = (x[i] - view.cx) * view.k + view.W / 2;
    Y[i] = view.H / 2 - (y[i] - view.cy) * view.k;
  }
  const range = colourRange(view, state);
  const map = colourMap(state.map, state.bands ? 10 : 0);
  paintField(view, state, range, map);
  const drawn = visible(view.body.topo, state.looks);
  if (state.lines) meshLines(view, drawn.inner, state);
  if (state.ghost) ghost(view);
  outline(view, drawn.outline, css('--edge'), 1.2);
  rigidLines(view, state);
  drawContact(view, state);
  colourBar(view, state, range, map);
  scaleBar(view);
  legendOf(view, state);
  drawLabels(view, state);
}

function paintField(view, state, [low, high], map) {
  const { V, body } = view;
  const values = body.frames[state.frame].field(state.field);
  const factor = high > low ? 255 / (high - low) : 0;
  for (let i = 0; i < body.n; ++i) V[i] = factor ? (values[i] - low) * factor : 0;
  fillVirtual(body.topo, V);
  view.pixels.fill(0);
  const drawn = visible(body.topo, state.looks);
  const faint = packed(map).map((v) => (v & 0xffffff) | 0x48000000);
  paint(view.pixels, view.W, view.H, view.X, view.Y, V, drawn.faint, faint, 0x48a0a0a0);
  paint(view.pixels, view.W, view.H, view.X, view.Y, V, drawn.tris, packed(map), 0xffa0a0a0);
  view.ctx.putImageData(view.image, 0, 0);
}

function trace(view, edges) {
  const { ctx, X, Y, W, H } = view;
  ctx.beginPath();
  for (const { a, b, mid } of edges) {
    if ((X[a] < 0 && X[b] < 0) || (X[a] > W && X[b] > W) ||
        (Y[a] < 0 && Y[b] < 0) || (Y[a] > H && Y[b] > H)) continue;
    ctx.moveTo(X[a], Y[a]);
    if (mid < 0) ctx.lineTo(X[b], Y[b]);
    else {
      ctx.quadraticCurveTo(2 * X[mid] - (X[a] + X[b]) / 2, 2 * Y[mid] - (Y[a] + Y[b]) / 2, X[b], Y[b]);
    }
  }
}

function outline(view, edges, colour, width) {
  trace(view, edges);
  view.ctx.lineWidth = width * view.dpr;
  view.ctx.lineJoin = 'round';
  view.ctx.strokeStyle = colour;
  view.ctx.stroke();
}

/** Whether most of what is painted has the dark colours. */
function isDark({ V, body }, { map }) {
  const sum = body.nodes.reduce((total, i) => total + (V[i] || 0), 0);
  return map === 'sequential' && sum < 70 * body.nodes.length;
}

/** Lines between elements, fainter as the elements get smaller, none below 6 pixels. */
function meshLines(view, inner, state) {
  const sample = Math.max(1, Math.floor(inner.length / 200));
  let sum = 0;
  let number = 0;
  for (let i = 0; i < inner.length; i += sample, ++number) {
    const { a, b } = inner[i];
    sum += Math.hypot(view.X[a] - view.X[b], view.Y[a] - view.Y[b]);
  }
  const size = number ? sum / number / view.dpr : 0;
  if (size < 6) return;
  view.ctx.globalAlpha = Math.min(0.55, 0.12 + size / 40);
  outline(view, inner, css(isDark(view, state) ? '--edge-on-dark' : '--edge'), 0.6);
  view.ctx.globalAlpha = 1;
}

/** The undeformed outline, dashed. */
function ghost(view) {
  const { ctx, body, dpr } = view;
  ctx.beginPath();
  for (const chain of (view.chains ??= chains(body.topo.outline))) {
    chain.forEach((i, k) => {
      const place = toScreen(view, body.points[2 * i], body.points[2 * i + 1]);
      if (k) ctx.lineTo(...place);
      else ctx.moveTo(...place);
    });
  }
  ctx.setLineDash([4 * dpr, 3 * dpr]);
  ctx.strokeStyle = css('--muted');
  ctx.lineWidth = dpr;
  ctx.stroke();
  ctx.setLineDash([]);
}

function rigidLines(view, state) {
  const { ctx, dpr } = view;
  ctx.strokeStyle = css('--rigid');
  ctx.lineWidth = 2.5 * dpr;
  ctx.lineJoin = ctx.lineCap = 'round';
  for (const r of view.body.rigid) {
    if (state.looks[r.body] === 'hidden') continue;
    ctx.globalAlpha = state.looks[r.body] === 'faint' ? 0.35 : 1;
    const line = r.at(state.frame);
    ctx.beginPath();
    for (let i = 0; i < line.length / 2; ++i) {
      const [x, y] = toScreen(view, ...rigidPoint(line, r.first, i, state.scale));
      if (i) ctx.lineTo(x, y);
      else ctx.moveTo(x, y);
      if (line.length === 2) ctx.lineTo(x, y);
    }
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
  ctx.lineCap = 'butt';
}

/** The colours with their values, on the right. */
export function colourBar(view, state, [low, high], map) {
  const { ctx, dpr, W, H } = view;
  const width = 14 * dpr;
  const height = Math.min(H - 84 * dpr, 300 * dpr);
  const left = W - (BAR - 18) * dpr;
  const top = Math.max((H - height) / 2 + 8 * dpr, 62 * dpr);
  ctx.fillStyle = css('--veil');
  ctx.fillRect(left - 12 * dpr, top - 32 * dpr, W, height + 48 * dpr);
  for (let i = 0; i < 256; ++i) {
    ctx.fillStyle = cssColour(map[255 - i]);
    ctx.fillRect(left, top + (i / 256) * height, width, height / 256 + 1);
  }
  ctx.strokeStyle = css('--muted');
  ctx.lineWidth = dpr;
  ctx.strokeRect(left, top, width, height);
  ctx.fillStyle = css('--ink');
  ctx.font = `${11.5 * dpr}px system-ui, sans-serif`;
  ctx.textBaseline = 'middle';
  ctx.textAlign = 'left';
  const ticks = high > low ? niceTicks(low, high, 6) : [low];
  tickLabels(ticks).forEach((text, i) => {
    const y = high > low ? top + height * (1 - (ticks[i] - low) / (high - low)) : top + height;
    ctx.fillRect(left + width, y - 0.5 * dpr, 4 * dpr, dpr);
    ctx.fillText(text, left + width + 7 * dpr, y);
  });
  ctx.textAlign = 'right';
  ctx.font = `600 ${12 * dpr}px system-ui, sans-serif`;
  ctx.fillText(state.field, W - 10 * dpr, top - 18 * dpr);
}

/** A round length in the lower left corner. */
export function scaleBar(view) {
  const { ctx, dpr, H, k } = view;
  const raw = (110 * dpr) / k;
  const power = 10 ** Math.floor(Math.log10(raw));
  const length = [5, 2, 1].map((f) => f * power).find((v) => v <= raw) ?? power;
  const left = 14 * dpr;
  const bottom = H - 14 * dpr;
  ctx.strokeStyle = ctx.fillStyle = css('--ink');
  ctx.lineWidth = 1.5 * dpr;
  ctx.beginPath();
  ctx.moveTo(left, bottom - 4 * dpr);
  ctx.lineTo(left, bottom);
  ctx.lineTo(left + length * k, bottom);
  ctx.lineTo(left + length * k, bottom - 4 * dpr);
  ctx.stroke();
  ctx.font = `${11.5 * dpr}px system-ui, sans-serif`;
  ctx.textAlign = 'center';
  ctx.textBaseline = 'bottom';
  ctx.fillText(num(length), left + (length * k) / 2, bottom - 3 * dpr);
}

/** What is under the pointer (canvas pixels): text lines, or null. */
export function probe(view, state, px, py) {
  const frame = view.body.frames[state.frame];
  const { X, Y, body } = view;
  for (const c of view.contactPoints ?? []) {
    if (Math.hypot(c.X - px, c.Y - py) < 6 * view.dpr) {
      return [`${c.pair}, point ${c.i}: ${stateWords[c.status] ?? 'open'}`,
        `pressure ${num(c.pressure, 5)}`, `shear ${num(c.shear, 5)}`];
    }
  }
  let best = -1;
  let distance = (18 * view.dpr) ** 2;
  for (let i = 0; i < body.n; ++i) {
    const d = (X[i] - px) ** 2 + (Y[i] - py) ** 2;
    if (d < distance) [best, distance] = [i, d];
  }
  if (best < 0) return null;
  const u = frame.u();
  return [`${state.field}: ${num(frame.field(state.field)[best], 6)}`,
    `node ${nodeNumber(body, best)} at ${num(body.points[2 * best] + u[2 * best], 5)}, ` +
    `${num(body.points[2 * best + 1] + u[2 * best + 1], 5)}`,
    `u = ${num(u[2 * best], 5)}, ${num(u[2 * best + 1], 5)}`];
}
