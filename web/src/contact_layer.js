// Contact on top of the deformed body: pressure as a filled profile or arrows, states as points.
import { rigidPoint, toScreen } from './camera.js';
import { symbol } from './curve.js';
import { num } from './format.js';
import { stateColour, stateWords } from './states.js';
import { css } from './theme.js';

const shapes = ['ring', 'disc', 'diamond', 'triangle'];

export function statusStyle(status) {
  const s = stateWords[status] ? status : 0;
  return { shape: shapes[s], colour: stateColour(stateWords[s]) };
}

/** Where contact points are drawn: as they are at scale 1, else carried along by the nearest line. */
function positions(view, state, c) {
  if (state.scale === 1) return c.x;
  c.anchors ??= anchors(view, state.frame, c);
  const { body } = view;
  const x = new Float64Array(2 * c.size);
  for (let i = 0; i < c.size; ++i) {
    const at = c.anchors[i];
    if (!at) {
      x.set([c.x[2 * i], c.x[2 * i + 1]], 2 * i);
      continue;
    }
    const ends = at.rigid
      ? [at.k, at.k + 1].map((k) => rigidPoint(at.rigid.at(state.frame), at.rigid.first, k, state.scale))
      : [at.a, at.b].map((k) => [view.x[k], view.y[k]]);
    x[2 * i] = ends[0][0] + at.t * (ends[1][0] - ends[0][0]);
    x[2 * i + 1] = ends[0][1] + at.t * (ends[1][1] - ends[0][1]);
  }
  return x;
}

/** The segment of an outline (or else of a rigid line) nearest to each contact point, unscaled. */
function anchors(view, frame, c) {
  const { body } = view;
  const u = body.frames[frame].u();
  const at = (i) => [body.points[2 * i] + u[2 * i], body.points[2 * i + 1] + u[2 * i + 1]];
  const segments = body.topo.outline.map((e) => ({ a: e.a, b: e.b, p: at(e.a), q: at(e.b), penalty: 1 }));
  for (const rigid of body.rigid) {
    const line = rigid.at(frame);
    for (let k = 0; k + 1 < line.length / 2; ++k) {
      segments.push({
        rigid, k, p: [line[2 * k], line[2 * k + 1]], q: [line[2 * k + 2], line[2 * k + 3]], penalty: 4,
      });
    }
  }
  return Array.from({ length: c.size }, (_, i) => closest(segments, c.x[2 * i], c.x[2 * i + 1], body.size));
}

function closest(segments, x, y, size) {
  let best = null;
  let distance = 0.02 * size;
  for (const s of segments) {
    const dx = s.q[0] - s.p[0];
    const dy = s.q[1] - s.p[1];
    const t = Math.min(1, Math.max(0, ((x - s.p[0]) * dx + (y - s.p[1]) * dy) / (dx * dx + dy * dy || 1)));
    const d = s.penalty * Math.hypot(s.p[0] + t * dx - x, s.p[1] + t * dy - y);
    if (d < distance) {
      distance = d;
      best = { ...s, t };
    }
  }
  return best;
}

/** Ranges [from, to) of points that follow one another along a surface. */
export function runs(x, size) {
  const steps = [];
  for (let i = 1; i < size; ++i) {
    steps.push(Math.hypot(x[2 * i] - x[2 * i - 2], x[2 * i + 1] - x[2 * i - 1]));
  }
  const usual = [...steps].sort((p, q) => p - q)[Math.floor(steps.length * 0.75)] ?? 0;
  const list = [];
  let from = 0;
  for (let i = 1; i <= size; ++i) {
    if (i === size || steps[i - 1] > 6 * usual) {
      list.push([from, i]);
      from = i;
    }
  }
  return list;
}

export function drawContact(view, state) {
  view.contactPoints = [];
  if (state.contact === 'none' && !state.points) return;
  const { body, dpr } = view;
  const largest = Math.max(body.largest('pressure'), state.contact === 'traction' ? body.largest('shear') : 0);
  const length = largest > 0 ? (0.13 * Math.min(view.W, view.H * 1.4)) / largest : 0;
  for (const c of body.frames[state.frame].contact()) {
    const x = positions(view, state, c);
    const P = Array.from({ length: c.size }, (_, i) => toScreen(view, x[2 * i], x[2 * i + 1]));
    if (state.contact === 'profile') runs(x, c.size).forEach((r) => profile(view, c, P, r, length));
    if (state.contact === 'arrows') arrows(view, c, P, length, 0);
    if (state.contact === 'traction') arrows(view, c, P, length, 1);
    const radius = pointRadius(P, dpr);
    for (let i = 0; i < c.size; ++i) {
      view.contactPoints.push({
        X: P[i][0], Y: P[i][1], i, pair: c.pair,
        pressure: c.pressure[i], shear: c.shear[i], status: c.status[i],
      });
      if (!state.points) continue;
      const style = statusStyle(c.status[i]);
      symbol(view.ctx, style.shape, ...P[i], radius, style.colour);
    }
  }
}

