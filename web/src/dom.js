// Small helpers to build the page.

/** An element with properties (`class`, `on…`, attributes) and children (nodes or text). */
export function el(tag, props = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(props)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else if (key === 'class') node.className = value;
    else if (key in node && key !== 'list') node[key] = value;
    else node.setAttribute(key, value);
  }
  node.append(...children.filter((c) => c !== undefined && c !== null && c !== false));
  return node;
}

/** A labelled drop-down; `options` are [value, text] pairs; calls `changed(value)`. */
export function choice(label, options, value, changed) {
  const select = el('select', { onchange: () => changed(select.value) },
    ...options.map(([v, text]) => el('option', { value: v, selected: String(v) === String(value) }, text)));
  return el('label', { class: 'control' }, el('span', {}, label), select);
}

/** A labelled check box; calls `changed(boolean)`. */
export function tick(label, value, changed) {
  const box = el('input', { type: 'checkbox', checked: value, onchange: () => changed(box.checked) });
  return el('label', { class: 'control tick' }, box, el('span', {}, label));
}

/** Calls `resized(width)` whenever the width of `node` changes. */
export function watchWidth(node, resized) {
  let last = 0;
  const look = () => {
    const width = Math.floor(node.clientWidth);
    if (width <= 0 || width === last) return;
    last = width;
    resized(width);
  };
  new ResizeObserver(() => requestAnimationFrame(look)).observe(node);
}
