// The deformed body with its controls, and the contact stresses along the surface.
import { bodyChoices, largestFrame } from './bodies.js';
import { bounds, fit, pan, zoom } from './camera.js';
import { choice, el, tick, watchWidth } from './dom.js';
import { num } from './format.js';
import { labelChoice } from './labels.js';
import { plot } from './plot.js';
import { autoScale, button, frameKeys, lookOf, onceAFrame, placeCamera, player, savePicture } from './player.js';
import { stateWords } from './states.js';
import { onTheme } from './theme.js';
import { createView, draw, probe, resize } from './view.js';
import { runs, statusStyle } from './contact_layer.js';

/** State of the view; `frameChanged(frame)` lets other plots follow; `preset` changes its first state. */
export function bodySection(body, frameChanged, { id = 'body', title = 'Deformed body', preset = {}, camera = null } = {}) {
  const canvas = el('canvas', { tabIndex: 0, class: 'body', 'aria-label': 'deformed body' });
  const view = createView(canvas, body);
  const hint = el('div', { class: 'tip', hidden: true });
  const host = el('div', { class: 'canvas-host' }, canvas, hint);
  const preferred = body.fieldNames.find((name) => /mises/i.test(name)) ?? body.fieldNames[0];
  const state = {
    frame: largestFrame(body.largestContact), looks: [], labels: 'none', field: preferred, scaled: 1, scale: 1, range: 'all', map: 'sequential',
    bands: false, lines: true, ghost: false, contact: 'profile', points: true, ...preset,
  };
  const self = { body, view, state, canvas, host, hint, frameChanged };
  self.redraw = onceAFrame(() => draw(view, state));
  self.contact = contactPlots(body);
  const shown = () => state.frame;
  const show = (frame) => showFrame(self, frame);
  self.player = player(body.frames, shown, show);
  const section = el('section', { id }, title && el('h2', {}, title),
    controls(self), host, self.player.bar, self.contact.node);
  watchWidth(host, (width) => {
    resize(view, width, heightFor(view, state.scale, width));
    placeCamera(view, camera, () => fit(view, state.scale));
    camera = null;
    refresh(self);
  });
  pointer(self);
  frameKeys(canvas, self.player, shown, show);
  onTheme(() => refresh(self));
  showFrame(self, state.frame);
  return {
    section, show: (frame) => showFrame(self, frame), playing: self.player.playing,
    look: () => lookOf(self, [['cx', 'cy', 'k'], []]),
  };
}

function heightFor(view, scale, width) {
  const [x0, y0, x1, y1] = bounds(view, scale);
  const aspect = (y1 - y0) / (x1 - x0 || 1);
  return Math.round(Math.min(Math.max((width - 96) * aspect * 1.2 + 60, 300), Math.max(340, width * 0.62), 620));
}

function refresh(self) {
  self.redraw();
}

function change(self, patch) {
  Object.assign(self.state, patch);
  refresh(self);
}

function showFrame(self, frame) {
  const last = self.body.frames.length - 1;
  self.state.frame = Math.min(last, Math.max(0, Math.round(frame)));
  self.player.update();
  self.contact.show(self.state.frame);
  self.hint.hidden = true;
  refresh(self);
  self.frameChanged(self.body.frames[self.state.frame]);
}

function controls(self) {
  const { state, body } = self;
  const auto = autoScale(body);
  const scales = [[1, '1 (true)'], ['auto', `auto (${num(auto)})`],
    ...[0, 2, 5, 10, 100, 1000].map((v) => [v, String(v)])];
  if (state.scaled === 'auto') state.scale = auto;
  const warning = el('span', { class: 'warning', hidden: state.scale === 1 }, 'scaled: gaps between bodies are not true');
  const rescale = (v) => {
    change(self, { scaled: v, scale: v === 'auto' ? auto : Number(v) });
    warning.hidden = state.scale === 1;
    fit(self.view, state.scale);
  };
  const contactModes = [['profile', 'pressure profile'], ['arrows', 'pressure arrows'],
    ['traction', 'pressure and shear'], ['none', 'hidden']];
  const touching = body.pairs().length > 0;
  if (!touching) Object.assign(state, { contact: 'none', points: false });
  return el('div', { class: 'controls' },
    choice('Field', body.fieldNames.map((f) => [f, f]), state.field, (field) => change(self, { field })),
    choice('Range', [['all', 'all frames'], ['frame', 'this frame']], state.range,
      (range) => change(self, { range })),
    choice('Colours', [['sequential', 'sequential'], ['diverging', 'diverging about 0']], state.map,
      (map) => change(self, { map })),
    choice('Displacements \u00d7', scales, state.scaled, rescale),
    touching && choice('Contact', contactModes, state.contact, (contact) => change(self, { contact })),
    touching && tick('states', state.points, (points) => change(self, { points })),
    tick('mesh', state.lines, (lines) => change(self, { lines })),
    tick('bands', state.bands, (bands) => change(self, { bands })),
    tick('undeformed', state.ghost, (ghost) => change(self, { ghost })),
    labelChoice(body, state.labels, (labels) => change(self, { labels })),
    bodyChoices(body.bodies, state, () => refresh(self)),
    warning,
    el('span', { class: 'buttons' },
      button('+', 'zoom in', () => zoomBy(self, 1.4)),
      button('\u2212', 'zoom out', () => zoomBy(self, 1 / 1.4)),
      button('fit', 'show everything', () => zoomBy(self, 0)),
      button('PNG', 'save the picture', () => savePicture(self.canvas, `frame_${self.state.frame}.png`))));
}

