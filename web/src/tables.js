// Header, model table, increments, time spent.
import { el } from './dom.js';
import { count, num, seconds } from './format.js';
import { countedStates } from './states.js';

const statusWords = { done: 'done', failed: 'stopped before its end', running: 'still running' };

export function header(report, increments) {
  const s = report.summary ?? {};
  const total = Object.values(s.seconds ?? {}).reduce((sum, v) => sum + v, 0);
  const sum = (key) => s.total?.[key] ?? increments.reduce((n, i) => n + (i[key] ?? 0), 0);
  const tiles = [
    s.unknowns !== undefined && [count(s.unknowns), 'unknowns'],
    increments.length && [count(increments.length), 'increments'],
    increments.length && [count(sum('iterations')), 'iterations'],
    increments.length && [count(sum('cutbacks')), 'cut-backs'],
    s.seconds && [seconds(s.seconds.total ?? total), 'run time'],
    s.peak_memory_mb !== undefined && [`${num(s.peak_memory_mb, 3)} MB`, 'peak memory'],
  ].filter(Boolean);
  const status = report.status ?? 'done';
  return el('header', { class: status },
    el('div', { class: 'title' }, el('h1', {}, report.title || 'Analysis'),
      el('span', { class: 'badge' }, statusWords[status] ?? status)),
    report.message && el('p', { class: 'message' }, report.message),
    tiles.length > 0 && el('div', { class: 'tiles' }, ...tiles.map(([value, name]) =>
      el('div', { class: 'tile' }, el('b', {}, String(value)), el('span', {}, name)))));
}

export function modelSection(report) {
  const groups = (report.model ?? []).filter((g) => g.rows?.length);
  if (!groups.length) return null;
  return el('section', { id: 'model' }, el('h2', {}, 'Model'), el('div', { class: 'grid tables' },
    ...groups.map((g) => el('div', { class: 'group' }, el('h3', {}, g.heading),
      el('table', {}, el('tbody', {}, ...g.rows.map((row) =>
        el('tr', {}, ...row.map((cell, i) => el(i ? 'td' : 'th', {}, String(cell)))))))))));
}

/** Table of increments (folded away) and the time spent in each phase. */
export function runSection(report, increments) {
  const spent = report.summary?.seconds ?? {};
  // The analysis as a whole is shown only where its parts are not known.
  const sums = spent.solver === undefined ? ['total'] : ['total', 'analysis'];
  const phases = Object.entries(spent).filter(([name]) => !sums.includes(name));
  if (!increments.length && !phases.length) return null;
  return el('section', { id: 'run' }, el('h2', {}, 'Run'),
    phases.length > 0 && phaseBars(phases), increments.length > 0 && incrementTable(increments));
}

function phaseBars(phases) {
  const largest = Math.max(...phases.map(([, v]) => v), 1e-12);
  return el('table', { class: 'phases' }, el('tbody', {}, ...phases.map(([name, value]) => {
    const bar = el('div', { class: 'bar' });
    bar.style.width = `${(100 * value) / largest}%`;
    return el('tr', {}, el('th', {}, name), el('td', { class: 'number' }, seconds(value)),
      el('td', { class: 'fill' }, bar));
  })));
}

function incrementTable(increments) {
  const columns = [['step', 'step'], ['index', 'increment'], ['time', 'time'], ['iterations', 'iterations'],
    ['cutbacks', 'cut-backs'], ['residual', 'residual'], ['energy', 'energy'],
    ...countedStates(increments).map((key) => [key, key])];
  if (increments.some((i) => i.wasted_iterations)) columns.splice(4, 0, ['wasted_iterations', 'given up']);
  const cell = (key, v) => el('td', { class: key === 'step' ? '' : 'number' },
    typeof v === 'number' ? num(v, key === 'residual' || key === 'energy' ? 3 : 6) : String(v ?? ''));
  return el('details', {}, el('summary', {}, `All ${increments.length} increments`),
    el('div', { class: 'scroll' }, el('table', { class: 'increments' },
      el('thead', {}, el('tr', {}, ...columns.map(([key, text]) =>
        el('th', { class: key === 'step' ? '' : 'number' }, text)))),
      el('tbody', {}, ...increments.map((i) =>
        el('tr', { class: i.cutbacks ? 'cut' : '' }, ...columns.map(([key]) => cell(key, i[key]))))))));
}
