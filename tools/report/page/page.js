// The table, its search and order, and the details of a case. The address keeps the state: #q=metal&v=fail&sort=p&desc=1&open=3.
const data = JSON.parse(document.getElementById("data").textContent);
const $ = id => document.getElementById(id);
const rank = {fail: 0, inconclusive: 1, pass: 2};
const columns = [["name", "Distribution"], ["scalar", "scalar"], ["p", "p"], ["detectable", "detects"], ["detectable_cell", "in a cell"],
  ["ns_per_sample", "ns"], ["seconds", "s"]];
const words = {fail: "fails", inconclusive: "inconclusive", pass: "passes"};
const state = {q: "", v: "", sort: "", desc: false, map: "", open: new Set()};
const redraws = new Map(); // functions to call again when the width or the colours change

// element("td", {class: "n"}, "text", child...)
function element(tag, attributes = {}, ...children) {
  const svg = ["svg", "path", "circle", "line", "text", "title", "g"].includes(tag);
  const e = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) e.addEventListener(key.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) e.setAttribute(key, value);
  }
  e.append(...children.filter(c => c !== null && c !== undefined));
  return e;
}

const percent = x => x > 1 ? ">100 %" : x > 0 ? short(100 * x, 2) + " %" : "\u2013";
const probability = p => p === null || p === undefined ? "\u2013" : p >= 0.0995 ? p.toFixed(2) : short(p, 2);
const spaced = n => String(n).replace(/\B(?=(\d{3})+$)/g, "\u202f");
const count = x => x >= 1e15 ? short(x) : Number.isInteger(x) ? spaced(x) : x >= 100 ? spaced(Math.round(x)) : short(x);
const time = ns => ns > 0 ? ns < 100 ? ns.toFixed(1) : spaced(Math.round(ns)) : "\u2013";

function head() {
  const failed = data.cases.filter(c => c.verdict === "fail").length, unsure = data.cases.filter(c => c.verdict === "inconclusive").length;
  const errors = (data.errors || []).length;
  const n = data.cases.length, verdict = failed ? "fail" : unsure || errors ? "inconclusive" : "pass";
  const part = k => `${k} of ${n} case${n === 1 ? "" : "s"}`;
  $("verdict").className = verdict;
  $("verdict").textContent = failed && n === 1 ? "The distribution fails" : failed ? `${part(failed)} fail${failed === 1 ? "s" : ""}` + (unsure ? `, ${unsure} inconclusive` : "")
    : unsure ? `${part(unsure)} inconclusive` : n === 1 ? "The distribution passes all checks" : `All ${n} cases pass`;
  if (data.interrupted) $("verdict").textContent += "; interrupted, the page contains the finished cases";
  if (errors) $("verdict").textContent += `; ${errors} more could not be checked`;
  $("facts").textContent = [`${spaced(data.samples)} samples each`, `family-wise \u03b1 = ${data.alpha}`, `seed ${data.seed}`,
    `commit ${data.commit}`, `${short(data.cases.reduce((s, c) => s + c.seconds, 0), 3)} s of work`].join(" \u00b7 ");
  $("command").textContent = data.command;
  document.title = `carlo validate: ${$("verdict").textContent}`;
  const groups = [["", "All", n], ["fail", "Fail", failed], ["inconclusive", "Inconclusive", unsure],
    ["pass", "Pass", n - failed - unsure]];
  for (const [v, label, k] of groups)
    if (v !== "inconclusive" || unsure)
      $("verdicts").append(element("button", {type: "button", "data-v": v, onclick: () => set({v})}, `${label} ${k}`));
  for (const [key, label] of columns) {
    const kind = key === "name" || key === "scalar" ? "" : "number";
    $("columns").append(element("button", {type: "button", "data-key": key, class: kind, onclick: () => order(key)}, label));
  }
  $("columns").prepend(element("span"));
  $("sort").append(element("option", {value: ""}, "by verdict"));
  for (const [key, label] of columns) for (const desc of ["", "-"])
    $("sort").append(element("option", {value: desc + key}, `${label} ${desc ? "\u2193" : "\u2191"}`));
  $("sort").addEventListener("change", () => set({sort: $("sort").value.replace("-", ""), desc: $("sort").value.startsWith("-")}));
  $("search").addEventListener("input", () => set({q: $("search").value}));
}

