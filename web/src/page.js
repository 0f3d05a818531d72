// The sections of the report page.
import { bodySection } from './body_section.js';
import { readSpace, spaceSection } from './space_section.js';
import { convergenceSection } from './convergence.js';
import { readBody, readHistory, readIncrements } from './data.js';
import { diagnosisSection } from './diagnosis_section.js';
import { el } from './dom.js';
import { historySection } from './histories.js';
import { header, modelSection, runSection } from './tables.js';

/** The frame of a step and increment, else the nearest in time. */
function frameOf(body, { step, index, increment, time }) {
  const wanted = increment ?? index;
  const same = body.frames.findIndex((f) =>
    String(f.step) === String(step) && Number(f.increment) === Number(wanted));
  if (same >= 0 || typeof time !== 'number') return same;
  let best = 0;
  body.frames.forEach((f, i) => {
    if (Math.abs(f.time - time) < Math.abs(body.frames[best].time - time)) best = i;
  });
  return best;
}

/** A section that cannot be built leaves a note instead of an empty page. */
function guarded(make) {
  try {
    return make();
  } catch (error) {
    console.error(error);
    return el('section', {}, el('p', { class: 'warning' }, `This part cannot be shown: ${error.message}`));
  }
}

/**
 * {nodes, view}: the sections of a report, and its picture ({body, show, look, playing}; null: there is none).
 * `look` is that of an earlier picture of the same bodies: this one then shows them so.
 */
export function build(report, look) {
  const increments = readIncrements(report);
  const history = readHistory(report);
  let view = null;
  let histories = null;
  const goTo = (where) => {
    const frame = view ? frameOf(view.body, where) : -1;
    if (frame >= 0) view.show(frame);
  };
  const historyPart = guarded(() => (histories = historySection(report, history, goTo)).section);
  const bodyPart = guarded(() => {
    const space = report.mesh?.dimension === 3;
    const body = space ? readSpace(report) : readBody(report);
    if (!body) return null;
    const preset = report.status === 'failed' || report.live ? { frame: body.frames.length - 1 } : {};
    const made = (space ? spaceSection : bodySection)(body, (frame) => histories?.follow(frame),
      { preset: { ...preset, ...look?.state }, camera: look?.camera });
    view = { ...made, body };
    if (look?.where) goTo(look.where);
    return made.section;
  });
  const energy = histories?.energy;
  const convergence = guarded(() => convergenceSection(report, increments, goTo));
  const parts = report.status === 'failed'
    ? [guarded(() => diagnosisSection(report)), convergence, bodyPart, historyPart, energy]
    : [bodyPart, historyPart, energy, convergence];
  parts.push(guarded(() => modelSection(report)), guarded(() => runSection(report, increments)));
  const shown = parts.filter(Boolean);
  const links = shown.filter((s) => s.id).map((s) =>
    el('a', { href: `#${s.id}` }, s.querySelector('h2').textContent));
  return { view, nodes: [header(report, increments), el('nav', {}, ...links), ...shown,
    el('footer', {}, `Osculate ${report.osculate ?? ''}. Plots: drag to zoom, double click to go back, ` +
      `click a point to show its frame. Body: ${report.mesh?.dimension === 3 ? 'drag to turn, shift and drag' : 'drag'} ` +
      'to move, click it and use the wheel to zoom, ' +
      'arrow keys to step through the frames.')] };
}
