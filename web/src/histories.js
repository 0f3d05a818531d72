// Histories of the requested quantities, and further curves the program added.
import { numbers } from './data.js';
import { el } from './dom.js';
import { energySection, isLedger } from './energy.js';
import { num } from './format.js';
import { plot } from './plot.js';

/** The plots asked for, or every column over time when none was (but those of the ledger of energies). */
function wanted(report, history) {
  if (report.plots?.length) return report.plots;
  const time = history.names.includes('time') ? 'time' : history.names[0];
  return history.names
    .filter((name) => !['step', 'increment', 'time', 'fraction', time].includes(name) && !isLedger(name))
    .map((name) => ({ title: name, x: time, y: [name] }));
}

/** {section, energy, follow(frame)}: `follow` marks the frame shown on all curves. */
export function historySection(report, history, picked) {
  const grid = el('div', { class: 'grid' });
  const section = el('section', { id: 'histories' }, el('h2', {}, 'Histories'), grid);
  const followers = [];
  for (const p of history ? wanted(report, history) : []) {
    const x = history.column(p.x);
    const names = (Array.isArray(p.y) ? p.y : [p.y]).filter((name) => history.column(name));
    if (!x || !names.length) continue;
    const curves = names.map((name) => ({ label: name, x, y: history.column(name) }));
    const shown = plot(grid, {
      title: p.title ?? names.join(', '), xlabel: p.xlabel ?? p.x,
      ylabel: p.ylabel ?? (names.length === 1 ? names[0] : ''),
      describe: (c, i) => [`${c.label}: ${num(c.y[i], 6)}`, `${p.x}: ${num(c.x[i], 6)}`, rowName(history, i)],
      picked: (_, i) => picked(rowOf(history, i)),
    }, curves);
    followers.push((row) => shown.mark(row < 0 ? [] : curves.map((c) => [c.x[row], c.y[row]])));
  }
  for (const p of report.profiles ?? []) {
    plot(grid, { title: p.title, xlabel: p.xlabel, ylabel: p.ylabel, legend: true }, (p.curves ?? []).map((c) => ({
      label: c.label ?? '', x: numbers(c.x), y: numbers(c.y),
    })));
  }
  const energy = energySection(history, (i) => picked(rowOf(history, i)), (i) => rowName(history, i));
  followers.push(energy.follow);
  return {
    section: grid.children.length ? section : null,
    energy: energy.section,
    follow: (frame) => {
      const row = history ? rowFor(history, frame) : -1;
      followers.forEach((f) => f(row));
    },
  };
}

function rowOf(history, i) {
  const get = (name) => history.text(name)?.[i];
  return { step: get('step'), increment: get('increment'), time: get('time') };
}

function rowName(history, i) {
  const { step, increment } = rowOf(history, i);
  return step === undefined ? '' : `${step}, increment ${increment}`;
}

/** The row of the same step and increment, else the one nearest in time; -1 when neither is known. */
function rowFor(history, frame) {
  const at = (name) => history.names.indexOf(name);
  const [s, k, t] = ['step', 'increment', 'time'].map(at);
  const same = history.rows.findIndex((r) => s >= 0 && k >= 0 &&
    String(r[s]) === String(frame.step) && Number(r[k]) === Number(frame.increment));
  if (same >= 0 || t < 0 || typeof frame.time !== 'number') return same;
  let best = -1;
  history.rows.forEach((r, i) => {
    if (best < 0 || Math.abs(r[t] - frame.time) < Math.abs(history.rows[best][t] - frame.time)) best = i;
  });
  return best;
}
