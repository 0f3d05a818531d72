// How the increments converged.
import { choice, el } from './dom.js';
import { colourMap, cssColour } from './colour.js';
import { symbol } from './curve.js';
import { num } from './format.js';
import { plot } from './plot.js';
import { countedStates, stateColour } from './states.js';
import { css } from './theme.js';

/** Section of iteration bars, convergence curves and contact states; null without increments. */
export function convergenceSection(report, increments, picked) {
  if (!increments.length && !report.iterations?.length) return null;
  const grid = el('div', { class: 'grid' });
  const section = el('section', { id: 'convergence' }, el('h2', {}, 'Convergence'), grid);
  if (increments.length) iterationBars(grid, increments, picked);
  if (report.iterations?.length) convergenceCurves(grid, report.iterations, increments);
  if (increments.some((i) => i.open || countedStates([i]).length > 1)) statePlot(grid, increments, picked);
  return section;
}

function about(i) {
  return [`${i.step}, increment ${i.index}, time ${num(i.time, 5)}`,
    `${i.iterations} iterations${i.cutbacks ? `, ${i.cutbacks} cut-backs` : ''}` +
      (i.wasted_iterations ? `, and ${i.wasted_iterations} of attempts that were given up` : ''),
    `residual ${num(i.residual, 3)}, energy ${num(i.energy, 3)}`,
    countedStates([i]).map((key) => `${key} ${i[key] ?? 0}`).join(', ')];
}

/** Where a new step begins, on an axis of increment numbers. */
function stepMarks(chart, increments) {
  const { ctx } = chart;
  const { left, top, width, height } = chart.bbox;
  const scale = devicePixelRatio || 1;
  ctx.save();
  ctx.font = `${11 * scale}px system-ui, sans-serif`;
  ctx.fillStyle = css('--muted');
  ctx.strokeStyle = css('--muted');
  ctx.textBaseline = 'top';
  ctx.textAlign = 'left';
  ctx.setLineDash([2 * scale, 3 * scale]);
  let free = left;
  increments.forEach((inc, i) => {
    if (i && increments[i - 1].step === inc.step) return;
    const x = chart.valToPos(inc.number - 0.5, 'x', true);
    if (x < left - 1 || x > left + width) return;
    if (i) {
      ctx.beginPath();
      ctx.moveTo(x, top);
      ctx.lineTo(x, top + height);
      ctx.stroke();
    }
    if (x < free - 1 || x + ctx.measureText(inc.step).width > left + width) return;
    ctx.fillText(inc.step, x + 4 * scale, top + 2 * scale);
    free = x + ctx.measureText(inc.step).width + 12 * scale;
  });
  ctx.restore();
}

function iterationBars(grid, increments, picked) {
  const x = increments.map((i) => i.number);
  const y = increments.map((i) => i.iterations ?? 0);
  const cut = increments.some((i) => i.cutbacks);
  const top = Math.max(...y);
  const curves = [{
    label: 'iterations', kind: 'bars', x, y,
    shade: (i) => (increments[i].cutbacks ? css('--bad') : css('--curve-0')),
  }];
  plot(grid, {
    title: cut ? 'Iterations per increment (red: after a cut-back)' : 'Iterations per increment',
    xlabel: 'increment', ylabel: 'iterations', integerX: true, yRange: [0, top * 1.12],
    xRange: [0.5, increments.length + 0.5],
    describe: (_, i) => about(increments[i]),
    picked: (_, i) => picked(increments[i]),
    overlay: (chart) => {
      stepMarks(chart, increments);
      increments.filter((i) => i.cutbacks).forEach((i) => cutMark(chart, i));
    },
  }, curves);
}

function cutMark(chart, inc) {
  const scale = devicePixelRatio || 1;
  const x = chart.valToPos(inc.number, 'x', true);
  const y = chart.valToPos(inc.iterations, 'y', true);
  const { left, width, top } = chart.bbox;
  if (x < left || x > left + width || y < top) return;
  symbol(chart.ctx, 'triangle', x, y - 7 * scale, 3.5 * scale, css('--bad'));
}

/** One curve per increment (early: dark, late: bright), of the residual or the energy. */
function convergenceCurves(grid, iterations, increments) {
  const state = { measure: iterations.some((i) => i.residuals?.length) ? 'residuals' : 'energies', only: 'all' };
  const map = colourMap('sequential');
  const colour = (k) => cssColour(map[Math.round(20 + (k / Math.max(1, iterations.length - 1)) * 190)]);
  const make = () => {
    const curve = { label: 'increments', x: [], y: [], of: [], dots: false, width: 1.25 };
    iterations.forEach((inc, k) => {
      if (state.only !== 'all' && Number(state.only) !== k) return;
      (inc[state.measure] ?? []).forEach((v, i) => {
        curve.x.push(i + 1);
        curve.y.push(v);
        curve.of.push(k);
      });
      curve.x.push(NaN);
      curve.y.push(NaN);
      curve.of.push(k);
    });
    curve.shade = (i) => colour(curve.of[i]);
    if (state.only !== 'all' || iterations.length <= 12) curve.dots = true;
    return [curve];
  };
  const name = (k) => `${increments[k]?.step ?? iterations[k].step}, increment ${iterations[k].increment}`;
  const shown = plot(grid, {
    title: 'Convergence within the increments', xlabel: 'iteration', ylabel: 'measure, relative', logY: true,
    integerX: true,
    describe: (c, i) => {
      return [name(c.of[i]), `iteration ${c.x[i]}: ${num(c.y[i], 4)}`];
    },
  }, make());
  const update = (patch) => {
    Object.assign(state, patch);
    shown.show(make());
  };
  const names = iterations.map((_, k) => [k, name(k)]);
  shown.frame.querySelector('figcaption').after(el('div', { class: 'controls' },
    choice('', [['residuals', 'residual'], ['energies', 'energy']], state.measure,
      (measure) => update({ measure })),
    choice('', [['all', 'all increments (dark: early)'], ...names], 'all', (only) => update({ only }))));
}

function statePlot(grid, increments, picked) {
  const states = countedStates(increments);
  const most = Math.max(...increments.flatMap((i) => states.map((key) => i[key] ?? 0)));
  const x = increments.map((i) => i.number);
  const curve = (key) => ({
    label: key, x, y: increments.map((i) => i[key] ?? 0), colour: () => stateColour(key), dots: false,
  });
  plot(grid, {
    title: 'Contact states', xlabel: 'increment', ylabel: 'points', integerX: true, yRange: [0, 1.1 * most],
    describe: (_, i) => about(increments[i]),
    picked: (_, i) => picked(increments[i]),
    overlay: (chart) => stepMarks(chart, increments),
  }, [...states.slice(1), 'open'].map(curve));
}
