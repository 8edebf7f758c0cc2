// The points, which of them are selected, and every state they were in.

const MOST_STATES = 200;
const MOST_BYTES = 128 << 20;

export class Cloud {
  constructor(limit = 1_000_000) {
    this.limit = limit;
    this.xy = new Float64Array(0);
    this.source = null;
    this.selected = new Set();
    this.past = [];
    this.future = [];
    this.key = null;
  }

  get size() {
    return this.xy.length / 2;
  }

  /** A new state. States with the same key in a row are one for undo. */
  become(xy, { source = null, key = null } = {}) {
    if (xy.length / 2 > this.limit) throw new Error(`At most ${this.limit.toLocaleString("en")} points are taken.`);
    if (key === null || key !== this.key) {
      this.past.push({ xy: this.xy, source: this.source });
      this.future = [];
      this.#trim();
    }
    this.key = key;
    if (xy.length !== this.xy.length) this.selected = new Set();
    this.xy = xy;
    this.source = source;
  }

  /** Ends a run of states that are one for undo. */
  settle() {
    this.key = null;
  }

  #trim() {
    let bytes = 0;
    for (let i = this.past.length - 1; i >= 0; i -= 1) {
      bytes += this.past[i].xy.byteLength;
      if (bytes > MOST_BYTES || this.past.length - i > MOST_STATES) {
        this.past.splice(0, i + 1);
        return;
      }
    }
  }

  #travel(from, to) {
    if (!from.length) return false;
    to.push({ xy: this.xy, source: this.source });
    const state = from.pop();
    this.xy = state.xy;
    this.source = state.source;
    this.selected = new Set([...this.selected].filter((row) => row < this.size));
    this.key = null;
    return true;
  }

  undo() {
    return this.#travel(this.past, this.future);
  }

  redo() {
    return this.#travel(this.future, this.past);
  }

  add(pairs, key = null) {
    const xy = new Float64Array(this.xy.length + pairs.length * 2);
    xy.set(this.xy);
    pairs.forEach(([x, y], i) => xy.set([x, y], this.xy.length + 2 * i));
    this.become(xy, { key });
  }

  /** Moves the selected points of `from` by (x, y); `snap` gives each its place. */
  move(from, x, y, key, snap = (...place) => place) {
    const xy = from.slice();
    for (const row of this.selected) {
      const [newX, newY] = snap(from[2 * row] + x, from[2 * row + 1] + y);
      xy[2 * row] = newX;
      xy[2 * row + 1] = newY;
    }
    this.become(xy, { key });
  }

  remove() {
    const kept = [];
    for (let row = 0; row < this.size; row += 1) {
      if (!this.selected.has(row)) kept.push(this.xy[2 * row], this.xy[2 * row + 1]);
    }
    this.become(Float64Array.from(kept));
    this.selected = new Set();
  }

  /** The point nearest to (x, y) within a distance, or -1. */
  nearest(x, y, within = Infinity) {
    let best = -1;
    let least = within * within;
    for (let row = 0; row < this.size; row += 1) {
      const dx = this.xy[2 * row] - x;
      const dy = this.xy[2 * row + 1] - y;
      const away = dx * dx + dy * dy;
      if (away <= least) {
        best = row;
        least = away;
      }
    }
    return best;
  }

  inBox([left, low, right, high]) {
    const found = [];
    for (let row = 0; row < this.size; row += 1) {
      const x = this.xy[2 * row];
      const y = this.xy[2 * row + 1];
      if (x >= left && x <= right && y >= low && y <= high) found.push(row);
    }
    return found;
  }

  get box() {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (let row = 0; row < this.size; row += 1) {
      box[0] = Math.min(box[0], this.xy[2 * row]);
      box[1] = Math.min(box[1], this.xy[2 * row + 1]);
      box[2] = Math.max(box[2], this.xy[2 * row]);
      box[3] = Math.max(box[3], this.xy[2 * row + 1]);
    }
    return this.size ? box : [0, 0, 1, 1];
  }
}

/** Points every `spacing` along a line of [x, y], from its start; its end too if that is far enough. */
export function along(line, spacing) {
  const found = line.length ? [line[0]] : [];
  let left = spacing;
  for (let i = 1; i < line.length; i += 1) {
    let [x, y] = line[i - 1];
    const [endX, endY] = line[i];
    let length = Math.hypot(endX - x, endY - y);
    while (length >= left && length > 0) {
      x += ((endX - x) * left) / length;
      y += ((endY - y) * left) / length;
      found.push([x, y]);
      length = Math.hypot(endX - x, endY - y);
      left = spacing;
    }
    left -= length;
  }
  return found;
}
