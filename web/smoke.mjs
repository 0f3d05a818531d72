// Opens a report in headless Chromium and fails on any console message or missing part.
//
// node smoke.mjs [REPORT.html] [--shot PREFIX]; without REPORT, examples are made. A page with a fault does not keep the others from being looked at.
import { writeFileSync } from 'node:fs';
import { basename, join, resolve } from 'node:path';
import { setTimeout as pause } from 'node:timers/promises';
import { BrowserCrashed, check, picture, until } from './browser.mjs';
import { example, page } from './example.mjs';

/** A page as it is shown; parts that it lacks are problems. */
async function look(browser, file, wanted) {
  await browser.send('Page.navigate', { url: `file://${resolve(file)}` });
  await until('page', () => browser.evaluate("document.readyState === 'complete' && document.querySelector('h1') !== null"), Boolean);
  await pause(500); // pictures are drawn in frames to come
  const dom = await browser.evaluate(`document.documentElement.outerHTML.replace(/<script[\\s\\S]*?<\\/script>/g, '')`);
  return wanted.filter((part) => !dom.includes(part)).map((part) => `missing: ${part}`);
}

const energies = ['kinetic', 'strain', 'contact', 'external', 'friction', 'damping', 'numerical', 'residual']
  .map((name) => `energy.${name}`);

/** One cell of every type, a rigid line that moves, missing values, nothing in contact at first. */
function everyCell() {
  const points = [];
  const cells = [];
  const q = [[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0], [0, 0]];
  const t = [[-1, -1], [1, -1], [-1, 1], [0, -1], [0, 0], [-1, 0]];
  Object.entries({ quad4: q.slice(0, 4), quad8: q.slice(0, 8), quad9: q, tri3: t.slice(0, 3), tri6: t,
    line2: q.slice(0, 2), line3: [q[0], q[1], q[4]] }).forEach(([type, nodes], k) => {
    cells.push({ type, connectivity: [nodes.map((_, i) => points.length + i)] });
    nodes.forEach(([x, y]) => points.push([x + 2.5 * k, y + (Math.abs(x) < 1 ? 0.2 : 0)]));
  });
  const values = points.map(([x, y], i) => (i === 3 ? null : x + y));
  const contact = [{ pair: 'p', x: [[-1, -1], [0, -1], [1, -1], [2, -1]],
    pressure: [0, 2, 1, 1], shear: [0, null, -1, 0], normal: [[0, 1], [0, 1], [0, 1], [0, 1]], status: [0, 1, 2, 3] }];
  return {
    title: 'every cell', status: 'running', mesh: { points, cells },
    frames: [{ time: 0, u: points.map(() => [0, 0]), fields: { f: values } },
      { time: 1, u: points.map(([x]) => [0, 0.01 * x * x]), fields: { f: values }, contact }],
    rigid: [{ name: 'r', polyline: [[[-1, -1.3], [15, -1.3]], [[-1, -1], [15, -1]]] }],
    history: { columns: ['time', 'a', 'elapsed', ...energies], rows: [[0, 1, 0, 3, 0, 0, 0, 0, 0, 0, 0],
      [1, null, 1, 1, 1, 0.5, -0.2, 0, 0, 0.3, 1e-16]] },
  };
}

/** A box in space of linear and quadratic faces, a rigid face that moves, values on one face only. */
function space() {
  const corner = (i) => [i & 1, (i >> 1) & 1, i >> 2];
  const points = Array.from({ length: 8 }, (_, i) => corner(i));
  const quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [3, 2, 6, 7]];
  const edge = (a, b) => points.push(points[a].map((v, k) => (v + points[b][k]) / 2)) - 1;
  const eight = [1, 3, 7, 5];
  eight.slice().forEach((a, k) => eight.push(edge(a, eight[(k + 1) % 4])));
  const six = [0, 4, 6];
  six.slice().forEach((a, k) => six.push(edge(a, six[(k + 1) % 3])));
  const n = points.length;
  points.push([-1, -1, -0.1], [2, -1, -0.1], [2, 2, -0.1], [-1, 2, -0.1]);
  const u = (s) => points.map(([x, , z], i) => (i < n ? [0.2 * s * z, 0, -0.1 * s * x] : [0, 0, 9 * s]));
  return {
    title: 'faces in space', status: 'failed', summary: { diagnosis: { cause: 'free motion', proposal: 'hold it',
      free_motions: [{ body: 'box', direction: [0, 0, 0], rotation: 1, axis: [0, 0, 1], center: [0, 0, 0] }] } },
    last_iterate: { u: u(1), motions: [points.map(([x, y], i) => (i < n ? [-y, x, 0] : [0, 0, 0]))] },
    history: { columns: ['time', 'a'], rows: [[0, 1], [1, 2]] },
    mesh: {
      dimension: 3, points, cells: [{ type: 'quad4', connectivity: quads.flat() },
        { type: 'quad8', connectivity: eight }, { type: 'tri6', connectivity: six },
        { type: 'tri3', connectivity: [0, 6, 2] },
        { type: 'quad4', connectivity: [n, n + 1, n + 2, n + 3], rigid: true, body: 1 }],
      volumes: [{ type: 'hex8', connectivity: [0, 1, 3, 2, 4, 5, 7, 6], body: 0 }],
      bodies: ['box', 'plate'], sets: [{ name: 'top', point: 4, points: [4, 5, 6, 7] }],
    },
    frames: [0, 1].map((s) => ({
      step: 1, increment: s, time: s, u: u(s), stress: points.map(([x, y, z]) => [x, y, z, 0, x, 0]),
      fields: { f: points.map(([x], i) => (i < 4 ? x : null)), 'von Mises stress': points.map(([x, y, z]) => x + y * z) },
    })),
  };
}

/** [file, parts that it has to have] of the pages that are looked at. */
function pages(dir) {
  const given = process.argv[2]?.endsWith('.html') ? process.argv[2] : null;
  if (given) return [[given, ['<h1>']]];
  const written = (name, content, parts) => {
    const file = join(dir, `${name}.html`);
    writeFileSync(file, content);
    return [file, parts];
  };
  const parts = ['<h1>', 'id="body"', 'id="histories"', 'id="convergence"', 'id="model"', 'id="run"', 'u-over'];
  return [
    written('done', example({}), parts),
    written('failed', example({ failed: true }), [...parts, 'id="diagnosis"']),
    written('one', example({ frames: 2, cells: 12 }), parts),
    written('bare', page({ title: 'bare' }), ['<h1>bare']),
    written('cells', page(everyCell()), ['<h1>', 'id="body"', 'id="energy"', 'lost numerically']),
    written('space', page(space()), ['<h1>', 'id="body"', 'id="diagnosis"', 'turning about', 'class="bodies"', 'nodes of top']),
  ];
}

const problems = [];
await check('smoke', problems, async ({ dir, browser }) => {
  const chromium = await browser();
  const said = [];
  for (const [file, parts] of pages(dir)) {
    const before = problems.length;
    try {
      problems.push(...await look(chromium, file, parts));
      await picture(chromium, basename(file, '.html') + '.png');
    } catch (error) {
      if (error instanceof BrowserCrashed) throw error;
      problems.push(error.stack);
    }
    for (let i = before; i < problems.length; ++i) problems[i] = `${basename(file)}: ${problems[i]}`;
    said.push(`${basename(file)}: ${problems.length > before ? 'faults' : 'no errors'}`);
  }
  return said;
});
