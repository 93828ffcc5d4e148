// The page of `throng watch`: what comes over /crowd, as it comes.
const kinds = {CROW: begin, MOMT: addMoment, TELL: tell, NONE: () => {}};
const textOf = bytes => new TextDecoder().decode(bytes);

function begin(bytes) {
  const first = crowd === null, made = new Crowd(JSON.parse(textOf(bytes)));
  if (made.levels.length) made.storeys = new Uint8Array(0);
  made.growing = true;
  const before = {chosen: state.chosen, following: state.following, count: crowd && crowd.count};
  showCrowd(made, !first);
  if (before.count === made.count) { state.chosen = before.chosen; state.following = before.following; }
  // Whoever has stopped at a moment sees the same one again, once it has come.
  if ((state.playing || first) && !made.continues) state.time = 0;
  if (first) play(true);
  $("title").textContent = made.name;
  document.title = `${made.name} – Throng`;
  $("about").textContent = `${number(made.count)} people, ${made.length.toFixed(1)} s at ${made.fps} frames/s, seed ${made.seed}`;
  document.body.dataset.crowds = Number(document.body.dataset.crowds || 0) + 1;
}

function withRoom(list, needed) {
  if (needed <= list.length) return list;
  const larger = new list.constructor(Math.max(needed, 2 * list.length));
  larger.set(list);
  return larger;
}

function addMoment(bytes) {
  const {count} = crowd, m = crowd.taken, view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const frame = view.getUint32(0, true), there = 4 + 4 * count, vehicles = there + count;
  crowd.moments = withRoom(crowd.moments, 2 * count * (m + 1));
  for (let i = 0; i < 2 * count; i++) crowd.moments[2 * count * m + i] = view.getUint16(4 + 2 * i, true);
  if (crowd.storeys) crowd.storeys = withRoom(crowd.storeys, count * (m + 1));
  for (let row = 0; row < count; row++) {
    const storey = bytes[there + row];
    if (crowd.storeys) crowd.storeys[count * m + row] = storey - 1;
    if (!storey) continue;
    if (crowd.first[row] > frame) crowd.first[row] = frame;
    crowd.last[row] = frame;
  }
  const numbers = 4 * crowd.vehicles.length;
  crowd.tracks = withRoom(crowd.tracks, numbers * (m + 1));
  for (let i = 0; i < numbers; i++) crowd.tracks[numbers * m + i] = view.getUint16(vehicles + 2 * i, true);
  crowd.taken = m + 1;
  if (m < 2 || !state.playing) crowdGrew();
  document.body.dataset.ready = "yes";
}

const states = {
  "reading": () => "Reading …",
  "read": () => "Setting up …",
  "warming up": told => `Warming up, ${Math.round(100 * told.warmup)} %`,
  "simulating": told => `Simulating: ${(told.frame / crowd.fps).toFixed(1)} of ${crowd.length.toFixed(1)} s`,
  "complete": () => "Simulated to its end",
  "full": () => `As much as there is room for (${data.megabytes} MiB; --memory gives more)`,
  "mistaken": () => "The layout has mistakes; below is the crowd before them",
  "baking": told => `Being baked: frame ${told.frame} of ${told.frames}` + (told.silent_seconds > 5 ? `, nothing new for ${Math.round(told.silent_seconds)} s` : ""),
  "baked": () => "A complete bake",
  "partial": told => `A bake that was stopped after frame ${told.frame}`,
  "gone": () => "The bake was stopped and is gone; this is as far as it had come",
};
const moving = new Set(["reading", "read", "warming up", "simulating", "baking"]);

function tell(bytes) {
  const told = JSON.parse(textOf(bytes));
  document.body.dataset.state = told.state;
  document.body.classList.toggle("stale", told.state === "mistaken" && crowd !== null);
  $("state").textContent = !crowd && told.state === "mistaken" ? "The layout has mistakes" : states[told.state](told);
  if (crowd) crowd.growing = moving.has(told.state) || (told.state === "mistaken" && crowd.taken === 0);
  $("progress").value = told.state === "warming up" ? told.warmup : told.frames ? told.frame / told.frames : told.state === "complete" ? 1 : 0;
  $("progress").hidden = told.state === "mistaken" || told.state === "gone";
  const steps = told.steps_per_second, live = steps / (told.steps_per_frame * (crowd ? crowd.fps : 24));
  $("speed").textContent = steps ? `${number(steps)} steps/s, ${number(live, 2)} times as fast as it plays` : "";
  if (told.texts) showMistakes(told);
}

// As the terminal has them: file, line, column, what was expected, the line itself, and a hint.
function showMistakes(told) {
  const wrong = told.diagnostics.filter(each => each.severity === "error").length;
  const shown = $("mistakes").dataset.shown, text = JSON.stringify(told.texts);
  if (shown === text) return;
  $("mistakes").dataset.shown = text;
  $("mistakes").hidden = !told.texts.length;
  $("mistakes").className = wrong || told.state === "mistaken" ? "" : "warnings";
  $("mistakes").replaceChildren(...told.texts.map(text => element("pre", {}, text)));
}

// Takes messages apart, wherever the pieces that come begin and end.
async function listen() {
  const reader = (await fetch("crowd")).body.getReader();
  let rest = new Uint8Array(0);
  for (;;) {
    const {done, value} = await reader.read();
    if (done) return;
    const bytes = new Uint8Array(rest.length + value.length);
    bytes.set(rest); bytes.set(value, rest.length);
    let at = 0;
    while (at + 8 <= bytes.length) {
      const length = new DataView(bytes.buffer).getUint32(at + 4, true);
      if (at + 8 + length > bytes.length) break;
      kinds[textOf(bytes.subarray(at, at + 4))](bytes.subarray(at + 8, at + 8 + length));
      at += 8 + length;
    }
    rest = bytes.slice(at);
  }
}

async function stayConnected() {
  for (;;) {
    try { await listen(); } catch (problem) { if (!(problem instanceof TypeError)) console.error(problem); }
    document.body.dataset.state = "ended";
    $("state").textContent = "throng has ended; this page goes on when it is started again at the same --port";
    if (crowd) crowd.growing = false;
    await new Promise(resolve => setTimeout(resolve, 1000));
  }
}

$("title").textContent = data.file;
$("settings").textContent = (data.is_bake ? "" : "Simulated with the layout's own steps, as a bake would be, but nothing is written: no streams of feet, gaze or poses, no glTF, no diagrams. ") +
  `Places are kept ${number(data.per_second)} times a second, rounded to 1/65,535 of the longer side, and played in straight lines in between. A click follows somebody, Esc lets go.`;
stayConnected();
