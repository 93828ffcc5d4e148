// Plays a crowd: time, view, and who is looked at. A page gives it one by showCrowd(), and tells by crowdGrew() when
// there is more of it.
let crowd = null;
const state = {time: 0, playing: false, rate: 1, colour: "group", density: "off", trails: true, chosen: null, partner: null,
               following: false, level: null};
const timed = [];  // plots with a cursor

function fit() {
  const [x0, y0] = crowd.minimum, [x1, y1] = crowd.maximum;
  view.x = (x0 + x1) / 2; view.y = (y0 + y1) / 2;
  view.scale = 0.96 * Math.min(width / Math.max(1, x1 - x0), height / Math.max(1, y1 - y0));
}

function showCrowd(next, keepView = false) {
  crowd = next;
  state.chosen = state.partner = null;
  state.following = false;
  if (state.level !== null && state.level >= crowd.levels.length) state.level = null;
  $("floors").hidden = !crowd.levels.length;
  $("level").replaceChildren(element("option", {value: ""}, "all"), ...crowd.levels.map((level, i) => element("option", {value: i}, level.id)));
  $("level").value = state.level === null ? "" : state.level;
  $("legend").replaceChildren(...crowd.groups.map((name, i) => element("span", {style: `--colour:${crowd.colours[i]}`}, name)));
  if (!keepView) fit();
  crowdGrew();
}
function crowdGrew() {
  $("scrub").max = crowd.length;
  redraw();
}

function draw() {
  if (!crowd || !crowd.taken) return;
  const where = crowd.momentAt(state.time), frame = Math.round(Math.min(state.time, crowd.end) * crowd.fps);
  if (state.following && crowd.isThere(state.chosen, frame)) Object.assign(view, crowd.placeOf(state.chosen, where.m, where.share));
  drawGround();
  drawHeat(where.m);
  drawTraffic(where);
  drawPeople(where, frame);
  drawMarks(where, frame);
  let present = 0;
  for (let row = 0; row < crowd.count; row++) present += crowd.isThere(row, frame) ? 1 : 0;
  $("clock").textContent = `${Math.min(state.time, crowd.end).toFixed(2)} s · frame ${frame + 1} · ${present.toLocaleString("en")} people`;
  $("scrub").value = state.time;
  for (const p of timed) p.cursor(state.time);
}

let asked = false;
function redraw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; draw(); });
}
function seek(time) { state.time = Math.min(crowd.length, Math.max(0, time)); redraw(); }
let clock = 0;
function play(on = !state.playing) {
  if (!crowd) return;
  const begins = on && !state.playing;
  state.playing = on && (crowd.growing || crowd.end > 0);
  $("play").textContent = state.playing ? "Pause" : "Play";
  if (!begins || !state.playing) return;
  if (!crowd.growing && state.time >= crowd.end) state.time = 0;
  clock = performance.now();
  requestAnimationFrame(advance);
}
function advance(now) {
  if (!state.playing) return;
  // Of a crowd that is still growing, the end is where one waits.
  state.time = Math.min(crowd.end, Math.max(0, state.time + (now - clock) / 1000 * state.rate));
  clock = now;
  stage.dataset.drawn = Number(stage.dataset.drawn || 0) + 1;
  if (state.time >= crowd.end && !crowd.growing) play(false);
  draw();
  if (state.playing) requestAnimationFrame(advance);
}
function zoom(factor, x = width / 2, y = height / 2) {
  const worldX = (x - width / 2) / view.scale + view.x, worldY = view.y - (y - height / 2) / view.scale;
  view.scale = Math.min(400 * pixel, Math.max(0.05, view.scale * factor));
  view.x = worldX - (x - width / 2) / view.scale; view.y = worldY + (y - height / 2) / view.scale;
  redraw();
}
function choose(row, partner, frame) {
  play(false);
  state.chosen = row; state.partner = partner; state.following = false;
  seek(frame / crowd.fps);
  const {m, share} = crowd.momentAt(state.time), at = crowd.placeOf(row, m, share);
  if (!crowd.isShown(row, m, state.level)) { state.level = null; crowd.densities = {}; $("level").value = ""; }
  view.x = at.x; view.y = at.y; view.scale = Math.max(view.scale, 30 * pixel);
  stage.scrollIntoView({block: "nearest"});
}
// Whoever is under the pointer is followed from here on; where nobody is, whoever was is let go.
function follow(x, y) {
  if (!crowd || !crowd.taken) return;
  const {m, share} = crowd.momentAt(state.time), frame = Math.round(Math.min(state.time, crowd.end) * crowd.fps);
  let nearest = null, least = Infinity;
  for (let row = 0; row < crowd.count; row++) {
    if (!crowd.isThere(row, frame) || !crowd.isShown(row, m, state.level)) continue;
    const at = crowd.placeOf(row, m, share), far = Math.hypot(toX(at.x) - x, toY(at.y) - y);
    if (far < least && far < Math.max(10 * pixel, crowd.radiusOf(row, m) * view.scale)) { nearest = row; least = far; }
  }
  state.chosen = nearest; state.partner = null; state.following = nearest !== null;
  redraw();
}

