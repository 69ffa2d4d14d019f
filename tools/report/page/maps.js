"use strict";
// Cells, axes and canvases of the maps.

// A complete kd-tree: the axis of each inner node in heap order, the splits, the counts.
function cellsOfTree(bytes, dimensions) {
  const n = (bytes.length + 5) / 13, axes = bytes.subarray(0, n - 1).map(digit => digit - 48), numbers = floats(bytes.subarray(n - 1));
  const cells = [];
  const visit = (node, lo, hi) => {
    if (node >= n) {
      const i = node - n;
      cells.push({lo, hi, observed: numbers[n - 1 + i], expected: numbers[2 * n - 1 + i]});
      return;
    }
    const axis = axes[node - 1], at = numbers[node - 1];
    visit(2 * node, lo, hi.map((x, d) => d === axis ? at : x));
    visit(2 * node + 1, lo.map((x, d) => d === axis ? at : x), hi);
  };
  visit(1, Array(dimensions).fill(0), Array(dimensions).fill(1));
  return cells;
}

function cellsOfOutcomes(bytes) {
  const numbers = floats(bytes), n = numbers.length / 2;
  return Array.from({length: n}, (_, i) => ({lo: [i / n], hi: [(i + 1) / n], observed: numbers[i], expected: numbers[n + i]}));
}

// Unpacks the cells {lo, hi, observed, expected, z} of a case once. A browser of before 2023 has no maps.
function load(c) {
  c.loading ??= (async () => {
    let cells = [];
    if (typeof DecompressionStream === "undefined") cells = [];
    else if (c.tree) cells = cellsOfTree(await unpack(c.tree), c.axes.length);
    else if (c.outcomes) cells = cellsOfOutcomes(await unpack(c.outcomes.counts));
    for (const cell of cells) cell.z = (cell.observed - cell.expected) / Math.sqrt(Math.max(cell.expected, 0.5));
    c.cells = cells;
  })();
  return c.loading;
}

// Coordinates of the domain for each chart axis; the numbers of outcomes where there is no chart.
const axesOf = c => c.tree ? c.axes : [{name: "outcome", scale: "linear", a: 0, b: c.outcomes ? c.outcomes.of : 1, unit: ""}];

function valueOf(axis, v) {
  switch (axis.scale) {
  case "radius": return Math.sqrt(axis.a ** 2 + (axis.b ** 2 - axis.a ** 2) * v);
  case "ball_radius": return axis.b * Math.cbrt(v);
  case "half_line": return axis.a + axis.b * v / (1 - v);
  case "real_line": return axis.a + axis.b * (2 * v - 1) / (2 * v * (1 - v));
  case "polar": return 360 / Math.PI * Math.asin(Math.sqrt(Math.min(axis.b * v / 2, 1)));
  case "azimuth": return 360 * v;
  default: return axis.a + (axis.b - axis.a) * v;
  }
}

const symbol = name => ({theta: "\u03b8", phi: "\u03c6"}[name] || name);
const degrees = axis => axis.unit === "deg" ? "\u00b0" : "";
function short(x, digits = 3) {
  if (!Number.isFinite(x)) return x > 0 ? "\u221e" : x < 0 ? "\u2212\u221e" : "\u2013";
  const extreme = x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e5);
  const text = extreme ? x.toExponential(digits - 1).replace("e+", "e") : String(+x.toPrecision(digits));
  return text.replace("-", "\u2212");
}

// Share of the expected samples below v on an axis: piecewise linear over the faces of the cells.
function shareBelow(cells, d) {
  const slope = new Map();
  for (const {lo, hi, expected} of cells) {
    const s = expected / (hi[d] - lo[d]);
    if (!Number.isFinite(s)) continue;
    slope.set(lo[d], (slope.get(lo[d]) || 0) + s);
    slope.set(hi[d], (slope.get(hi[d]) || 0) - s);
  }
  const at = [...slope.keys()].sort((a, b) => a - b), sum = [0];
  for (let i = 1, s = 0; i < at.length; ++i) {
    s += slope.get(at[i - 1]);
    sum.push(sum[i - 1] + Math.max(s, 0) * (at[i] - at[i - 1]));
  }
  const total = sum[sum.length - 1] || 1;
  const interpolate = (xs, ys, x) => {
    let lo = 0, hi = xs.length - 1;
    while (hi - lo > 1) {
      const mid = (lo + hi) >> 1;
      if (xs[mid] <= x) lo = mid; else hi = mid;
    }
    const t = xs[hi] > xs[lo] ? (x - xs[lo]) / (xs[hi] - xs[lo]) : 0;
    return ys[lo] + Math.min(Math.max(t, 0), 1) * (ys[hi] - ys[lo]);
  };
  return {below: v => interpolate(at, sum, v) / total, quantile: q => interpolate(sum, at, q * total)};
}

