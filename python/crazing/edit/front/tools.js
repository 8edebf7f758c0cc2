// What the pointer and the keys do on the canvas.

import { along } from "./cloud.js";

/** Pixels within which a point is meant; a finger is wider than a mouse. */
const REACH = { mouse: 9, pen: 12, touch: 22 };

export const TOOLS = [
  { name: "draw", label: "Draw: click adds, drag moves", key: "d" },
  { name: "select", label: "Select: drag a box", key: "s" },
  { name: "curve", label: "Freehand curve", key: "f" },
  { name: "pan", label: "Pan", key: "h" },
];

export class Tools {
  /** `editor` has view, cloud, scene, `changed(what)`, `say(words)` and `setTool(name)`. */
  constructor(editor) {
    this.editor = editor;
    this.name = "draw";
    this.spacing = 18;
    this.pointers = new Map();
    this.gesture = null;
    this.space = false;
    const { canvas } = editor;
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#up(event));
    canvas.addEventListener("pointercancel", (event) => this.#cancel(event));
    canvas.addEventListener("pointerleave", () => this.#hover(-1, null));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("keydown", (event) => this.#key(event));
    canvas.addEventListener("keyup", (event) => {
      if (event.key === " ") this.space = false;
    });
    canvas.addEventListener("blur", () => this.#cursor(null));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  #place(event) {
    const box = this.editor.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #snapped(x, y) {
    return this.editor.scene.snap ? this.editor.view.snapped(x, y) : [x, y];
  }

  #hit(left, top, kind) {
    const { view, cloud, scene } = this.editor;
    if (!scene.showPoints) return -1;
    return cloud.nearest(...view.toData(left, top), (REACH[kind] ?? 9) / view.scale);
  }

  #down(event) {
    const { canvas, cloud, view } = this.editor;
    canvas.focus({ preventScroll: true });
    this.#cursor(null);
    canvas.setPointerCapture(event.pointerId);
    const at = this.#place(event);
    this.pointers.set(event.pointerId, at);
    if (this.pointers.size === 2) {
      this.#drop();
      this.gesture = { kind: "pinch", distance: this.#spread(), middle: this.#middle() };
      return;
    }
    if (this.pointers.size > 2) return;
    const start = view.toData(...at);
    if (event.button === 1 || event.button === 2 || this.name === "pan" || this.space) {
      this.gesture = { kind: "pan", at };
      return;
    }
    if (this.name === "curve") {
      this.gesture = { kind: "curve", line: [start] };
      return;
    }
    const row = this.#hit(...at, event.pointerType);
    const more = event.shiftKey || event.ctrlKey || event.metaKey;
    if (row >= 0) {
      const was = cloud.selected.has(row);
      if (more && was) cloud.selected.delete(row);
      else if (more) cloud.selected.add(row);
      else if (!was) cloud.selected = new Set([row]);
      this.gesture = { kind: "move", at, start, row, from: cloud.xy, key: Symbol("move"), moved: false, only: !more && was };
    } else if (this.name === "select" || more) {
      this.gesture = { kind: "box", at, start, before: more ? new Set(cloud.selected) : new Set() };
    } else {
      this.gesture = { kind: "add", at, start };
    }
    this.editor.changed("selection");
  }

  #move(event) {
    const at = this.#place(event);
    if (!this.pointers.has(event.pointerId)) {
      const sees = this.name === "draw" || this.name === "select";
      this.#hover(sees ? this.#hit(...at, event.pointerType) : -1, at);
      return;
    }
    const before = this.pointers.get(event.pointerId);
    this.pointers.set(event.pointerId, at);
    this.editor.pointed(this.editor.view.toData(...at));
    const { gesture } = this;
    if (!gesture) return;
    const { view, cloud, scene } = this.editor;
    const data = view.toData(...at);
    const far = gesture.at && Math.hypot(at[0] - gesture.at[0], at[1] - gesture.at[1]) > 3;
    if (gesture.kind === "pan") {
      view.pan(at[0] - before[0], at[1] - before[1]);
      this.editor.changed("view");
    } else if (gesture.kind === "pinch" && this.pointers.size === 2) {
      const [distance, middle] = [this.#spread(), this.#middle()];
      view.pan(middle[0] - gesture.middle[0], middle[1] - gesture.middle[1]);
      if (gesture.distance > 0) view.zoom(distance / gesture.distance, ...middle);
      Object.assign(gesture, { distance, middle });
      this.editor.changed("view");
    } else if (gesture.kind === "curve") {
      for (const part of event.getCoalescedEvents?.() ?? [event]) gesture.line.push(view.toData(...this.#place(part)));
      scene.stroke = { line: gesture.line, points: this.#sampled(gesture.line) };
      scene.invalidate();
    } else if (gesture.kind === "move" && (gesture.moved || far)) {
      gesture.moved = true;
      scene.dragging = true;
      this.#shift(gesture, data);
    } else if (gesture.kind === "box" || (gesture.kind === "add" && far && this.name === "select")) {
      scene.box = [Math.min(gesture.start[0], data[0]), Math.min(gesture.start[1], data[1]), Math.max(gesture.start[0], data[0]), Math.max(gesture.start[1], data[1])];
      cloud.selected = new Set([...gesture.before, ...cloud.inBox(scene.box)]);
      this.editor.changed("selection");
    } else if (gesture.kind === "add" && far) {
      // Pressed on an empty place and drawn on: the new point comes along.
      const key = Symbol("move");
      this.#add(gesture.start, key);
      cloud.selected = new Set([cloud.size - 1]);
      this.gesture = { kind: "move", at: gesture.at, start: gesture.start, row: cloud.size - 1, from: cloud.xy, key, moved: true };
      scene.dragging = true;
      this.#shift(this.gesture, data);
    }
  }

  #shift(gesture, [x, y]) {
    const { cloud } = this.editor;
    // The point under the pointer lands on the grid, the others keep their places beside it.
    const home = [gesture.from[2 * gesture.row], gesture.from[2 * gesture.row + 1]];
    const [newX, newY] = this.#snapped(home[0] + x - gesture.start[0], home[1] + y - gesture.start[1]);
    if (cloud.selected.size === 1) cloud.move(gesture.from, 0, 0, gesture.key, () => [newX, newY]);
    else cloud.move(gesture.from, newX - home[0], newY - home[1], gesture.key);
    this.editor.changed("points");
  }

  #up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    const { gesture } = this;
    const { cloud, scene } = this.editor;
    if (!gesture || this.pointers.size) {
      if (gesture?.kind === "pinch") this.gesture = null;
      return;
    }
    this.gesture = null;
    scene.dragging = false;
    if (gesture.kind === "add") {
      const had = cloud.selected.size;
      cloud.selected = new Set();
      if (this.name === "draw") this.#add(gesture.start);
      else if (had) this.editor.changed("selection");
    } else if (gesture.kind === "curve") {
      scene.stroke = null;
      const points = this.#sampled(gesture.line);
      this.editor.add(points.map((point) => this.#snapped(...point)));
    } else if (gesture.kind === "move") {
      if (gesture.moved) this.editor.say(cloud.selected.size === 1 ? "Point moved" : `${cloud.selected.size} points moved`);
      else if (gesture.only) cloud.selected = new Set([gesture.row]);
    } else if (gesture.kind === "box") {
      scene.box = null;
      this.editor.say(`${cloud.selected.size} selected`);
    }
    cloud.settle();
    this.editor.changed(gesture.kind === "move" && gesture.moved ? "settled" : "selection");
  }

  #cancel(event) {
    this.pointers.delete(event.pointerId);
    this.#drop();
  }

  /** Leaves a gesture without its end. */
  #drop() {
    const { scene, cloud } = this.editor;
    Object.assign(scene, { box: null, stroke: null, dragging: false });
    this.gesture = null;
    cloud.settle();
    this.editor.changed("settled");
  }

  #add(place, key = null) {
    this.editor.add([this.#snapped(...place)], key);
  }

  #sampled(line) {
    return along(line, this.spacing / this.editor.view.scale);
  }

  #spread() {
    const [a, b] = [...this.pointers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  }

  #middle() {
    const [a, b] = [...this.pointers.values()];
    return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  }

  #hover(row, at) {
    const { scene, view } = this.editor;
    this.editor.pointed(at ? view.toData(...at) : null);
    if (scene.visited !== Boolean(at)) {
      scene.visited = Boolean(at);
      scene.invalidate();
    }
    if (row === scene.hover) return;
    scene.hover = row;
    this.editor.canvas.dataset.over = row >= 0 ? "point" : "";
    scene.invalidate();
  }

  #wheel(event) {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 30 : event.deltaMode === 2 ? 400 : 1);
    this.editor.view.zoom(Math.exp(-Math.max(-300, Math.min(300, pixels)) / 400), ...this.#place(event));
    this.editor.changed("view");
  }

  #cursor(place) {
    this.editor.scene.cursor = place;
    this.editor.scene.invalidate();
  }

