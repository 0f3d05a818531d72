// What part of the plane a view shows: fit, zoom, pan.

/** CSS pixels kept free for the colour bar. */
export const BAR = 96;

/** A point of a rigid line, its motion since the first frame scaled like the bodies'. */
export function rigidPoint(line, first, i, scale) {
  return [first[2 * i] + scale * (line[2 * i] - first[2 * i]),
    first[2 * i + 1] + scale * (line[2 * i + 1] - first[2 * i + 1])];
}

/** Bounds of the bodies over (up to 40 of) all frames, with what is near of the rigid lines. */
export function bounds(view, scale) {
  const { body } = view;
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const add = (b, x, y) => {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return;
    b[0] = Math.min(b[0], x);
    b[1] = Math.min(b[1], y);
    b[2] = Math.max(b[2], x);
    b[3] = Math.max(b[3], y);
  };
  const stride = Math.ceil(body.frames.length / 40);
  const ends = new Set(body.topo.outline.flatMap((e) => [e.a, e.b]));
  for (let f = 0; f < body.frames.length; f += stride) {
    const u = body.frames[f].u();
    for (const i of ends) {
      add(box, body.points[2 * i] + scale * u[2 * i], body.points[2 * i + 1] + scale * u[2 * i + 1]);
    }
  }
  if (!(box[0] <= box[2])) return [0, 0, 1, 1];
  const reach = 0.15 * Math.max(box[2] - box[0], box[3] - box[1]);
  const near = [box[0] - reach, box[1] - reach, box[2] + reach, box[3] + reach];
  const whole = [...box];
  for (const r of body.rigid) {
    for (let i = 0; i < r.first.length / 2; ++i) {
      add(whole, Math.min(near[2], Math.max(near[0], r.first[2 * i])),
        Math.min(near[3], Math.max(near[1], r.first[2 * i + 1])));
    }
  }
  return whole;
}

/** Shows everything; keeps room for the colour bar on the right. */
export function fit(view, scale) {
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
  const wx = view.cx + (px - view.W / 2) / view.k;
  const wy = view.cy - (py - view.H / 2) / view.k;
  view.k *= factor;
  view.cx = wx - (px - view.W / 2) / view.k;
  view.cy = wy + (py - view.H / 2) / view.k;
}

export function pan(view, dx, dy) {
  view.cx -= dx / view.k;
  view.cy += dy / view.k;
}
