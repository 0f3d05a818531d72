// A run that goes on (`osculate view`, docs/view.md): asks for what is new and shows it.
import { el, tick } from './dom.js';
import { num } from './format.js';
import { build } from './page.js';
import { plot } from './plot.js';
import { countedStates } from './states.js';
import { scope } from './theme.js';

/** What is known of the run: {run, state, entries, frames (by the number of their entry), base}. */
export const nothing = () => ({ run: '', state: null, entries: [], frames: new Map(), base: null });

/** What is known with an answer of the server: of another run nothing else is kept. */
export function withState(known, state) {
  const kept = state.run === known.run ? known : { ...nothing(), run: state.run };
  return { ...kept, state, entries: [...kept.entries.slice(0, state.from), ...state.entries] };
}

/** Numbers of the entries whose frames are shown: at most `most`, evenly, the last one among them. */
export function chosenFrames(entries, most) {
  const all = entries.flatMap((entry, i) => (entry.frame ? [i] : []));
  let stride = 1;
  while (Math.ceil(all.length / stride) >= Math.max(2, most)) stride *= 2;
  return all.filter((_, k) => k % stride === 0 || k === all.length - 1);
}

/** So many frames of a mesh are kept together, as in the report. */
export function mostFrames(mesh) {
  const values = 8e6 / 14;
  const points = mesh?.points?.shape?.[0] ?? mesh?.points?.length ?? 0;
  return mesh?.dimension === 3 ? Math.min(60, Math.floor(values / Math.max(points, 1))) : 60;
}

/** Rigid lines of all frames, as the report has them. */
function rigidOf(frames) {
  return (frames[0]?.rigid ?? []).map((line, k) => ({
    ...line, polyline: frames.map((f) => f.rigid?.[k]?.polyline ?? line.polyline),
  }));
}

const killedText = 'Its process ended without a word';

/** What is said of how the run stands. */
function messageOf(state, entries) {
  if (state.status !== 'killed') return state.message;
  const there = entries.length ? '; what had converged is shown. osculate run --restart goes on from there' : '';
  return [`${killedText}${there}.`, state.message].filter(Boolean).join(' ');
}

/** What is said when an answer of the server is missing. */
export function lostText(error) {
  return error instanceof TypeError
    ? 'osculate view does not answer any more: this is what was known last.'
    : `osculate view cannot tell how the run stands (${error.message}): this is what was known last.`;
}

/** The report (docs/report_data.md) of what is known. */
export function compose({ state, entries, frames, base }) {
  const steps = (base?.summary?.steps ?? []).map(({ name }) => ({ name, increments: [] }));
  const iterations = [];
  for (const { step, row, increment } of entries) {
    if (!increment) continue;
    while (steps.length < step) steps.push({ name: `step ${steps.length + 1}`, increments: [] });
    steps[step - 1].increments.push({ ...increment, increment: row[1] });
    iterations.push({ step, increment: row[1], residuals: increment.residuals, energies: increment.energies });
  }
  const shown = [...frames.keys()].sort((a, b) => a - b).map((i) => frames.get(i));
  const ended = state.status !== 'running';
  return {
    title: base?.title || state.model, osculate: base?.osculate, live: true,
    status: state.status === 'done' ? 'done' : ended ? 'failed' : 'running',
    message: messageOf(state, entries),
    model: base?.model, plots: base?.plots, mesh: base?.mesh,
    summary: { steps: steps.filter((s) => s.increments.length) }, iterations,
    history: { columns: state.columns, rows: entries.map((entry) => entry.row) },
    frames: shown, rigid: rigidOf(shown),
  };
}

/** The increment under way: {text, curves, counts}; null before the first iteration. Rows of iterations.csv. */
export function underWay({ state, entries, base }) {
  const rows = state?.iterations ?? [];
  if (!rows.length) return null;
  const [step, increment, time, number] = rows.at(-1);
  const last = entries.at(-1)?.row ?? [0, 0];
  const over = last[0] > step || (last[0] === step && last[1] >= increment);
  const name = base?.summary?.steps?.[step - 1]?.name ?? `step ${step}`;
  const attempts = rows.filter((r, i) => i > 0 && r[2] !== rows[i - 1][2]).length;
  const curve = (label, column) => {
    const made = { label, x: [], y: [] };
    rows.forEach((row, i) => {
      if (i && row[3] <= rows[i - 1][3]) { // begins again
        made.x.push(NaN);
        made.y.push(NaN);
      }
      made.x.push(i + 1);
      made.y.push(row[column]);
    });
    return made;
  };
  const [open, stick, slipping, closed] = rows.at(-1).slice(7);
  const counts = { open, stick, slipping, closed };
  return {
    text: `${name}, increment ${increment} to time ${num(time, 5)}: ` +
      `${over ? `converged after ${rows.length} iterations` : `iteration ${number}`}` +
      `${!over && attempts ? `, after ${attempts} other attempt${attempts > 1 ? 's' : ''}` : ''}`,
    measures: `residual ${num(rows.at(-1)[4], 3)}, energy ${num(rows.at(-1)[5], 3)}`,
    counts: open + stick + slipping + closed > 0
      ? countedStates([counts]).map((key) => `${key} ${counts[key]}`).join(', ') : '',
    curves: [curve('residual', 4), curve('energy', 5)],
  };
}