function zoomBy(self, factor, x, y) {
  if (factor) zoom(self.view, factor, x, y);
  else fit(self.view, self.state.scale);
  refresh(self);
}

/** Drag moves, wheel zooms once the picture has been clicked (or with Ctrl), double click fits. */
function pointer(self) {
  const { canvas, view, hint } = self;
  let from = null;
  const at = (e) => {
    const r = canvas.getBoundingClientRect();
    return [(e.clientX - r.left) * view.dpr, (e.clientY - r.top) * view.dpr];
  };
  canvas.addEventListener('pointerdown', (e) => {
    if (e.pointerType === 'touch' && !e.isPrimary) return;
    from = at(e);
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener('pointerup', () => { from = null; });
  canvas.addEventListener('pointercancel', () => { from = null; });
  canvas.addEventListener('pointerleave', () => { hint.hidden = true; });
  canvas.addEventListener('pointermove', (e) => {
    const to = at(e);
    if (from) {
      pan(view, to[0] - from[0], to[1] - from[1]);
      from = to;
      hint.hidden = true;
      refresh(self);
      return;
    }
    const lines = probe(view, self.state, ...to);
    hint.hidden = !lines;
    if (!lines) return;
    const [x, y] = to.map((v) => v / view.dpr);
    const right = x > canvas.clientWidth / 2;
    hint.replaceChildren(...lines.map((line) => el('div', {}, line)));
    hint.style.cssText = `left:${x + (right ? -12 : 12)}px;top:${y + 12}px;` +
      `transform:translateX(${right ? '-100%' : '0'})`;
  });
  canvas.addEventListener('wheel', (e) => {
    if (!e.ctrlKey && document.activeElement !== canvas) return;
    e.preventDefault();
    zoomBy(self, Math.exp(-e.deltaY * 0.0015), ...at(e));
  }, { passive: false });
  canvas.addEventListener('dblclick', () => zoomBy(self, 0));
}

/** Points in the direction in which the picture shows them: from left to right, or else upwards. */
function asSeen(c) {
  const last = 2 * (c.size - 1);
  const [dx, dy] = [c.x[last] - c.x[0], c.x[last + 1] - c.x[1]];
  const order = Array.from({ length: c.size }, (_, i) => i);
  return (Math.abs(dx) >= 0.2 * Math.abs(dy) ? dx : dy) < 0 ? order.reverse() : order;
}

/** Arc length along the contact points as the picture runs, and the values, broken where the surface is. */
export function along(c) {
  const s = [];
  const pressure = [];
  const shear = [];
  const styles = [];
  let length = 0;
  const order = asSeen(c);
  const x = order.flatMap((i) => [c.x[2 * i], c.x[2 * i + 1]]);
  runs(x, c.size).forEach(([from, to], r) => {
    if (r) {
      s.push(length);
      pressure.push(NaN);
      shear.push(NaN);
      styles.push(null);
    }
    for (let k = from; k < to; ++k) {
      if (k) length += Math.hypot(x[2 * k] - x[2 * k - 2], x[2 * k + 1] - x[2 * k - 1]);
      const i = order[k];
      s.push(length);
      pressure.push(c.pressure[i]);
      shear.push(c.shear[i]);
      styles.push({ ...statusStyle(c.status[i]), status: c.status[i], size: 2.4 });
    }
  });
  return { s, pressure, shear, styles };
}

/** One plot of pressure and shear for every contact pair. */
function contactPlots(body) {
  const node = el('div', { class: 'grid contact-plots' });
  const all = body.frames.flatMap((f) => f.contact());
  const plots = body.pairs().map((pair) => {
    const list = all.filter((c) => c.pair === pair);
    const low = Math.min(0, ...list.map((c) => Math.min(...c.shear.filter((v) => v === v), 0)));
    const high = Math.max(...list.map((c) => Math.max(0, ...c.pressure.filter((v) => v === v),
      ...c.shear.filter((v) => v === v))));
    const curvesAt = (frame) => {
      const c = body.frames[frame].contact().find((k) => k.pair === pair);
      const { s, pressure, shear, styles } = c ? along(c) : { s: [], pressure: [], shear: [], styles: [] };
      return [
        { label: 'pressure', x: s, y: pressure, styles: styles.map((v) => v ?? {}) },
        { label: 'shear', x: s, y: shear, dashed: true, dots: false },
      ];
    };
    const shown = plot(node, {
      title: `Contact stress along ${pair}`, xlabel: 'length along the surface', ylabel: 'force / area',
      height: 260, yRange: [low, high],
      describe: (curve, i) => [`${curve.label}: ${num(curve.y[i], 5)}`, `at length ${num(curve.x[i], 5)}`,
        stateWords[curve.styles?.[i]?.status] ?? ''],
    }, curvesAt(body.frames.length - 1));
    return (frame) => shown.show(curvesAt(frame));
  });
  return { node, show: (frame) => plots.forEach((p) => p(frame)) };
}
