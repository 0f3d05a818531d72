// Play button, slider and read-out of the frames, and small buttons, for both pictures.
import { el } from './dom.js';
import { num } from './format.js';
import { css, onEnd } from './theme.js';

export function button(text, title, onclick) {
  return el('button', { type: 'button', class: 'small', title, onclick }, text);
}

/** Saves a canvas on the colour of its panel as PNG. */
export function savePicture(canvas, name) {
  const copy = el('canvas', { width: canvas.width, height: canvas.height });
  const ctx = copy.getContext('2d');
  ctx.fillStyle = css('--panel');
  ctx.fillRect(0, 0, copy.width, copy.height);
  ctx.drawImage(canvas, 0, 0);
  copy.toBlob((blob) => {
    const url = URL.createObjectURL(blob);
    el('a', { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 1000);
  });
}

/** Calls `draw` once per animation frame however often it is asked. */
export function onceAFrame(draw) {
  let waiting = false;
  return () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      draw();
    });
  };
}

/** Play button, slider and read-out; with one frame only the read-out. */
export function player(frames, current, show) {
  const slider = el('input', {
    type: 'range', min: 0, max: frames.length - 1, step: 1, 'aria-label': 'frame',
    oninput: () => { stop(); show(Number(slider.value)); },
  });
  const text = el('span', { class: 'readout' });
  const play = el('button', { type: 'button', class: 'play', title: 'play (space)', onclick: toggle }, '\u25b6');
  let timer = 0;
  function stop() {
    clearInterval(timer);
    timer = 0;
    play.textContent = '\u25b6';
  }
  function toggle() {
    if (timer) return stop();
    play.textContent = '\u275a\u275a';
    const pause = Math.max(50, Math.min(250, 5000 / frames.length));
    timer = setInterval(() => show((current() + 1) % frames.length), pause);
  }
  const several = frames.length > 1;
  onEnd(stop);
  return {
    bar: el('div', { class: 'player' }, several && play, several && slider, text),
    stop, toggle: several ? toggle : stop, playing: () => timer !== 0,
    update() {
      const f = frames[current()];
      slider.value = current();
      const parts = [f.step !== undefined && `step ${f.step}`,
        f.increment !== undefined && `increment ${f.increment}`, f.time !== undefined && `time ${num(f.time, 5)}`];
      text.textContent = `${parts.filter(Boolean).join(', ')}  (${current() + 1} of ${frames.length})`;
    },
  };
}

/** Arrow keys step through the frames, space plays. */
export function frameKeys(canvas, frames, current, show) {
  canvas.addEventListener('keydown', (e) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
    if (step) {
      frames.stop();
      show(current() + step);
    } else if (e.key === ' ') frames.toggle();
    else return;
    e.preventDefault();
  });
}

/** How bodies are looked at, for a picture of the same bodies with other frames; the last frame stays the last. */
export function lookOf({ state, body, view }, [place, direction]) {
  const { frame, cut, ...kept } = state; // a cut is made anew
  if (body.pairs && !body.pairs().length) { // nothing touched: what is drawn of contact was not chosen
    delete kept.contact;
    delete kept.points;
  }
  const { step, increment, time } = body.frames[frame];
  const keys = [...direction, ...(view.moved ? place : [])];
  return {
    state: kept, where: frame === body.frames.length - 1 ? null : { step, increment, time },
    camera: Object.fromEntries(keys.map((key) => [key, view[key]])),
  };
}

/** Puts a camera of `lookOf` in place; `fit` shows everything unless the user had moved it. */
export function placeCamera(view, camera, fit) {
  Object.assign(view, camera);
  if (camera?.k) view.moved = true;
  else fit();
}

/** The scale at which the largest displacement is a tenth of the model; never below 1. */
export function autoScale(body) {
  const [, largest] = body.range('displacement |u|');
  const raw = largest > 0 ? (0.1 * body.size) / largest : 1;
  if (raw <= 1) return 1;
  const power = 10 ** Math.floor(Math.log10(raw));
  return [5, 2, 1].map((f) => f * power).find((v) => v <= raw);
}