// 1, 2 or 5 times a power of ten, two to five of which fill the span.
function niceStep(span) {
  const ten = 10 ** Math.floor(Math.log10(span / 2));
  return [1, 2, 5, 10].map(k => k * ten).find(step => span / step <= 5);
}

// A view of an axis: where v lies in [0,1] of the picture, how long [lo, hi] is, and the ticks.
//   "true"  : by the quantity itself, infinite ends cut a little beyond the outermost faces
//   "equal" : by the share of expected samples below
function viewOf(cells, axis, d, mode) {
  const infinite = axis.scale.endsWith("line"), marginal = mode === "equal" ? shareBelow(cells, d) : null;
  let from = valueOf(axis, 0), to = valueOf(axis, 1);
  if (infinite) {
    const faces = cells.flatMap(c => [c.lo[d], c.hi[d]]).filter(v => v > 0 && v < 1).map(v => valueOf(axis, v));
    const a = faces.reduce((x, y) => Math.min(x, y), Infinity), b = faces.reduce((x, y) => Math.max(x, y), -Infinity);
    const ends = [Math.max(a - 0.2 * (b - a), Math.min(from, to)), Math.min(b + 0.2 * (b - a), Math.max(from, to))];
    [from, to] = from < to ? ends : ends.reverse();
  }
  const clip = x => Math.min(Math.max(x, Math.min(from, to)), Math.max(from, to));
  const length = infinite ? (lo, hi) => Math.abs(clip(valueOf(axis, hi)) - clip(valueOf(axis, lo))) : (lo, hi) => hi - lo;
  if (mode === "equal") {
    const value = at => valueOf(axis, at === 0 || at === 1 ? at : marginal.quantile(at));
    const small = 1e-4 * Math.abs(value(0.75) - value(0.25));
    const label = x => short(Math.abs(x) < small ? 0 : x, Math.abs(x) < 0.01 ? 2 : 3) + degrees(axis);
    const ticks = [0, 0.25, 0.5, 0.75, 1].map(at => ({at, label: label(value(at))}));
    return {at: marginal.below, length, ticks};
  }
  const at = v => Math.min(Math.max((valueOf(axis, v) - from) / (to - from), 0), 1);
  const least = Math.min(from, to), span = Math.abs(to - from), ticks = [];
  const step = degrees(axis) && span > 40 ? (span > 200 ? 90 : span > 100 ? 45 : 30) : niceStep(span);

  for (let k = Math.ceil(least / step - 1e-9); k * step <= least + span * (1 + 1e-9); ++k)
    ticks.push({at: (k * step - from) / (to - from), label: short(k * step, 4) + degrees(axis)});
  return {at, length, ticks};
}

const css = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const dark = () => matchMedia("(prefers-color-scheme: dark)").matches;

function mix(stops, t) {
  const x = Math.min(Math.max(t, 0), 1) * (stops.length - 1), i = Math.min(Math.floor(x), stops.length - 2), f = x - i;
  return "rgb(" + stops[i].map((a, k) => Math.round(a + f * (stops[i + 1][k] - a))).join(" ") + ")";
}
const heat = [[68, 1, 84], [65, 68, 135], [42, 120, 142], [34, 168, 132], [122, 209, 81], [253, 231, 37]];
const residual = () => dark() ? [[110, 180, 255], [46, 98, 170], [30, 34, 40], [176, 62, 50], [255, 150, 120]]
                              : [[24, 70, 150], [120, 170, 220], [246, 245, 242], [236, 140, 110], [165, 20, 35]];
const gradient = stops => "linear-gradient(to right," + stops.map(s => `rgb(${s.join(" ")})`).join(",") + ")";

