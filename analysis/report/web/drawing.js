// The crowd as it looks from above. People are drawn straight into the pixels, which is fast enough for tens of
// thousands; `crowd`, `state` and `view` are the player's.
function wordOf(hex) { const n = parseInt(hex.slice(1), 16); return 0xff000000 | (n & 255) << 16 | (n >> 8 & 255) << 8 | n >> 16; }
const speedWords = Array.from({length: 64}, (_, i) => {
  const s = i / 63, mix = (a, b) => Math.round(a + (b - a) * s);
  return (0xff000000 | mix(30, 60) << 16 | mix(40, 150) << 8 | mix(190, 20)) >>> 0;  // standing red, fast green
});
const vehicleColours = {bus: "#8a5a2b", tram: "#7d2f3a", bicycle: "#3f6f6b"};

const view = {x: 0, y: 0, scale: 1};  // the world's point in the middle, px per metre
const stage = $("stage"), canvases = ["ground", "heat", "traffic", "people", "marks"].map($);
let width = 1, height = 1, pixel = 1, image = null, words = null;
const toX = x => (x - view.x) * view.scale + width / 2, toY = y => height / 2 - (y - view.y) * view.scale;

function resize() {
  const box = stage.getBoundingClientRect();
  pixel = Math.min(2, window.devicePixelRatio || 1);
  width = Math.max(1, Math.round(box.width * pixel)); height = Math.max(1, Math.round(box.height * pixel));
  for (const canvas of canvases) { canvas.width = width; canvas.height = height; }
  image = $("people").getContext("2d").createImageData(width, height);
  words = new Uint32Array(image.data.buffer);
}
function cleared(name) {
  const context = $(name).getContext("2d");
  context.clearRect(0, 0, width, height);
  return context;
}

function trace(context, points, closed) {
  context.beginPath();
  for (let i = 0; i < points.length; i += 2) context[i ? "lineTo" : "moveTo"](toX(points[i]), toY(points[i + 1]));
  if (closed) context.closePath();
}

function drawGround() {
  const context = cleared("ground"), geometry = crowd.geometry, onLevel = thing => crowd.isOnLevel(thing, state.level);
  context.lineJoin = "round";
  for (const [i, level] of crowd.levels.entries()) {
    if (state.level !== null && state.level !== i) continue;
    trace(context, level.points, true); context.fillStyle = "rgba(228,226,217,.45)"; context.fill();
  }
  for (const road of geometry.roads.filter(onLevel)) {
    trace(context, road.points, false);
    context.lineWidth = road.width * view.scale; context.strokeStyle = "#e4e2d9"; context.stroke();
  }
  for (const lane of geometry.lanes || []) {
    trace(context, lane.points, false);
    context.lineWidth = lane.width * view.scale; context.strokeStyle = "#cfcdc8"; context.stroke();
  }
  for (const crossing of geometry.crossings || []) drawZebra(context, crossing.points);
  for (const area of geometry.areas.filter(onLevel)) { trace(context, area.points, true); context.fillStyle = "rgba(31,95,168,.07)"; context.fill(); }
  for (const wall of geometry.walls.filter(onLevel)) {
    const toggled = wall.toggles.filter(at => at <= state.time).length % 2 === 1;
    if (wall.open !== toggled) continue;
    trace(context, wall.points, wall.closed);
    if (wall.closed) { context.fillStyle = "#c9c6bc"; context.fill(); }
    context.lineWidth = wall.closed ? Math.max(1, pixel) : Math.max(pixel, wall.width * view.scale);
    context.strokeStyle = "#55544f"; context.stroke();
  }
}

