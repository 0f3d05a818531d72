// Colours of the page as the canvases need them; they follow the light or dark scheme.

const listeners = new Set();
const ends = new Set();

/** Value of a custom property of the style sheet. */
export function css(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** Colour of the i-th curve of a plot. */
export function curveColour(i) {
  return css(`--curve-${i % 6}`);
}

/** `redraw` is called when the scheme changes, and before and after printing (always light). */
export function onTheme(redraw) {
  listeners.add(redraw);
}

/** `end` is called when what is built now is taken off the page. */
export function onEnd(end) {
  ends.add(end);
}

/** Everything that is built from now on belongs together: the function that is returned ends it. */
export function scope() {
  const before = [new Set(listeners), new Set(ends)];
  return () => {
    for (const end of ends) if (!before[1].has(end)) end();
    [listeners, ends].forEach((set, k) => set.forEach((f) => before[k].has(f) || set.delete(f)));
  };
}

function announce() {
  for (const redraw of listeners) redraw();
}

matchMedia('(prefers-color-scheme: dark)').addEventListener('change', announce);
addEventListener('beforeprint', () => {
  document.documentElement.classList.add('print');
  announce();
});
addEventListener('afterprint', () => {
  document.documentElement.classList.remove('print');
  announce();
});
