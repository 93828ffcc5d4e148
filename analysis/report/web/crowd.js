// A crowd, moment by moment: x and y of everybody as 16-bit numbers, all of them in one list.
class Crowd {
  // about: {fps, frames, every, quantum, minimum, maximum, geometry, groups, colours, group, radii}, and of vehicles
  // {vehicles, ground: {minimum, quantum}}
  constructor(about) {
    Object.assign(this, about);
    this.count = this.group.length;
    this.radii = Float32Array.from(this.radii);
    this.vehicles = this.vehicles || [];
    this.levels = this.geometry.levels || [];
    this.links = this.geometry.links || [];
    this.first = new Float64Array(this.count).fill(Infinity);  // frames in which everybody is there
    this.last = new Float64Array(this.count).fill(-1);
    this.taken = 0;            // moments so far
    this.moments = new Uint16Array(0);
    this.storeys = null;       // of everybody in every moment, where there are levels
    this.sizes = null;         // likewise, where the ground makes people larger: from half (0) to twice (255) their own
    this.tracks = new Uint16Array(0);  // of every vehicle: x, y, heading, whether it is there
    this.growing = false;      // whether there will be more
    this.words = this.colours.map(wordOf);
    this.layCells();
  }

  // Squares of a metre, or larger ones of a large place, in which people are counted.
  layCells() {
    const sides = [0, 1].map(i => Math.max(1, Math.ceil(this.maximum[i] - this.minimum[i])));
    const side = Math.max(1, Math.sqrt(sides[0] * sides[1] / 250000));
    this.cells = {side, width: Math.ceil(sides[0] / side), height: Math.ceil(sides[1] / side)};
    this.densities = {};
  }

  get momentSeconds() { return this.every / this.fps; }
  // s, of all that there will be, and of what there is.
  get length() { return Math.max(0, (this.frames - 1) / this.fps); }
  get end() { return this.taken ? this.momentTime(this.taken - 1) : 0; }
  // The last moment may come sooner than the others.
  momentTime(m) { return Math.min(m * this.momentSeconds, this.length); }
  momentAt(time) {
    const m = Math.max(0, Math.min(Math.floor(time / this.momentSeconds), this.taken - 2));
    const span = this.momentTime(m + 1) - this.momentTime(m);
    return {m, share: span > 0 && this.taken > 1 ? Math.min(1, Math.max(0, (time - this.momentTime(m)) / span)) : 0};
  }

  isThere(row, frame) { return frame >= this.first[row] && frame <= this.last[row]; }
  placeOf(row, m, share) {
    const a = m * 2 * this.count + 2 * row, b = this.taken > 1 ? a + 2 * this.count : a, all = this.moments;
    return {x: this.minimum[0] + this.quantum * (all[a] + share * (all[b] - all[a])),
            y: this.minimum[1] + this.quantum * (all[a + 1] + share * (all[b + 1] - all[a + 1]))};
  }
  radiusOf(row, m) {
    return this.radii[row] * (this.sizes ? 0.5 + 1.5 * this.sizes[m * this.count + row] / 255 : 1);
  }
  speedOf(row, m) {
    if (this.taken < 2) return 0;
    const a = m * 2 * this.count + 2 * row, b = a + 2 * this.count, all = this.moments;
    return this.quantum * Math.hypot(all[b] - all[a], all[b + 1] - all[a + 1]) / (this.momentTime(m + 1) - this.momentTime(m));
  }
  // Where a vehicle is, or null.
  vehicleAt(vehicle, m, share) {
    const a = 4 * (m * this.vehicles.length + vehicle), b = this.taken > 1 ? a + 4 * this.vehicles.length : a, all = this.tracks;
    const from = all[a + 3] ? a : b, to = all[b + 3] ? b : a;
    if (!all[share < 0.5 ? a + 3 : b + 3]) return null;
    const turn = (all[to + 2] - all[from + 2] + 98304) % 65536 - 32768;
    const {minimum, quantum} = this.ground;  // lanes begin outside of what people can reach
    return {x: minimum[0] + quantum * (all[from] + share * (all[to] - all[from])),
            y: minimum[1] + quantum * (all[from + 1] + share * (all[to + 1] - all[from + 1])),
            heading: (all[from + 2] + share * turn) / 65536 * 2 * Math.PI};
  }
  isOnLevel(thing, level) { return level === null || thing.levels.includes(level); }
  // Whether somebody is on a level, or on a link from or to it.
  isShown(row, m, level) {
    if (level === null) return true;
    const storey = this.storeys[m * this.count + row], link = this.links[storey - this.levels.length];
    return storey < this.levels.length ? storey === level : link !== undefined && this.isOnLevel(link, level);
  }
}
