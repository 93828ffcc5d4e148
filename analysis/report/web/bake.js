// The crowd, moment by moment: x and y of everybody as 16-bit numbers.
const agents = data.agents, count = agents.group.length, ways = data.ways;
const duration = Math.max(0, (data.frames - 1) / data.fps);
const momentSeconds = ways.every / data.fps;
let moments = null, storeys = null;

async function inflated(packed) {
  const text = atob(packed), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function unpack() {
  if (ways.storeys) storeys = await inflated(ways.storeys);
  const raw = await inflated(ways.deflated);
  const numbers = 2 * count;
  moments = new Uint16Array(numbers * ways.moments);
  for (let m = 0; m < ways.moments; m++) {
    const here = m * numbers, from = 2 * here;
    for (let i = 0; i < numbers; i++) {
      const folded = raw[from + i] | raw[from + numbers + i] << 8;
      const left = (folded >>> 1) ^ -(folded & 1);
      const last = m > 0 ? moments[here - numbers + i] : 0, before = m > 1 ? moments[here - 2 * numbers + i] : 0;
      moments[here + i] = 2 * last - before + left;
    }
  }
  delete ways.deflated;
  delete ways.storeys;
}

// Where the last moment may come sooner than the others.
const momentTime = m => Math.min(m * momentSeconds, duration);
function momentAt(time) {
  const m = Math.min(Math.floor(time / momentSeconds), Math.max(0, ways.moments - 2));
  const span = momentTime(m + 1) - momentTime(m);
  return {m, share: span > 0 ? Math.min(1, (time - momentTime(m)) / span) : 0};
}
const isThere = (row, frame) => agents.first[row] !== null && frame >= agents.first[row] && frame <= agents.last[row];

const first = Float64Array.from(agents.first, f => f === null ? Infinity : f), last = Float64Array.from(agents.last, f => f === null ? -1 : f);
const radii = Float32Array.from(agents.radius);
const state = {time: 0, playing: false, rate: 1, colour: "group", density: "off", trails: true, chosen: null, partner: null, level: null};
// Of a layout with levels: who is on the chosen one, or on a link from or to it; and what stands there.
const levels = data.geometry.levels || [], links = data.geometry.links || [];
const isOnLevel = thing => state.level === null || thing.levels.includes(state.level);
function isShown(row, m) {
  if (state.level === null) return true;
  const storey = storeys[m * count + row];
  return storey < levels.length ? storey === state.level : storey - levels.length < links.length && isOnLevel(links[storey - levels.length]);
}
const view = {x: 0, y: 0, scale: 1};  // the world's point in the middle, px per metre
const stage = $("stage"), canvases = ["ground", "heat", "people", "marks"].map($);
let width = 1, height = 1, pixel = 1, image = null, words = null;

const toX = x => (x - view.x) * view.scale + width / 2, toY = y => height / 2 - (y - view.y) * view.scale;

function fit() {
  const [x0, y0] = data.minimum, [x1, y1] = data.maximum;
  view.x = (x0 + x1) / 2; view.y = (y0 + y1) / 2;
  view.scale = 0.96 * Math.min(width / Math.max(1, x1 - x0), height / Math.max(1, y1 - y0));
}

function resize() {
  const box = stage.getBoundingClientRect();
  pixel = Math.min(2, window.devicePixelRatio || 1);
  width = Math.max(1, Math.round(box.width * pixel)); height = Math.max(1, Math.round(box.height * pixel));
  for (const canvas of canvases) { canvas.width = width; canvas.height = height; }
  image = $("people").getContext("2d").createImageData(width, height);
  words = new Uint32Array(image.data.buffer);
}

function trace(context, points, closed) {
  context.beginPath();
  for (let i = 0; i < points.length; i += 2) context[i ? "lineTo" : "moveTo"](toX(points[i]), toY(points[i + 1]));
  if (closed) context.closePath();
}

function drawGround() {
  const context = $("ground").getContext("2d");
  context.clearRect(0, 0, width, height);
  context.lineJoin = "round";
  for (const [i, level] of levels.entries()) {
    if (state.level !== null && state.level !== i) continue;
    trace(context, level.points, true); context.fillStyle = "rgba(228,226,217,.45)"; context.fill();
  }
  for (const road of data.geometry.roads.filter(isOnLevel)) {
    trace(context, road.points, false);
    context.lineWidth = road.width * view.scale; context.strokeStyle = "#e4e2d9"; context.stroke();
  }
  for (const area of data.geometry.areas.filter(isOnLevel)) { trace(context, area.points, true); context.fillStyle = "rgba(31,95,168,.07)"; context.fill(); }
  for (const wall of data.geometry.walls.filter(isOnLevel)) {
    const toggled = wall.toggles.filter(at => at <= state.time).length % 2 === 1;
    if (wall.open !== toggled) continue;
    trace(context, wall.points, wall.closed);
    if (wall.closed) { context.fillStyle = "#c9c6bc"; context.fill(); }
    context.lineWidth = wall.closed ? Math.max(1, pixel) : Math.max(pixel, wall.width * view.scale);
    context.strokeStyle = "#55544f"; context.stroke();
  }
}

// ---- density: people in squares of a metre, smeared over the neighbours
const cells = {width: Math.max(1, Math.ceil(data.maximum[0] - data.minimum[0])), height: Math.max(1, Math.ceil(data.maximum[1] - data.minimum[1]))};
cells.side = Math.max(1, Math.sqrt(cells.width * cells.height / 250000));
cells.width = Math.ceil(cells.width / cells.side); cells.height = Math.ceil(cells.height / cells.side);
function countInto(grid, m, frame) {
  const from = m * 2 * count, toCell = ways.quantum / cells.side;
  for (let row = 0; row < count; row++) {
    if (frame < first[row] || frame > last[row] || !isShown(row, m)) continue;
    const x = Math.min(cells.width - 1, moments[from + 2 * row] * toCell | 0), y = Math.min(cells.height - 1, moments[from + 2 * row + 1] * toCell | 0);
    grid[y * cells.width + x]++;
  }
}
let kept = {};
function densityGrid(kind, m) {
  if (kind !== "now" && kept[kind]) return kept[kind];
  const grid = new Float32Array(cells.width * cells.height);
  if (kind === "now") countInto(grid, m, m * ways.every);
  else {
    const step = Math.max(1, Math.floor(ways.moments / 400));
    let taken = 0;
    const now = new Float32Array(grid.length);
    for (let at = 0; at < ways.moments; at += step, taken++) {
      if (kind === "mean") countInto(grid, at, at * ways.every);
      else { now.fill(0); countInto(now, at, at * ways.every); const smooth = smeared(now); for (let i = 0; i < grid.length; i++) if (smooth[i] > grid[i]) grid[i] = smooth[i]; }
    }
    if (kind === "mean") for (let i = 0; i < grid.length; i++) grid[i] /= taken;
    kept[kind] = grid;
  }
  return kind === "now" ? smeared(grid) : grid;
}
// Each square with its neighbours, a quarter of the weight in the middle.
function smeared(grid) {
  const out = new Float32Array(grid.length), w = cells.width;
  for (let y = 0; y < cells.height; y++) for (let x = 0; x < w; x++) {
    const value = grid[y * w + x];
    if (!value) continue;
    for (let dy = -1; dy <= 1; dy++) for (let dx = -1; dx <= 1; dx++) {
      const xx = x + dx, yy = y + dy;
      if (xx >= 0 && yy >= 0 && xx < w && yy < cells.height) out[yy * w + xx] += value * (dx ? 1 : 2) * (dy ? 1 : 2) / 16;
    }
  }
  return out;
}
function drawHeat(m) {
  const context = $("heat").getContext("2d");
  context.clearRect(0, 0, width, height);
  if (state.density === "off") return;
  const grid = densityGrid(state.density, m), small = new OffscreenCanvas(cells.width, cells.height);
  const pixels = new ImageData(cells.width, cells.height), area = cells.side * cells.side;
  for (let y = 0; y < cells.height; y++) for (let x = 0; x < cells.width; x++) {
    const value = Math.min(1, grid[y * cells.width + x] / area / 3);  // 3 per square metre is dark red
    const at = 4 * ((cells.height - 1 - y) * cells.width + x);
    pixels.data.set([250 - 40 * value, 200 - 170 * value, 120 - 95 * value, value > 0 ? 60 + 170 * value : 0], at);
  }
  small.getContext("2d").putImageData(pixels, 0, 0);
  context.imageSmoothingEnabled = true;
  context.drawImage(small, toX(data.minimum[0]), toY(data.minimum[1] + cells.height * cells.side), cells.width * cells.side * view.scale, cells.height * cells.side * view.scale);
}

// ---- people: drawn straight into the pixels, which is fast enough for tens of thousands
const wordOf = hex => { const n = parseInt(hex.slice(1), 16); return 0xff000000 | (n & 255) << 16 | (n >> 8 & 255) << 8 | n >> 16; };
const groupWords = data.colours.map(wordOf);
const speedWords = Array.from({length: 64}, (_, i) => {
  const s = i / 63, mix = (a, b) => Math.round(a + (b - a) * s);
  return (0xff000000 | mix(30, 60) << 16 | mix(40, 150) << 8 | mix(190, 20)) >>> 0;  // standing red, fast green
});
const masks = new Map();
function maskFor(radius) {  // coverage of a disc's pixels, 0 to 255
  const key = Math.round(radius * 4);
  if (masks.has(key)) return masks.get(key);
  const r = key / 4, side = Math.ceil(r), size = 2 * side + 1, cover = new Uint8Array(size * size);
  for (let y = -side; y <= side; y++) for (let x = -side; x <= side; x++)
    cover[(y + side) * size + x + side] = Math.round(255 * Math.min(1, Math.max(0, r + 0.5 - Math.hypot(x, y))));
  const mask = {side, size, cover};
  masks.set(key, mask);
  return mask;
}
function blend(at, word, cover) {
  const under = words[at], alpha = under >>> 24;
  if (cover > 250 || alpha === 0) { words[at] = (word & 0xffffff) | cover << 24; return; }
  const s = cover / 255, mix = shift => Math.round((word >>> shift & 255) * s + (under >>> shift & 255) * (1 - s));
  words[at] = (Math.max(alpha, cover) << 24 | mix(16) << 16 | mix(8) << 8 | mix(0)) >>> 0;
}
function stamp(cx, cy, mask, word) {
  const x0 = Math.round(cx) - mask.side, y0 = Math.round(cy) - mask.side;
  if (x0 + mask.size < 0 || y0 + mask.size < 0 || x0 >= width || y0 >= height) return;
  for (let y = 0, i = 0; y < mask.size; y++) for (let x = 0; x < mask.size; x++, i++) {
    const cover = mask.cover[i], px = x0 + x, py = y0 + y;
    if (cover && px >= 0 && py >= 0 && px < width && py < height) blend(py * width + px, word, cover);
  }
}
const place = {x: 0, y: 0};
function placeOf(row, m, share) {
  const a = m * 2 * count + 2 * row, b = ways.moments > 1 ? a + 2 * count : a;
  place.x = data.minimum[0] + ways.quantum * (moments[a] + share * (moments[b] - moments[a]));
  place.y = data.minimum[1] + ways.quantum * (moments[a + 1] + share * (moments[b + 1] - moments[a + 1]));
  return place;
}
function speedOf(row, m) {
  if (ways.moments < 2) return 0;
  const a = m * 2 * count + 2 * row, b = a + 2 * count;
  return ways.quantum * Math.hypot(moments[b] - moments[a], moments[b + 1] - moments[a + 1]) / (momentTime(m + 1) - momentTime(m));
}

function drawPeople({m, share}, frame) {
  words.fill(0);
  const scaleX = view.scale * ways.quantum, offsetX = toX(data.minimum[0]), offsetY = toY(data.minimum[1]);
  const wordFor = row => state.colour === "group" ? groupWords[agents.group[row]] : speedWords[Math.min(63, speedOf(row, m) / 2 * 63 | 0)];
  if (state.trails) {
    const back = Math.min(m, Math.ceil(3 / momentSeconds));  // three seconds
    for (let behind = back; behind >= 0; behind--) {
      const from = (m - behind) * 2 * count, alpha = 40 + Math.round(90 * (1 - behind / (back + 1))), then = (m - behind) * ways.every;
      for (let row = 0; row < count; row++) {
        if (frame < first[row] || frame > last[row] || then < first[row] || !isShown(row, m)) continue;
        // Dots between two moments, close enough to look like a line.
        const ax = offsetX + scaleX * moments[from + 2 * row], ay = offsetY - scaleX * moments[from + 2 * row + 1];
        if (ax < 0 || ay < 0 || ax >= width || ay >= height) continue;
        const next = from + (behind > 0 ? 2 * count : 0);
        const dx = scaleX * (moments[next + 2 * row] - moments[from + 2 * row]), dy = scaleX * (moments[next + 2 * row + 1] - moments[from + 2 * row + 1]);
        const dots = Math.min(16, Math.max(1, Math.abs(dx) + Math.abs(dy) | 0));
        for (let dot = 0; dot < dots; dot++) {
          const px = ax + dx * dot / dots | 0, py = ay - dy * dot / dots | 0;
          if (px >= 0 && py >= 0 && px < width && py < height) words[py * width + px] = (groupWords[agents.group[row]] & 0xffffff) | alpha << 24;
        }
      }
    }
  }
  for (let row = 0; row < count; row++) {
    if (frame < first[row] || frame > last[row] || !isShown(row, m)) continue;
    const {x, y} = placeOf(row, m, share);
    stamp(toX(x), toY(y), maskFor(Math.max(0.8 * pixel, radii[row] * view.scale)), wordFor(row));
  }
  $("people").getContext("2d").putImageData(image, 0, 0);
}

function drawMarks({m, share}, frame) {
  const context = $("marks").getContext("2d");
  context.clearRect(0, 0, width, height);
  for (const row of [state.chosen, state.partner]) {
    if (row === null || first[row] > frame) continue;
    const {x, y} = placeOf(row, m, share);
    context.beginPath();
    context.arc(toX(x), toY(y), Math.max(9 * pixel, radii[row] * view.scale + 4 * pixel), 0, 2 * Math.PI);
    context.lineWidth = 2.5 * pixel; context.strokeStyle = "#b3261e"; context.stroke();
    context.font = `${12 * pixel}px system-ui, sans-serif`; context.fillStyle = "#b3261e";
    context.fillText(`${row}`, toX(x) + 12 * pixel, toY(y) - 10 * pixel);
  }
  // A scale in the corner.
  const room = 140 * pixel / view.scale, power = 10 ** Math.floor(Math.log10(room)), metres = [5, 2, 1].find(m => m * power <= room) * power;
  context.strokeStyle = "#22242a"; context.fillStyle = "#22242a"; context.lineWidth = pixel;
  context.beginPath(); context.moveTo(14 * pixel, height - 14 * pixel); context.lineTo(14 * pixel + metres * view.scale, height - 14 * pixel); context.stroke();
  context.font = `${11 * pixel}px system-ui, sans-serif`;
  context.fillText(`${number(metres)} m`, 14 * pixel, height - 20 * pixel);
}

const timed = [];  // plots with a cursor
function draw() {
  if (!moments) return;
  const where = momentAt(state.time), frame = Math.round(state.time * data.fps);
  drawGround();
  drawHeat(where.m);
  drawPeople(where, frame);
  drawMarks(where, frame);
  let present = 0;
  for (let row = 0; row < count; row++) present += frame >= first[row] && frame <= last[row] ? 1 : 0;
  $("clock").textContent = `${state.time.toFixed(2)} s · frame ${frame + 1} · ${present.toLocaleString("en")} people`;
  $("scrub").value = state.time;
  for (const p of timed) p.cursor(state.time);
}

let asked = false;
function redraw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; draw(); });
}
function seek(time) { state.time = Math.min(duration, Math.max(0, time)); redraw(); }
let clock = 0;
function play(on = !state.playing) {
  state.playing = on && duration > 0;
  $("play").textContent = state.playing ? "Pause" : "Play";
  if (!state.playing) return;
  if (state.time >= duration) state.time = 0;
  clock = performance.now();
  const advance = now => {
    if (!state.playing) return;
    state.time += (now - clock) / 1000 * state.rate;
    clock = now;
    stage.dataset.drawn = Number(stage.dataset.drawn || 0) + 1;
    if (state.time >= duration) { state.time = duration; play(false); }
    draw();
    if (state.playing) requestAnimationFrame(advance);
  };
  requestAnimationFrame(advance);
}
function zoom(factor, x = width / 2, y = height / 2) {
  const worldX = (x - width / 2) / view.scale + view.x, worldY = view.y - (y - height / 2) / view.scale;
  view.scale = Math.min(400 * pixel, Math.max(0.05, view.scale * factor));
  view.x = worldX - (x - width / 2) / view.scale; view.y = worldY + (y - height / 2) / view.scale;
  redraw();
}
function choose(row, partner, frame) {
  play(false);
  state.chosen = row; state.partner = partner;
  seek(frame / data.fps);
  const {m, share} = momentAt(state.time), at = placeOf(row, m, share);
  if (!isShown(row, m)) { state.level = null; kept = {}; $("level").value = ""; }
  view.x = at.x; view.y = at.y; view.scale = Math.max(view.scale, 30 * pixel);
  stage.scrollIntoView({block: "nearest"});
}

