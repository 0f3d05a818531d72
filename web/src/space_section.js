// Deformed bodies in space with their controls.
import { bodyChoices, largestFrame } from './bodies.js';
import { tetrahedra } from './cut.js';
import { addStress, extent, memo, naming, numbers, once } from './data.js';
import { choice, el, tick, watchWidth } from './dom.js';
import { num } from './format.js';
import { labelChoice } from './labels.js';
import { topology } from './mesh.js';
import { autoScale, button, frameKeys, lookOf, onceAFrame, placeCamera, player, savePicture } from './player.js';
import {
  createSpaceView, drawSpace, fitSpace, look, probeSpace, resizeSpace, shift, towardsEye, turn, zoomSpace,
} from './space_view.js';
import { onTheme } from './theme.js';

/** Faces, frames and fields of a report in space; null when it has no picture. */
export function readSpace(report) {
  const points = numbers(report.mesh?.points);
  const n = points.length / 3;
  if (!n || !report.frames?.length) return null;
  const blocks = (report.mesh.cells ?? []).map((block) => ({
    type: block.type, body: block.body, rigid: !!block.rigid, endless: !!block.endless, connectivity: Array.from(numbers(block.connectivity)),
  }));
  // One numbering: points of the bodies' faces first, then those of the rigid ones.
  const topo = topology(blocks.filter((b) => !b.rigid), n);
  const rigidTopo = topology(blocks.filter((b) => b.rigid), n);
  const moved = topo.total - n; // the virtual points of the rigid faces follow the bodies'
  rigidTopo.tris = rigidTopo.tris.map((i) => (i < n ? i : i + moved));
  Object.assign(topo, { virtual: [...topo.virtual, ...rigidTopo.virtual], total: topo.total + rigidTopo.total - n });
  const volumes = (report.mesh.volumes ?? []).map((block) => ({ ...block, connectivity: numbers(block.connectivity) }));
  const deformable = [...new Set([...topo.tris, ...volumes.flatMap((block) => [...block.connectivity])])].filter((i) => i < n);
  const whole = [...deformable, ...blocks.filter((b) => b.rigid && !b.endless).flatMap(thing(points, deformable))];
  const coloured = new Uint8Array(n);
  for (const i of deformable) coloured[i] = 1;
  const frames = report.frames.map((f) => readFrame(f, n, coloured));
  return {
    n, points, topo, rigidTopo, frames, deformable, whole, ...naming(report.mesh, topo, n),
    tetrahedra: volumes.length ? once(() => tetrahedra(volumes)) : null,
    largestContact: frames.map((f) => Math.max(0, extent([f.field('contact pressure')])[1])),
    fieldNames: [...new Set(frames.flatMap((f) => [...f.fields.keys()]))],
    size: Math.hypot(...[0, 1, 2].map((k) => {
      const [low, high] = extent([points.filter((_, i) => i % 3 === k)]);
      return high - low;
    })) || 1,
    range: memo((name) => extent(frames.map((f) => f.field(name)))),
  };
}

/** The points of a block of rigid faces that is to be seen whole: one not much larger than the bodies. */
function thing(points, deformable) {
  const extentOf = (list) => Math.hypot(...[0, 1, 2].map((k) => {
    const [low, high] = extent([Float64Array.from(list, (i) => points[3 * i + k])]);
    return high - low;
  }));
  const size = extentOf(deformable);
  return ({ connectivity }) => {
    const list = [...new Set(connectivity)];
    return extentOf(list) <= 4 * size ? list : [];
  };
}