// The colours of a pair of density maps: logarithmic where the density spans more than a factor of 30.
function densityScale(cells, views) {
  const size = cell => views.reduce((s, view, d) => s * view.length(cell.lo[d], cell.hi[d]), 1);
  const all = cells.map(cell => cell.expected / size(cell)).filter(x => x > 0 && Number.isFinite(x)).sort((a, b) => a - b);
  const high = all[Math.floor(0.995 * (all.length - 1))] || 1, low = all[Math.floor(0.02 * (all.length - 1))] || 0;
  const log = high > 30 * low, floor = Math.max(low, high * 1e-9);
  const at = log ? x => Math.log(x / floor) / Math.log(high / floor) : x => x / high;
  const total = cells.reduce((s, cell) => s + cell.expected, 0) || 1, volume = views.reduce((s, view) => s * view.length(0, 1), 1);
  return {of: (cell, count) => at(count / size(cell)), low: log ? floor * volume / total : 0, high: high * volume / total, log};
}

// A canvas ready to draw on, in units of CSS pixels.
function paper(canvas, width, height) {
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  canvas.width = Math.round(width * ratio), canvas.height = Math.round(height * ratio);
  canvas.style.height = height + "px";
  const g = canvas.getContext("2d");
  g.scale(ratio, ratio);
  g.snap = x => Math.round(x * ratio) / ratio;
  g.pixel = 1 / ratio;
  g.font = "11px system-ui, sans-serif";
  return g;
}

const isDisk = axes => axes.length === 2 && axes[0].scale === "radius" && axes[1].scale === "azimuth";
// The first coordinate of directions and disks points down, as on a map of a globe; of other domains to the right.
const across = axes => axes[1] && axes[1].scale === "azimuth" ? 1 : 0;

// Draws a map of 2-D cells. colour(cell) is a CSS colour; cells with a larger rank(cell) are drawn later. Returns a function from
// a point to the cell below it.
function drawMap(canvas, cells, axes, views, colour, rank, options) {
  const bare = options.bare, left = bare ? 0 : 46, top = bare ? 0 : 4, right = bare ? 0 : 8, bottom = bare ? 0 : 20;
  const width = bare ? 56 : canvas.clientWidth || 300, round = isDisk(axes) && options.mode === "true";
  const x = across(axes), y = 1 - x, down = x === 1, globe = down && axes[0].scale === "polar";
  const inner = width - left - right, flat = options.mode === "true" && axes[0].b < 1.5;
  const high = bare ? 36 : globe ? Math.round(inner / (flat ? 2.6 : 1.8)) : Math.min(inner, 260);
  const g = paper(canvas, width, high + top + bottom);
  const order = cells.map(cell => [rank(cell), cell]).sort((a, b) => a[0] - b[0]);
  if (round) {
    const radius = Math.min(inner, high) / 2, cx = left + inner / 2, cy = top + high / 2, turn = 2 * Math.PI;
    for (const [, cell] of order) {
      const [r0, r1] = [cell.lo[0], cell.hi[0]].map(v => radius * valueOf(axes[0], v) / axes[0].b);
      g.beginPath();
      g.arc(cx, cy, r1, -turn * cell.lo[1], -turn * cell.hi[1], true);
      g.arc(cx, cy, r0, -turn * cell.hi[1], -turn * cell.lo[1]);
      g.fillStyle = g.strokeStyle = colour(cell);
      g.fill(), g.stroke();
    }
    canvas.dataset.cells = cells.length;
    return (px, py) => {
      const r = Math.hypot(px - cx, py - cy) / radius * axes[0].b, phi = (Math.atan2(cy - py, px - cx) / turn + 1) % 1;
      return cells.find(c => valueOf(axes[0], c.lo[0]) <= r && r < valueOf(axes[0], c.hi[0]) && c.lo[1] <= phi && phi < c.hi[1]);
    };
  }
  const places = order.map(([, cell]) => {
    const a = views[x].at(cell.lo[x]), b = views[x].at(cell.hi[x]);
    let c = views[y].at(cell.lo[y]), d = views[y].at(cell.hi[y]);
    if (!down) [c, d] = [1 - d, 1 - c];
    const x0 = g.snap(left + a * inner), y0 = g.snap(top + c * high);
    const w = Math.max(g.snap(left + b * inner) - x0, g.pixel), h = Math.max(g.snap(top + d * high) - y0, g.pixel);
    g.fillStyle = colour(cell);
    g.fillRect(x0, y0, w, h);
    return [x0, y0, w, h, cell];
  });
  canvas.dataset.cells = cells.length;
  if (bare) return null;
  g.fillStyle = css("--soft");
  g.textAlign = "center";
  for (const tick of views[x].ticks) g.fillText(tick.label, Math.min(left + tick.at * inner, width - 14), top + high + 14);
  g.textAlign = "right";
  for (const tick of views[y].ticks) g.fillText(tick.label, left - 5, top + (down ? tick.at : 1 - tick.at) * (high - 8) + 8);
  return (px, py) => {
    for (let i = places.length; i-- > 0;) {
      const [x0, y0, w, h, cell] = places[i];
      if (px >= x0 && px < x0 + w && py >= y0 && py < y0 + h) return cell;
    }
    return null;
  };
}

