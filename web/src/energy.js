// Where the energy of a run with inertia is: what the bodies hold, what has gone, and whether the sum is kept.
import { el } from './dom.js';
import { num } from './format.js';
import { plot } from './plot.js';

const held = ['kinetic', 'strain', 'contact'];
const exchanged = ['external', 'friction', 'damping', 'plastic', 'numerical', 'residual'];
const optional = ['plastic']; // of models with materials that dissipate

/** Columns that the ledger shows. */
export function isLedger(name) {
  return name === 'elapsed' || (name.startsWith('energy.') && [...held, ...exchanged].includes(name.slice(7)));
}

/** Where the ledger begins: a step without inertia has no entries, and the next one with it begins anew. */
function pieces(elapsed, entries) {
  const list = [];
  elapsed.forEach((t, i) => {
    const begins = i === 0 && elapsed[1] > 0; // at rest
    if (t === 0 && !begins && entries.every((e) => !e[i])) return;
    const before = list.at(-1)?.at(-1);
    if (before === undefined || before !== i - 1 || t < elapsed[before]) list.push([]);
    list.at(-1).push(i);
  });
  return list;
}

/**
 * The ledger of a history: {rows (of the history, -1 between pieces), x, curves: Map name -> numbers, largest, lost,
 * open}; null without inertia. A second piece follows the first on the axis.
 */
export function ledger(history) {
  const elapsed = history?.column('elapsed');
  const names = [...held, ...exchanged].filter((name) => !optional.includes(name) || history?.column(`energy.${name}`));
  const columns = new Map(names.map((name) => [name, history?.column(`energy.${name}`)]));
  if (!elapsed || [...columns.values()].some((c) => !c)) return null;
  const parts = pieces(elapsed, [...columns.values()]);
  const rows = parts.flatMap((part, k) => (k ? [-1, ...part] : part));
  if (rows.length < 2) return null;
  let begin = 0;
  const x = parts.flatMap((part, k) => {
    const times = part.map((i) => begin + elapsed[i]);
    begin = times.at(-1);
    return k ? [NaN, ...times] : times;
  });
  const along = (list) => rows.map((i) => (i < 0 ? NaN : list[i]));
  const curves = new Map([...columns].map(([name, list]) => [name, along(list)]));
  const total = along(elapsed.map((_, i) => held.reduce((sum, name) => sum + columns.get(name)[i], 0)));
  const most = (list) => list.reduce((m, v) => (Math.abs(v) > m ? Math.abs(v) : m), 0);
  return {
    rows, x, curves, total,
    largest: Math.max(most(total), ...[...held, ...exchanged.slice(0, 4)].filter((name) => curves.has(name)).map((name) => most(curves.get(name)))),
    lost: parts.reduce((sum, part) => sum + columns.get('numerical')[part.at(-1)], 0),
    open: most(curves.get('residual')),
  };
}

/** Whether the books balance, in a sentence. */
export function closure({ largest, lost, open }) {
  if (!(largest > 0)) return 'There is no energy in this run.';
  const share = (v) => `${num((100 * v) / largest, 2)} %`;
  const gone = lost < 0 ? `${num(-lost, 3)} (${share(-lost)}) has come in numerically`
    : `${num(lost, 3)} (${share(lost)}) has been lost numerically`;
  return `The largest energy is ${num(largest, 4)}; ${gone}. ` +
    `The ledger closes to ${num(open / largest, 2)} of the largest energy (its residual).`;
}

/** {section, follow(row)}: `picked(row)` is called with a row of the history. */
export function energySection(history, picked, nameOf) {
  const found = ledger(history);
  if (!found) return { section: null, follow: () => {} };
  const { rows, x, curves, total } = found;
  const grid = el('div', { class: 'grid' });
  const moves = (name) => curves.get(name)?.some((v) => v);
  const still = [...curves.keys()].filter((name) => !moves(name));
  const curve = (name) => ({ label: name, x, y: curves.get(name), dots: false, dashed: name === 'residual' });
  const groups = [
    ['Energy that the bodies hold', [...held.filter(moves).map(curve), { label: 'sum', x, y: total, dots: false, dashed: true }]],
    ['Energy that has come (external) and gone', exchanged.filter(moves).map(curve)],
  ].filter(([, list]) => list.length);
  const followers = groups.map(([title, list]) => {
    const shown = plot(grid, {
      title, xlabel: 'elapsed', ylabel: 'energy', legend: true,
      describe: (c, i) => [`${c.label}: ${num(c.y[i], 6)}`, `elapsed: ${num(c.x[i], 6)}`, nameOf(rows[i])],
      picked: (_, i) => picked(rows[i]),
    }, list);
    return (i) => shown.mark(i < 0 ? [] : list.map((c) => [c.x[i], c.y[i]]));
  });
  const section = el('section', { id: 'energy' }, el('h2', {}, 'Energy'), el('p', {}, closure(found)), grid,
    still.length > 0 && el('p', { class: 'readout' }, `Zero throughout: ${still.join(', ')}.`));
  return { section, follow: (row) => followers.forEach((f) => f(rows.indexOf(row))) };
}