stage.addEventListener("wheel", event => {
  event.preventDefault();
  const box = stage.getBoundingClientRect();
  zoom(Math.exp(-event.deltaY / 400), (event.clientX - box.left) * pixel, (event.clientY - box.top) * pixel);
}, {passive: false});
stage.addEventListener("pointerdown", event => { stage.setPointerCapture(event.pointerId); stage.dataset.drag = `${event.clientX},${event.clientY}`; });
stage.addEventListener("pointermove", event => {
  if (!stage.dataset.drag) return;
  const [x, y] = stage.dataset.drag.split(",").map(Number);
  view.x -= (event.clientX - x) * pixel / view.scale; view.y += (event.clientY - y) * pixel / view.scale;
  stage.dataset.drag = `${event.clientX},${event.clientY}`;
  redraw();
});
stage.addEventListener("pointerup", () => { delete stage.dataset.drag; });
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || (event.target.matches("select, input, button") && event.key !== "Escape")) return;
  const step = (event.shiftKey ? 1 : 1 / data.fps), keys = {
    " ": () => play(), ArrowRight: () => { play(false); seek(state.time + step); }, ArrowLeft: () => { play(false); seek(state.time - step); },
    Home: () => seek(0), End: () => seek(duration), "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), 0: () => { fit(); redraw(); },
    Escape: () => { state.chosen = state.partner = null; redraw(); }};
  if (keys[event.key]) { event.preventDefault(); keys[event.key](); }
});
$("play").addEventListener("click", () => play());
$("fit").addEventListener("click", () => { fit(); redraw(); });
$("scrub").max = duration;
$("scrub").addEventListener("input", event => { play(false); seek(Number(event.target.value)); });
$("rate").addEventListener("change", event => { state.rate = Number(event.target.value); });
$("colour").addEventListener("change", event => { state.colour = event.target.value; redraw(); });
$("density").addEventListener("change", event => { state.density = event.target.value; redraw(); });
$("floors").hidden = !levels.length;
$("level").append(...levels.map((level, i) => element("option", {value: i}, level.id)));
$("level").addEventListener("change", event => { state.level = event.target.value === "" ? null : Number(event.target.value); kept = {}; redraw(); });
$("trails").addEventListener("change", event => { state.trails = event.target.checked; redraw(); });