// Stripes along the lane that is nearest to its middle.
function drawZebra(context, points) {
  const corners = Array.from({length: points.length / 2}, (_, i) => [points[2 * i], points[2 * i + 1]]);
  const middle = [0, 1].map(i => corners.reduce((sum, corner) => sum + corner[i], 0) / corners.length);
  let along = [1, 0], least = Infinity;
  for (const lane of crowd.geometry.lanes || []) for (let i = 0; i + 3 < lane.points.length; i += 2) {
    const [x, y] = lane.points.slice(i, i + 2), dx = lane.points[i + 2] - x, dy = lane.points[i + 3] - y, length = Math.hypot(dx, dy) || 1;
    const at = Math.min(1, Math.max(0, ((middle[0] - x) * dx + (middle[1] - y) * dy) / length ** 2));
    const far = Math.hypot(x + at * dx - middle[0], y + at * dy - middle[1]);
    if (far < least) { least = far; along = [dx / length, dy / length]; }
  }
  const reach = Math.max(...corners.map(([x, y]) => Math.hypot(x - middle[0], y - middle[1])));
  context.save();
  trace(context, points, true);
  context.clip();
  context.lineWidth = 0.5 * view.scale; context.strokeStyle = "#fbfaf7";
  for (let aside = -Math.ceil(reach); aside <= reach; aside++) {
    const x = middle[0] - along[1] * aside, y = middle[1] + along[0] * aside;
    trace(context, [x - along[0] * reach, y - along[1] * reach, x + along[0] * reach, y + along[1] * reach], false);
    context.stroke();
  }
  context.restore();
}

// ---- density: people in squares of a metre, smeared over the neighbours
function countInto(grid, m, frame) {
  const {cells, first, last, moments, count} = crowd, from = m * 2 * count, toCell = crowd.quantum / cells.side;
  for (let row = 0; row < count; row++) {
    if (frame < first[row] || frame > last[row] || !crowd.isShown(row, m, state.level)) continue;
    const x = Math.min(cells.width - 1, moments[from + 2 * row] * toCell | 0), y = Math.min(cells.height - 1, moments[from + 2 * row + 1] * toCell | 0);
    grid[y * cells.width + x]++;
  }
}
function densityGrid(kind, m) {
  const kept = crowd.densities[kind];
  if (kept && kept.taken === crowd.taken) return kept.grid;
  const grid = new Float32Array(crowd.cells.width * crowd.cells.height);
  if (kind === "now") { countInto(grid, m, m * crowd.every); return smeared(grid); }
  const step = Math.max(1, Math.floor(crowd.taken / 400)), now = new Float32Array(grid.length);
  let looked = 0;
  for (let at = 0; at < crowd.taken; at += step, looked++) {
    if (kind === "mean") countInto(grid, at, at * crowd.every);
    else { now.fill(0); countInto(now, at, at * crowd.every); const smooth = smeared(now); for (let i = 0; i < grid.length; i++) if (smooth[i] > grid[i]) grid[i] = smooth[i]; }
  }
  if (kind === "mean") for (let i = 0; i < grid.length; i++) grid[i] /= looked;
  crowd.densities[kind] = {grid, taken: crowd.taken};
  return grid;
}
// Each square with its neighbours, a quarter of the weight in the middle.
function smeared(grid) {
  const {width: w, height: h} = crowd.cells, out = new Float32Array(grid.length);
  for (let y = 0; y < h; y++) for (let x = 0; x < w; x++) {
    const value = grid[y * w + x];
    if (!value) continue;
    for (let dy = -1; dy <= 1; dy++) for (let dx = -1; dx <= 1; dx++) {
      const xx = x + dx, yy = y + dy;
      if (xx >= 0 && yy >= 0 && xx < w && yy < h) out[yy * w + xx] += value * (dx ? 1 : 2) * (dy ? 1 : 2) / 16;
    }
  }
  return out;
}
function drawHeat(m) {
  const context = cleared("heat"), {cells, minimum} = crowd;
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
  context.drawImage(small, toX(minimum[0]), toY(minimum[1] + cells.height * cells.side), cells.width * cells.side * view.scale, cells.height * cells.side * view.scale);
}

