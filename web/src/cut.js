// A plane that cuts bodies in space: what lies before it is left out, and where cells are known the
// section is painted.

// Tetrahedra of the corners of a cell.
const hex = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]];
const wedge = [[0, 1, 2, 5], [0, 1, 5, 4], [0, 4, 5, 3]];
const cells = {
  tet4: [4, [[0, 1, 2, 3]]], tet10: [10, [[0, 1, 2, 3]]], hex8: [8, hex], hex20: [20, hex], hex27: [27, hex],
  shell18: [18, hex], wedge6: [6, wedge], wedge15: [15, wedge],
};

/** For each tetrahedron which of its faces (opposite to corner k) are on faces of the cell. */
function outerFaces(list) {
  const key = (corners, k) => corners.filter((_, j) => j !== k).sort((a, b) => a - b).join();
  const all = list.flatMap((corners) => corners.map((_, k) => key(corners, k)));
  return list.map((corners) => corners.map((_, k) => all.filter((other) => other === key(corners, k)).length === 1));
}

/** All tetrahedra of the cells: {nodes: four a tetrahedron, bodies and outer faces: one}. */
export function tetrahedra(blocks) {
  const nodes = [];
  const bodies = [];
  const outer = [];
  for (const { type, connectivity, body } of blocks) {
    const [width, list] = cells[type] ?? [1, []];
    const faces = outerFaces(list);
    for (let c = 0; c + width <= connectivity.length; c += width) {
      list.forEach((corners, t) => {
        for (const k of corners) nodes.push(connectivity[c + k]);
        bodies.push(body);
        outer.push(faces[t]);
      });
    }
  }
  return { nodes: Int32Array.from(nodes), bodies, outer };
}

/** Distance of every point before the plane `x[axis] = at`; `flip` looks from the other side. */
export function distances(x, { axis, at, flip }) {
  return x[axis].map((v) => (flip ? at - v : v - at));
}

/**
 * The section of tetrahedra where D = 0, as triangles of points of their own and the lines between cells:
 * {arrays, tris, bodies, lines}, `arrays` = interpolated values of the given ones (over points);
 * `wanted(body)`: whether it is cut.
 */
export function section({ nodes, bodies, outer }, D, arrays, wanted = () => true) {
  const out = arrays.map(() => []);
  const tris = [];
  const owner = [];
  const lines = [];
  const point = (a, b) => {
    const t = D[a] / (D[a] - D[b]);
    arrays.forEach((list, k) => out[k].push(list[a] + t * (list[b] - list[a])));
    return out[0].length - 1;
  };
  for (let t = 0; t < nodes.length; t += 4) {
    if (!wanted(bodies[t / 4])) continue;
    const before = [];
    const behind = [];
    for (let k = t; k < t + 4; ++k) (D[nodes[k]] > 0 ? before : behind).push(nodes[k]);
    if (!before.length || !behind.length) continue;
    const ring = before.length === 2
      ? [[0, 0], [0, 1], [1, 1], [1, 0]].map(([i, j]) => point(before[i], behind[j]))
      : before.flatMap((a) => behind.map((b) => point(a, b)));
    for (let k = 2; k < ring.length; ++k) {
      tris.push(ring[0], ring[k - 1], ring[k]);
      owner.push(bodies[t / 4]);
    }
    outer[t / 4].forEach((isOuter, k) => {
      const crossed = isOuter ? before.flatMap((a) => behind.map((b) => [a, b])).filter((e) => !e.includes(nodes[t + k])) : [];
      if (crossed.length === 2) lines.push(crossed.map((e) => point(...e)));
    });
  }
  return { arrays: out.map((list) => Float32Array.from(list)), tris: Int32Array.from(tris), bodies: owner, lines };
}
