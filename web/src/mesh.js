// Topology of a planar mesh: triangles to paint, edges to draw. Quadrilaterals and quadratic
// cells are painted as triangles around a virtual centre point, whose values are weighted sums
// of the values of the cell's nodes; centres follow the nodes in all extended arrays.

const quarter = [0.25, 0.25, 0.25, 0.25];
const serendipity = [-0.25, -0.25, -0.25, -0.25, 0.5, 0.5, 0.5, 0.5];

// ring: corners of the triangles around the centre; edges: [end, end, mid or -1].
const shapes = {
  line2: { nodes: 2, edges: [[0, 1, -1]], line: true },
  line3: { nodes: 3, edges: [[0, 1, 2]], line: true },
  tri3: { nodes: 3, tris: [[0, 1, 2]], edges: [[0, 1, -1], [1, 2, -1], [2, 0, -1]] },
  tri6: {
    nodes: 6, tris: [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
    edges: [[0, 1, 3], [1, 2, 4], [2, 0, 5]],
  },
  quad4: {
    nodes: 4, ring: [0, 1, 2, 3], centre: quarter,
    edges: [[0, 1, -1], [1, 2, -1], [2, 3, -1], [3, 0, -1]],
  },
  quad8: {
    nodes: 8, ring: [0, 4, 1, 5, 2, 6, 3, 7], centre: serendipity,
    edges: [[0, 1, 4], [1, 2, 5], [2, 3, 6], [3, 0, 7]],
  },
  quad9: {
    nodes: 9, ring: [0, 4, 1, 5, 2, 6, 3, 7], centreNode: 8,
    edges: [[0, 1, 4], [1, 2, 5], [2, 3, 6], [3, 0, 7]],
  },
};

function addTriangles(shape, nodes, centre, tris) {
  if (shape.tris) {
    for (const t of shape.tris) tris.push(nodes[t[0]], nodes[t[1]], nodes[t[2]]);
    return;
  }
  const ring = shape.ring ?? [];
  for (let i = 0; i < ring.length; ++i) {
    tris.push(nodes[ring[i]], nodes[ring[(i + 1) % ring.length]], centre);
  }
}

function addEdges(shape, nodes, n, edges) {
  for (const [a, b, mid] of shape.edges) {
    const lo = Math.min(nodes[a], nodes[b]);
    const hi = Math.max(nodes[a], nodes[b]);
    const found = edges.get(lo * n + hi);
    if (found) ++found.cells;
    else {
      edges.set(lo * n + hi, {
        a: nodes[a], b: nodes[b], mid: mid < 0 ? -1 : nodes[mid], cells: 1, line: !!shape.line,
      });
    }
  }
}

/**
 * Topology of `cells` = [{type, connectivity}] over n nodes:
 * {n, total, centres: [{nodes, weights}], tris: Int32Array, inner: edges, outline: edges}.
 */
export function topology(cells, n) {
  const centres = [];
  const tris = [];
  const edges = new Map();
  for (const block of cells) {
    const shape = shapes[block.type];
    if (!shape) continue;
    const list = block.connectivity.flat ? block.connectivity.flat() : block.connectivity;
    for (let c = 0; c + shape.nodes <= list.length; c += shape.nodes) {
      const nodes = list.slice(c, c + shape.nodes);
      let centre = -1;
      if (shape.centreNode !== undefined) centre = nodes[shape.centreNode];
      else if (shape.centre) centre = n + centres.push({ nodes, weights: shape.centre }) - 1;
      addTriangles(shape, nodes, centre, tris);
      addEdges(shape, nodes, n, edges);
    }
  }
  const all = [...edges.values()];
  return {
    n,
    total: n + centres.length,
    centres,
    tris: Int32Array.from(tris),
    inner: all.filter((e) => e.cells > 1 && !e.line),
    outline: all.filter((e) => e.cells === 1 || e.line),
  };
}

/** Fills the entries of the virtual centres in an array of `total` values. */
export function fillCentres(topo, values) {
  const { centres, n } = topo;
  for (let c = 0; c < centres.length; ++c) {
    const { nodes, weights } = centres[c];
    let sum = 0;
    for (let k = 0; k < weights.length; ++k) sum += weights[k] * values[nodes[k]];
    values[n + c] = sum;
  }
}