// ---- the rest of the page
const measured = data.measured;
$("title").textContent = data.name;
$("about").textContent = `${number(count)} people, ${duration.toFixed(1)} s at ${data.fps} frames/s, seed ${data.seed}${data.complete ? "" : " · INCOMPLETE"} · ${data.generator} on ${data.device.renderer || "?"}`;
$("legend").append(...data.groups.map((name, i) => element("span", {style: `--colour:${data.colours[i]}`}, name)));
$("error").textContent = `Positions here are rounded: ${(100 * ways.usual_error).toFixed(2)} cm off as a rule, ${(100 * ways.largest_error).toFixed(1)} cm at most; the streams hold them exactly.`;
const figure = (name, value, mark = "") => element("div", {}, element("dt", {}, name), element("dd", {class: mark}, value));
const spread = s => s ? number(s.p99) : "–";
$("figures").append(
  figure("time ratio", number(measured.time_ratio)), figure("way ratio", number(measured.detour_ratio)),
  figure("mean speed, m/s", number(measured.mean_speed)), figure("density p99, /m²", number(measured.high_density)),
  figure("lane order", number(measured.lane_order)), figure("effort, J/kg/m", number(measured.effort)),
  figure("turning p99, °/s", spread(measured.heading_rate)), figure("acceleration p99, m/s²", spread(measured.acceleration)),
  figure("backward, %", number(measured.backward_percent)),
  figure("deepest overlap, %", number(measured.deepest_overlap_percent), measured.deepest_overlap_percent > 2 ? "bad" : ""),
  figure("wall crossings", number(measured.wall_crossings), measured.wall_crossings ? "bad" : ""));