function order(key) {
  if (state.sort !== key) set({sort: key, desc: false});
  else if (!state.desc) set({desc: true});
  else set({sort: "", desc: false});
}

function row(c, i) {
  const number = (key, label, text, more = "") =>
    element("span", {class: "number " + more, "data-key": key}, element("span", {class: "key"}, label), text);
  const canvas = element("canvas", {role: "img", "aria-label": "expected density"});
  const button = element("button", {type: "button", class: "row", "aria-expanded": "false", onclick: () => toggle(i)},
    canvas,
    element("span", {class: "name"}, element("span", {class: "mark"}), element("b", {}, c.name),
      c.verdict === "pass" ? null : element("span", {class: "word"}, words[c.verdict]), element("small", {}, c.parameters || "\u00a0")),
    element("span", {class: "scalar"}, element("span", {class: "key"}, "scalar"), c.scalar),
    number("p", "p", probability(c.p)),
    number("detectable", "detects", percent(c.detectable)),
    number("detectable_cell", "in a cell", percent(c.detectable_cell), "cell"),
    number("ns_per_sample", "ns", time(c.ns_per_sample)),
    number("seconds", "s", c.seconds.toFixed(2), "cell"));
  const item = element("li", {class: c.verdict, id: "case-" + i}, button);
  c.item = item, c.text = `${c.name} ${c.parameters} ${c.scalar} ${c.verdict}`.toLowerCase();
  thumbnails.observe(canvas);
  canvas.draw = () => load(c).then(() => picture(canvas, c, "expected", {bare: true, mode: modeOf(c)}));
  return item;
}

const thumbnails = new IntersectionObserver(entries => {
  for (const e of entries) {
    if (!e.isIntersecting || redraws.has(e.target)) continue;
    e.target.draw();
    redraws.set(e.target, e.target.draw);
  }
}, {rootMargin: "300px"});

// True coordinates, unless half of the samples lie in cells that are too small for the map.
function modeOf(c) {
  if (state.map) return state.map;
  if (c.mode) return c.mode;
  const cells = c.cells, axes = axesOf(c), views = axes.map((axis, d) => viewOf(cells, axis, d, "true"));
  let seen = 0, all = 0;
  for (const cell of cells) {
    all += cell.expected;
    if (cell.lo.every((lo, d) => views[d].at(cell.hi[d]) - views[d].at(lo) > (axes.length > 1 ? 0.004 : 2e-4))) seen += cell.expected;
  }
  return c.mode = seen < 0.5 * all ? "equal" : "true";
}

// Cells of three axes projected along the last.
function flat(cells, axes) {
  if (axes.length < 3) return cells;
  const n = 24, grid = [];
  const cuts = [0, 1].map(d => {
    const share = shareBelow(cells, d);
    return Array.from({length: n + 1}, (_, k) => k === 0 ? 0 : k === n ? 1 : share.quantile(k / n));
  });
  for (let i = 0; i < n; ++i) for (let j = 0; j < n; ++j)
    grid.push({lo: [cuts[0][i], cuts[1][j]], hi: [cuts[0][i + 1], cuts[1][j + 1]], observed: 0, expected: 0});
  const inside = (d, k, c) => Math.max(0, Math.min(cuts[d][k + 1], c.hi[d]) - Math.max(cuts[d][k], c.lo[d])) / (c.hi[d] - c.lo[d]);
  for (const c of cells) for (let i = 0; i < n; ++i) {
    const part = inside(0, i, c);
    if (part > 0) for (let j = 0; j < n; ++j) {
      const w = part * inside(1, j, c);
      grid[i * n + j].observed += w * c.observed, grid[i * n + j].expected += w * c.expected;
    }
  }
  for (const g of grid) g.z = (g.observed - g.expected) / Math.sqrt(Math.max(g.expected, 0.5));
  return grid;
}