/** Fields are known on the bodies only: how far a tool has moved would spoil the colours. */
function readFrame(f, n, coloured) {
  const u = once(() => {
    const list = numbers(f.u);
    return list.length === 3 * n ? list : new Float32Array(3 * n);
  });
  const fields = new Map();
  for (const [name, values] of Object.entries(f.fields ?? {})) {
    fields.set(name, once(() => {
      const list = numbers(values);
      return Float32Array.from({ length: n }, (_, i) => (coloured[i] ? list[i] ?? NaN : NaN));
    }));
  }
  addStress(f.stress, n, (i, v) => (coloured[i] ? v : NaN), fields);
  const derived = {
    'displacement |u|': (i, d) => Math.hypot(d[3 * i], d[3 * i + 1], d[3 * i + 2]),
    'displacement ux': (i, d) => d[3 * i],
    'displacement uy': (i, d) => d[3 * i + 1],
    'displacement uz': (i, d) => d[3 * i + 2],
  };
  for (const [name, of] of Object.entries(derived)) {
    fields.set(name, once(() => Float32Array.from({ length: n }, (_, i) => (coloured[i] ? of(i, u()) : NaN))));
  }
  return {
    step: f.step, increment: f.increment, time: f.time, u, fields,
    field: (name) => (fields.has(name) ? fields.get(name)() : new Float32Array(n).fill(NaN)),
  };
}

/** The section, and `show(frame)`; `frameChanged(frame)` lets the plots follow. */
export function spaceSection(body, frameChanged, { id = 'body', title = 'Deformed bodies', preset = {}, camera = null } = {}) {
  const canvas = el('canvas', { tabIndex: 0, class: 'body', 'aria-label': 'deformed bodies' });
  const view = createSpaceView(canvas, body);
  const hint = el('div', { class: 'tip', hidden: true });
  const host = el('div', { class: 'canvas-host' }, canvas, hint);
  const preferred = body.fieldNames.find((name) => /mises/i.test(name)) ?? body.fieldNames[0];
  const state = {
    frame: largestFrame(body.largestContact), looks: [], labels: 'none', cut: null, field: preferred, scaled: 1, scale: 1, range: 'all', map: 'sequential',
    bands: false, lines: true, rigid: true, ghost: false, ...preset,
  };
  const self = { body, view, state, canvas, hint, redraw: onceAFrame(() => drawSpace(view, state)) };
  const shown = () => state.frame;
  const show = (frame) => {
    state.frame = Math.min(body.frames.length - 1, Math.max(0, Math.round(frame)));
    self.player.update();
    hint.hidden = true;
    self.redraw();
    frameChanged(body.frames[state.frame]);
  };
  self.player = player(body.frames, shown, show);
  const section = el('section', { id }, title && el('h2', {}, title), controls(self), host,
    self.player.bar);
  watchWidth(host, (width) => {
    resizeSpace(view, width, Math.round(Math.max(320, Math.min(width * 0.6, 620))));
    placeCamera(view, camera, () => fitSpace(view, state));
    camera = null;
    self.redraw();
  });
  pointer(self);
  frameKeys(canvas, self.player, shown, show);
  onTheme(self.redraw);
  show(state.frame);
  return {
    section, show, playing: self.player.playing,
    look: () => lookOf(self, [['centre', 'px', 'py', 'k'], ['azimuth', 'elevation']]),
  };
}

function controls(self) {
  const { state, body, view } = self;
  const change = (patch) => {
    Object.assign(state, patch);
    self.redraw();
  };
  const auto = autoScale(body);
  if (state.scaled === 'auto') state.scale = auto;
  const warning = el('span', { class: 'warning', hidden: state.scale === 1 }, 'scaled: gaps between bodies are not true');
  const rescale = (v) => {
    change({ scaled: v, scale: v === 'auto' ? auto : Number(v) });
    warning.hidden = state.scale === 1;
    fitSpace(view, state);
  };
  const from = (azimuth, elevation) => () => {
    look(view, azimuth, elevation);
    fitSpace(view, state);
    self.redraw();
  };
  const scales = [[1, '1 (true)'], ['auto', `auto (${num(auto)})`],
    ...[0, 2, 5, 10, 100, 1000].map((v) => [v, String(v)])];
  return el('div', { class: 'controls' },
    choice('Field', body.fieldNames.map((f) => [f, f]), state.field, (field) => change({ field })),
    choice('Range', [['all', 'all frames'], ['frame', 'this frame']], state.range, (range) => change({ range })),
    choice('Colours', [['sequential', 'sequential'], ['diverging', 'diverging about 0']], state.map,
      (map) => change({ map })),
    choice('Displacements \u00d7', scales, state.scaled, rescale),
    tick('mesh', state.lines, (lines) => change({ lines })),
    tick('bands', state.bands, (bands) => change({ bands })),
    tick('undeformed', state.ghost, (ghost) => change({ ghost })),
    cutControl(self, change),
    labelChoice(body, state.labels, (labels) => change({ labels })),
    bodyChoices(body.bodies, state, () => change({})),
    body.bodies.length < 2 && body.rigidTopo.tris.length > 0 && tick('rigid bodies', state.rigid, (rigid) => change({ rigid })),
    warning,
    el('span', { class: 'buttons' },
      button('x', 'look along x', from(0, 0)), button('y', 'look along y', from(-Math.PI / 2, 0)),
      button('z', 'look down', from(-Math.PI / 2, Math.PI / 2)), button('\u2b12', 'from a corner', from(-0.9, 0.45)),
      button('+', 'zoom in', () => zoomBy(self, 1.4)), button('\u2212', 'zoom out', () => zoomBy(self, 1 / 1.4)),
      button('fit', 'show everything', () => zoomBy(self, 0)),
      button('PNG', 'save the picture', () => savePicture(self.canvas, `frame_${state.frame}.png`))));
}

