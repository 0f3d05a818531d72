// Stress fields of a frame from its tensors: xx, yy, zz, xy, in space also yz, xz.

const components = ['xx', 'yy', 'zz', 'xy', 'yz', 'xz'];

function mises(s) {
  const shear = s[3] ** 2 + (s[4] ?? 0) ** 2 + (s[5] ?? 0) ** 2;
  return Math.sqrt(0.5 * ((s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2) + 3 * shear);
}

/** The eigenvalues, largest first (Smith 1961: the angle of the third invariant of the deviator). */
export function principal([xx, yy, zz, xy, yz = 0, xz = 0]) {
  const mean = (xx + yy + zz) / 3;
  const [a, b, c] = [xx - mean, yy - mean, zz - mean];
  const p = Math.sqrt((a * a + b * b + c * c + 2 * (xy * xy + yz * yz + xz * xz)) / 6);
  if (!(p > 0)) return [mean, mean, mean];
  const third = (a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)) / (2 * p ** 3);
  const angle = Math.acos(Math.max(-1, Math.min(1, third))) / 3;
  const first = mean + 2 * p * Math.cos(angle);
  const last = mean + 2 * p * Math.cos(angle + (2 * Math.PI) / 3);
  return [first, 3 * mean - first - last, last];
}

/** Functions of a tensor by the name of the field; `width` components. */
export function stressFields(width) {
  const list = [['von Mises stress', mises]];
  components.slice(0, width).forEach((name, k) => list.push([`stress ${name}`, (s) => s[k]]));
  ['1 (largest)', '2', '3 (smallest)'].forEach((name, k) =>
    list.push([`principal stress ${name}`, (s) => principal(s)[k]]));
  return list;
}