function drawTraffic({m, share}) {
  const context = cleared("traffic");
  for (const [i, vehicle] of crowd.vehicles.entries()) {
    const at = crowd.vehicleAt(i, m, share);
    if (!at) continue;
    context.save();
    context.translate(toX(at.x), toY(at.y)); context.rotate(-at.heading); context.scale(view.scale, view.scale);
    context.fillStyle = vehicleColours[vehicle.kind] || "#4b5563";
    context.fillRect(-vehicle.length / 2, -vehicle.width / 2, vehicle.length, vehicle.width);
    context.fillStyle = "#dfe8ee";  // the windscreen says which end is the front
    context.fillRect(vehicle.length * 0.22, -vehicle.width * 0.38, vehicle.length * 0.1, vehicle.width * 0.76);
    context.restore();
  }
}

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

function drawTrails(m, frame) {
  const {count, first, last, moments, every} = crowd, seconds = 3;
  const scale = view.scale * crowd.quantum, offsetX = toX(crowd.minimum[0]), offsetY = toY(crowd.minimum[1]);
  const back = Math.min(m, Math.ceil(seconds / crowd.momentSeconds));
  for (let behind = back; behind >= 0; behind--) {
    const from = (m - behind) * 2 * count, alpha = 40 + Math.round(90 * (1 - behind / (back + 1))), then = (m - behind) * every;
    for (let row = 0; row < count; row++) {
      if (frame < first[row] || frame > last[row] || then < first[row] || !crowd.isShown(row, m, state.level)) continue;
      // Dots between two moments, close enough to look like a line.
      const ax = offsetX + scale * moments[from + 2 * row], ay = offsetY - scale * moments[from + 2 * row + 1];
      if (ax < 0 || ay < 0 || ax >= width || ay >= height) continue;
      const next = from + (behind > 0 ? 2 * count : 0);
      const dx = scale * (moments[next + 2 * row] - moments[from + 2 * row]), dy = scale * (moments[next + 2 * row + 1] - moments[from + 2 * row + 1]);
      const dots = Math.min(16, Math.max(1, Math.abs(dx) + Math.abs(dy) | 0));
      for (let dot = 0; dot < dots; dot++) {
        const px = ax + dx * dot / dots | 0, py = ay - dy * dot / dots | 0;
        if (px >= 0 && py >= 0 && px < width && py < height) words[py * width + px] = (crowd.words[crowd.group[row]] & 0xffffff) | alpha << 24;
      }
    }
  }
}
function drawPeople({m, share}, frame) {
  const {count, first, last, moments, quantum, minimum} = crowd;
  words.fill(0);
  const wordFor = row => state.colour === "group" ? crowd.words[crowd.group[row]] : speedWords[Math.min(63, crowd.speedOf(row, m) / 2 * 63 | 0)];
  if (state.trails) drawTrails(m, frame);
  const from = m * 2 * count, to = from + (crowd.taken > 1 ? 2 * count : 0);
  for (let row = 0; row < count; row++) {
    if (frame < first[row] || frame > last[row] || !crowd.isShown(row, m, state.level)) continue;
    const a = from + 2 * row, b = to + 2 * row;
    const x = minimum[0] + quantum * (moments[a] + share * (moments[b] - moments[a]));
    const y = minimum[1] + quantum * (moments[a + 1] + share * (moments[b + 1] - moments[a + 1]));
    stamp(toX(x), toY(y), maskFor(Math.max(0.8 * pixel, crowd.radiusOf(row, m) * view.scale)), wordFor(row));
  }
  $("people").getContext("2d").putImageData(image, 0, 0);
}

function drawMarks({m, share}, frame) {
  const context = cleared("marks");
  for (const row of [state.chosen, state.partner]) {
    if (row === null || crowd.first[row] > frame) continue;
    const {x, y} = crowd.placeOf(row, m, share);
    context.beginPath();
    context.arc(toX(x), toY(y), Math.max(9 * pixel, crowd.radiusOf(row, m) * view.scale + 4 * pixel), 0, 2 * Math.PI);
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
