const columns = data.columns, parameters = data.parameters;
const rows = data.rows.map(values => Object.fromEntries(columns.map((name, i) => [name, values[i]])));
const missedOf = row => { try { return JSON.parse(row.missed || "[]"); } catch { return []; } };
for (const row of rows) row.missed_bars = row.status === "ok" ? missedOf(row).length : null;
// Failures first, then what misses its bars.
const rank = row => row.status === "failed" ? 0 : row.status === "missing" ? 1 : row.missed_bars ? 2 : 3;
const usual = ["number", "status", ...parameters, "missed_bars", "agents", "arrived", "stuck", "refused", "deepest_overlap_percent", "mean_speed", "high_density", "lane_order", "total_seconds"];
const every = ["number", "status", "missed_bars", ...columns.filter(name => !["number", "status"].includes(name))];
const numeric = [...parameters, ...columns].filter((name, i, all) => all.indexOf(name) === i && rows.some(row => typeof row[name] === "number"));
const state = {sort: "attention", down: false, filter: () => true, chosen: null};

// ---- filter: `column op value` joined by `and`, or a word anywhere
function filterFor(text) {
  text = text.trim();
  if (!text) return () => true;
  if (!/[<>=]/.test(text)) return row => Object.values(row).some(value => String(value).toLowerCase().includes(text.toLowerCase()));
  const tests = text.split(/\s+and\s+/i).map(part => {
    const match = part.match(/^(.+?)\s*(<=|>=|!=|<|>|=)\s*(.+)$/);
    if (!match) throw new Error(`“${part}” is no comparison: write for example stuck > 0`);
    const [, name, sign, wanted] = match;
    if (!(name in rows[0])) throw new Error(`there is no column “${name}”`);
    const value = wanted.replace(/^["'](.*)["']$/, "$1");
    return row => {
      const here = row[name], asNumber = typeof here === "number" && !Number.isNaN(Number(value));
      if (here === null || here === undefined) return sign === "!=";
      const a = asNumber ? here : String(here), b = asNumber ? Number(value) : value;
      return {"<": a < b, ">": a > b, "<=": a <= b, ">=": a >= b, "=": a === b, "!=": a !== b}[sign];
    };
  });
  return row => tests.every(test => test(row));
}

// ---- thumbnails
const palette = data.colours;
function drawThumbnail(canvas, thumbnail) {
  const pixel = Math.min(2, window.devicePixelRatio || 1), box = [canvas.clientWidth || 96, canvas.clientHeight || 72];
  canvas.width = box[0] * pixel; canvas.height = box[1] * pixel;
  const context = canvas.getContext("2d");
  if (!thumbnail) { context.fillStyle = "#b3261e"; context.font = `${11 * pixel}px system-ui, sans-serif`; context.fillText("no picture", 8 * pixel, canvas.height / 2); return; }
  const scale = Math.min(canvas.width / thumbnail.size[0], canvas.height / thumbnail.size[1]);
  const left = (canvas.width - thumbnail.size[0] * scale) / 2, top = (canvas.height + thumbnail.size[1] * scale) / 2;
  const trace = (points, from) => {
    context.beginPath();
    for (let i = from; i < points.length; i += 2) context[i > from ? "lineTo" : "moveTo"](left + points[i] * scale, top - points[i + 1] * scale);
  };
  for (const wall of thumbnail.walls) {
    trace(wall, 1);
    if (wall[0]) { context.closePath(); context.fillStyle = "#c9c6bc"; context.fill(); }
    context.lineWidth = pixel; context.strokeStyle = "#55544f"; context.stroke();
  }
  context.globalAlpha = 0.7;
  for (const way of thumbnail.ways) { trace(way, 1); context.lineWidth = 1.1 * pixel; context.strokeStyle = palette[way[0] % palette.length]; context.stroke(); }
  context.globalAlpha = 1;
}
const watcher = new IntersectionObserver(entries => {
  for (const entry of entries) if (entry.isIntersecting) { watcher.unobserve(entry.target); drawThumbnail(entry.target, data.thumbnails[entry.target.dataset.id]); }
}, {rootMargin: "300px"});

// ---- table
function sorted() {
  const by = state.sort, sign = state.down ? -1 : 1;
  return rows.filter(state.filter).sort((a, b) => {
    if (by === "attention") return rank(a) - rank(b) || a.number - b.number;
    const x = a[by], y = b[by];
    if (x === null || y === null) return (x === null) - (y === null) || a.number - b.number;
    return sign * (typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y))) || a.number - b.number;
  });
}
function cellOf(row, name) {
  if (name === "status") return element("td", {class: row.status === "ok" ? "good" : "bad"}, row.status);
  if (name === "reason" || name === "missed") return element("td", {class: "wide"}, row[name] || "");
  return element("td", {class: name === "missed_bars" && row[name] ? "bad" : ""}, number(row[name], 4));
}
function drawTable() {
  const names = $("columns").value === "all" ? every : rows.some(row => row.status === "failed") ? [...usual.slice(0, 2), "reason", ...usual.slice(2)] : usual;
  const head = element("tr", {}, element("th", {}, "picture"), ...names.map(name => element("th", {"aria-sort": state.sort === name ? (state.down ? "descending" : "ascending") : "none"},
    element("button", {"data-column": name, onclick: () => { state.down = state.sort === name && !state.down; state.sort = name; drawTable(); }},
      name + (state.sort === name ? (state.down ? " ↓" : " ↑") : "")))));
  document.querySelector("#table thead").replaceChildren(head);
  const shown = sorted(), most = 2000;
  document.querySelector("#table tbody").replaceChildren(...shown.slice(0, most).map(row => {
    const picture = element("canvas", {class: "thumbnail", "data-id": row.id});
    watcher.observe(picture);
    return element("tr", {tabindex: 0, "data-id": row.id, class: state.chosen === row.id ? "chosen" : "",
      onclick: () => choose(row.id), onkeydown: event => {
        if (event.key === "Enter") choose(row.id);
        const beside = event.key === "ArrowDown" ? event.currentTarget.nextElementSibling : event.key === "ArrowUp" ? event.currentTarget.previousElementSibling : null;
        if (beside) { event.preventDefault(); beside.focus(); }
      }}, element("td", {}, picture), ...names.map(name => cellOf(row, name)));
  }));
  $("shown").textContent = `${shown.length.toLocaleString("en")} of ${rows.length.toLocaleString("en")} scenarios${shown.length > most ? `, the first ${most} shown` : ""}`;
  drawScatter(shown);
}

