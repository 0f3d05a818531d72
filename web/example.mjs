// Writes an invented result as a report page: a round-bottomed block pressed on a rigid line
// and sheared to and fro. Only the page is meant; the numbers are closed forms, no analysis.
//
// node example.mjs [FILE=example.html] [--cells 1500] [--frames 40] [--failed] [--small-motion]
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { dirname, join } from 'node:path';

const here = dirname(fileURLToPath(import.meta.url));

function option(name, fallback) {
  const at = process.argv.indexOf(`--${name}`);
  return at < 0 ? fallback : Number(process.argv[at + 1]);
}

const f32 = (list, ...shape) => ({
  f32: Buffer.from(Float32Array.from(list).buffer).toString('base64'), shape,
});

const radius = 3;
const width = 2.4;
const height = 1.1;

function makeMesh(cells) {
  const nx = Math.max(4, Math.round(Math.sqrt(cells * 2.2)));
  const ny = Math.max(2, Math.round(cells / nx));
  const points = [];
  const quads = [];
  for (let j = 0; j <= ny; ++j) {
    for (let i = 0; i <= nx; ++i) {
      const x = width * (i / nx - 0.5);
      const bottom = (x * x) / (2 * radius);
      points.push([x, bottom + (height - bottom) * (j / ny) ** 1.4]);
    }
  }
  for (let j = 0; j < ny; ++j) {
    for (let i = 0; i < nx; ++i) {
      const a = j * (nx + 1) + i;
      quads.push(a, a + 1, a + nx + 2, a + nx + 1);
    }
  }
  return { points, quads, nx, ny };
}

/** Hertz pressure p0 over |x| < a and the stress below it along z (line contact, McEwen). */
function hertz(x, z, a, p0) {
  if (a < 1e-9) return [0, 0, 0];
  const s = a * a - x * x + z * z;
  const root = Math.sqrt(s * s + 4 * x * x * z * z);
  const m = Math.sqrt(Math.max(0, (root + s) / 2));
  const n = Math.sign(x || 1) * Math.sqrt(Math.max(0, (root - s) / 2));
  const q = (z * z + n * n) / Math.max(1e-12, m * m + n * n);
  const sx = (-p0 / a) * (m * (1 + q) - 2 * z);
  const sz = (-p0 / a) * m * (1 - q);
  const t = (p0 / a) * n * ((m * m - z * z) / Math.max(1e-12, m * m + n * n));
  return [sx, sz, t];
}

/** State of the load at parameter t in 0..1: press during the first third, then shear cycles. */
function load(t) {
  const press = Math.min(1, 3 * t + 0.02);
  const phase = Math.max(0, t - 1 / 3) * 1.5;
  return { a: 0.55 * Math.sqrt(press), press, shear: 0.85 * Math.sin(2 * Math.PI * phase * 1.25) };
}

function frame(mesh, number, frames, motion) {
  const { a, press, shear } = load(number / (frames - 1));
  const p0 = 620 * Math.sqrt(press);
  const delta = (a * a) / (2 * radius);
  const fields = { 'von Mises': [], 'stress yy': [], 'stress xy': [] };
  const u = [];
  const at = ([x, y]) => {
    const bottom = (x * x) / (2 * radius);
    const h = y - bottom;
    const fade = Math.exp((-1.6 * h) / Math.max(a, 0.05));
    return [motion * 0.08 * shear * (1 - Math.exp(-3 * h)),
      motion * (-delta + Math.max(0, delta - bottom) * fade) * 1.6 + motion * 0.6 * Math.max(0, delta - bottom) * -fade];
  };
  for (const p of mesh.points) {
    u.push(...at(p));
    const [sx, sz, t] = hertz(p[0], Math.max(0.002, p[1]), a, p0);
    const txy = t + 0.22 * shear * sz;
    fields['von Mises'].push(Math.sqrt(sx * sx - sx * sz + sz * sz + 3 * txy * txy));
    fields['stress yy'].push(sz);
    fields['stress xy'].push(txy);
  }
  return { number, a, p0, press, shear, u, fields, contact: contact(mesh, a, p0, shear, at) };
}