if (data.missed.length) $("missed").append(element("h2", {class: "bad", style: "margin-top:10px"}, "Bars missed"), element("ul", {}, ...data.missed.map(bar => element("li", {}, bar))));
$("account").append(figure("people", number(measured.agents)), figure("arrived", number(measured.arrived), measured.arrived === measured.agents ? "good" : ""),
  figure("still walking", number(measured.walking)), figure("stuck", number(data.stuck.length), data.stuck.length ? "bad" : ""),
  figure("refused", number(measured.refused), measured.refused ? "bad" : ""), figure("overlapping pairs", number(data.overlap_pairs)));

const series = data.series, over = key => series.time.map((t, i) => [t, series[key][i]]);
// Arrivals in every five seconds (or a twentieth of the bake, if it is shorter).
const span = Math.min(5, duration / 20), arrivedBy = time => measured.arrivals.reduce((n, p) => p[0] <= time ? p[1] : n, 0);
const flow = measured.arrived && span > 0 ? Array.from({length: Math.floor(duration / span)}, (_, i) => [(i + 0.5) * span, (arrivedBy((i + 1) * span) - arrivedBy(i * span)) / span]) : [];
function addPlot(options, withTime) {
  const made = plot({...options, onPick: withTime ? time => { play(false); seek(time); } : null});
  if (withTime) timed.push(made);
  $("plots").append(element("div", {}, made.svg));
}
addPlot({title: "People in the scene", yLabel: "", xLabel: "s", series: [{points: over("present"), colour: "#1f5fa8"}]}, true);
addPlot({title: "Mean speed", yLabel: "m/s", xLabel: "s", series: [{points: over("speed"), colour: "#0c8a72"}]}, true);
addPlot({title: "Arrivals", yLabel: "persons", xLabel: "s", series: [{points: measured.arrivals, colour: "#7b3fa0"}]}, true);
if (flow.length) addPlot({title: "Flow at the goals", yLabel: "persons/s", xLabel: "s", series: [{points: flow, colour: "#a8326e"}]}, true);
if (measured.speed_by_density.length) addPlot({title: "Speed by density", yLabel: "m/s", xLabel: "persons/m²", series: [{points: measured.speed_by_density, colour: "#44506b"}]}, false);
const at = frame => `${(frame / data.fps).toFixed(1)} s`;
function list(title, items, make) {
  if (items.length) $("moments").append(element("div", {}, element("h2", {}, title), element("ul", {class: "chips"}, ...items.map(item => element("li", {}, make(item))))));
}
list("Stuck, since", data.stuck, s => element("button", {onclick: () => choose(s.agent, null, s.frame)}, `${s.agent} · ${at(s.frame)}`));
list("Overlaps, deepest first", data.overlaps, o => element("button", {onclick: () => choose(o.a, o.b, o.frame)}, `${o.a} and ${o.b} · ${o.percent} % · ${at(o.frame)}`));
list("Refused", Object.entries(data.refused), ([reason, people]) => element("span", {}, `${people}: ${reason}`));

new ResizeObserver(() => { resize(); fit(); redraw(); }).observe(stage);
window.addEventListener("beforeprint", draw);
resize(); fit();
unpack().then(() => { document.body.dataset.ready = "yes"; draw(); });
