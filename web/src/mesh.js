// Topology of a planar mesh: triangles to paint, edges to draw. Cells other than tri3 are painted
// as triangles around their centre; quadratic edges are cut into four pieces. The points this needs
// are virtual: their values are weighted sums of nodal values, and they follow the nodes in all
// extended arrays.

const ninth = 1 / 9;

// edges: [end, end, mid or -1]; centre: weights of the nodes, or the node that stands there.
const shapes = {
  line2: { nodes: 2, edges: [[0, 1, -1]], line: true },
  line3: { nodes: 3, edges: [[0, 1, 2]], line: true },
  tri3: { nodes: 3, edges: [[0, 1, -1], [1, 2, -1], [2, 0, -1]] },
  tri6: {
    nodes: 6, edges: [[0, 1, 3], [1, 2, 4], [2, 0, 5]],
    centre: [-ninth, -ninth, -ninth, 4 * ninth, 4 * ninth, 4 * ninth],
  },
  quad4: {
    nodes: 4, edges: [[0, 1, -1], [1, 2, -1], [2, 3, -1], [3, 0, -1]],
    centre: [0.25, 0.25, 0.25, 0.25],
  },
  quad8: {
    nodes: 8, edges: [[0, 1, 4], [1, 2, 5], [2, 3, 6], [3, 0, 7]],
    centre: [-0.25, -0.25, -0.25, -0.25, 0.5, 0.5, 0.5, 0.5],
  },
  quad9: { nodes: 9, edges: [[0, 1, 4], [1, 2, 5], [2, 3, 6], [3, 0, 7]], centreNode: 8 },
};

// Quadratic shape functions (first end, second end, middle) a quarter of the way along an edge.
const nearFirst = [0.375, -0.125, 0.75];
const nearSecond = [-0.125, 0.375, 0.75];

/** The points around a cell, counter-clockwise, with virtual points on quadratic edges. */
function boundaryOf(shape, nodes, virtual) {
  const ring = [];
  for (const [a, b, mid] of shape.edges) {
    ring.push(nodes[a]);
    if (mid < 0) continue;
    const edge = [nodes[a], nodes[b], nodes[mid]];
    ring.push(virtual(edge, nearFirst), nodes[mid], virtual(edge, nearSecond));
  }
  return ring;
}

function addTriangles(shape, nodes, virtual, tris) {
  if (shape.line) return;
  const ring = boundaryOf(shape, nodes, virtual);
  if (ring.length === 3) {
    tris.push(...ring);
    return;
  }
  const centre = shape.centre ? virtual(nodes, shape.centre) : nodes[shape.centreNode];
  for (let i = 0; i < ring.length; ++i) tris.push(ring[i], ring[(i + 1) % ring.length], centre);
}

function addEdges(shape, nodes, n, edges, cell, body) {
  for (const [a, b, mid] of shape.edges) {
    const lo = Math.min(nodes[a], nodes[b]);
    const hi = Math.max(nodes[a], nodes[b]);
    const found = edges.get(lo * n + hi);
    if (found) {
      ++found.cells;
      found.other = cell;
    } else {
      edges.set(lo * n + hi, {
        a: nodes[a], b: nodes[b], mid: mid < 0 ? -1 : nodes[mid], cells: 1, line: !!shape.line, cell, other: -1, body,
      });
    }
  }
}

/**
 * Topology of `cells` = [{type, connectivity: flat number[], body}] over n nodes:
 * {n, total, virtual: [{nodes, weights}], tris: Int32Array, bodies: one a triangle, inner: edges,
 * outline: edges, corners}: three corners of every cell; an edge knows its cells {cell, other or -1}
 * and its body.
 */
export function topology(cells, n) {
  const points = [];
  const tris = [];
  const edges = new Map();
  const corners = [];
  const bodies = [];
  const virtual = (nodes, weights) => n + points.push({ nodes, weights }) - 1;
  for (const block of cells) {
    const shape = shapes[block.type];
    if (!shape) continue;
    const list = block.connectivity;
    for (let c = 0; c + shape.nodes <= list.length; c += shape.nodes) {
      const nodes = list.slice(c, c + shape.nodes);
      addTriangles(shape, nodes, virtual, tris);
      while (bodies.length < tris.length / 3) bodies.push(block.body ?? -1);
      addEdges(shape, nodes, n, edges, corners.length / 3, block.body ?? -1);
      corners.push(nodes[0], nodes[1], nodes[2] ?? -1);
    }
  }
  const all = [...edges.values()];
  return {
    n,
    total: n + points.length,
    virtual: points,
    tris: Int32Array.from(tris),
    corners,
    bodies,
    inner: all.filter((e) => e.cells > 1 && !e.line),
    outline: all.filter((e) => e.cells === 1 || e.line),
  };
}

/** Edges joined end to end, as far as they go: lists of nodes, with the middle ones of quadratic edges. */
export function chains(edges) {
  const at = new Map();
  for (const e of edges) for (const node of [e.a, e.b]) at.set(node, [...(at.get(node) ?? []), e]);
  const left = new Set(edges);
  const walk = (node) => {
    const list = [node];
    for (let e; (e = at.get(list.at(-1)).find((o) => left.has(o)));) {
      left.delete(e);
      const next = e.a === list.at(-1) ? e.b : e.a;
      if (e.mid >= 0) list.push(e.mid);
      list.push(next);
      if (at.get(next).length !== 2) break;
    }
    return list;
  };
  const found = [];
  for (const [node, here] of at) if (here.length !== 2) here.forEach((e) => left.has(e) && found.push(walk(node)));
  for (const e of edges) if (left.has(e)) found.push(walk(e.a));
  return found;
}

/** Fills the entries of the virtual points in an array of `total` values. */
export function fillVirtual(topo, values) {
  const { virtual, n } = topo;
  for (let c = 0; c < virtual.length; ++c) {
    const { nodes, weights } = virtual[c];
    let sum = 0;
    for (let k = 0; k < weights.length; ++k) sum += weights[k] * values[nodes[k]];
    values[n + c] = sum;
  }
}
