// Numbers as people read them.

/** At most `digits` significant digits; powers of ten only where they help. */
export function num(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return 'n/a';
  if (!Number.isFinite(value)) return value > 0 ? 'inf' : '-inf';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const rounded = Number(value.toPrecision(digits));
  if (size >= 1e-3 && size < 1e6) return String(rounded);
  return rounded.toExponential().replace('e+', 'e');
}

/** `12 345` for counts. */
export function count(value) {
  return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, '\u202f');
}

export function seconds(value) {
  if (!(value >= 0)) return 'n/a';
  if (value < 0.1) return `${num(value * 1e3, 2)} ms`;
  if (value < 120) return `${num(value, 3)} s`;
  const minutes = Math.floor(value / 60);
  if (minutes < 120) return `${minutes} min ${Math.round(value - 60 * minutes)} s`;
  return `${num(value / 3600, 3)} h`;
}

/** Tick labels of a linear axis, all in the same notation. */
export function tickLabels(ticks) {
  const size = Math.max(...ticks.map(Math.abs));
  const gap = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : size;
  if (size === 0) return ticks.map(() => '0');
  if (size >= 1e5 || size < 1e-3) {
    const digits = Math.max(0, Math.round(Math.log10(size / gap) + 0.5));
    return ticks.map((t) => (t === 0 ? '0' : t.toExponential(digits)
      .replace(/\.?0+e/, 'e').replace('e+', 'e')));
  }
  const digits = Math.min(8, Math.max(0, -Math.floor(Math.log10(gap) + 1e-9) + extraDigit(gap)));
  return ticks.map((t) => t.toFixed(digits).replace(/^-(0(\.0+)?)$/, '$1'));
}

/** 1 when the step needs one digit more than its size says (0.25, 2.5). */
function extraDigit(gap) {
  const lead = gap / 10 ** Math.floor(Math.log10(gap) + 1e-9);
  return Math.abs(lead - Math.round(lead)) > 1e-6 ? 1 : 0;
}

/** About `wanted` round values covering [low, high]. */
export function niceTicks(low, high, wanted = 5) {
  if (!(high > low)) return [low];
  const raw = (high - low) / wanted;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((f) => f * power).find((s) => s >= raw * 0.999);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) ticks.push(i * step);
  return ticks;
}
