// Plots of curves that may turn back (hysteresis loops), on top of uPlot's axes and zoom.
import uPlot from 'uplot';
import { el, watchWidth } from './dom.js';
import { num, tickLabels } from './format.js';
import { css, curveColour, onEnd, onTheme } from './theme.js';
import { drawCurve } from './curve.js';

/**
 * A plot inside `host`.
 * options: {title, xlabel, ylabel, height, logY, xRange, yRange, integerX, describe(curve, i), picked(curve, i)}
 * curves: [{label, x, y, colour?, kind: 'line'|'bars'|'points', dots?, styles?, dashed?}]
 * Returns {show(curves), mark([[x, y], ...])}.
 */
export function plot(host, options, curves) {
  const box = el('div', { class: 'plot', role: 'img', 'aria-label': options.title });
  const legend = el('div', { class: 'legend' });
  const hint = el('div', { class: 'tip', hidden: true });
  const frame = el('figure', { class: 'plot-frame' },
    options.title && el('figcaption', {}, options.title), legend, box);
  host.append(frame);
  const self = { options, curves, box, legend, hint, hidden: new Set(), marks: [], chart: null };
  fillLegend(self);
  watchWidth(box, (width) => {
    if (self.chart) self.chart.setSize({ width, height: heightOf(self, width) });
    else create(self, width);
    placeMarks(self);
  });
  onTheme(() => {
    fillLegend(self);
    rebuild(self);
  });
  onEnd(() => self.chart?.destroy());
  return {
    frame,
    show(next) {
      const same = next.length === self.curves.length;
      self.curves = next;
      fillLegend(self);
      if (!self.chart) return;
      if (!same) rebuild(self);
      else if (!self.zoomed) self.chart.setData(dataOf(self));
      else {
        self.chart.setData(dataOf(self), false);
        self.chart.redraw();
      }
      placeMarks(self);
    },
    mark(points) {
      self.marks = points;
      placeMarks(self);
    },
  };
}

function heightOf(self, width) {
  return self.options.height ?? Math.round(Math.min(320, Math.max(220, width * 0.55)));
}

function colourOf(self, i) {
  return self.curves[i].colour?.() ?? curveColour(i);
}

function fillLegend(self) {
  const many = self.curves.length > 1 || self.options.legend;
  self.legend.replaceChildren(...(many ? self.curves : []).map((curve, i) => el('button', {
    class: self.hidden.has(i) ? 'chip off' : 'chip',
    type: 'button',
    title: 'show or hide',
    'aria-pressed': String(!self.hidden.has(i)),
    onclick: () => {
      if (!self.hidden.delete(i)) self.hidden.add(i);
      fillLegend(self);
      self.chart?.setSeries(i + 1, { show: !self.hidden.has(i) });
      fit(self);
    },
  }, swatch(curve, colourOf(self, i)), curve.label)));
}

function swatch(curve, colour) {
  const mark = el('span', { class: `swatch ${curve.kind ?? 'line'}${curve.dashed ? ' dashed' : ''}` });
  mark.style.setProperty('--c', colour);
  return mark;
}

function dataOf(self) {
  return [null, ...self.curves.map((c) => [c.x, c.y])];
}

/** Range of all visible curves along 'x' or 'y', with a margin; whole decades on a log axis. */
function fullRange(self, axis) {
  const given = self.options[`${axis}Range`];
  let low = Infinity;
  let high = -Infinity;
  const log = axis === 'y' && self.options.logY;
  self.curves.forEach((c, k) => {
    if (self.hidden.has(k)) return;
    for (const v of c[axis]) {
      if (!Number.isFinite(v) || (log && v <= 0)) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
  });
  if (given) [low, high] = [Math.min(low, given[0]), Math.max(high, given[1])];
  if (!(low <= high)) [low, high] = log ? [0.1, 10] : [0, 1];
  if (log) return [10 ** Math.floor(Math.log10(low)), 10 ** (Math.floor(Math.log10(high)) + 1)];
  const flat = high - low < 1e-9 * Math.max(Math.abs(low), Math.abs(high));
  const margin = flat ? Math.abs(high) * 0.05 || 1 : (high - low) * (axis === 'x' ? 0.02 : 0.06);
  const floor = axis === 'y' && self.curves.every((c) => c.kind === 'bars') ? 0 : low - margin;
  return [floor, high + margin];
}

function fit(self) {
  self.zoomed = false;
  const [x0, x1] = fullRange(self, 'x');
  const [y0, y1] = fullRange(self, 'y');
  self.chart?.batch(() => {
    self.chart.setScale('x', { min: x0, max: x1 });
    self.chart.setScale('y', { min: y0, max: y1 });
  });
}

function axes(self) {
  const common = {
    stroke: () => css('--muted'),
    font: '11px system-ui, sans-serif',
    labelFont: '12px system-ui, sans-serif',
    grid: { stroke: () => css('--grid'), width: 1 },
    ticks: { show: false },
    labelGap: 2,
  };
  const x = {
    ...common, label: self.options.xlabel, labelSize: 20, size: 28, space: 60,
    values: (_, ticks) => tickLabels(ticks),
  };
  if (self.options.integerX) x.incrs = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1e3, 2e3, 5e3, 1e4, 1e5];
  const y = {
    ...common, label: self.options.ylabel, labelSize: 20, space: 34,
    size: (_, labels) => 14 + 6.4 * Math.max(3, ...(labels ?? []).map((v) => v.length)),
    values: (_, ticks) => tickLabels(ticks),
  };
  if (self.options.logY) {
    y.splits = (_, __, min, max) => decades(min, max);
    y.values = (_, ticks) => ticks.map((t) => `1e${Math.round(Math.log10(t))}`);
    y.filter = (_, ticks) => ticks;
  }
  return [x, y];
}