/** Radius of the points of a pair: smaller where they stand close together on the screen. */
function pointRadius(P, dpr) {
  const steps = [];
  for (let i = 1; i < P.length; ++i) steps.push(Math.hypot(P[i][0] - P[i - 1][0], P[i][1] - P[i - 1][1]));
  const usual = steps.sort((p, q) => p - q)[Math.floor(steps.length / 2)] ?? Infinity;
  return Math.max(1.3 * dpr, Math.min(3 * dpr, 0.36 * usual));
}

/** Pressure as an area on the master's side of the surface (against the normal). */
function profile(view, c, P, [from, to], length) {
  if (!c.pressure.slice(from, to).some((p) => p > 0)) return;
  const { ctx, dpr } = view;
  const tip = (i) => {
    const p = Math.max(0, c.pressure[i] || 0) * length;
    return [P[i][0] - c.normal[2 * i] * p, P[i][1] + c.normal[2 * i + 1] * p];
  };
  ctx.beginPath();
  ctx.moveTo(...P[from]);
  for (let i = from; i < to; ++i) ctx.lineTo(...tip(i));
  for (let i = to - 1; i >= from; --i) ctx.lineTo(...P[i]);
  ctx.closePath();
  ctx.fillStyle = css('--contact-fill');
  ctx.fill();
  ctx.beginPath();
  for (let i = from; i < to; ++i) {
    const idle = !(c.pressure[i] > 0) && !(i > from && c.pressure[i - 1] > 0);
    if (idle || i === from) ctx.moveTo(...tip(i));
    else ctx.lineTo(...tip(i));
  }
  ctx.strokeStyle = css('--contact');
  ctx.lineWidth = 1.75 * dpr;
  ctx.lineJoin = 'round';
  ctx.stroke();
}

/** Force per area on the slave: pressure along the normal, with `sheared` also the shear. */
function arrows(view, c, P, length, sheared) {
  const { ctx, dpr } = view;
  ctx.strokeStyle = ctx.fillStyle = css('--contact');
  ctx.lineWidth = 1.5 * dpr;
  let last = null;
  for (let i = 0; i < c.size; ++i) {
    const nx = c.normal[2 * i];
    const ny = c.normal[2 * i + 1];
    const p = c.pressure[i] || 0;
    const q = sheared * (c.shear[i] || 0);
    const dx = (p * nx + q * ny) * length;
    const dy = -(p * ny - q * nx) * length;
    if (Math.hypot(dx, dy) < 1.5 * dpr) continue;
    if (last && Math.hypot(P[i][0] - last[0], P[i][1] - last[1]) < 7 * dpr) continue;
    last = P[i];
    arrow(ctx, P[i][0] - dx, P[i][1] - dy, P[i][0], P[i][1], 5 * dpr);
  }
}

function arrow(ctx, x0, y0, x1, y1, head) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  const size = Math.min(head, 0.6 * length);
  const ex = ((x1 - x0) / length) * size;
  const ey = ((y1 - y0) / length) * size;
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x1 - ex, y1 - ey);
  ctx.stroke();
  ctx.beginPath();
  ctx.moveTo(x1, y1);
  ctx.lineTo(x1 - ex - 0.45 * ey, y1 - ey + 0.45 * ex);
  ctx.lineTo(x1 - ex + 0.45 * ey, y1 - ey - 0.45 * ex);
  ctx.fill();
}

/** Legend of states and of the pressure drawing, upper left. */
export function legendOf(view, state) {
  const { ctx, dpr, body } = view;
  if (!body.pairs().length) return;
  ctx.font = `${11.5 * dpr}px system-ui, sans-serif`;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'middle';
  let x = 14 * dpr;
  let y = 16 * dpr;
  const entry = (text, mark) => {
    if (x + ctx.measureText(text).width > view.W - 14 * dpr) [x, y] = [14 * dpr, y + 17 * dpr];
    mark(x + 5 * dpr);
    ctx.fillStyle = css('--ink');
    ctx.fillText(text, x + 14 * dpr, y);
    x += ctx.measureText(text).width + 28 * dpr;
  };
  if (state.points) {
    [1, 2, 3, 0].filter((s) => body.states().has(s)).forEach((s) => entry(stateWords[s], (at) => {
      const style = statusStyle(s);
      symbol(ctx, style.shape, at, y, 3.8 * dpr, style.colour);
    }));
  }
  if (state.contact !== 'none') {
    const peak = Math.max(0, ...body.frames[state.frame].contact().flatMap((c) => [...c.pressure])
      .filter((v) => v === v));
    entry(`${state.contact === 'traction' ? 'pressure and shear' : 'pressure'}, at most ${num(peak, 4)} here`, (at) => {
      ctx.fillStyle = css('--contact');
      ctx.fillRect(at - 5 * dpr, y - 4 * dpr, 10 * dpr, 8 * dpr);
    });
  }
}
