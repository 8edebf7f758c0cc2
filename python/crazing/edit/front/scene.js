// Everything on the canvas, drawn anew whenever something changed, once a frame.

const TAU = 2 * Math.PI;

/** What lies thick or thin, of what colour; colours are those of the style sheet. */
const WIDTHS = { delaunay: 1, voronoi: 1, crust: 2.4, curve: 2.2, axis: 1.7, walls: 1.8, solution: 2.6, crack: 1.4, shared: 1.8, "only-first": 2.6, "only-second": 2.6 };

/** Segments of one path: browsers that paint without a graphics card take long over the whole of a large one. */
const AT_ONCE = 32;

export class Scene {
  constructor(canvas, view, cloud, root) {
    Object.assign(this, { canvas, view, cloud, root });
    this.context = canvas.getContext("2d");
    this.layers = [];
    this.origin = [0, 0];
    this.preview = null;
    this.underlay = null;
    this.mode = "skeleton";
    this.showPoints = true;
    this.showLines = true;
    this.snap = false;
    this.split = null;
    this.box = null;
    this.stroke = null;
    this.cursor = null;
    this.hover = -1;
    this.frame = 0;
    this.colors = {};
  }

  /** Reads the colours of the theme from the style sheet. */
  readColors() {
    const probe = document.createElement("i");
    this.root.append(probe);
    const read = (name) => {
      probe.style.color = `var(--${name})`;
      return getComputedStyle(probe).color;
    };
    const names = ["paper", "grid", "grid-strong", "ruler", "point", "point-edge", "accent", "ghost", "delaunay", "voronoi", "crust", "axis", "curve", "poles", "shared", "first", "second", "walls", "solution", "crack", "nested-0", "nested-1", "nested-2", "nested-3", "nested-4"];
    this.colors = Object.fromEntries(names.map((name) => [name, read(name)]));
    probe.remove();
    this.invalidate();
  }

  color(name) {
    const same = { "crust-first": "crust", "crust-second": "crust", "axis-first": "first", "axis-second": "second", "only-first": "first", "only-second": "second", ends: "solution" };
    return this.colors[same[name] ?? name];
  }

  invalidate() {
    if (!this.frame) this.frame = requestAnimationFrame(() => this.draw());
  }

  /** The layers of an answer: lines as one path each, ready to be drawn at any zoom. */
  take(answer, toNumbers) {
    this.origin = answer.origin;
    const part = (i) => (i === undefined ? null : toNumbers(answer.buffers[i], Float32Array));
    this.layers = answer.layers.map(({ name, kind, widths }, i) => ({ name, kind, xy: part(i), widths: part(widths) }));
    this.invalidate();
  }

  draw() {
    this.frame = 0;
    const { context: c, view } = this;
    const dpr = window.devicePixelRatio || 1;
    const [wide, tall] = [Math.round(view.width * dpr), Math.round(view.height * dpr)];
    if (this.canvas.width !== wide || this.canvas.height !== tall) Object.assign(this.canvas, { width: wide, height: tall });
    c.setTransform(wide / view.width, 0, 0, tall / view.height, 0, 0);
    c.fillStyle = this.colors.paper;
    c.fillRect(0, 0, view.width, view.height);
    this.#grid();
    this.#picture(this.underlay, 0.35, "high");
    // It has been made at the size it is seen at, or is about to be.
    this.#picture(this.preview, 1, "low");
    this.#plate(wide, tall);
    this.#points();
    this.#marks();
  }