function decades(min, max) {
  const low = Math.ceil(Math.log10(min) - 1e-9);
  const high = Math.floor(Math.log10(max) + 1e-9);
  const step = Math.max(1, Math.ceil((high - low) / 7));
  const ticks = [];
  for (let e = low; e <= high; e += step) ticks.push(10 ** e);
  return ticks;
}

function create(self, width) {
  const series = self.curves.map((curve, i) => ({
    label: curve.label,
    show: !self.hidden.has(i),
    stroke: () => colourOf(self, i),
    facets: [{ scale: 'x', auto: true }, { scale: 'y', auto: true }],
    paths: (chart) => {
      drawCurve(chart, self.curves[i], colourOf(self, i));
      return null;
    },
  }));
  self.chart = new uPlot({
    mode: 2,
    width,
    height: heightOf(self, width),
    pxAlign: 0,
    padding: [10, 14, 0, 4],
    legend: { show: false },
    scales: {
      x: { time: false, range: () => fullRange(self, 'x') },
      y: { distr: self.options.logY ? 3 : 1, range: () => fullRange(self, 'y') },
    },
    axes: axes(self),
    series: [{}, ...series],
    cursor: {
      x: false, y: false, points: { show: false }, dataIdx: () => null,
      drag: { x: true, y: true, uni: 24, dist: 4 },
      bind: { dblclick: () => () => { fit(self); return null; } },
    },
    hooks: {
      setSelect: [() => { self.zoomed = true; }],
      draw: [(chart) => {
        self.options.overlay?.(chart);
        placeMarks(self);
      }],
    },
  }, dataOf(self), self.box);
  self.chart.over.append(self.hint);
  listen(self);
}

function rebuild(self) {
  if (!self.chart) return;
  self.chart.destroy();
  create(self, Math.floor(self.box.clientWidth));
  placeMarks(self);
}

/** The point drawn nearest to a position in the plot area: {curve, i, x, y} or null. */
function nearest(self, left, top, reach) {
  let best = null;
  let distance = reach * reach;
  self.curves.forEach((curve, k) => {
    if (self.hidden.has(k) || curve.silent) return;
    for (let i = 0; i < curve.x.length; ++i) {
      const x = self.chart.valToPos(curve.x[i], 'x');
      const bar = curve.kind === 'bars';
      const y = self.chart.valToPos(curve.y[i], 'y');
      const d = (x - left) ** 2 + (bar ? 0 : (y - top) ** 2);
      if (d < distance) {
        distance = d;
        best = { curve, k, i, x, y };
      }
    }
  });
  return best;
}

function listen(self) {
  const over = self.chart.over;
  const dot = el('div', { class: 'dot', hidden: true });
  over.append(dot);
  over.addEventListener('pointermove', (event) => {
    const r = over.getBoundingClientRect();
    const hit = event.buttons ? null : nearest(self, event.clientX - r.left, event.clientY - r.top, 60);
    showHint(self, dot, hit, r);
    self.hit = hit;
  });
  over.addEventListener('pointerleave', () => showHint(self, dot, null));
  over.addEventListener('pointerdown', (e) => { self.pressed = [e.clientX, e.clientY]; });
  over.addEventListener('click', (e) => {
    const moved = self.pressed ? Math.hypot(e.clientX - self.pressed[0], e.clientY - self.pressed[1]) : 0;
    if (self.hit && moved < 4) self.options.picked?.(self.hit.curve, self.hit.i);
  });
}

function showHint(self, dot, hit, area) {
  const hidden = !hit;
  dot.hidden = hidden;
  self.hint.hidden = hidden;
  if (hidden) return;
  const { curve, i, x, y } = hit;
  dot.style.cssText = `left:${x}px;top:${y}px;--c:${colourOf(self, hit.k)}`;
  const lines = self.options.describe?.(curve, i) ?? [
    `${curve.label}: ${num(curve.y[i], 6)}`,
    `${self.options.xlabel ?? 'x'}: ${num(curve.x[i], 6)}`,
  ];
  self.hint.replaceChildren(...lines.map((line) => el('div', {}, line)));
  const right = x > area.width / 2;
  self.hint.style.cssText =
    `left:${x + (right ? -12 : 12)}px;top:${Math.max(4, Math.min(y, area.height - 60))}px;` +
    `transform:translateX(${right ? '-100%' : '0'})`;
}

/** Small rings on the curves: where the frame shown above is. */
function placeMarks(self) {
  if (!self.chart) return;
  const over = self.chart.over;
  over.querySelectorAll('.ring').forEach((n) => n.remove());
  for (const [px, py] of self.marks) {
    const x = self.chart.valToPos(px, 'x');
    const y = self.chart.valToPos(py, 'y');
    if (!(x >= 0 && x <= over.clientWidth && y >= 0 && y <= over.clientHeight)) continue;
    const ring = el('div', { class: 'ring' });
    ring.style.cssText = `left:${x}px;top:${y}px`;
    over.append(ring);
  }
}
