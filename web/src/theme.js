// Colours of the page as the canvases need them; they follow the light or dark scheme.

const listeners = new Set();

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