const emptyCurves = ['residual', 'energy'].map((label) => ({ label, x: [], y: [] }));

/** The section of the increment under way; `update(known)` fills it. To be made outside of any scope: it stays. */
function liveSection(follow) {
  const text = el('p', { class: 'message' });
  const log = el('pre', { class: 'log' });
  const charts = el('div');
  const section = el('section', { id: 'live' }, el('h2', {}, 'Now'), el('div', { class: 'controls' }, follow), text,
    el('div', { class: 'grid' }, charts, log));
  const chart = plot(charts, {
    title: 'Iterations of this increment', xlabel: 'iteration', ylabel: 'measure, relative', logY: true, integerX: true,
  }, emptyCurves);
  return {
    section,
    update(known) {
      const now = underWay(known);
      section.hidden = known.state.status !== 'running';
      text.replaceChildren(...[now?.text ?? 'nothing has been iterated yet', now?.measures, now?.counts]
        .filter(Boolean).map((line) => el('div', {}, line)));
      log.textContent = known.state.log.join('\n');
      chart.show(now ? now.curves : emptyCurves);
    },
  };
}

async function ask(path) {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
  return answer.json();
}

/** What is new; the same object where nothing is. */
async function refreshed(known) {
  const state = await ask(`/state.json?run=${encodeURIComponent(known.run)}&from=${known.entries.length}`);
  const next = withState(known, state);
  const older = next.base && next.base.status !== 'running' && state.status === 'running'; // it has been taken up again
  if (!next.base || older) next.base = await ask('/report.json').catch(() => null); // none: the model wants no report
  const wanted = chosenFrames(next.entries, mostFrames(next.base?.mesh));
  const frames = new Map();
  for (const i of next.base?.mesh?.points ? wanted : []) {
    const frame = next.frames.get(i) ?? await ask(`/frame.json?entry=${i}`).catch(() => null);
    if (frame) frames.set(i, frame);
  }
  return { ...next, frames };
}

/** The report that the run has left, once it is there; null before. */
async function finalReport(known) {
  if (known.state.status === 'running' || known.state.status === 'killed') return null;
  const report = await ask('/report.json').catch(() => null);
  return report && report.status !== 'running' ? report : null;
}

/** Whether the user is in the middle of something that building anew would take out of his hands. */
function attention(root) {
  let pressed = false;
  let touched = 0;
  for (const [name, down] of [['pointerdown', true], ['pointerup', false], ['pointercancel', false], ['keydown', false]]) {
    addEventListener(name, () => {
      pressed = down;
      touched = Date.now();
    }, true);
  }
  addEventListener('pointermove', (e) => { // a list that drops down may keep the end of a press to itself
    if (!e.buttons) pressed = false;
  }, true);
  addEventListener('change', () => {
    pressed = false;
    touched = Date.now();
  }, true);
  addEventListener('blur', () => { pressed = false; });
  const chosen = () => root.contains(document.activeElement) && document.activeElement.matches('select, input');
  return () => pressed || (chosen() && Date.now() - touched < 4000);
}

/** Builds the page of a report in `host`, looking at the bodies of the same run as before; `live` stays, below the heading. */
function builder(host, live) {
  let end = () => {};
  let view = null;
  let shown = null;
  return {
    playing: () => view?.playing() ?? false,
    show(report, run) {
      const look = run === shown ? view?.look() : undefined;
      shown = run;
      const opened = [...host.querySelectorAll('details')].map((d) => d.open);
      host.style.minHeight = `${host.offsetHeight}px`; // the place on the page stays
      end();
      end = scope();
      const made = build(report, look);
      view = made.view;
      host.replaceChildren(made.nodes[0], live, ...made.nodes.slice(1));
      host.querySelectorAll('details').forEach((d, i) => { d.open = opened[i] ?? false; });
      setTimeout(() => { host.style.minHeight = ''; }, 500);
    },
  };
}

/** Asks once a second, for ever: another run may begin in the folder. */
export function watch(root) {
  let following = true;
  const live = liveSection(tick('follow the run', true, (on) => { following = on; }));
  const lost = el('p', { class: 'warning', hidden: true });
  const host = el('div', {}, live.section);
  root.replaceChildren(lost, host);
  const page = builder(host, live.section);
  const busy = attention(host);
  let [known, built, pause, tries] = [nothing(), '', 0, 0];
  const look = async () => {
    known = await refreshed(known);
    document.title = known.base?.title || known.state.model;
    live.update(known);
    const now = `${known.run} ${known.entries.length} ${known.state.status}`;
    const final = now !== built ? await finalReport(known) : null;
    if (now === built || (!final && (!following || page.playing())) || busy() || Date.now() < pause) return;
    const begin = Date.now();
    page.show(final ?? compose(known), known.run);
    pause = Date.now() + 4 * (Date.now() - begin);
    const there = final || known.state.status === 'running' || known.state.status === 'killed';
    tries = there ? 0 : tries + 1; // a run that found the disk full has left no report
    if (there || tries > 3) built = now;
  };
  const again = async () => {
    const error = await look().then(() => null, (reason) => reason);
    lost.hidden = !error;
    if (error) lost.textContent = lostText(error);
    if (error && !(error instanceof TypeError)) console.error(error);
    setTimeout(again, 1000);
  };
  again();
}