// ---- scatter plot
const names = [...numeric];
const pick = (select, value) => { select.append(...names.map(name => element("option", {value: name, selected: name === value}, name))); select.addEventListener("change", () => drawTable()); };
const varying = parameters.filter(name => numeric.includes(name));
pick($("x"), varying[0] || "number"); pick($("y"), numeric.includes("mean_speed") ? "mean_speed" : names[0]);
$("z").append(element("option", {value: ""}, "status")); pick($("z"), null);
function drawScatter(shown) {
  const [x, y, z] = ["x", "y", "z"].map(id => $(id).value);
  const usable = shown.filter(row => typeof row[x] === "number" && typeof row[y] === "number");
  const values = usable.map(row => row[z]).filter(value => typeof value === "number"), low = Math.min(...values), high = Math.max(...values);
  const colour = row => {
    if (!z || typeof row[z] !== "number") return rank(row) === 3 ? "#1f5fa8" : "#b3261e";
    const s = high > low ? (row[z] - low) / (high - low) : 0;
    return `hsl(${240 - 240 * s} 65% 45%)`;
  };
  const made = plot({title: `${y} over ${x}`, xLabel: x, yLabel: z ? `colour: ${z}, ${number(low)} to ${number(high)}` : "", points: true, width: 640, height: 320, onPick: choose,
    series: [{points: usable.map(row => [row[x], row[y], row.id, colour(row), `scenario ${row.number}`]), colour: "#1f5fa8"}]});
  if (state.chosen) { const dot = made.svg.querySelector(`[data-key="${state.chosen}"]`); if (dot) { dot.setAttribute("r", 7); dot.setAttribute("stroke", "#22242a"); } }
  $("scatter").replaceChildren(made.svg);
}

// ---- one scenario
function choose(id) {
  state.chosen = id;
  const row = rows.find(candidate => candidate.id === id);
  $("chosen").hidden = false;
  $("name").textContent = `Scenario ${row.number} · ${id}`;
  const picture = element("canvas", {"aria-label": "The ways of some of its people"});
  const figures = element("dl", {}, ...[...parameters, ...every].filter((name, i, all) => all.indexOf(name) === i && row[name] !== null && row[name] !== "[]").map(name =>
    element("div", {}, element("dt", {}, name), element("dd", {class: name === "reason" ? "bad" : ""}, name === "bake" || name === "log" ? element("a", {href: data.folder + row[name]}, row[name]) : number(row[name], 5)))));
  $("detail").replaceChildren(picture, figures);
  if (data.pages && row.bake) figures.prepend(element("div", {}, element("dt", {}, "playback"), element("dd", {}, element("a", {href: `${data.pages}${id}.html`}, "open"))));
  drawThumbnail(picture, data.thumbnails[id]);
  for (const line of document.querySelectorAll("#table tbody tr")) line.classList.toggle("chosen", line.dataset.id === id);
  drawScatter(sorted());
}

$("title").textContent = data.name;
$("about").textContent = `${rows.length.toLocaleString("en")} scenarios of ${data.base} · throng ${data.version}`;
const figure = (name, value, mark = "") => element("div", {}, element("dt", {}, name), element("dd", {class: mark}, value));
const tally = test => rows.filter(test).length;
const mean = name => { const v = rows.map(row => row[name]).filter(value => typeof value === "number"); return v.length ? v.reduce((a, b) => a + b, 0) / v.length : null; };
$("summary").append(figure("done", number(tally(row => row.status === "ok")), "good"), figure("failed", number(tally(row => row.status === "failed")), tally(row => row.status === "failed") ? "bad" : ""),
  figure("missing", number(tally(row => row.status === "missing"))), figure("miss a bar", number(tally(row => row.missed_bars > 0)), tally(row => row.missed_bars > 0) ? "bad" : ""),
  figure("with stuck people", number(tally(row => row.stuck > 0))), figure("s a scenario, mean", number(mean("total_seconds"))));
let waiting = 0;
$("filter").addEventListener("input", () => {
  clearTimeout(waiting);
  waiting = setTimeout(() => {
    try { state.filter = filterFor($("filter").value); $("mistake").textContent = ""; } catch (error) { $("mistake").textContent = error.message; }
    drawTable();
  }, 120);
});
$("columns").addEventListener("change", drawTable);
drawTable();
document.body.dataset.ready = "yes";
