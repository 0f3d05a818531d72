// What part of the plane a view shows: fit, zoom, pan.

/** CSS pixels kept free for the colour bar. */
export const BAR = 96;

/** A point of a rigid line, its motion since the first frame scaled like the bodies'. */
export function rigidPoint(line, first, i, scale) {
  return [first[2 * i] + scale * (line[2 * i] - first[2 * i]),
    first[2 * i + 1] + scale * (line[2 * i + 1] - first[2 * i + 1])];
}

/** Up to 41 of `count` frames, the first and the last among them. */
export function someFrames(count) {
  const stride = Math.ceil(count / 40) || 1;
  return Array.from({ length: count }, (_, f) => f).filter((f) => f % stride === 0 || f === count - 1);
}

function add(box, x, y) {
  if (!Number.isFinite(x) || !Number.isFinite(y)) return;
  box[0] = Math.min(box[0], x);
  box[1] = Math.min(box[1], y);
  box[2] = Math.max(box[2], x);
  box[3] = Math.max(box[3], y);
}

const nothing = () => [Infinity, Infinity, -Infinity, -Infinity];
const sizeOf = ([x0, y0, x1, y1]) => Math.hypot(x1 - x0, y1 - y0);

/** Whether a rigid line is a thing to be seen whole, or one that goes on beyond what matters. */
function isThing(line, size) {
  const own = nothing();
  const n = line.length / 2;
  for (let i = 0; i < n; ++i) add(own, line[2 * i], line[2 * i + 1]);
  const extent = sizeOf(own);
  const open = Math.hypot(line[0] - line[2 * n - 2], line[1] - line[2 * n - 1]) > 1e-6 * extent;
  return extent <= (open ? 1 : 4) * size;
}

/** Bounds over (up to 41 of) all frames: bodies, rigid ones wherever they are, and what is near of endless lines. */
export function bounds(view, scale) {
  const { body } = view;
  const box = nothing();
  const frames = someFrames(body.frames.length);
  const ends = new Set(body.topo.outline.flatMap((e) => [e.a, e.b]));
  for (const f of frames) {
    const u = body.frames[f].u();
    for (const i of ends) {
      add(box, body.points[2 * i] + scale * u[2 * i], body.points[2 * i + 1] + scale * u[2 * i + 1]);
    }
  }
  if (!(box[0] <= box[2])) return [0, 0, 1, 1];
  const size = sizeOf(box);
  const [things, endless] = [[], []];
  for (const r of body.rigid) (isThing(r.first, size) ? things : endless).push(r);
  const each = (r, put) => frames.forEach((f) => {
    const line = r.at(f);
    for (let i = 0; i < line.length / 2; ++i) put(...rigidPoint(line, r.first, i, scale));
  });
  for (const r of things) each(r, (x, y) => add(box, x, y));
  const reach = 0.15 * Math.max(box[2] - box[0], box[3] - box[1]);
  const near = [box[0] - reach, box[1] - reach, box[2] + reach, box[3] + reach];
  const whole = [...box];
  for (const r of endless) {
    each(r, (x, y) => add(whole, Math.min(near[2], Math.max(near[0], x)), Math.min(near[3], Math.max(near[1], y))));
  }
  return whole;
}

/** Shows everything; keeps room for the colour bar on the right. */
export function fit(view, scale) {
  view.moved = false;
  const [x0, y0, x1, y1] = bounds(view, scale);
  const free = view.W - BAR * view.dpr;
  const size = Math.max(x1 - x0, y1 - y0, 1e-300);
  view.k = Math.min((free * 0.92) / Math.max(x1 - x0, size * 1e-3),
    (view.H * 0.86) / Math.max(y1 - y0, size * 1e-3));
  view.cx = (x0 + x1) / 2 + (BAR * view.dpr) / 2 / view.k;
  view.cy = (y0 + y1) / 2;
}

export function toScreen(view, x, y) {
  return [(x - view.cx) * view.k + view.W / 2, view.H / 2 - (y - view.cy) * view.k];
}

export function zoom(view, factor, px = view.W / 2, py = view.H / 2) {
  view.moved = true;
  const wx = view.cx + (px - view.W / 2) / view.k;
  const wy = view.cy - (py - view.H / 2) / view.k;
  view.k *= factor;
  view.cx = wx - (px - view.W / 2) / view.k;
  view.cy = wy + (py - view.H / 2) / view.k;
}

export function pan(view, dx, dy) {
  view.moved = true;
  view.cx -= dx / view.k;
  view.cy += dy / view.k;
}