stage.addEventListener("wheel", event => {
  event.preventDefault();
  const box = stage.getBoundingClientRect();
  zoom(Math.exp(-event.deltaY / 400), (event.clientX - box.left) * pixel, (event.clientY - box.top) * pixel);
}, {passive: false});
let drag = null;  // where the pointer was last, and how far it has gone since it was pressed
stage.addEventListener("pointerdown", event => { stage.setPointerCapture(event.pointerId); drag = {x: event.clientX, y: event.clientY, way: 0}; });
stage.addEventListener("pointermove", event => {
  if (!drag) return;
  const x = event.clientX - drag.x, y = event.clientY - drag.y, way = drag.way + Math.hypot(x, y);
  view.x -= x * pixel / view.scale; view.y += y * pixel / view.scale;
  drag = {x: event.clientX, y: event.clientY, way};
  if (way > 4) state.following = false;
  redraw();
});
stage.addEventListener("pointerup", event => {
  const box = stage.getBoundingClientRect();
  if (drag && drag.way <= 4) follow((event.clientX - box.left) * pixel, (event.clientY - box.top) * pixel);
  drag = null;
});
document.addEventListener("keydown", event => {
  if (!crowd || event.ctrlKey || event.metaKey || event.altKey || (event.target.matches("select, input, button") && event.key !== "Escape")) return;
  const step = (event.shiftKey ? 1 : 1 / crowd.fps), keys = {
    " ": () => play(), ArrowRight: () => { play(false); seek(state.time + step); }, ArrowLeft: () => { play(false); seek(state.time - step); },
    Home: () => seek(0), End: () => seek(crowd.end), "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), 0: () => { fit(); redraw(); },
    Escape: () => { state.chosen = state.partner = null; state.following = false; redraw(); }};
  if (keys[event.key]) { event.preventDefault(); keys[event.key](); }
});
$("play").addEventListener("click", () => play());
$("fit").addEventListener("click", () => { if (crowd) { fit(); redraw(); } });
$("scrub").addEventListener("input", event => { if (crowd) { play(false); seek(Number(event.target.value)); } });
$("rate").addEventListener("change", event => { state.rate = Number(event.target.value); });
$("colour").addEventListener("change", event => { state.colour = event.target.value; redraw(); });
$("density").addEventListener("change", event => { state.density = event.target.value; redraw(); });
$("level").addEventListener("change", event => { state.level = event.target.value === "" ? null : Number(event.target.value); crowd.densities = {}; redraw(); });
$("trails").addEventListener("change", event => { state.trails = event.target.checked; redraw(); });
new ResizeObserver(() => { resize(); if (crowd) fit(); redraw(); }).observe(stage);
window.addEventListener("beforeprint", draw);
resize();
