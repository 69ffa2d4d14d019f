// The page of one picture, or of two: what carlo view, carlo compare --report and carlo render --report write.

const data = JSON.parse(document.getElementById("data").textContent);
const by = id => document.getElementById(id);
const width = data.width, height = data.height, count = width * height;

// What the user chose. The address of the page keeps it: a link names a pixel, and a reload changes nothing.
const state = {x: width >> 1, y: height >> 1, zoom: 0, left: 0, top: 0, exposure: data.exposure, channel: "color", view: "a", wipe: 0.5};
const pictures = []; // {name, radiance, half, layers}: arrays of floats, one plane for each channel
let channels = [];   // see channelsOf()

const clamp = (x, lo, hi) => Math.min(Math.max(x, lo), hi);
const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
function number(x, digits = 5) {
  if (Number.isNaN(x)) return "NaN";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  const text = x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e6) ? x.toExponential(digits - 1) : String(+x.toPrecision(digits));
  return text.replaceAll("-", "−");
}
function element(tag, properties = {}, children = []) {
  const e = Object.assign(document.createElement(tag), properties);
  e.append(...children);
  return e;
}

// --- Channels: what of a picture is shown ---

// Layers whose names differ in the last letter only are one channel of three planes: albedo.R, .G, .B or N.X, .Y, .Z.
function layerGroups(names) {
  const groups = new Map();
  for (const name of names) {
    const match = /^(.*)\.([RGBXYZ])$/.exec(name), key = match ? match[1] : name;
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(name);
  }
  return groups;
}

//   kind  : "color" (three planes of light), "grey" (light), "error" (a map of sizes), "data" (any numbers, shown from
//           the least to the largest)
//   value : plane c of a picture at pixel i
function channelsOf(p) {
  const plane = c => (q, i) => q.radiance[c * count + i];
  const all = [
    {id: "color", label: "Colour", kind: "color", value: (q, i, c) => q.radiance[c * count + i]},
    {id: "luminance", label: "Luminance", kind: "grey", value: (q, i) => luminance(plane(0)(q, i), plane(1)(q, i), plane(2)(q, i))},
    {id: "red", label: "Red", kind: "grey", value: plane(0)},
    {id: "green", label: "Green", kind: "grey", value: plane(1)},
    {id: "blue", label: "Blue", kind: "grey", value: plane(2)},
  ];
  const mean = (numbers, i) => (numbers[i] + numbers[count + i] + numbers[2 * count + i]) / 3;
  if (p.half) {
    all.push({id: "interval", label: "Half width of the intervals", kind: "error", value: (q, i) => q.half ? mean(q.half, i) : NaN});
    all.push({id: "relative", label: "Half width / value", kind: "error",
      value: (q, i) => q.half ? mean(q.half, i) / Math.max(Math.abs(mean(q.radiance, i)), 1e-30) : NaN});
  }
  for (const [key, names] of layerGroups(Object.keys(p.layers))) {
    const three = names.length === 3;
    const value = (q, i, c = 0) => q.layers[names[c]] ? q.layers[names[c]][i] : NaN;
    names.sort((a, b) => "RGBXYZ".indexOf(a.at(-1)) - "RGBXYZ".indexOf(b.at(-1)));
    all.push(three ? {id: key, label: key, kind: names[0].endsWith("R") ? "color" : "data", planes: 3, value}
                   : {id: key, label: key, kind: "data", planes: 1, value});
  }
  return all;
}
const channel = () => channels.find(c => c.id === state.channel) ?? channels[0];

// --- Pixels of the screen ---

const curve = Float32Array.from({length: 4096}, (_, i) => {
  const x = (i / 4095) ** 2; // so that dark values have enough entries
  return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
});
const encoded = x => x > 0 ? curve[Math.min(4095, Math.round(4095 * Math.sqrt(x)))] : 0;

