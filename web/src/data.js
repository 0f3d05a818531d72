// Reads the report data (docs/report_data.md) into what the page draws. Big arrays stay encoded
// until a frame is looked at.
import { topology } from './mesh.js';
import { stressFields } from './stress.js';

/** number[] | number[][] | {f32: base64} -> typed array; null entries become NaN. */
export function numbers(source) {
  if (!source) return new Float32Array(0);
  if (ArrayBuffer.isView(source)) return source;
  if (typeof source.f32 === 'string') {
    const text = atob(source.f32);
    const bytes = new Uint8Array(text.length & ~3);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
    return new Float32Array(bytes.buffer);
  }
  const flat = Array.isArray(source[0]) ? source.flat() : source;
  return Float64Array.from(flat, (v) => (v === null ? NaN : v));
}

/** Remembers the result of `make`. */
export function once(make) {
  let value;
  return () => (value === undefined ? (value = make()) : value);
}

function readContact(c) {
  const x = numbers(c.x);
  const size = x.length / 2;
  const pick = (v, wanted) => {
    const list = numbers(v);
    return list.length === wanted ? list : new Float32Array(wanted).fill(v ? NaN : 0);
  };
  return {
    pair: c.pair ?? 'contact', size, x,
    pressure: pick(c.pressure, size), shear: pick(c.shear, size),
    normal: pick(c.normal, 2 * size), status: pick(c.status, size),
  };
}

function readFrame(f, n) {
  const u = once(() => {
    const list = numbers(f.u);
    return list.length === 2 * n ? list : new Float32Array(2 * n);
  });
  const derived = {
    'displacement |u|': (i, d) => Math.hypot(d[2 * i], d[2 * i + 1]),
    'displacement ux': (i, d) => d[2 * i],
    'displacement uy': (i, d) => d[2 * i + 1],
  };
  const fields = new Map();
  for (const [name, values] of Object.entries(f.fields ?? {})) {
    fields.set(name, once(() => {
      const list = numbers(values);
      return list.length === n ? list : new Float32Array(n).fill(NaN);
    }));
  }
  addStress(f.stress, n, (_, v) => v, fields);
  for (const [name, of] of Object.entries(derived)) {
    if (!fields.has(name)) {
      fields.set(name, once(() => Float32Array.from({ length: n }, (_, i) => of(i, u()))));
    }
  }
  return {
    step: f.step, increment: f.increment, time: f.time, u, fields,
    field: (name) => (fields.has(name) ? fields.get(name)() : new Float32Array(n).fill(NaN)),
    contact: once(() => (f.contact ?? []).map(readContact)),
  };
}

/** Adds the fields of the stress tensors to others; `shown(i, value)` is what a point has of them. */
export function addStress(source, n, shown, fields) {
  const width = source?.shape?.[1] ?? source?.[0]?.length;
  const tensors = once(() => numbers(source));
  if (!width) return;
  for (const [name, of] of stressFields(width)) {
    fields.set(name, once(() => Float32Array.from({ length: n }, (_, i) =>
      shown(i, of(tensors().subarray(width * i, width * i + width))))));
  }
}

/** A rigid line as polylines per frame (one for all frames: an array of length 1). */
function readRigid(r) {
  const source = r.polyline ?? [];
  const perFrame = Array.isArray(source[0]?.[0]) || typeof source[0]?.f32 === 'string';
  const lines = (perFrame ? source : [source]).map(numbers);
  return { name: r.name ?? '', body: r.body ?? -1, at: (frame) => lines[Math.min(frame, lines.length - 1)], first: lines[0] };
}

/** Smallest and largest finite entry over several arrays; [0, 0] when there is none. */
export function extent(arrays) {
  let low = Infinity;
  let high = -Infinity;
  for (const list of arrays) {
    for (let i = 0; i < list.length; ++i) {
      const v = list[i];
      if (v < low && v > -Infinity) low = v;
      if (v > high && v < Infinity) high = v;
    }
  }
  return low <= high ? [low, high] : [0, 0];
}

/** The deformed body: null when the report has no mesh or no frames. */
export function readBody(report) {
  const points = numbers(report.mesh?.points);
  const n = points.length / 2;
  if (!n || !report.frames?.length) return null;
  const topo = topology((report.mesh.cells ?? []).map((block) => ({
    type: block.type, body: block.body, connectivity: Array.from(numbers(block.connectivity)),
  })), n);
  const ends = numbers(report.mesh.edges);
  if (ends.length) {
    topo.outline = Array.from({ length: ends.length >> 1 }, (_, i) => (
      { a: ends[2 * i], b: ends[2 * i + 1], mid: -1, body: -1 }));
  }
  const frames = report.frames.map((f) => readFrame(f, n));
  const names = [...new Set(frames.flatMap((f) => [...f.fields.keys()]))];
  const range = new Map();
  return {
    n, points, topo, frames, fieldNames: names, ...naming(report.mesh, topo, n),
    largestContact: frames.map((f) => Math.max(0, ...f.contact().flatMap((c) => [...c.pressure].filter((v) => v === v)))),
    rigid: (report.rigid ?? []).map(readRigid),
    size: diagonal(points),
    /** Range of a field over all frames. */
    range(name) {
      if (!range.has(name)) range.set(name, extent(frames.map((f) => f.field(name))));
      return range.get(name);
    },
    /** Largest |value| of a contact quantity over all frames. */
    largest: memo((key) => {
      const [low, high] = extent(frames.flatMap((f) => f.contact().map((c) => c[key])));
      return Math.max(-low, high);
    }),
    states: once(() => new Set(frames.flatMap((f) => f.contact().flatMap((c) => [...c.status])))),
    pairs: once(() => [...new Set(frames.flatMap((f) => f.contact().map((c) => c.pair)))]),
  };
}

/** Names of bodies and sets, numbers of nodes, and the nodes of the cells. */
export function naming(mesh, topo, n) {
  const nodes = [...new Set(topo.tris)].filter((i) => i < n);
  return { bodies: mesh.bodies ?? [], sets: mesh.sets ?? [], numbers: mesh.numbers, nodes };
}

/** Remembers the results of `make` by key. */
export function memo(make) {
  const known = new Map();
  return (key) => {
    if (!known.has(key)) known.set(key, make(key));
    return known.get(key);
  };
}

function diagonal(points) {
  const [x0, x1] = extent([points.filter((_, i) => i % 2 === 0)]);
  const [y0, y1] = extent([points.filter((_, i) => i % 2 === 1)]);
  return Math.hypot(x1 - x0, y1 - y0) || 1;
}

/** All increments in order: {step, index (1-based in the step), number (1-based), ...data}. */
export function readIncrements(report) {
  const list = [];
  for (const step of report.summary?.steps ?? []) {
    (step.increments ?? []).forEach((inc, i) => {
      list.push({ ...inc, step: step.name ?? '', index: inc.increment ?? i + 1, number: list.length + 1 });
    });
  }
  return list;
}

/** History as columns: {names, column(name) -> numbers}; null when there is none. */
export function readHistory(report) {
  const names = report.history?.columns ?? [];
  const rows = report.history?.rows ?? [];
  if (!names.length || !rows.length) return null;
  return {
    names, rows,
    column(name) {
      const at = names.indexOf(name);
      return at < 0 ? null : rows.map((r) => (typeof r[at] === 'number' ? r[at] : NaN));
    },
    text(name) {
      const at = names.indexOf(name);
      return at < 0 ? null : rows.map((r) => r[at]);
    },
  };
}