function contact(mesh, a, p0, shear, at) {
  const c = { pair: 'floor', x: [], pressure: [], shear: [], normal: [], status: [] };
  const stick = a * Math.sqrt(1 - Math.min(0.97, Math.abs(shear)));
  for (let i = 0; i <= mesh.nx; ++i) {
    const p = mesh.points[i];
    const u = at(p);
    const inside = Math.abs(p[0]) < a;
    const pressure = inside ? p0 * Math.sqrt(1 - (p[0] / a) ** 2) : 0;
    const held = Math.abs(p[0]) < stick;
    c.x.push(p[0] + u[0], p[1] + u[1]);
    c.normal.push(0, 1);
    c.pressure.push(pressure);
    const core = held ? (stick / a) * p0 * Math.sqrt(1 - (p[0] / stick) ** 2) : 0;
    c.shear.push(-Math.sign(shear) * 0.3 * (pressure - core));
    c.status.push(!inside ? 0 : held ? 1 : 2);
  }
  return c;
}

function increments(frames, failed) {
  const iterations = [];
  const steps = [{ name: 'press', increments: [] }, { name: 'shear', increments: [] }];
  frames.forEach((f, k) => {
    const step = steps[k < frames.length / 3 ? 0 : 1];
    const bad = failed && k === frames.length - 1;
    const cutbacks = bad ? 5 : k % 17 === 11 ? 1 : 0;
    const rate = bad ? 0.05 : 1.6 + 0.5 * Math.sin(k);
    const residuals = [];
    for (let i = 0, e = 0; e < (bad ? 1e9 : 11) && i < (bad ? 25 : 12); ++i) {
      residuals.push((bad ? 0.3 + 0.4 * Math.abs(Math.sin(9 * i)) : 1) * 10 ** -Math.min(e, 15));
      e += bad ? 0 : rate * (0.6 + 0.55 * i);
    }
    const count = (s) => f.contact.status.filter((v) => v === s).length;
    step.increments.push({
      increment: step.increments.length + 1, time: (k + 1) / frames.length, iterations: residuals.length,
      residual: residuals.at(-1), energy: residuals.at(-1) ** 1.6, cutbacks,
      open: count(0), stick: count(1), slipping: count(2), closed: 0,
    });
    iterations.push({
      step: step.name, increment: step.increments.length, residuals, energies: residuals.map((r) => r ** 1.6),
    });
  });
  return { steps, iterations };
}

/** The cause of the failure, and that the block may slide or turn. */
function diagnosis() {
  return {
    cause: 'sliding motion', reason: 'not converged after 25 iterations', proposal: 'hold the block sideways',
    free_motions: [
      { body: 'block', direction: [1, 0], rotation: 0, axis: [0, 0, 1], center: [0, 0.5] },
      { body: 'block', direction: [0, 0], rotation: 1, axis: [0, 0, 1], center: [0, 0.5] }],
  };
}

function freeMotion(last, n) {
  return {
    u: f32(last.u, n, 2), rigid: [{ name: 'base', polyline: [[-2.2, 0], [2.2, 0]] }],
    motions: [f32(last.u.map((_, i) => 1 - (i % 2)), n, 2), f32(last.u.map((_, i) => (i % 2 ? 1 : 0)), n, 2)],
  };
}

