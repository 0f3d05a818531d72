// What the page computes before it draws: node --test test.mjs
import assert from 'node:assert/strict';
import test from 'node:test';

Object.assign(globalThis, {
  matchMedia: () => ({ addEventListener() {} }), addEventListener() {}, document: {},
  getComputedStyle: () => ({ getPropertyValue: () => '' }),
});
const { largestFrame, visible } = await import('./src/bodies.js');
const { along } = await import('./src/body_section.js');
const { section, tetrahedra } = await import('./src/cut.js');
const { labelsOf } = await import('./src/labels.js');
const live = await import('./src/live.js');
const { principal } = await import('./src/stress.js');
const { bounds } = await import('./src/camera.js');
const { readBody, readHistory } = await import('./src/data.js');
const { closure, isLedger, ledger } = await import('./src/energy.js');
const { chains } = await import('./src/mesh.js');
const { readSpace } = await import('./src/space_section.js');
const { countedStates, stateWords } = await import('./src/states.js');
const { statusStyle } = await import('./src/contact_layer.js');

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

test('what plastic materials dissipate is in the ledger where there is such a column', () => {
  const rows = [[1, 0, 0, 0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0], [1, 1, 1, 0, 0.5, 6, 1, 0.5, 0, 0, 0, 0, 0, 12.5]];
  const found = ledger(readHistory({ history: { columns: [...columns, 'energy.plastic'], rows } }));
  assert.deepEqual(found.curves.get('plastic'), [0, 12.5]);
  assert.equal(found.largest, 12.5);
  assert.ok(isLedger('energy.plastic'));
  assert.ok(!ledger(history(rows.map((row) => row.slice(0, -1)))).curves.has('plastic'));
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

test('principal stresses are the eigenvalues of the tensor, largest first', () => {
  const near = (found, wanted) => found.forEach((v, i) => assert.ok(Math.abs(v - wanted[i]) < 1e-12, `${found}`));
  near(principal([1, -2, 0.5, 0, 0, 0]), [1, 0.5, -2]);
  near(principal([3, 3, 3, 0]), [3, 3, 3]);
  near(principal([0, 0, 0, 2]), [2, 0, -2]);
  near(principal([5, 1, 3, 0]), [5, 3, 1]);
  const [a, b, c] = principal([1, 2, 3, 4, 5, 6]);
  near([a + b + c, a * b + b * c + c * a, a * b * c], [6, 2 + 6 + 3 - 16 - 25 - 36, 101]);
});

test('a frame has the components and principal values of its stress in both dimensions', () => {
  const plane = readBody({ mesh: square, frames: [{ u: [], stress: Array(4).fill([1, 2, 3, 0]) }] });
  assert.deepEqual([...plane.frames[0].field('stress yy')], [2, 2, 2, 2]);
  assert.ok(Math.abs(plane.frames[0].field('principal stress 1 (largest)')[0] - 3) < 1e-6);
  assert.ok(Math.abs(plane.frames[0].field('von Mises stress')[0] - Math.sqrt(3)) < 1e-6);
  const mesh = { dimension: 3, points: square.points.map(([x, y]) => [x, y, 0]), cells: square.cells };
  const space = readSpace({ mesh, frames: [{ u: [], fields: { f: [7, 8, 9] }, stress: Array(3).fill([1, 2, 3, 0, 5, 0]) }] });
  assert.deepEqual([...space.frames[0].field('stress yz')], [5, 5, 5, NaN]);
  assert.deepEqual([...space.frames[0].field('f')], [7, 8, 9, NaN]);
  assert.ok(space.fieldNames.includes('principal stress 3 (smallest)'));
});

test('the plot along the surface runs as the picture does: to the right, else upwards', () => {
  const contact = (x, pressure) => ({
    size: pressure.length, x: x.flat(), pressure, shear: pressure.map(() => 0), status: pressure.map(() => 1),
  });
  const right = along(contact([[2, 0], [1, 0], [0, 0]], [3, 2, 1]));
  assert.deepEqual([right.s, right.pressure], [[0, 1, 2], [1, 2, 3]]);
  assert.deepEqual(along(contact([[0, 0], [1, 0], [2, 0]], [1, 2, 3])).pressure, [1, 2, 3]);
  assert.deepEqual(along(contact([[0, 2], [0.1, 1], [0, 0]], [3, 2, 1])).pressure, [1, 2, 3]);
});

test('the first view is that of the largest contact, the latest of equals, else the end', () => {
  assert.equal(largestFrame([0, 3, 1]), 1);
  assert.equal(largestFrame([0, 3, 3, 0]), 2);
  assert.equal(largestFrame([0, 0, 0]), 2);
});

test('hidden bodies are left out, transparent ones apart', () => {
  const mesh = { points: [...square.points, [5, 0], [6, 0], [6, 1]], bodies: ['a', 'b'], cells: [
    { ...square.cells[0], body: 0 }, { type: 'tri3', connectivity: [4, 5, 6], body: 1 }] };
  const { topo } = readBody({ mesh, frames: [{}] });
  assert.deepEqual([...visible(topo, ['hidden', 'shown']).tris], [4, 5, 6]);
  assert.deepEqual([...visible(topo, ['shown', 'faint']).faint], [4, 5, 6]);
  assert.equal(visible(topo, ['hidden']).outline.length, 3);
  assert.equal(visible(topo, []).tris.length, 15);
});

test('a cut through a cube is a square with the values in between', () => {
  const cube = Array.from({ length: 8 }, (_, i) => [[0, 0], [1, 0], [1, 1], [0, 1]][i % 4].concat(i >> 2));
  const tets = tetrahedra([{ type: 'hex8', connectivity: [0, 1, 2, 3, 4, 5, 6, 7], body: 4 }]);
  const [X, Y, Z] = [0, 1, 2].map((k) => cube.map((p) => p[k]));
  const cut = section(tets, Z.map((z) => z - 0.25), [X, Y, Z]);
  const [x, y, z] = cut.arrays;
  assert.ok(z.every((v) => v === 0.25));
  assert.ok(cut.bodies.every((b) => b === 4));
  let area = 0;
  for (let t = 0; t < cut.tris.length; t += 3) {
    const [a, b, c] = cut.tris.slice(t, t + 3);
    area += Math.abs((x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a])) / 2;
  }
  assert.ok(Math.abs(area - 1) < 1e-6);
  const rim = cut.lines.map(([p, q]) => Math.hypot(x[p] - x[q], y[p] - y[q]));
  assert.ok(Math.abs(rim.reduce((sum, v) => sum + v, 0) - 4) < 1e-6);
  assert.equal(section(tets, Z.map((z) => z - 0.25), [X], () => false).tris.length, 0);
});

test('sets and nodes are labelled as the user calls them', () => {
  const mesh = { ...square, numbers: [10, 20, 30, 40], sets: [{ name: 'top', point: 2, points: [2, 3] }] };
  const body = readBody({ mesh, frames: [{}] });
  assert.deepEqual(labelsOf(body, 'sets'), [[2, 'top']]);
  assert.deepEqual(labelsOf(body, 'set 0'), [[2, '30'], [3, '40']]);
  assert.deepEqual(labelsOf(body, 'nodes').map(([, text]) => text).sort(), ['10', '20', '30', '40']);
  assert.deepEqual(labelsOf(body, 'none'), []);
});

test('only states that there can be are counted, and each has a mark of its own', () => {
  assert.deepEqual(countedStates([{ open: 3, stick: 0, slipping: 0, closed: 4 }]), ['open', 'closed']);
  assert.deepEqual(countedStates([{ open: 3 }, { open: 0, stick: 0, slipping: 2, closed: 0 }]),
    ['open', 'stick', 'slipping']);
  assert.deepEqual(countedStates([{ stick: 1, closed: 1 }]), ['open', 'stick', 'slipping', 'closed']);
  assert.equal(new Set(stateWords.map((_, s) => statusStyle(s).shape)).size, 4);
  const contact = [{ x: [[0, 0], [1, 0]], status: [3, 0] }];
  const body = readBody({ mesh: square, frames: [{}, { contact }] });
  assert.deepEqual([...body.states()].sort(), [0, 3]);
});

const entry = (step, number, frame, increment) => ({ step, row: [step, number, number], frame, increment });
const done = (iterations) => ({ iterations, residuals: [0.1, 1e-9], energies: [1, 1e-12] });
const state = (patch) => ({ run: 'a', from: 0, status: 'running', model: 'm.yaml', message: '', columns: ['step', 'increment', 'time'],
  entries: [], iterations: [], log: [], ...patch });

test('what the server tells is added to what is known, and another run begins anew', () => {
  let known = live.withState(live.nothing(), state({ entries: [entry(1, 0, true), entry(1, 1, true, done(2))] }));
  known.frames.set(0, {});
  known.base = { title: 't' };
  known = live.withState(known, state({ from: 2, entries: [entry(1, 2, true, done(3))] }));
  assert.deepEqual(known.entries.map((e) => e.row[1]), [0, 1, 2]);
  assert.equal(known.frames.size, 1);
  const other = live.withState(known, state({ run: 'b', entries: [entry(1, 0, false)] }));
  assert.deepEqual([other.entries.length, other.frames.size, other.base], [1, 0, null]);
});

test('of many frames some are shown, evenly and with the last one', () => {
  const entries = (n) => Array.from({ length: n }, (_, i) => entry(1, i, i % 2 === 0));
  assert.deepEqual(live.chosenFrames(entries(5), 60), [0, 2, 4]);
  const some = live.chosenFrames(entries(401), 60);
  assert.ok(some.length <= 60 && some.length > 25);
  assert.deepEqual([some[0], some.at(-1)], [0, 400]);
  assert.deepEqual(live.chosenFrames([], 60), []);
  assert.equal(live.mostFrames({ dimension: 3, points: { shape: [100000, 3] } }), 5);
});

test('a report is composed of a run that goes on', () => {
  const base = { title: 't', status: 'running', mesh: square, summary: { steps: [{ name: 'press' }, { name: 'push' }] } };
  const line = (y) => [{ name: 'r', body: 1, polyline: [[0, y], [1, y]] }];
  const entries = [entry(1, 0, true), entry(1, 1, true, done(2)), entry(2, 1, false, done(4))];
  const frames = new Map([[1, { u: [1], rigid: line(2) }], [0, { u: [0], rigid: line(1) }]]);
  const report = live.compose({ state: state({}), entries, frames, base });
  assert.deepEqual(report.summary.steps.map((s) => [s.name, s.increments.map((i) => i.iterations)]), [['press', [2]], ['push', [4]]]);
  assert.deepEqual(report.iterations[1], { step: 2, increment: 1, residuals: [0.1, 1e-9], energies: [1, 1e-12] });
  assert.deepEqual(report.frames.map((f) => f.u), [[0], [1]]);
  assert.deepEqual(report.rigid[0].polyline, [[[0, 1], [1, 1]], [[0, 2], [1, 2]]]);
  assert.equal(report.status, 'running');
  const killed = live.compose({ state: state({ status: 'killed' }), entries, frames, base: null });
  assert.equal(killed.status, 'failed');
  assert.match(killed.message, /ended without a word/);
  assert.match(killed.message, /--restart/);
  assert.equal(killed.title, 'm.yaml');
  const early = live.compose({ state: state({ status: 'killed', message: 'of another version' }), entries: [], frames: new Map(), base: null });
  assert.equal(early.message, 'Its process ended without a word. of another version'); // nothing to go on from
  assert.equal(killed.summary.steps[1].name, 'step 2');
});

test('no connection is told apart from an answer that says no', () => {
  assert.match(live.lostText(new TypeError('fetch failed')), /does not answer/);
  assert.match(live.lostText(new Error('/state.json: 500')), /\/state.json: 500/);
});

test('the increment under way is told with its attempts', () => {
  const rows = [[1, 2, 1, 1, 0.5, 1, 1, 3, 0, 0, 2], [1, 2, 1, 2, 0.7, 2, 1, 3, 0, 0, 2], [1, 2, 0.75, 1, 0.1, 1, 1, 4, 0, 0, 1]];
  const known = { state: state({ iterations: rows }), entries: [entry(1, 1, true, done(1))], base: null };
  const now = live.underWay(known);
  assert.equal(now.text, 'step 1, increment 2 to time 0.75: iteration 1, after 1 other attempt');
  assert.equal(now.counts, 'open 4, closed 1');
  assert.deepEqual(now.curves[0].y, [0.5, 0.7, NaN, 0.1]);
  assert.deepEqual(now.curves[0].x, [1, 2, NaN, 3]);
  known.entries.push(entry(1, 2, true, done(3)));
  assert.match(live.underWay(known).text, /converged after 3 iterations/);
  assert.equal(live.underWay({ state: state({}), entries: [], base: null }), null);
});
