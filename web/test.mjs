// What the page computes before it draws: node --test test.mjs
import assert from 'node:assert/strict';
import test from 'node:test';

Object.assign(globalThis, { matchMedia: () => ({ addEventListener() {} }), addEventListener() {} });
const { bounds } = await import('./src/camera.js');
const { readBody, readHistory } = await import('./src/data.js');
const { closure, isLedger, ledger } = await import('./src/energy.js');
const { chains } = await import('./src/mesh.js');
const { readSpace } = await import('./src/space_section.js');

const names = ['kinetic', 'strain', 'contact', 'external', 'friction', 'damping', 'numerical', 'residual'];
const columns = ['step', 'increment', 'time', 'top.ux', 'elapsed', ...names.map((n) => `energy.${n}`)];
const history = (rows) => readHistory({ history: { columns, rows } });

test('the ledger has the columns of the history', () => {
  const found = ledger(history([
    [1, 0, 0, 0, 0, 10, 0, 0, 0, 0, 0, 0, 0],
    [1, 1, 1, 0, 0.5, 6, 1, 0.5, -2, 0.25, 0, 0.25, 1e-9]]));
  assert.deepEqual(found.x, [0, 0.5]);
  assert.deepEqual(found.total, [10, 7.5]);
  assert.deepEqual(found.curves.get('friction'), [0, 0.25]);
  assert.equal(found.largest, 10);
  assert.equal(found.lost, 0.25);
  assert.match(closure(found), /largest energy is 10; 0.25 \(2.5 %\) has been lost .* closes to 1e-10 /);
  assert.match(closure({ largest: 4, lost: -1, open: 0 }), /1 \(25 %\) has come in .* closes to 0 /);
});

test('after a step without inertia the ledger begins anew, behind the first piece', () => {
  const found = ledger(history([
    [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
    [1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
    [2, 1, 1.5, 0, 1, 5, 0, 0, 0, 0, 0, 2, 0],
    [2, 2, 2, 0, 2, 4, 0, 0, 0, 0, 0, 3, 0],
    [3, 1, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
    [4, 1, 4, 0, 1, 1, 0, 0, 0, 0, 0, 0.5, 0]]));
  assert.deepEqual(found.rows, [2, 3, -1, 5]);
  assert.deepEqual(found.x, [1, 2, NaN, 3]);
  assert.equal(found.lost, 3.5);
});

test('a ledger that begins at rest begins with nothing', () => {
  const found = ledger(history([
    [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
    [1, 1, 1, 0, 0.5, 1, 0, 0, 1, 0, 0, 0, 0]]));
  assert.deepEqual(found.x, [0, 0.5]);
  assert.deepEqual(found.total, [0, 1]);
});

test('a run without inertia has no ledger, and its columns none of it', () => {
  assert.equal(ledger(null), null);
  assert.equal(ledger(readHistory({ history: { columns: ['time', 'a'], rows: [[0, 1]] } })), null);
  assert.equal(ledger(history([[1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]])), null);
  assert.deepEqual(columns.filter(isLedger), columns.slice(4));
});

const square = { points: [[0, 0], [1, 0], [1, 1], [0, 1]], cells: [{ type: 'quad4', connectivity: [0, 1, 2, 3] }] };
const still = (count) => Array.from({ length: count }, () => ({ u: [0, 0, 0, 0, 0, 0, 0, 0] }));
const ring = (y) => [[0, y], [0.5, y + 0.5], [0, y + 1], [-0.5, y + 0.5], [0, y]];

test('the view holds a rigid body that flies off, to its last frame', () => {
  const polyline = Array.from({ length: 50 }, (_, k) => ring(1 + k));
  const body = readBody({ mesh: square, frames: still(50), rigid: [{ name: 'r', polyline }] });
  assert.deepEqual(bounds({ body }, 1), [-0.5, 0, 1, 51]);
  assert.deepEqual(bounds({ body }, 2), [-0.5, 0, 1, 100]);
});

test('of a line that goes on beyond the bodies the view holds what is near', () => {
  const polyline = [[[-99, 0], [99, 0]], [[-99, -0.1], [99, -0.1]]];
  const body = readBody({ mesh: square, frames: still(2), rigid: [{ name: 'r', polyline }] });
  assert.deepEqual(bounds({ body }, 1), [-0.15, -0.1, 1.15, 1]);
});

test('in space rigid bodies belong to the view, endless surfaces do not', () => {
  const z = (list) => list.map(([x, y]) => [x, y, 0]);
  const far = [[50, 0, 0], [51, 0, 0], [51, 1, 0], [50, 1, 0]];
  const cells = [...square.cells, { type: 'quad4', connectivity: [4, 5, 6, 7], rigid: true },
    { type: 'quad4', connectivity: [0, 1, 6, 7], rigid: true, endless: true },
    { type: 'quad4', connectivity: [0, 1, 5, 4], rigid: true }];
  const mesh = { dimension: 3, points: [...z(square.points), ...far], cells };
  const body = readSpace({ mesh, frames: [{ u: new Array(24).fill(0) }] });
  assert.deepEqual([...new Set(body.whole)].sort(), [0, 1, 2, 3, 4, 5, 6, 7]);
});

test('edges are joined end to end', () => {
  const edge = (a, b, mid = -1) => ({ a, b, mid });
  assert.deepEqual(chains([edge(0, 1), edge(2, 1, 9), edge(2, 3)]), [[0, 1, 9, 2, 3]]);
  assert.deepEqual(chains([edge(0, 1), edge(1, 2), edge(2, 0)]), [[0, 1, 2, 0]]);
  const star = chains([edge(0, 1), edge(0, 2), edge(0, 3)]);
  assert.deepEqual(star.map((c) => c.length), [2, 2, 2]);
});