// Draws cells of one axis as steps: observed filled, expected as a line; or bars of the residuals.
function drawSteps(canvas, cells, axes, views, kind, options) {
  const bare = options.bare, left = bare ? 0 : 46, right = bare ? 0 : 8, top = bare ? 1 : 6, bottom = bare ? 1 : 20;
  const width = bare ? 56 : canvas.clientWidth || 300, inner = width - left - right, high = bare ? 34 : 170;
  const g = paper(canvas, width, high + top + bottom), view = views[0];
  cells = cells.filter(c => view.length(c.lo[0], c.hi[0]) > 0); // the tails of an infinite axis lie outside
  const whole = view.length(0, 1), total = cells.reduce((s, c) => s + c.expected, 0) || 1;
  const density = (cell, count) => count / total / (view.length(cell.lo[0], cell.hi[0]) / whole);
  const steps = kind === "residual" ? c => c.z : c => density(c, c.observed);
  const sorted = cells.flatMap(c => [density(c, c.expected), density(c, c.observed)]).filter(Number.isFinite).sort((a, b) => a - b);
  const most = kind === "residual" ? Math.max(4, ...cells.map(c => Math.abs(c.z)))
    : 1.08 * (sorted[Math.floor(0.998 * (sorted.length - 1))] || 1);
  const base = kind === "residual" ? top + high / 2 : top + high;
  const up = v => base - Math.min(Math.max(v / most, -1), 1) * (kind === "residual" ? high / 2 : high);
  if (!bare) {
    g.strokeStyle = css("--line"), g.fillStyle = css("--soft");
    const step = niceStep(kind === "residual" ? 2 * most : most);
    for (let k = kind === "residual" ? Math.ceil(-most / step) : 0; k * step <= most; ++k) {
      g.beginPath(), g.moveTo(left, up(k * step)), g.lineTo(width - right, up(k * step)), g.stroke();
      g.textAlign = "right", g.fillText(short(k * step), left - 5, up(k * step) + 4);
    }
    g.textAlign = "center";
    for (const tick of view.ticks) g.fillText(tick.label, Math.min(left + tick.at * inner, width - 12), top + high + 14);
  }
  const places = cells.map(cell => [g.snap(left + view.at(cell.lo[0]) * inner), g.snap(left + view.at(cell.hi[0]) * inner), cell]);
  const colours = residual();
  for (const [x0, x1, cell] of places) {
    const y = up(steps(cell));
    const strength = Math.sign(cell.z) * (0.2 + Math.min(Math.abs(cell.z) / 12, 0.3));
    g.fillStyle = kind === "residual" ? mix(colours, 0.5 + strength) : css("--link");
    g.globalAlpha = kind === "residual" ? 1 : bare ? 0.8 : 0.35;
    g.fillRect(x0, Math.min(y, base), kind === "residual" ? Math.max(x1 - x0, g.pixel) : x1 - x0, Math.abs(base - y));
  }
  g.globalAlpha = 1;
  if (kind !== "residual" && !bare) {
    g.strokeStyle = css("--ink"), g.lineWidth = 1.4;
    g.beginPath();
    for (const [x0, x1, cell] of places) g.lineTo(x0, up(density(cell, cell.expected))), g.lineTo(x1, up(density(cell, cell.expected)));
    g.stroke();
  }
  canvas.dataset.cells = cells.length;
  return px => (places.find(([x0, x1]) => px >= x0 && px < x1) || [])[2];
}