function report(cells, count, failed, motion) {
  const mesh = makeMesh(cells);
  const frames = Array.from({ length: count }, (_, k) => frame(mesh, k, count, motion));
  const { steps, iterations } = increments(frames, failed);
  const flat = steps.flatMap((s) => s.increments.map((i) => ({ ...i, step: s.name })));
  const n = mesh.points.length;
  const rows = frames.map((f, k) => [flat[k].step, flat[k].increment, flat[k].time,
    0.08 * motion * f.shear, -f.a * f.p0 * Math.PI / 2 / 1000,
    0.3 * f.a * f.p0 * 0.0016 * (f.shear + 0.35 * Math.cos(7.85 * Math.max(0, k / count - 1 / 3))), f.p0]);
  return {
    title: 'Round block pressed on a rigid base & sheared', osculate: '0.1.0',
    status: failed ? 'failed' : 'done',
    message: failed
      ? 'Increment 27 of step shear did not converge after 5 cut-backs. The nodes 12, 13 and 41 of pair floor ' +
        'change between stick and slip in every iteration.\nTry a smaller tangential penalty: contact[0].friction.coulomb.penalty.'
      : `All ${count} increments converged. Largest penetration 1.4e-5, 0.0013 % of the block's height.`,
    model: [
      { heading: 'Bodies', rows: [['block', `${mesh.nx * mesh.ny} quad4, plane strain, steel`], ['base', 'rigid line, fixed']] },
      { heading: 'Materials', rows: [['steel', 'linear elastic, E = 21000, nu = 0.3']] },
      { heading: 'Contact', rows: [['floor', 'master base, slave bottom; penalty 2.1e6 times reference area, sampled at nodes'],
        ['', 'Coulomb friction, mu = 0.3, tangential penalty 2.1e6; consistent tangent']] },
      { heading: 'Solver', rows: [['tolerance', 'energy 1e-12, residual 1e-9'], ['iterations', 'at most 25, line search auto']] },
    ],
    summary: {
      ...(failed && { diagnosis: diagnosis() }),
      steps, unknowns: 2 * n, peak_memory_mb: 212.4,
      seconds: { reading: 0.031, assembly: 1.92, factorisation: 7.41, contact: 0.84, output: 0.55 },
    },
    ...(failed && { last_iterate: freeMotion(frames.at(-1), n) }),
    iterations,
    history: { columns: ['step', 'increment', 'time', 'top.ux', 'floor.normal_force', 'floor.shear_force', 'floor.max_pressure'], rows },
    plots: [
      { title: 'Shear force over displacement', x: 'top.ux', y: ['floor.shear_force'] },
      { title: 'Contact forces', x: 'time', y: ['floor.normal_force', 'floor.shear_force'], ylabel: 'force' },
      { title: 'Largest pressure', x: 'time', y: ['floor.max_pressure'] },
    ],
    profiles: [{
      title: 'Pressure at the end against Hertz', xlabel: 'x', ylabel: 'pressure',
      curves: [{ label: 'computed', x: frames.at(-1).contact.x.filter((_, i) => i % 2 === 0), y: frames.at(-1).contact.pressure.map((p, i) => p * (1 + 0.02 * Math.sin(5 * i))) },
        { label: 'Hertz', x: frames.at(-1).contact.x.filter((_, i) => i % 2 === 0), y: frames.at(-1).contact.pressure }],
    }],
    mesh: { points: mesh.points, cells: [{ type: 'quad4', connectivity: mesh.quads }] },
    frames: frames.map((f, k) => ({
      step: flat[k].step, increment: flat[k].increment, time: flat[k].time, u: f32(f.u, n, 2),
      fields: Object.fromEntries(Object.entries(f.fields).map(([name, v]) => [name, f32(v, n)])),
      contact: [{ ...f.contact, x: f32(f.contact.x, mesh.nx + 1, 2), normal: f32(f.contact.normal, mesh.nx + 1, 2) }],
    })),
    rigid: [{ name: 'base', polyline: [[-2.2, 0], [2.2, 0]] }],
  };
}

/** The page as `osculate report` writes it. */
export function page(data) {
  const template = readFileSync(join(here, 'page.html'), 'utf8');
  const parts = {
    '@TITLE@': data.title.replace(/&/g, '&amp;').replace(/</g, '&lt;'),
    '@DATA@': JSON.stringify(data).replace(/</g, '\\u003c'),
    '@CONNECT@': "'none'",
    '@BUNDLE@': readFileSync(join(here, 'dist/report.js'), 'utf8'),
  };
  return template.replace(/@TITLE@|@CONNECT@|@DATA@|@BUNDLE@/g, (mark) => parts[mark]);
}

export function example({ cells = 1500, frames = 40, failed = false, motion = 1 } = {}) {
  return page(report(cells, frames, failed, motion));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const file = process.argv[2]?.startsWith('--') ? 'example.html' : process.argv[2] ?? 'example.html';
  writeFileSync(file, example({
    cells: option('cells', 1500), frames: option('frames', 40),
    failed: process.argv.includes('--failed'), motion: process.argv.includes('--small-motion') ? 1e-3 : 1,
  }));
}