// Draws one kind of map (observed, expected, residual) of a case; returns the low and the high end of its colours.
function picture(canvas, c, kind, options) {
  const axes = axesOf(c).slice(0, 2), cells = flat(c.cells, axesOf(c));
  if (!cells.length) return null;
  const views = axes.map((axis, d) => viewOf(cells, axis, d, options.mode));
  if (axes.length === 1) {
    canvas.find = drawSteps(canvas, cells, axes, views, kind, options);
    return null;
  }
  const scale = densityScale(cells, views), colours = residual();
  canvas.find = kind === "residual"
    ? drawMap(canvas, cells, axes, views, cell => mix(colours, 0.5 + cell.z / 8), cell => Math.abs(cell.z), options)
    : drawMap(canvas, cells, axes, views, cell => mix(heat, scale.of(cell, cell[kind])), cell => scale.of(cell, cell.expected), options);
  return scale;
}

function hover(canvas, c) {
  const axes = axesOf(c);
  const tip = element("div", {class: "tip", hidden: ""});
  canvas.after(tip);
  canvas.addEventListener("pointerleave", () => { tip.hidden = true; });
  canvas.addEventListener("pointermove", e => {
    const box = canvas.getBoundingClientRect(), cell = canvas.find && canvas.find(e.clientX - box.left, e.clientY - box.top);
    tip.hidden = !cell;
    if (!cell) return;
    const range = (axis, lo, hi) => `${symbol(axis.name)} ${short(valueOf(axis, lo))} to ${short(valueOf(axis, hi))}${degrees(axis)}`;
    const place = cell.lo.map((lo, d) => range(axes[d], lo, cell.hi[d])).join(", ");
    tip.replaceChildren(place, element("br"), `observed ${count(cell.observed)}, expected ${count(cell.expected)}, ` +
      `z = ${short(cell.z, 2)}`);
    tip.style.left = Math.max(4, Math.min(e.clientX + 12, innerWidth - tip.offsetWidth - 8)) + "px";
    tip.style.top = e.clientY + 14 + "px";
  });
}

function maps(c) {
  const box = element("div", {class: "maps"});
  const axes = axesOf(c), names = axes.map(axis => symbol(axis.name)), one = axes.length === 1;
  const sides = one ? "" : isDisk(axes) ? "" : across(axes) ? `${names[0]} down, ${names[1]} across` : `${names[0]} across, ${names[1]} up`;
  const kinds = one
    ? [["observed", "Observed, expected", `density in ${names[0]}, relative to uniform`], ["residual", "Standardised residual", "\u03c3"]]
    : [["observed", "Observed", sides], ["expected", "Expected", sides], ["residual", "Standardised residual", sides]];
  for (const [kind, title, note] of kinds) {
    const canvas = element("canvas", {role: "img", "aria-label": `${kind} map`}), low = element("span"), high = element("span");
    const bar = one ? null : element("div", {class: "bar"}, low, element("i"), high);
    box.append(element("figure", {}, element("figcaption", {}, title, element("span", {}, note)), canvas, bar));
    hover(canvas, c);
    redraws.set(canvas, () => {
      const scale = picture(canvas, c, kind, {mode: modeOf(c)});
      if (!bar || !scale) return;
      bar.children[1].style.background = gradient(kind === "residual" ? residual() : heat);
      low.textContent = kind === "residual" ? "\u22124 \u03c3" : short(scale.low, 2);
      high.textContent = kind === "residual" ? "4 \u03c3" : short(scale.high, 2) + " \u00d7 uniform" + (scale.log ? ", log" : "");
    });
  }
  return box;
}