  #key(event) {
    const { editor } = this;
    const { cloud } = editor;
    const control = event.ctrlKey || event.metaKey;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const actions = {
      Delete: () => editor.remove(),
      Backspace: () => editor.remove(),
      Escape: () => this.#escape(),
      Enter: () => this.#enter(),
      " ": () => this.#choose(event.shiftKey),
      n: () => this.#next(1),
      p: () => this.#next(-1),
      g: () => editor.setSnap(!editor.scene.snap),
      "+": () => editor.zoom(1.25),
      "=": () => editor.zoom(1.25),
      "-": () => editor.zoom(0.8),
      0: () => editor.fit(),
      ...Object.fromEntries(TOOLS.map((tool) => [tool.key, () => editor.setTool(tool.name)])),
    };
    const controlled = {
      a: () => this.#all(),
      z: () => (event.shiftKey ? editor.redo() : editor.undo()),
      y: () => editor.redo(),
    };
    let action = control ? controlled[key] : actions[key];
    if (arrows[key] && !control) action = () => this.#arrow(...arrows[key], event.shiftKey ? 10 : 1, event.altKey);
    if (!action) return;
    event.preventDefault();
    event.stopPropagation();
    action();
  }

  #arrow(x, y, times, view) {
    const { editor } = this;
    const { cloud, scene } = editor;
    const pixel = 1 / editor.view.scale;
    const step = (scene.snap ? editor.view.step() : pixel) * times;
    if (view) {
      editor.view.pan(-40 * x, 40 * y);
      editor.changed("view");
    } else if (cloud.selected.size && !scene.cursor) {
      cloud.move(cloud.xy, x * step, y * step, "arrows", scene.snap ? (...place) => editor.view.snapped(...place) : undefined);
      editor.changed("points");
    } else {
      const far = (scene.snap ? editor.view.step() : 10 * pixel) * times;
      const [oldX, oldY] = scene.cursor ?? [editor.view.x, editor.view.y];
      const place = this.#snapped(oldX + (scene.cursor ? x * far : 0), oldY + (scene.cursor ? y * far : 0));
      this.#cursor(place);
      editor.pointed(place);
    }
  }

  #enter() {
    const { editor } = this;
    if (!editor.scene.cursor) this.#cursor(this.#snapped(editor.view.x, editor.view.y));
    else this.#add(editor.scene.cursor);
  }

  #choose(more) {
    const { editor } = this;
    if (!editor.scene.cursor) {
      this.space = true;
      return;
    }
    const row = editor.cloud.nearest(...editor.scene.cursor, 40 / editor.view.scale);
    if (row < 0) return editor.say("No point near the cursor");
    if (!more) editor.cloud.selected = new Set([row]);
    else if (!editor.cloud.selected.delete(row)) editor.cloud.selected.add(row);
    this.#cursor(null);
    editor.say(`Point ${row + 1} selected. Arrow keys move it.`);
    return editor.changed("selection");
  }

  #next(by) {
    const { editor } = this;
    const { cloud } = editor;
    if (!cloud.size) return editor.say("No points");
    const last = cloud.selected.size ? [...cloud.selected].at(-1) : by > 0 ? -1 : 0;
    const row = (last + by + cloud.size) % cloud.size;
    cloud.selected = new Set([row]);
    this.#cursor(null);
    const [x, y] = [cloud.xy[2 * row], cloud.xy[2 * row + 1]].map((part) => Number(part.toPrecision(4)));
    editor.say(`Point ${row + 1} of ${cloud.size} at ${x}, ${y}`);
    return editor.changed("selection");
  }

  #all() {
    const { editor } = this;
    editor.cloud.selected = new Set(Array.from({ length: editor.cloud.size }, (_, row) => row));
    editor.say(`${editor.cloud.size} selected`);
    editor.changed("selection");
  }

  #escape() {
    const { editor } = this;
    if (this.gesture) this.#drop();
    editor.cloud.selected = new Set();
    this.#cursor(null);
    editor.changed("selection");
  }
}