// Green's cubehelix (2011): its lightness grows evenly, also in print and for colour-blind readers.
function helix(t) {
  const x = clamp(t, 0, 1), angle = 2 * Math.PI * (0.5 / 3 + 1 - 1.5 * x), size = x * (1 - x) / 2;
  const c = Math.cos(angle), s = Math.sin(angle);
  return [x + size * (-0.14861 * c + 1.78277 * s), x + size * (-0.29227 * c - 0.90649 * s), x + size * 1.97294 * c].map(v => 255 * clamp(v, 0, 1));
}
// Orange above 0, blue below, black at 0: told apart with every colour vision.
const signed = v => (v > 0 ? [255, 150, 40] : [70, 150, 255]).map(c => c * Math.sqrt(Math.min(Math.abs(v), 1)));

function rangeOf(p, c) {
  let lo = Infinity, hi = -Infinity;
  for (let i = 0; i < count; ++i)
    for (let k = 0; k < (c.planes ?? 1); ++k) {
      const v = c.value(p, i, k);
      if (Number.isFinite(v)) { lo = Math.min(lo, v); hi = Math.max(hi, v); }
    }
  return lo < hi ? [lo, hi] : [0, 1];
}

// Joint half width of the intervals of two pictures, in plane c.
const joint = (i, c) => Math.hypot(pictures[0].half[c * count + i], pictures[1].half[c * count + i]);
// The difference over its joint half width, of the channel where that is largest.
function excess(i) {
  let most = 0;
  for (let c = 0; c < 3; ++c) {
    const d = pictures[0].radiance[c * count + i] - pictures[1].radiance[c * count + i], v = d === 0 ? 0 : d / joint(i, c);
    if (Math.abs(v) > Math.abs(most)) most = v;
  }
  return most;
}

// Colour of pixel i: "a" and "b" are the pictures.
function painter(view) {
  const scale = 2 ** state.exposure, ch = channel();
  if (view === "excess") return i => signed(excess(i) / 2 * scale);
  if (view === "difference") {
    const planes = ch.kind === "color" ? 3 : 1;
    return i => {
      let d = 0;
      for (let c = 0; c < planes; ++c) d += (ch.value(pictures[0], i, c) - ch.value(pictures[1], i, c)) / planes;
      return signed(d * scale);
    };
  }
  const p = pictures[view === "b" ? 1 : 0];
  if (ch.kind === "color") return i => [0, 1, 2].map(c => encoded(scale * ch.value(p, i, c)));
  if (ch.kind === "error") return i => helix(scale * ch.value(p, i));
  if (ch.kind === "grey") return i => Array(3).fill(encoded(scale * ch.value(p, i)));
  const [lo, hi] = rangeOf(p, ch);
  return i => ch.planes === 3 ? [0, 1, 2].map(c => 255 * clamp((ch.value(p, i, c) - lo) / (hi - lo), 0, 1))
                              : Array(3).fill(255 * clamp((ch.value(p, i) - lo) / (hi - lo), 0, 1));
}

