// Which bodies are shown, transparent or hidden, and the frame that is shown first.
import { choice, el } from './dom.js';

/** What is drawn of a topology: `looks` by body: `shown`, `faint` or `hidden`. */
export function visible(topo, looks) {
  const key = looks.join();
  if (topo.drawn?.key === key) return topo.drawn;
  const look = (body) => looks[body] ?? 'shown';
  const pick = (wanted) => topo.tris.filter((_, i) => look(topo.bodies[Math.floor(i / 3)]) === wanted);
  const seen = (e) => look(e.body) !== 'hidden';
  topo.drawn = {
    key, tris: pick('shown'), faint: pick('faint'), inner: topo.inner.filter(seen), outline: topo.outline.filter(seen),
  };
  return topo.drawn;
}

/** A list to fold out, with one choice a body; null where there is but one. */
export function bodyChoices(names, state, changed) {
  if (!(names?.length > 1)) return null;
  const options = [['shown', 'shown'], ['faint', 'transparent'], ['hidden', 'hidden']];
  return el('details', { class: 'bodies' }, el('summary', {}, 'Bodies'),
    ...names.map((name, b) => choice(name, options, state.looks[b] ?? 'shown', (look) => {
      state.looks = names.map((_, k) => (k === b ? look : state.looks[k] ?? 'shown'));
      changed();
    })));
}

/** The frame with the largest of `values` (one a frame), the latest of equals; else the last one. */
export function largestFrame(values) {
  let best = values.length - 1;
  values.forEach((v, i) => {
    if (v > 0 && !(v < values[best])) best = i;
  });
  return best;
}