// The p-value against the samples, both logarithmic.
function pCurve(c) {
  const alpha = c.alpha, w = 440, h = 190, left = 46, right = 10, top = 10, bottom = 24;
  const log = p => Math.log10(Math.max(p, 1e-30)), points = c.p_after;
  const least = Math.min(-3, Math.floor(log(alpha)) - 1, Math.floor(Math.min(...points.map(([, p]) => log(p)))));
  const n0 = Math.log2(points[0][0]), n1 = Math.max(Math.log2(points[points.length - 1][0]), n0 + 1);
  const x = n => left + (Math.log2(n) - n0) / (n1 - n0) * (w - left - right), y = p => top + log(p) / least * (h - top - bottom);
  const svg = element("svg", {viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": "p-value against samples"});
  const last = points.length - 1, round = n => n >= 1e6 ? short(n / 1e6) + " M" : n >= 1e4 ? Math.round(n / 1e3) + " k" : n;
  const each = Math.ceil(-least / 5);
  for (let k = 0; k >= least; k -= each)
    svg.append(element("line", {class: "grid", x1: left, x2: w - right, y1: y(10 ** k), y2: y(10 ** k)}),
      element("text", {class: "axis", x: left - 6, y: y(10 ** k) + 4, "text-anchor": "end"}, k === 0 ? "1" : `1e\u2212${-k}`));
  points.forEach(([n], k) => {
    if (k < last && (k % 3 || last - k < 2)) return;
    svg.append(element("text", {class: "axis", x: x(n), y: h - 6, "text-anchor": k === last ? "end" : "middle"}, round(n)));
  });
  const line = points.map(([n, p]) => `${x(n).toFixed(1)},${y(p).toFixed(1)}`).join("L");
  svg.append(element("line", {x1: left, x2: w - right, y1: y(alpha), y2: y(alpha), stroke: "var(--fail)", "stroke-dasharray": "4 3"}),
    element("text", {class: "axis", x: w - right, y: y(alpha) - 4, "text-anchor": "end", style: "fill: var(--fail)"}, `rejected below ${short(alpha, 2)}`),
    element("path", {d: "M" + line, fill: "none", stroke: "var(--link)", "stroke-width": 2}));
  for (const [n, p] of points)
    svg.append(element("circle", {cx: x(n), cy: y(p), r: 3.2, fill: p <= alpha ? "var(--fail)" : "var(--link)"},
      element("title", {}, `${n} samples: p = ${probability(p)}`)));
  return svg;
}

function table(heads, rows) {
  const cell = (tag, [text, kind]) => element(tag, {class: kind}, text);
  return element("table", {}, element("thead", {}, element("tr", {}, ...heads.map(h => cell("th", h)))),
    element("tbody", {}, ...rows.map(r => element("tr", {class: r.kind || ""}, ...r.cells.map(x => cell("td", x))))));
}

function detail(c) {
  const box = element("div", {class: "detail"});
  const broken = c.checks.filter(k => k.verdict);
  const found = k => k.p === undefined ? `${short(k.statistic, 4)}, limit ${short(k.limit, 4)}` : `p = ${probability(k.p)}`;
  if (broken.length)
    box.append(element("div", {class: "fault " + c.verdict},
      element("h3", {}, c.finding || (c.verdict === "fail" ? "A check fails" : "A test is not reliable")),
      c.verdict === "fail" ? element("p", {}, element("b", {}, "Likely cause: "), c.fault) : null,
      element("ul", {}, ...broken.map(k =>
        element("li", {}, element("b", {}, k.name), `: ${found(k)}${k.detail ? "; " + k.detail : ""}`)))));
  box.append(element("p", {class: "again"}, "Repeat:", element("code", {}, c.again)));
  if (c.cells.length) {
    const modes = element("span", {class: "modes", role: "group", "aria-label": "Axes of the maps"});
    for (const [mode, label] of [["true", "true"], ["equal", "equal probability"]])
      modes.append(element("button", {type: "button", "data-mode": mode, onclick: () => set({map: mode})}, label));
    box.append(element("div", {}, maps(c), element("p", {class: "mapping"}, "Coordinates:", modes,
      `${spaced(c.cells.length)} cells` + (axesOf(c).length > 2 ? ", projected along the third axis" : "") +
      (c.mode === "equal" && !state.map ? "; stretched, because the density is narrow" : ""))));
  }
  const tables = element("div", {class: "tables"}), first = element("div", {class: "stack"});
  tables.append(first);
  if (c.p_after && c.p_after.length > 1) first.append(element("section", {}, element("h2", {}, "p-value against samples"), pCurve(c)));
  if (c.worst.length) {
    const where = w => [w.cell, w.where].filter(x => x).join(" at ");
    first.append(element("section", {class: "scroll"}, element("h2", {}, "Worst cells"),
      table([["where"], ["observed", "n"], ["expected", "n"], ["z", "n"]],
        c.worst.map(w => ({cells: [[where(w)], [count(w.observed), "n"], [count(w.expected), "n"], [short(w.z, 2), "n"]]})))));
  }
  const error = k => k.p === undefined
    ? [[short(k.statistic, 3), "n"], [short(k.limit, 3), "n"], ["", "n"]]
    : [["", "n"], ["", "n"], [probability(k.p), "n"]];
  tables.append(element("section", {class: "scroll"},
    element("h2", {}, `Checks; the density integrates to ${+c.mass.toPrecision(9)} \u00b1 ${short(c.mass_error, 2)}`),
    table([["law or test"], ["error", "n"], ["limit", "n"], ["p", "n"]],
      c.checks.map(k => ({kind: {fail: "bad", inconclusive: "unsure"}[k.verdict], cells: [[k.name], ...error(k)]})))));
  box.append(tables);
  return box;
}

function toggle(i) {
  if (!state.open.delete(i)) state.open.add(i);
  set({});
}

function showDetail(c) {
  const box = detail(c);
  c.item.append(box);
  for (const canvas of box.querySelectorAll("canvas")) redraws.get(canvas)();
  pressModes(c);
}

function pressModes(c) {
  for (const b of c.item.querySelectorAll(".modes button")) b.setAttribute("aria-pressed", b.dataset.mode === modeOf(c));
}

// Updates the page to the state.
function show() {
  const q = state.q.toLowerCase().split(/\s+/).filter(x => x);
  const key = state.sort, sign = state.desc ? -1 : 1, a = data.cases;
  const shown = a.map((c, i) => i).filter(i => (!state.v || a[i].verdict === state.v) && q.every(word => a[i].text.includes(word)));
  shown.sort((i, j) => {
    if (!key) return rank[a[i].verdict] - rank[a[j].verdict] || i - j;
    const x = a[i][key], y = a[j][key];
    return sign * (typeof x === "string" ? x.localeCompare(y) : (x ?? Infinity) - (y ?? Infinity)) || i - j;
  });
  $("cases").replaceChildren(...shown.map(i => a[i].item));
  $("none").hidden = shown.length > 0;
  for (const b of $("verdicts").children) b.setAttribute("aria-pressed", b.dataset.v === state.v);
  for (const b of $("columns").querySelectorAll("button")) {
    if (b.dataset.key === key) b.setAttribute("aria-sort", state.desc ? "descending" : "ascending");
    else b.removeAttribute("aria-sort");
  }
  $("sort").value = (state.desc ? "-" : "") + key;
  if ($("search").value !== state.q) $("search").value = state.q;
  a.forEach((c, i) => {
    const open = state.open.has(i), now = c.item.querySelector(".detail");
    c.item.classList.toggle("open", open);
    c.item.firstChild.setAttribute("aria-expanded", open);
    if (!open && now) {
      for (const canvas of now.querySelectorAll("canvas")) redraws.delete(canvas);
      now.remove();
    } else if (open && !now) {
      load(c).then(() => { if (state.open.has(i) && !c.item.querySelector(".detail")) showDetail(c); });
    }
    pressModes(c);
  });
}

function set(change) {
  const redraw = "map" in change && change.map !== state.map;
  Object.assign(state, change);
  const hash = new URLSearchParams();
  if (state.q) hash.set("q", state.q);
  if (state.v) hash.set("v", state.v);
  if (state.sort) hash.set("sort", state.sort);
  if (state.desc) hash.set("desc", 1);
  if (state.map) hash.set("map", state.map);
  if (state.open.size) hash.set("open", [...state.open].join(","));
  history.replaceState(null, "", "#" + hash);
  show();
  if (redraw) drawAll();
}

function read() {
  const hash = new URLSearchParams(location.hash.slice(1)), open = (hash.get("open") || "").split(",").filter(x => x).map(Number);
  const known = (key, values) => values.includes(hash.get(key)) ? hash.get(key) : "";
  Object.assign(state, {q: hash.get("q") || "", v: known("v", Object.keys(rank)), sort: known("sort", columns.map(([k]) => k)),
    desc: hash.has("desc"), map: known("map", ["true", "equal"]), open: new Set(open.filter(i => i in data.cases))});
  show();
}

function drawAll() {
  for (const draw of redraws.values()) draw();
}

head();
data.cases.forEach(row);
const broken = data.cases.flatMap((c, i) => c.verdict === "pass" ? [] : [i]);
if (!location.hash && broken.length && broken.length <= 3) broken.forEach(i => state.open.add(i));
if (location.hash) read(); else show();
addEventListener("hashchange", read);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
let width = innerWidth;
addEventListener("resize", () => { if (innerWidth !== width) width = innerWidth, drawAll(); });
