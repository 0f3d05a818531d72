// Names of sets and numbers of nodes on request.
import { choice } from './dom.js';
import { css } from './theme.js';

/** The numbers of the nodes as the mesh file has them: by point. */
export const nodeNumber = (body, i) => body.numbers?.[i] ?? i + 1;

/** What can be labelled: nothing, all sets, the nodes, or the nodes of one set. */
export function labelChoice(body, value, changed) {
  const sets = (body.sets ?? []).map((s, k) => [`set ${k}`, `nodes of ${s.name}`]).filter((_, k) => body.sets[k].points);
  return choice('Labels', [['none', 'none'], ...(body.sets?.length ? [['sets', 'sets']] : []),
    ['nodes', 'nodes'], ...sets], value, changed);
}

/** [point, text] of the labels wanted. */
export function labelsOf(body, wanted) {
  const numbered = (points) => points.map((i) => [i, String(nodeNumber(body, i))]);
  if (wanted === 'sets') return body.sets.map((s) => [s.point, s.name]);
  if (wanted === 'nodes') return numbered(body.nodes);
  return wanted?.startsWith('set ') ? numbered(body.sets[Number(wanted.slice(4))].points) : [];
}

/** Draws labels at pixels X, Y; of those that would cover one another the first. */
export function drawLabels(view, state) {
  const { ctx, X, Y, W, H, dpr, body } = view;
  const size = 11.5 * dpr;
  const taken = new Set();
  ctx.font = `600 ${size}px system-ui, sans-serif`;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'middle';
  ctx.lineJoin = 'round';
  ctx.lineWidth = 3 * dpr;
  ctx.strokeStyle = css('--panel');
  for (const [i, text] of labelsOf(body, state.labels)) {
    const [x, y] = [X[i], Y[i]];
    if (!(x >= 0 && y >= 0 && x < W && y < H) || view.D?.[i] > 0) continue;
    ctx.fillStyle = css('--accent');
    ctx.fillRect(x - 2 * dpr, y - 2 * dpr, 4 * dpr, 4 * dpr);
    const width = ctx.measureText(text).width + 8 * dpr;
    const cells = [];
    for (let k = 0; k * size < width; ++k) cells.push(`${Math.floor(x / size) + k},${Math.round(y / size)}`);
    if (cells.some((c) => taken.has(c))) continue;
    cells.forEach((c) => taken.add(c));
    ctx.strokeText(text, x + 5 * dpr, y);
    ctx.fillStyle = css('--ink');
    ctx.fillText(text, x + 5 * dpr, y);
  }
}
