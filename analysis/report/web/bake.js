// The page of a bake: its crowd, and what was measured of it.
const agents = data.agents, count = agents.group.length, ways = data.ways;
const duration = Math.max(0, (data.frames - 1) / data.fps);

async function inflated(packed) {
  const text = atob(packed), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function unpacked() {
  const made = new Crowd({...data, every: ways.every, quantum: ways.quantum, group: agents.group, radii: agents.radius});
  agents.first.forEach((frame, row) => { if (frame !== null) { made.first[row] = frame; made.last[row] = agents.last[row]; } });
  if (ways.storeys) made.storeys = await inflated(ways.storeys);
  if (ways.sizes) made.sizes = await inflated(ways.sizes);
  const raw = await inflated(ways.deflated), numbers = 2 * count, moments = new Uint16Array(numbers * ways.moments);
  for (let m = 0; m < ways.moments; m++) {
    const here = m * numbers, from = 2 * here;
    for (let i = 0; i < numbers; i++) {
      const folded = raw[from + i] | raw[from + numbers + i] << 8;
      const left = (folded >>> 1) ^ -(folded & 1);
      const last = m > 0 ? moments[here - numbers + i] : 0, before = m > 1 ? moments[here - 2 * numbers + i] : 0;
      moments[here + i] = 2 * last - before + left;
    }
  }
  made.moments = moments;
  made.taken = ways.moments;
  delete ways.deflated;
  delete ways.storeys;
  delete ways.sizes;
  return made;
}

const measured = data.measured;
$("title").textContent = data.name;
$("about").textContent = `${number(count)} people, ${duration.toFixed(1)} s at ${data.fps} frames/s, seed ${data.seed}${data.complete ? "" : " · INCOMPLETE"} · ${data.generator} on ${data.device.renderer || "?"}`;
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

unpacked().then(made => { showCrowd(made); document.body.dataset.ready = "yes"; draw(); });
