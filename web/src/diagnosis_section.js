// Why an analysis stopped, and a picture of the rigid motions that nothing resists.
import { bodySection } from './body_section.js';
import { numbers, readBody } from './data.js';
import { choice, el } from './dom.js';
import { num } from './format.js';
import { readSpace, spaceSection } from './space_section.js';

const cycle = 24; // frames of one swing

/** `body 'block': along (1, 0)` */
function nameOf(motion) {
  const vector = (v) => `(${v.map((c) => num(c, 3)).join(', ')})`;
  const turns = Math.abs(motion.rotation ?? 0) > 0.5;
  const plane = motion.direction.length === 2;
  const how = !turns ? `along ${vector(motion.direction)}`
    : `turning about ${vector(motion.center)}${plane ? '' : `, axis ${vector(motion.axis)}`}`;
  return `body '${motion.body}': ${how}`;
}

/** How far something is spread out, over all directions. */
function spread(list) {
  let [low, high] = [Infinity, -Infinity];
  for (const x of list) [low, high] = [Math.min(low, x), Math.max(high, x)];
  return high - low;
}

/** Whether the last iterate is near enough to be shown: iterations may throw a free body far away. */
function near(report) {
  const far = 2 * spread(numbers(report.mesh.points));
  return numbers(report.last_iterate.u).every((v) => Math.abs(v) <= far);
}

/** The report of a body that swings to and fro in a motion about the place where the analysis stopped. */
function swinging(report, k) {
  const { last_iterate: last, mesh } = report;
  const reference = numbers(mesh.points);
  const u = near(report) ? numbers(last.u) : [];
  const motion = numbers(last.motions[k]);
  const dim = mesh.dimension === 3 ? 3 : 2;
  const points = reference.map((x, i) => x + (u[i] ?? 0));
  const n = points.length / dim;
  const far = 0.12 * spread(points);
  const size = Float32Array.from({ length: n }, (_, i) => (
    Math.hypot(...Array.from({ length: dim }, (__, d) => motion[dim * i + d]))));
  const frames = Array.from({ length: cycle }, (_, i) => {
    const phase = Math.cos((2 * Math.PI * (i + 1)) / cycle);
    return {
      u: motion.map((v) => far * phase * v), fields: { 'free motion': size.map((v) => Math.abs(phase) * v) },
    };
  });
  return { mesh: { ...mesh, points }, frames, rigid: last.rigid };
}

function picture(report, k) {
  const shown = swinging(report, k);
  const space = report.mesh.dimension === 3;
  const body = space ? readSpace(shown) : readBody(shown);
  if (!body) return el('div');
  const look = {
    id: '', title: '', preset: { field: 'free motion', ghost: true, contact: 'none', points: false },
  };
  return (space ? spaceSection : bodySection)(body, () => {}, look).section;
}

/** Null unless the analysis failed with a diagnosis. */
export function diagnosisSection(report) {
  const found = report.summary?.diagnosis;
  if (!found) return null;
  const section = el('section', { id: 'diagnosis' }, el('h2', {}, 'Diagnosis'),
    el('table', {}, ...[['cause', found.cause], ['solver', found.reason], ['proposal', found.proposal]]
      .filter(([, text]) => text).map(([name, text]) => el('tr', {}, el('th', {}, name), el('td', {}, text)))));
  const motions = (found.free_motions ?? []).slice(0, report.last_iterate?.motions?.length ?? 0);
  if (!motions.length || !report.mesh?.points) return section;
  const host = el('div', {}, picture(report, 0));
  section.append(
    el('p', {}, `${near(report) ? 'Where the analysis stopped' : 'The undeformed place'} (dashed), and ` +
      'the body moved as nothing resists it, exaggerated; play it to see it swing.'),
    el('div', { class: 'controls' }, choice('Free motion', motions.map((m, k) => [k, nameOf(m)]), 0,
      (k) => host.replaceChildren(picture(report, Number(k))))),
    host);
  return section;
}
