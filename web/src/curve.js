// Draws one curve of a plot straight onto uPlot's canvas.

/** kind: line (default; NaN breaks it), bars (from 0), points. `styles[i]` = {colour, shape}. */
export function drawCurve(chart, curve, colour) {
  const ctx = chart.ctx;
  const scale = devicePixelRatio || 1;
  const { left, top, width, height } = chart.bbox;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, width, height);
  ctx.clip();
  const log = chart.scales.y.distr === 3;
  const at = (i) => [
    chart.valToPos(curve.x[i], 'x', true),
    log && !(curve.y[i] > 0) ? NaN : chart.valToPos(curve.y[i], 'y', true),
  ];
  if (curve.kind === 'bars') bars(chart, ctx, curve, colour, at);
  else if (curve.kind !== 'points') line(ctx, curve, colour, at, scale);
  const few = curve.kind !== 'bars' && curve.x.length <= 60 && curve.x.length * 7 * scale < width;
  if (curve.kind === 'points' || curve.styles || curve.dots || (few && curve.dots !== false)) {
    dots(ctx, curve, colour, at, scale);
  }
  ctx.restore();
}

function line(ctx, curve, colour, at, scale) {
  ctx.lineWidth = (curve.width ?? 1.75) * scale;
  ctx.lineJoin = 'round';
  ctx.setLineDash(curve.dashed ? [5 * scale, 4 * scale] : []);
  let open = false;
  let shade = null;
  ctx.strokeStyle = colour;
  ctx.beginPath();
  for (let i = 0; i < curve.x.length; ++i) {
    const [x, y] = at(i);
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      open = false;
      continue;
    }
    const wanted = curve.shade?.(i);
    if (wanted && wanted !== shade) {
      ctx.stroke();
      ctx.beginPath();
      ctx.strokeStyle = shade = wanted;
      open = false;
    }
    if (open) ctx.lineTo(x, y);
    else ctx.moveTo(x, y);
    open = true;
  }
  ctx.stroke();
  ctx.setLineDash([]);
}

function bars(chart, ctx, curve, colour, at) {
  const unit = chart.valToPos(1, 'x', true) - chart.valToPos(0, 'x', true);
  const wide = Math.max(1, Math.min(unit * 0.78, 40));
  const base = chart.valToPos(0, 'y', true);
  for (let i = 0; i < curve.x.length; ++i) {
    const [x, y] = at(i);
    ctx.fillStyle = curve.shade?.(i) ?? colour;
    ctx.fillRect(x - wide / 2, y, wide, base - y);
  }
}

function dots(ctx, curve, colour, at, scale) {
  for (let i = 0; i < curve.x.length; ++i) {
    const [x, y] = at(i);
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    const style = curve.styles?.[i];
    symbol(ctx, style?.shape ?? 'disc', x, y, (style?.size ?? 2.6) * scale,
      style?.colour ?? curve.shade?.(i) ?? colour);
  }
}

/** disc, ring (hollow), diamond, triangle. */
export function symbol(ctx, shape, x, y, r, colour) {
  ctx.beginPath();
  if (shape === 'diamond') {
    ctx.moveTo(x, y - 1.3 * r);
    ctx.lineTo(x + 1.3 * r, y);
    ctx.lineTo(x, y + 1.3 * r);
    ctx.lineTo(x - 1.3 * r, y);
    ctx.closePath();
  } else if (shape === 'triangle') {
    ctx.moveTo(x, y + r);
    ctx.lineTo(x - 1.1 * r, y - r);
    ctx.lineTo(x + 1.1 * r, y - r);
    ctx.closePath();
  } else {
    ctx.arc(x, y, r, 0, 2 * Math.PI);
  }
  if (shape === 'ring') {
    ctx.strokeStyle = colour;
    ctx.lineWidth = 0.5 * r;
    ctx.stroke();
  } else {
    ctx.fillStyle = colour;
    ctx.fill();
  }
}