  #grid() {
    const { context: c, view } = this;
    const step = view.step(this.snap ? 28 : 70);
    const [left, high] = view.toData(0, 0);
    const [right, low] = view.toData(view.width, view.height);
    c.lineWidth = 1;
    c.font = "11px system-ui, sans-serif";
    const line = (value, across) => {
      const [x, y] = view.toScreen(value, value);
      const at = Math.round(across ? y : x) + 0.5;
      c.strokeStyle = Math.abs(value) < step / 2 ? this.colors["grid-strong"] : this.colors.grid;
      c.beginPath();
      c.moveTo(across ? 0 : at, across ? at : 0);
      c.lineTo(across ? view.width : at, across ? at : view.height);
      c.stroke();
      return at;
    };
    const labelled = view.step(70);
    const text = (value) => Number(value.toPrecision(12)).toString();
    const isLabelled = (value) => Math.abs(value / labelled - Math.round(value / labelled)) < 1e-6;
    c.fillStyle = this.colors.ruler;
    for (let i = Math.ceil(left / step); i * step <= right; i += 1) {
      const at = line(i * step, false);
      if (isLabelled(i * step) && at > 34) c.fillText(text(i * step), at + 3, view.height - 5);
    }
    for (let i = Math.ceil(low / step); i * step <= high; i += 1) {
      const at = line(i * step, true);
      if (isLabelled(i * step) && at < view.height - 22) c.fillText(text(i * step), 4, at - 3);
    }
  }

  #picture(picture, alpha, quality) {
    if (!picture) return;
    const { context: c, view } = this;
    const [left, low, right, high] = picture.bounds;
    const [x, y] = view.toScreen(left, high);
    const [endX, endY] = view.toScreen(right, low);
    c.globalAlpha = alpha;
    c.imageSmoothingEnabled = true;
    c.imageSmoothingQuality = quality;
    c.drawImage(picture.image, x, y, endX - x, endY - y);
    c.globalAlpha = 1;
  }

  /** The layers, from a canvas of their own: while only points, cursor or pictures move they are not drawn again. */
  #plate(wide, tall) {
    if (!this.layers.length) return;
    const { context: c, view } = this;
    this.plate ??= document.createElement("canvas");
    const now = [this.layers, this.colors, this.mode, this.split, this.preview, this.showLines, view.x, view.y, view.scale, wide, tall];
    if (!this.plated || now.some((part, i) => part !== this.plated[i])) {
      this.plated = now;
      Object.assign(this.plate, { width: wide, height: tall });
      const layers = this.plate.getContext("2d");
      layers.setTransform(wide / view.width, 0, 0, tall / view.height, 0, 0);
      if (this.mode === "crack" && this.preview && !this.showLines) this.#thin(layers, this.layers[0]);
      else this.#layers(layers);
    }
    c.drawImage(this.plate, 0, 0, view.width, view.height);
  }

  /** Cracks too thin for the pixels of the preview, as lines: they stay sharp while it is small. */
  #thin(c, { xy, widths }) {
    const { view, preview } = this;
    const [left, top] = view.toScreen(...this.origin);
    const { scale } = view;
    const pixel = 1 / (window.devicePixelRatio || 1);
    // A path for all lines about as thick; those below a pixel are faint instead of thinner.
    const paths = new Map();
    for (let i = 0; i < widths.length; i += 1) {
      const width = widths[i] * scale;
      if (width <= 0 || widths[i] >= preview.resolved) continue;
      const [x, y, endX, endY] = [left + xy[4 * i] * scale, top - xy[4 * i + 1] * scale, left + xy[4 * i + 2] * scale, top - xy[4 * i + 3] * scale];
      if (Math.max(x, endX) < 0 || Math.min(x, endX) > view.width || Math.max(y, endY) < 0 || Math.min(y, endY) > view.height) continue;
      const thick = width < 1.5 * pixel ? pixel : Math.round(2 * width) / 2;
      const faint = Math.max(0.25, Math.min(1, Math.round((4 * width) / pixel) / 4));
      const key = 8 * thick + faint / 2;
      if (!paths.has(key)) paths.set(key, { thick, faint, path: new Path2D() });
      const { path } = paths.get(key);
      path.moveTo(x, y);
      path.lineTo(endX, endY);
    }
    c.strokeStyle = preview.ink;
    c.lineCap = "round";
    for (const { thick, faint, path } of paths.values()) {
      Object.assign(c, { lineWidth: thick, globalAlpha: faint });
      c.stroke(path);
    }
    c.globalAlpha = 1;
  }

  #layers(c) {
    const { view } = this;
    if (this.mode !== "compare") {
      for (const layer of this.layers) this.#layer(c, layer);
      return;
    }
    const named = Object.fromEntries(this.layers.map((layer) => [layer.name, layer]));
    if (this.split === null) {
      c.globalAlpha = 0.3;
      for (const name of ["crust-first", "crust-second"]) this.#layer(c, named[name]);
      c.globalAlpha = 1;
      for (const name of ["shared", "only-first", "only-second"]) this.#layer(c, named[name]);
      return;
    }
    const at = this.split * view.width;
    for (const [start, end, side] of [[0, at, "first"], [at, view.width, "second"]]) {
      c.save();
      c.beginPath();
      c.rect(start, 0, end - start, view.height);
      c.clip();
      this.#layer(c, named[`axis-${side}`]);
      this.#layer(c, named[`crust-${side}`]);
      c.restore();
    }
    c.strokeStyle = this.colors.accent;
    c.lineWidth = 2;
    c.beginPath();
    c.moveTo(at, 0);
    c.lineTo(at, view.height);
    c.stroke();
  }

  #layer(c, layer) {
    if (!layer) return;
    const { view } = this;
    const { xy } = layer;
    // The origin in screen units; the rest is one multiplication a number.
    const [left, top] = view.toScreen(...this.origin);
    const scale = view.scale;
    c.beginPath();
    if (layer.kind === "lines") {
      c.strokeStyle = this.color(layer.name);
      c.lineWidth = WIDTHS[layer.name] ?? WIDTHS[layer.name.split("-")[0]] ?? 1.1;
      c.lineCap = "round";
      c.lineJoin = "round";
      // What is far outside is left out: the canvas is slow on it.
      const far = 1e5;
      for (let i = 0; i < xy.length; i += 4) {
        const x = left + xy[i] * scale;
        const y = top - xy[i + 1] * scale;
        const endX = left + xy[i + 2] * scale;
        const endY = top - xy[i + 3] * scale;
        if (Math.abs(x) > far || Math.abs(y) > far || Math.abs(endX) > far || Math.abs(endY) > far) continue;
        c.moveTo(x, y);
        c.lineTo(endX, endY);
        if ((i / 4) % AT_ONCE === AT_ONCE - 1 && c.globalAlpha === 1) {
          c.stroke();
          c.beginPath();
        }
      }
      c.stroke();
      return;
    }
    const radius = layer.name === "ends" ? 6 : 2.6;
    for (let i = 0; i < xy.length; i += 2) {
      const x = left + xy[i] * scale;
      const y = top - xy[i + 1] * scale;
      c.moveTo(x + radius, y);
      c.arc(x, y, radius, 0, TAU);
    }
    c.fillStyle = this.color(layer.name);
    c.fill();
  }

  #points() {
    const { context: c, view, cloud } = this;
    // On a crack they would spoil the picture: there they are seen while somebody is about to move them.
    if (!this.dragging && (!this.showPoints || (this.mode === "crack" && !this.visited))) return;
    const many = cloud.size > 3000;
    const radius = Math.min(3.6, Math.max(cloud.size > 1200 ? 1.3 : 2.1, 0.24 * this.#spacing() * view.scale));
    c.globalAlpha = this.mode === "crack" ? 0.6 : 1;
    c.beginPath();
    const chosen = [];
    for (let row = 0; row < cloud.size; row += 1) {
      const [x, y] = view.toScreen(cloud.xy[2 * row], cloud.xy[2 * row + 1]);
      if (x < -9 || y < -9 || x > view.width + 9 || y > view.height + 9) continue;
      if (cloud.selected.has(row)) {
        chosen.push([x, y]);
      } else if (many) {
        c.rect(x - radius, y - radius, 2 * radius, 2 * radius);
      } else {
        c.moveTo(x + radius, y);
        c.arc(x, y, radius, 0, TAU);
      }
    }
    c.fillStyle = this.colors.point;
    c.fill();
    c.globalAlpha = 1;
    this.#discs(chosen, Math.max(radius, 2.6) + 1.4, this.colors.accent);
    if (this.hover >= 0 && this.hover < cloud.size) {
      this.#ring(view.toScreen(cloud.xy[2 * this.hover], cloud.xy[2 * this.hover + 1]), radius + 5);
    }
  }

  /** About how far a point is from its nearest: the median of some of them, found once a state. */
  #spacing() {
    const { cloud } = this;
    if (this.spaced?.xy !== cloud.xy) {
      const found = [];
      const every = Math.max(1, Math.floor(cloud.size / 25));
      for (let row = 0; row < cloud.size; row += every) {
        const [x, y] = [cloud.xy[2 * row], cloud.xy[2 * row + 1]];
        let least = Infinity;
        for (let other = 0; other < cloud.size; other += 1) {
          const away = (cloud.xy[2 * other] - x) ** 2 + (cloud.xy[2 * other + 1] - y) ** 2;
          if (away < least && away > 0) least = away;
        }
        found.push(Math.sqrt(least));
      }
      found.sort((a, b) => a - b);
      this.spaced = { xy: cloud.xy, value: found[found.length >> 1] ?? Infinity };
    }
    return this.spaced.value;
  }

  #discs(places, radius, color) {
    const { context: c } = this;
    c.beginPath();
    for (const [x, y] of places) {
      c.moveTo(x + radius, y);
      c.arc(x, y, radius, 0, TAU);
    }
    c.fillStyle = color;
    c.fill();
    c.strokeStyle = this.colors["point-edge"];
    c.lineWidth = 1.2;
    c.stroke();
  }

  #ring([x, y], radius) {
    const { context: c } = this;
    c.beginPath();
    c.arc(x, y, radius, 0, TAU);
    c.strokeStyle = this.colors.accent;
    c.lineWidth = 2;
    c.stroke();
  }

  /** What is only there while something is being done: the box, the stroke, the cursor of the keyboard. */
  #marks() {
    const { context: c, view } = this;
    if (this.box) {
      const [x, y] = view.toScreen(this.box[0], this.box[3]);
      const [endX, endY] = view.toScreen(this.box[2], this.box[1]);
      c.fillStyle = this.colors.ghost;
      c.fillRect(x, y, endX - x, endY - y);
      c.strokeStyle = this.colors.accent;
      c.lineWidth = 1;
      c.strokeRect(x, y, endX - x, endY - y);
    }
    if (this.stroke) {
      c.beginPath();
      this.stroke.line.forEach(([x, y], i) => c[i ? "lineTo" : "moveTo"](...view.toScreen(x, y)));
      c.strokeStyle = this.colors.ghost;
      c.lineWidth = 8;
      c.lineCap = "round";
      c.lineJoin = "round";
      c.stroke();
      this.#discs(this.stroke.points.map(([x, y]) => view.toScreen(x, y)), 3.4, this.colors.accent);
    }
    if (this.cursor) {
      const [x, y] = view.toScreen(...this.cursor);
      c.strokeStyle = this.colors.accent;
      c.lineWidth = 2;
      c.beginPath();
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        c.moveTo(x + 5 * dx, y + 5 * dy);
        c.lineTo(x + 15 * dx, y + 15 * dy);
      }
      c.stroke();
    }
  }
}