// The whole picture as a canvas, kept until another exposure or channel is chosen.
const painted = new Map();
function paint(view) {
  const key = [view, state.exposure, state.channel].join();
  if (painted.get(view)?.key === key) return painted.get(view).canvas;
  const canvas = element("canvas", {width, height}), context = canvas.getContext("2d"), image = context.createImageData(width, height);
  const color = painter(view);
  for (let i = 0; i < count; ++i) {
    const [r, g, b] = color(i);
    image.data[4 * i] = r, image.data[4 * i + 1] = g, image.data[4 * i + 2] = b, image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
  painted.set(view, {key, canvas});
  return canvas;
}

const size = () => ({width: by("stage").clientWidth, height: by("stage").clientHeight});
const fitting = () => Math.min(size().width / width, size().height / height);

function draw() {
  const ratio = window.devicePixelRatio || 1, {width: w, height: h} = size(), canvas = by("canvas");
  canvas.width = Math.round(w * ratio);
  canvas.height = Math.round(h * ratio);
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  context.imageSmoothingEnabled = state.zoom * ratio < 1;
  const put = (view, from, to) => {
    context.save();
    context.beginPath();
    context.rect(from, 0, to - from, h);
    context.clip();
    context.drawImage(paint(view), state.left, state.top, width * state.zoom, height * state.zoom);
    context.restore();
  };
  if (state.view === "split") {
    put("a", 0, state.wipe * w);
    put("b", state.wipe * w, w);
  } else put(state.view, 0, w);
  const side = Math.max(state.zoom, 3), x = state.left + (state.x + 0.5) * state.zoom - side / 2, y = state.top + (state.y + 0.5) * state.zoom - side / 2;
  for (const [color, out] of [["#000", 1.5], ["#fff", 0.5]]) {
    context.strokeStyle = color;
    context.strokeRect(x - out, y - out, side + 2 * out, side + 2 * out);
  }
}

// --- Texts and controls ---

function showValues() {
  const i = state.y * width + state.x, names = ["red", "green", "blue"], ch = channel();
  by("pixel").textContent = `Pixel (${state.x + data.x}, ${state.y + data.y})`;
  const cell = text => element("td", {className: "n", textContent: text});
  const head = element("tr", {}, [element("th")]);
  for (const p of pictures) {
    head.append(element("th", {className: "n", textContent: pictures.length > 1 ? p.name : "value"}));
    if (p.half) head.append(element("th", {className: "n", textContent: "95 % interval"}));
  }
  if (pictures.length > 1) head.append(element("th", {className: "n", textContent: "difference"}));
  const row = (name, value, half) => {
    const r = element("tr", {}, [element("td", {textContent: name})]);
    for (const p of pictures) {
      const v = value(p), h = half ? half(p) : NaN;
      r.append(cell(number(v)));
      if (p.half) r.append(cell(Number.isNaN(h) ? "" : `${number(v - h)} … ${number(v + h)}`));
    }
    if (pictures.length > 1) r.append(cell(number(value(pictures[0]) - value(pictures[1]))));
    return r;
  };
  const rows = names.map((name, c) => row(name, p => p.radiance[c * count + i], p => p.half ? p.half[c * count + i] : NaN));
  const isLayer = ch.planes !== undefined;
  if (isLayer) for (let c = 0; c < ch.planes; ++c) rows.push(row(ch.planes > 1 ? `${ch.label} ${c + 1}` : ch.label, p => ch.value(p, i, c)));
  by("values").replaceChildren(element("thead", {}, [head]), element("tbody", {}, rows));
}

function legend() {
  const unit = number(2 ** -state.exposure, 3), ch = channel();
  if (state.view === "excess")
    return `Orange: the first picture is brighter. Full colour: the difference is ${number(2 * 2 ** -state.exposure, 3)} times the half width of its 95 % interval.`;
  if (state.view === "difference") return `Orange: the first picture is brighter; blue: the second. Full colour: a difference of ${unit}.`;
  if (ch.kind === "error") return `Black: 0; white: ${unit}.`;
  if (ch.kind === "data") return `Black: ${number(rangeOf(pictures[0], ch)[0], 3)}; white: ${number(rangeOf(pictures[0], ch)[1], 3)}.`;
  return `White: ${unit} and more.`;
}

function show() {
  for (const button of by("views").children) button.setAttribute("aria-pressed", button.value === state.view);
  by("channel").value = channel().id;
  by("exposure").value = state.exposure;
  by("stops").textContent = `${state.exposure > 0 ? "+" : ""}${number(state.exposure, 3)} stops`;
  by("scale").textContent = `${Math.round(100 * state.zoom)} %`;
  by("wipe").hidden = state.view !== "split";
  by("wipe").style.left = `${100 * state.wipe}%`;
  by("wipe").setAttribute("aria-valuenow", Math.round(100 * state.wipe));
  by("legend").textContent = legend();
  showValues();
  draw();
  const kept = ["x", "y", "exposure", "channel", "view"].map(k => `${k}=${encodeURIComponent(state[k])}`);
  if (Math.abs(state.zoom / fitting() - 1) > 1e-6) kept.push(`zoom=${+state.zoom.toPrecision(4)}`);
  history.replaceState(null, "", "#" + kept.join("&"));
}

// Zooms so that the pixel below a point of the stage stays there.
function zoomTo(zoom, x = size().width / 2, y = size().height / 2) {
  const next = clamp(zoom, Math.min(fitting(), 1) / 2, 64), factor = next / state.zoom;
  state.left = x - factor * (x - state.left);
  state.top = y - factor * (y - state.top);
  state.zoom = next;
}
function fit() {
  state.zoom = fitting();
  state.left = (size().width - width * state.zoom) / 2;
  state.top = (size().height - height * state.zoom) / 2;
}
function select(x, y) {
  state.x = clamp(x, 0, width - 1);
  state.y = clamp(y, 0, height - 1);
}
// Moves the picture so that the selected pixel is visible.
function reveal() {
  const {width: w, height: h} = size(), x = state.left + (state.x + 0.5) * state.zoom, y = state.top + (state.y + 0.5) * state.zoom;
  state.left += clamp(x, 8, w - 8) - x;
  state.top += clamp(y, 8, h - 8) - y;
}

const views = () => [["a", pictures[0].name], ...(pictures.length < 2 ? [] : [["b", pictures[1].name], ["split", "Split"],
  ["difference", "Difference"], ...(pictures.every(p => p.half) ? [["excess", "Difference / interval"]] : [])])];

function press(key, shift) {
  const step = shift ? 10 : 1, ids = channels.map(c => c.id), isPair = pictures.length > 1;
  const actions = {
    ArrowLeft: () => { select(state.x - step, state.y); reveal(); },
    ArrowRight: () => { select(state.x + step, state.y); reveal(); },
    ArrowUp: () => { select(state.x, state.y - step); reveal(); },
    ArrowDown: () => { select(state.x, state.y + step); reveal(); },
    "+": () => zoomTo(1.5 * state.zoom), "=": () => zoomTo(1.5 * state.zoom), "-": () => zoomTo(state.zoom / 1.5),
    0: fit, 1: () => zoomTo(1 / (window.devicePixelRatio || 1)),
    "[": () => { state.exposure = clamp(state.exposure - 0.5, -10, 10); }, "]": () => { state.exposure = clamp(state.exposure + 0.5, -10, 10); },
    c: () => { state.channel = ids[(ids.indexOf(state.channel) + 1) % ids.length]; },
    ...(isPair && {" ": () => { state.view = state.view === "a" ? "b" : "a"; }, s: () => { state.view = "split"; },
      d: () => { state.view = "difference"; }}),
  };
  if (!actions[key]) return false;
  actions[key]();
  show();
  return true;
}

function listen() {
  const stage = by("stage"), at = e => { const r = stage.getBoundingClientRect(); return [e.clientX - r.left, e.clientY - r.top]; };
  let drag = null;
  stage.addEventListener("wheel", e => {
    e.preventDefault();
    zoomTo(state.zoom * 2 ** (-e.deltaY / 200), ...at(e));
    show();
  }, {passive: false});
  stage.addEventListener("pointerdown", e => {
    const [x, y] = at(e);
    drag = e.target === by("wipe") ? {wipe: true} : {x, y, left: state.left, top: state.top};
    stage.setPointerCapture(e.pointerId);
    stage.classList.add("moving");
  });
  stage.addEventListener("pointermove", e => {
    const [x, y] = at(e);
    if (drag?.wipe) state.wipe = clamp(x / size().width, 0, 1);
    else if (drag) {
      state.left = drag.left + x - drag.x;
      state.top = drag.top + y - drag.y;
    } else select(Math.floor((x - state.left) / state.zoom), Math.floor((y - state.top) / state.zoom));
    show();
  });
  for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, () => { drag = null; stage.classList.remove("moving"); });
  by("wipe").addEventListener("keydown", e => {
    const step = {ArrowLeft: -0.02, ArrowRight: 0.02}[e.key];
    if (!step) return;
    state.wipe = clamp(state.wipe + step, 0, 1);
    e.stopPropagation();
    e.preventDefault();
    show();
  });
  document.addEventListener("keydown", e => {
    if (e.ctrlKey || e.metaKey || e.altKey || e.target.matches("select, input")) return;
    if (e.target.matches("button") && (e.key === " " || e.key === "Enter")) return;
    if (press(e.key, e.shiftKey)) e.preventDefault();
  });
  by("channel").addEventListener("change", e => { state.channel = e.target.value; show(); });
  by("exposure").addEventListener("input", e => { state.exposure = +e.target.value; show(); });
  by("smaller").addEventListener("click", () => press("-"));
  by("larger").addEventListener("click", () => press("+"));
  by("fit").addEventListener("click", () => press("0"));
  by("whole").addEventListener("click", () => press("1"));
  window.addEventListener("resize", show);
}