/** An axis, a slider through the extent of the bodies in all frames, and which side is left out: first the one before. */
function cutControl({ state, body, view }, change) {
  const slider = el('input', {
    type: 'range', min: 0, max: 1, step: 0.002, value: 0.5, hidden: true, 'aria-label': 'place of the cut',
    oninput: () => move({}),
  });
  const side = tick('other side', false, () => move({ flip: !state.cut.flip }));
  side.hidden = true;
  const reach = memo((axis) => extent(body.frames.map((f) => Float64Array.from(body.nodes, (i) =>
    body.points[3 * i + axis] + f.u()[3 * i + axis]))));
  const move = (patch) => {
    const cut = { flip: false, ...state.cut, ...patch };
    const [low, high] = reach(cut.axis);
    change({ cut: { ...cut, at: low + Number(slider.value) * (high - low) } });
  };
  const choose = (axis) => {
    slider.hidden = side.hidden = axis === '';
    if (axis === '') change({ cut: null });
    else move({ axis: Number(axis), flip: (towardsEye(view)[axis] < 0) !== side.querySelector('input').checked });
  };
  return el('span', { class: 'control cut' },
    choice(body.tetrahedra ? 'Cut' : 'Cut (hollow)', [['', 'none'], ['0', 'across x'], ['1', 'across y'], ['2', 'across z']],
      '', choose), slider, side);
}

function zoomBy(self, factor, x, y) {
  if (factor) zoomSpace(self.view, factor, x, y);
  else fitSpace(self.view, self.state);
  self.redraw();
}

/** Drag turns, with shift or another button it moves; wheel zooms once the picture has been clicked. */
function pointer(self) {
  const { canvas, view, state, hint } = self;
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
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { from = null; });
  canvas.addEventListener('contextmenu', (e) => e.preventDefault());
  canvas.addEventListener('pointerleave', () => { hint.hidden = true; });
  canvas.addEventListener('pointermove', (e) => {
    const to = at(e);
    if (from) {
      (e.shiftKey || e.buttons > 1 ? shift : turn)(view, to[0] - from[0], to[1] - from[1]);
      from = to;
      hint.hidden = true;
      self.redraw();
      return;
    }
    const lines = probeSpace(view, state, ...to);
    hint.hidden = !lines;
    if (!lines) return;
    const [x, y] = to.map((v) => v / view.dpr);
    hint.replaceChildren(...lines.map((text) => el('div', {}, text)));
    hint.style.cssText = `left:${x + (x > canvas.clientWidth / 2 ? -12 : 12)}px;top:${y + 12}px;` +
      `transform:translateX(${x > canvas.clientWidth / 2 ? '-100%' : '0'})`;
  });
  canvas.addEventListener('wheel', (e) => {
    if (!e.ctrlKey && document.activeElement !== canvas) return;
    e.preventDefault();
    zoomBy(self, Math.exp(-e.deltaY * 0.0015), ...at(e));
  }, { passive: false });
  canvas.addEventListener('dblclick', () => zoomBy(self, 0));
}
