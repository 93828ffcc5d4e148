"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const $ = id => document.getElementById(id);
const element = (name, attributes = {}, ...children) => {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (value === true) made.setAttribute(key, "");
    else if (value !== null && value !== false) made.setAttribute(key, value);
  }
  made.append(...children.filter(child => child !== null && child !== undefined));
  return made;
};
const drawn = (name, attributes = {}, text = null) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== null) made.textContent = text;
  return made;
};
const number = (value, digits = 3) => value === null || value === undefined ? "–"
  : typeof value !== "number" ? String(value)
  : Number.isInteger(value) ? value.toLocaleString("en")
  : Number(value.toPrecision(digits)).toLocaleString("en", {maximumSignificantDigits: digits});

// Ticks at 1, 2 or 5 times a power of ten.
function ticks(low, high, about) {
  if (!(high > low)) return [low];
  const raw = (high - low) / about, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find(m => m * power >= raw) * power;
  const found = [];
  for (let at = Math.ceil(low / step - 1e-9) * step; at <= high + 1e-9 * step; at += step) found.push(Number(at.toPrecision(12)));
  return found;
}

// A plot of lines or points. series: [{points: [[x, y], ...], colour, name}]. Returns {svg, x: value -> px, cursor(x)}.
function plot({title, series, xLabel, yLabel, points = false, onPick = null, width = 420, height = 200, fromZero = true}) {
  const left = 46, right = 12, top = 22, bottom = 34;
  const all = series.flatMap(s => s.points).filter(p => p[1] !== null);
  const xs = all.map(p => p[0]), ys = all.map(p => p[1]);
  const range = (values, zero) => {
    let low = values.reduce((a, b) => Math.min(a, b), Infinity), high = values.reduce((a, b) => Math.max(a, b), -Infinity);
    if (!(low <= high)) [low, high] = [0, 1];
    if (zero && low > 0) low = 0;
    return low === high ? [low - (zero && low === 0 ? 0 : 0.5), high + 0.5] : [low, high];
  };
  const padded = ([low, high]) => points ? [low - 0.04 * (high - low), high + 0.04 * (high - low)] : [low, high];
  const [x0, x1] = padded(range(xs, fromZero && !points)), [y0, y1] = padded(range(ys, fromZero && !points));
  const x = v => left + (v - x0) / (x1 - x0) * (width - left - right);
  const y = v => height - bottom - (v - y0) / (y1 - y0) * (height - top - bottom);
  const svg = drawn("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": title, style: "width:100%;height:auto;display:block"});
  svg.append(drawn("text", {x: left, y: 13, style: "font-weight:600;fill:#22242a"}, title));
  for (const t of ticks(x0, x1, 6)) {
    svg.append(drawn("line", {x1: x(t), x2: x(t), y1: top, y2: height - bottom, stroke: "#ebe9e1"}));
    svg.append(drawn("text", {x: x(t), y: height - bottom + 14, "text-anchor": "middle"}, number(t)));
  }
  for (const t of ticks(y0, y1, 4)) {
    svg.append(drawn("line", {x1: left, x2: width - right, y1: y(t), y2: y(t), stroke: "#ebe9e1"}));
    svg.append(drawn("text", {x: left - 6, y: y(t) + 4, "text-anchor": "end"}, number(t)));
  }
  svg.append(drawn("text", {x: (left + width - right) / 2, y: height - 4, "text-anchor": "middle"}, xLabel));
  if (yLabel) svg.append(drawn("text", {x: width - right, y: 13, "text-anchor": "end"}, yLabel));
  for (const s of series) {
    if (points) {
      for (const p of s.points) {
        const dot = drawn("circle", {cx: x(p[0]), cy: y(p[1]), r: 4, fill: p[3] || s.colour, "fill-opacity": 0.75, style: onPick ? "cursor:pointer" : ""});
        if (p[2] !== undefined) { dot.dataset.key = p[2]; dot.append(drawn("title", {}, `${p[4] || p[2]}: ${number(p[0])}, ${number(p[1])}`)); }
        if (onPick) dot.addEventListener("click", () => onPick(p[2]));
        svg.append(dot);
      }
      continue;
    }
    let path = "", pen = false;
    for (const p of s.points) {
      if (p[1] === null) { pen = false; continue; }
      path += `${pen ? "L" : "M"}${x(p[0]).toFixed(1)} ${y(p[1]).toFixed(1)}`;
      pen = true;
    }
    svg.append(drawn("path", {d: path, fill: "none", stroke: s.colour, "stroke-width": 1.8}));
  }
  const cursor = drawn("line", {y1: top, y2: height - bottom, stroke: "#b3261e", "stroke-width": 1, visibility: "hidden", class: "no-print"});
  svg.append(cursor);
  if (onPick && !points) {
    svg.style.cursor = "pointer";
    svg.addEventListener("click", event => {
      const box = svg.getBoundingClientRect();
      const at = x0 + ((event.clientX - box.left) / box.width * width - left) / (width - left - right) * (x1 - x0);
      onPick(Math.min(x1, Math.max(x0, at)));
    });
  }
  return {svg, cursor(value) { cursor.setAttribute("x1", x(value)); cursor.setAttribute("x2", x(value)); cursor.setAttribute("visibility", "visible"); }};
}