function details() {
  for (const p of data.pictures) {
    if (Object.keys(p.metadata).length === 0) continue;
    const rows = Object.entries(p.metadata).map(([k, v]) => element("tr", {}, [element("th", {textContent: k}), element("td", {textContent: v})]));
    by("details").append(element("h2", {textContent: p.name}), element("div", {className: "scroll"}, [element("table", {}, rows)]));
  }
}

// Error against time, both logarithmic.
function plot(points) {
  const xs = points.map(p => Math.log10(p[0])), ys = points.map(p => Math.log10(p[1]));
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const at = (x, y) => `${(60 + 420 * (x - x0) / (x1 - x0 || 1)).toFixed(1)},${(15 + 120 * (y1 - y) / (y1 - y0 || 1)).toFixed(1)}`;
  const label = (x, y, text, anchor) => `<text class="axis" x="${x}" y="${y}" text-anchor="${anchor}">${text}</text>`;
  return `<svg viewBox="0 0 500 170" role="img" aria-label="Error against time"><polyline points="${xs.map((x, i) => at(x, ys[i])).join(" ")}"/>` +
    label(55, 19, number(100 * 10 ** y1, 3) + " %", "end") + label(55, 139, number(100 * 10 ** y0, 3) + " %", "end") +
    label(60, 160, number(10 ** x0, 3) + " s", "start") + label(480, 160, number(10 ** x1, 3) + " s", "end") + "</svg>";
}
function progress() {
  const p = data.progress;
  if (!p) return;
  by("progress").hidden = false;
  by("progress").append(element("p", {textContent: p.text}), element("progress", {max: 1, value: p.fraction}));
  const known = p.errors.filter(([t, e]) => t > 0 && e > 0);
  if (known.length > 1) by("progress").insertAdjacentHTML("beforeend", plot(known));
}

(async () => {
  by("tool").textContent = data.tool;
  by("title").textContent = data.title;
  by("command").textContent = data.command;
  by("verdict").textContent = data.verdict;
  by("verdict").hidden = !data.verdict;
  by("pairs").hidden = data.pictures.length < 2;
  progress();
  details();
  if (typeof DecompressionStream === "undefined") {
    by("legend").textContent = "This browser is older than 2023 and cannot unpack the picture.";
    return;
  }
  for (const p of data.pictures) {
    const layers = {};
    for (const [name, text] of Object.entries(p.layers)) layers[name] = floats(await unpack(text));
    pictures.push({name: p.name, radiance: floats(await unpack(p.radiance)), half: p.half_width ? floats(await unpack(p.half_width)) : null, layers});
  }
  channels = channelsOf(pictures[0]);
  for (const c of channels) by("channel").append(element("option", {value: c.id, textContent: c.label}));
  for (const [value, label] of views())
    by("views").append(element("button", {type: "button", value, textContent: label, onclick: () => { state.view = value; show(); }}));
  by("views").hidden = pictures.length < 2;
  const given = new URLSearchParams(location.hash.slice(1));
  for (const k of ["x", "y", "exposure"]) if (given.has(k) && Number.isFinite(+given.get(k))) state[k] = +given.get(k);
  if (channels.some(c => c.id === given.get("channel"))) state.channel = given.get("channel");
  if (views().some(([v]) => v === given.get("view"))) state.view = given.get("view");
  select(Math.round(state.x), Math.round(state.y));
  state.exposure = clamp(state.exposure, -10, 10);
  fit();
  if (+given.get("zoom") > 0) { zoomTo(+given.get("zoom")); reveal(); }
  listen();
  show();
  document.body.dataset.ready = "yes";
})();
