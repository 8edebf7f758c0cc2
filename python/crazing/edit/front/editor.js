// The editor: puts the parts together, and tells Python what changed.

import { h, icon, iconButton, unique } from "./dom.js";
import { View } from "./view.js";
import { Cloud } from "./cloud.js";
import { Live, Wire, numbers } from "./wire.js";
import { Scene } from "./scene.js";
import { Preview } from "./preview.js";
import { TOOLS, Tools } from "./tools.js";
import { controls } from "./controls.js";
import { keepFile, measureSection, modeSection, outSection, pictureSection, pointsSection } from "./panels.js";

const KEYS = [
  ["Click", "add a point"], ["Drag a point", "move it"], ["Shift + click, Shift + drag", "select"], ["Delete", "delete what is selected"],
  ["Ctrl + Z, Ctrl + Y", "undo, redo"], ["Wheel, + and −", "zoom"], ["Right button, Space + drag, Alt + arrows", "pan"], ["0", "show everything"],
  ["Arrow keys", "move the cursor, or what is selected; with Shift ten times as far"], ["Enter", "add a point at the cursor"], ["Space", "select the point at the cursor"],
  ["N, P", "select the next or the last point"], ["G", "grid on and off"], ["D, S, F, H", "draw, select, freehand, pan"], ["Esc", "let go of everything"],
];

class Editor {
  constructor(model, root, state) {
    Object.assign(this, { model, root, state });
    this.mode = state.mode;
    this.cloud = new Cloud(state.limits.points);
    this.cloud.xy = numbers(state.buffers[0], Float64Array);
    this.view = new View();
    this.canvas = h("canvas", { class: "crz-canvas", tabIndex: 0, role: "application", "aria-label": "Drawing area", "aria-roledescription": "point editor" });
    this.scene = new Scene(this.canvas, this.view, this.cloud, root);
    this.wire = state.wire;
    this.resting = true;
    this.unmeasured = false;
    const lamp = Object.fromEntries(state.lamp.map(({ name, default: value }) => [name, value]));
    this.preview = new Preview(this.wire, this.view, this.scene, lamp, () => this.tools.pointers.size > 0, (error) => this.#tell(error.message));
    this.layers = new Live(() => this.#askLayers(), (answer) => this.#showLayers(answer), (error) => this.#tell(error.message));
    this.contour = new Live(() => this.wire.ask({ kind: "contour", ...this.picture.values }), (answer) => this.#traced(answer), (error) => this.picture.complain(error.message));
    this.#build();
    this.tools = new Tools(this);
    this.setTool("draw");
    this.#watch();
    this.changed("everything");
  }

  // ---- building

  #build() {
    this.points = pointsSection(this, this.state);
    this.picture = pictureSection(this, this.state);
    this.modes = modeSection(this, this.state);
    this.measures = measureSection(this);
    this.out = outSection(this, this.state);
    this.status = h("p", { role: "status", class: "crz-hidden" });
    const panel = h("div", { class: "crz-panel", role: "group", "aria-label": "Settings" }, this.modes.element, this.picture.element, this.points.element, this.measures.element, this.out.element);
    const stage = h("div", { class: "crz-stage" }, this.#stage(), this.#foot());
    this.root.replaceChildren(h("div", { class: "crz-frame" }, this.#bar(), stage, panel, this.status));
    this.modes.select(this.mode);
    this.out.select(this.mode);
  }

  #bar() {
    this.toolButtons = TOOLS.map(({ name, label, key }) => iconButton(name, `${label} (${key.toUpperCase()})`, () => this.setTool(name), { "data-tool": name, "aria-pressed": "false" }));
    this.undoButton = iconButton("undo", "Undo (Ctrl+Z)", () => this.undo(), { "data-action": "undo" });
    this.redoButton = iconButton("redo", "Redo (Ctrl+Y)", () => this.redo(), { "data-action": "redo" });
    this.snapButton = iconButton("snap", "Snap to the grid (G)", () => this.setSnap(!this.scene.snap), { "aria-pressed": "false", "data-action": "snap" });
    this.themeButton = iconButton("moon", "Dark", () => this.#turnTheme(), { "data-action": "theme" });
    const help = h("dialog", { class: "crz-help", "aria-label": "Keys" }, h("h2", {}, "Mouse and keys"), h("dl", {}, KEYS.flatMap(([key, what]) => [h("dt", {}, key), h("dd", {}, what)])),
      h("form", { method: "dialog" }, h("button", { class: "crz-primary" }, "Close")));
    const mark = h("h1", { class: "crz-mark" }, "crazing");
    return h("div", { class: "crz-bar", role: "toolbar", "aria-label": "Tools" }, mark,
      h("div", { class: "crz-group" }, this.toolButtons), h("div", { class: "crz-group" }, this.undoButton, this.redoButton, this.snapButton),
      h("span", { class: "crz-space" }), h("div", { class: "crz-group" }, iconButton("help", "Mouse and keys", () => help.showModal(), { "data-action": "help" }), this.themeButton), help);
  }

  #stage() {
    const how = h("p", { class: "crz-hidden", id: unique("how") }, "Arrow keys move a cursor, Enter adds a point, Space selects the one at the cursor, N and P go from point to point, Delete deletes.");
    this.canvas.setAttribute("aria-describedby", how.id);
    this.note = h("p", { class: "crz-note", role: "status" });
    this.note.hidden = true;
    this.empty = h("div", { class: "crz-empty" }, h("h2", {}, "Click anywhere to place points"), h("p", {}, "Draw a curve, drop a picture or a file, or begin with one of these."),
      h("div", { class: "crz-buttons" }, this.state.outlines.map((name) => h("button", { type: "button", "data-start": name, onclick: () => this.#start({ sampler: name, n: 160 }) }, `A ${name}`)),
        h("button", { type: "button", "data-start": "random", onclick: () => this.#start({ sampler: "uniform", n: 300 }) }, icon("dice"), "Random points"),
        h("button", { type: "button", "data-start": "open", onclick: () => this.points.open() }, icon("picture"), "A picture")));
    const spacing = h("input", { type: "range", min: 4, max: 80, step: 1, value: 18, id: unique("spacing"), oninput: () => {
      this.tools.spacing = Number(spacing.value);
      far.textContent = `${spacing.value} px`;
    } });
    const far = h("output", { htmlFor: spacing.id }, "18 px");
    this.options = h("div", { class: "crz-options" }, h("label", { htmlFor: spacing.id }, "A point every"), spacing, far);
    const split = h("input", { type: "range", class: "crz-split", min: 0, max: 1, step: 0.001, value: 0.5, "aria-label": "Where the two halves meet", oninput: () => this.setSplit(Number(split.value)) });
    this.splitInput = split;
    this.sides = [h("span", { class: "crz-side" }), h("span", { class: "crz-side" })];
    this.dropHere = h("div", { class: "crz-drop" }, "Drop a picture, or points as CSV, NPY, SVG or GeoJSON");
    this.area = h("div", { class: "crz-area" }, this.canvas, how, this.empty, this.note, this.options, h("div", { class: "crz-sides" }, this.sides), split, this.dropHere);
    return this.area;
  }

  #foot() {
    this.where = h("span", { class: "crz-where" });
    this.howMany = h("span", { class: "crz-many" });
    this.took = h("span", { class: "crz-took", title: "From the change to its drawing, and Python's part" });
    const see = h("input", { type: "checkbox", id: unique("dots"), checked: true, onchange: () => {
      this.scene.showPoints = see.checked;
      this.scene.invalidate();
    } });
    return h("div", { class: "crz-foot" }, this.howMany, this.where, h("span", { class: "crz-space" }), this.took, h("label", { class: "crz-dots" }, see, "Points"),
      h("div", { class: "crz-group" }, iconButton("minus", "Zoom out", () => this.zoom(0.8)), iconButton("fit", "Show everything (0)", () => this.fit(), { "data-action": "fit" }), iconButton("plus", "Zoom in", () => this.zoom(1.25))));
  }

  /** What a mode has beside its knobs. */
  extras(mode) {
    if (mode === "compare") {
      const name = unique("look");
      const radio = (value, label) => {
        const input = h("input", { type: "radio", name, id: unique("look"), value, checked: value === "overlay", onchange: () => this.setSplit(value === "split" ? Number(this.splitInput.value) : null) });
        return h("label", { htmlFor: input.id, class: "crz-radio" }, input, label);
      };
      const key = (layer, label) => h("span", { class: "crz-key" }, h("span", { class: "crz-swatch", "data-layer": layer, "aria-hidden": "true" }), label);
      return h("fieldset", { class: "crz-look" }, h("legend", {}, "Shown as"), radio("overlay", "Overlay"), radio("split", "Split"),
        h("p", { class: "crz-keys" }, key("shared", "both"), key("first", "first only"), key("second", "second only")));
    }
    if (mode === "crack") {
      const lines = h("input", { type: "checkbox", role: "switch", id: unique("lines"), onchange: () => {
        this.scene.showLines = lines.checked;
        this.scene.invalidate();
      } });
      this.scene.showLines = false;
      const lamp = controls(this.state.lamp, this.preview.lamp, () => this.preview.light());
      lamp.element.querySelector("details").open = true;
      return [lamp.element, h("div", { class: "crz-row crz-switch" }, lines, h("label", { htmlFor: lines.id }, h("span", { class: "crz-swatch", "data-layer": "crack", "aria-hidden": "true" }), "Centrelines"))];
    }
    return null;
  }

  #watch() {
    this.observer = new ResizeObserver(() => this.#resize());
    this.observer.observe(this.area);
    this.dark = window.matchMedia("(prefers-color-scheme: dark)");
    this.themed = () => this.#showTheme();
    this.dark.addEventListener("change", this.themed);
    const { root } = this;
    let inside = 0;
    const over = (event, by) => {
      event.preventDefault();
      inside = Math.max(0, inside + by);
      this.dropHere.classList.toggle("crz-on", inside > 0);
    };
    root.addEventListener("dragenter", (event) => over(event, 1));
    root.addEventListener("dragleave", (event) => over(event, -1));
    root.addEventListener("dragover", (event) => event.preventDefault());
    root.addEventListener("drop", (event) => {
      over(event, -inside);
      const [file] = event.dataTransfer.files;
      if (file) this.load(file).catch((error) => this.#tell(error.message, true));
    });
    this.model.on("change:points", () => this.#pointsFromPython());
    this.model.on("change:settings", () => this.#settingsFromPython());
    this.#resize(true);
    this.#showTheme();
    this.fit();
  }

  stop() {
    this.observer.disconnect();
    clearTimeout(this.rest);
    this.preview.stop();
    this.dark.removeEventListener("change", this.themed);
    this.wire.forget("closed");
  }

  #resize() {
    const { width, height } = this.canvas.getBoundingClientRect();
    const first = this.view.width === 1;
    this.view.resize(width, height);
    if (first) this.fit();
    this.changed("view");
  }

  // ---- theme

  #turnTheme() {
    const isDark = this.root.dataset.theme === "dark";
    this.theme = isDark ? "light" : "dark";
    try {
      localStorage.setItem("crazing-theme", this.theme);
    } catch {
      // A host without storage forgets it.
    }
    this.#showTheme();
  }

  #showTheme() {
    let kept = this.theme;
    try {
      kept ??= localStorage.getItem("crazing-theme");
    } catch {
      kept ??= null;
    }
    const { jpThemeLight, vscodeThemeKind } = document.body.dataset;
    const host = jpThemeLight ? (jpThemeLight === "false" ? "dark" : "light") : vscodeThemeKind ? (vscodeThemeKind.includes("dark") ? "dark" : "light") : null;
    const theme = kept ?? host ?? (this.dark.matches ? "dark" : "light");
    this.root.dataset.theme = theme;
    this.themeButton.replaceChildren(icon(theme === "dark" ? "sun" : "moon"));
    this.themeButton.setAttribute("aria-label", theme === "dark" ? "Light theme" : "Dark theme");
    this.themeButton.title = this.themeButton.getAttribute("aria-label");
    this.scene.readColors();
  }

  // ---- what the tools and the panel do

  setTool(name) {
    this.tools.name = name;
    this.canvas.dataset.tool = name;
    this.options.hidden = name !== "curve";
    for (const button of this.toolButtons) button.setAttribute("aria-pressed", String(button.dataset.tool === name));
  }

  setSnap(on) {
    this.scene.snap = on;
    this.snapButton.setAttribute("aria-pressed", String(on));
    this.say(on ? `Grid of ${this.view.step()}` : "Grid off");
    this.scene.invalidate();
  }

  setMode(mode) {
    this.mode = mode;
    this.modes.select(mode);
    this.out.select(mode);
    this.changed("mode");
  }

  setSplit(at) {
    this.scene.split = at;
    this.#sides();
    this.scene.invalidate();
  }

  #sides() {
    const on = this.mode === "compare" && this.scene.split !== null && this.cloud.size > 2;
    this.splitInput.hidden = !on;
    const { first, second } = this.state.values.compare;
    [first, second].forEach((name, i) => {
      this.sides[i].hidden = !on;
      this.sides[i].textContent = name;
    });
  }

  add(pairs, key = null) {
    if (!pairs.length) return;
    try {
      this.cloud.add(pairs, key);
    } catch (error) {
      this.#tell(error.message);
      return;
    }
    this.say(pairs.length === 1 ? `Point ${this.cloud.size} added` : `${pairs.length} points added`);
    this.changed("points");
    this.changed("settled");
  }

  remove() {
    const { size } = this.cloud.selected;
    if (!size) return;
    this.cloud.remove();
    this.scene.hover = -1;
    this.say(`${size} deleted`);
    this.changed("settled");
  }

  clear() {
    if (!this.cloud.size) return;
    this.cloud.become(new Float64Array(0));
    this.closePicture();
    this.say("All points removed");
    this.changed("settled");
  }

  undo() {
    if (this.cloud.undo()) this.#travelled("Undone");
  }

  redo() {
    if (this.cloud.redo()) this.#travelled("Done again");
  }

  #travelled(words) {
    this.say(`${words}, ${this.cloud.size} points`);
    this.scene.hover = -1;
    this.changed("settled");
  }

  zoom(factor) {
    this.view.zoom(factor);
    this.changed("view");
  }

  fit() {
    const box = this.scene.underlay ? this.scene.underlay.bounds : this.cloud.size > 1 ? this.cloud.box : [0, 0, 1, 1];
    this.view.fit(box);
    this.changed("view");
  }

  async #start(values) {
    await this.sample({ seed: 7, ...values });
    this.canvas.focus({ preventScroll: true });
  }

  async sample(values) {
    const answer = await this.wire.ask({ kind: "sample", ...values });
    this.closePicture();
    this.#replace(answer);
    this.fit();
  }

  #replace(answer, key = null) {
    const xy = numbers(answer.buffers[0], Float64Array);
    this.cloud.become(xy, { source: answer.source, key });
    this.say(`${this.cloud.size} points`);
    this.changed("settled");
  }

  /** A file that was opened or dropped: points, or a picture to be traced. */
  async load(file) {
    if (file.size > this.state.limits.bytes) throw new Error(`${file.name} is larger than ${this.state.limits.bytes >> 20} MB.`);
    let answer = await this.wire.ask({ kind: "load" }, [await file.arrayBuffer()]);
    let shown = file;
    if (answer.kind === "drawing") {
      shown = await rasterised(file);
      answer = await this.wire.ask({ kind: "load" }, [await shown.arrayBuffer()]);
    }
    this.noteStays = false;
    this.#tell("");
    if (answer.kind === "points") {
      this.closePicture();
      this.#replace(answer);
      this.fit();
      return;
    }
    this.picture.show(file.name, answer.width, answer.height);
    this.scene.underlay = { image: await createImageBitmap(shown).catch(() => null), bounds: [0, 0, answer.width, answer.height] };
    if (!this.scene.underlay.image) this.scene.underlay = null;
    this.underlay = this.scene.underlay;
    this.tracing = Symbol("contour");
    this.view.fit([0, 0, answer.width, answer.height]);
    await this.contour.poke();
  }

  trace() {
    this.picture.complain("");
    this.contour.poke();
  }

  #traced(answer) {
    this.picture.complain("");
    this.#replace(answer, this.tracing);
  }

  showUnderlay(on) {
    this.scene.underlay = on ? this.underlay : null;
    this.scene.invalidate();
  }

  closePicture() {
    this.picture.element.hidden = true;
    this.scene.underlay = null;
    this.underlay = null;
    this.cloud.settle();
    this.scene.invalidate();
  }

  // ---- Python

  bytes() {
    return this.cloud.xy.slice().buffer;
  }

  #state() {
    return { mode: this.mode, values: this.state.values };
  }

  export(what, size) {
    return this.wire.ask({ kind: "export", what, size, lamp: this.preview.lamp, ...this.#state() }, [this.bytes()]);
  }

  measure() {
    return this.wire.ask({ kind: "measure", ...this.#state() }, [this.bytes()]);
  }

  async script() {
    return (await this.wire.ask({ kind: "script", source: this.cloud.source, lamp: this.preview.lamp, ...this.#state() }, [this.bytes()])).text;
  }

  keep(answer) {
    keepFile(answer);
  }

  #askLayers() {
    this.asked = performance.now();
    const { resting, mode } = this;
    const crack = mode === "crack";
    this.askedAtRest = resting;
    this.preview.stop();
    const wish = crack ? { preview: this.preview.wish(resting), later: resting } : {};
    return this.wire.ask({ kind: "layers", ...wish, moving: this.scene.dragging === true || (crack && !resting), ...this.#state() }, [this.bytes()]);
  }

  #showLayers(answer) {
    this.scene.mode = answer.mode;
    this.scene.take(answer, numbers);
    this.preview.take(answer, this.asked);
    this.#tell(answer.note);
    this.modes.count(answer.mode, answer.head, answer.rows);
    this.#sides();
    this.scene.invalidate();
    // The large picture of rest is no part of what is live.
    if (!this.askedAtRest) {
      const took = performance.now() - this.asked;
      this.took.textContent = this.cloud.size ? `${Math.round(took)} ms` : "";
      this.root.dataset.milliseconds = String(took);
    }
    this.root.dataset.answers = String(Number(this.root.dataset.answers ?? 0) + 1);
  }

  #pointsFromPython() {
    const xy = numbers(this.model.get("points"), Float64Array);
    if (same(xy, this.cloud.xy)) return;
    this.cloud.become(xy);
    this.say(`${this.cloud.size} points from Python`);
    this.changed("settled");
    this.fit();
  }

  #settingsFromPython() {
    const { mode, ...values } = this.model.get("settings");
    if (JSON.stringify({ mode, values }) === JSON.stringify(this.#state())) return;
    for (const [panel, given] of Object.entries(values)) Object.assign(this.state.values[panel] ?? {}, given);
    this.modes.set();
    if (mode !== this.mode) this.setMode(mode);
    else this.changed("values");
  }

  /** Keeps the traits of a notebook's widget; a page's model keeps them nowhere. */
  #keepTraits() {
    this.model.set("points", new DataView(this.bytes()));
    this.model.set("settings", structuredClone({ mode: this.mode, ...this.state.values }));
    this.model.save_changes();
  }

  // ---- what follows from a change

  /** `what`: points (and there is more to come), settled, values, mode, selection, view, or everything. */
  changed(what) {
    this.scene.invalidate();
    if (what === "view") {
      this.#moved();
      return;
    }
    const { cloud } = this;
    const chosen = cloud.selected.size ? ` · ${cloud.selected.size} selected` : "";
    this.howMany.textContent = `${cloud.size.toLocaleString("en")} point${cloud.size === 1 ? "" : "s"}${chosen}`;
    this.empty.hidden = cloud.size > 0 || !this.picture.element.hidden || (this.mode === "crack" && this.state.values.crack.plates !== "of the points");
    this.undoButton.disabled = !cloud.past.length;
    this.redoButton.disabled = !cloud.future.length;
    if (what === "selection") return;
    this.unmeasured = true;
    this.resting = false;
    this.layers.poke();
    if (what !== "points") this.#keepTraits();
    this.#restLater();
  }

  /** Another part of a crack, or another size of it, is another picture. */
  #moved() {
    if (this.mode !== "crack") return;
    if (this.scene.preview && !this.preview.covers) {
      this.resting = false;
      this.layers.poke();
    }
    this.#restLater();
  }

  /** What moves is drawn small; when nothing has moved for a while it deserves the large picture. */
  #restLater() {
    clearTimeout(this.rest);
    this.rest = setTimeout(() => {
      if (this.tools.pointers.size) {
        this.#restLater();
        return;
      }
      if (this.unmeasured) this.measures.poke();
      this.unmeasured = false;
      if (this.mode !== "crack") return;
      this.resting = true;
      this.layers.poke();
    }, 220);
  }

  pointed(place) {
    if (!place) {
      this.where.textContent = "";
      return;
    }
    const digits = Math.max(0, Math.min(12, Math.ceil(Math.log10(this.view.scale))));
    this.where.textContent = place.map((part) => part.toFixed(digits)).join(", ");
  }

  say(words) {
    this.status.textContent = words;
  }

  #tell(words, stays = false) {
    if (!words && this.noteStays && !stays) {
      // A complaint about a file is not wiped away by the next drawing.
      return;
    }
    this.noteStays = stays;
    if (stays) setTimeout(() => { this.noteStays = false; this.#tell(""); }, 8000);
    this.note.textContent = words;
    this.note.hidden = !words;
  }
}

function same(a, b) {
  return a.length === b.length && a.every((value, i) => Object.is(value, b[i]));
}

/** A drawing of lines as a picture of pixels, on white, its longer side 1024. */
async function rasterised(file) {
  const address = URL.createObjectURL(new Blob([file], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode().catch(() => Promise.reject(new Error(`${file.name} cannot be drawn by this browser.`)));
    const [wide, tall] = [image.naturalWidth || 1, image.naturalHeight || 1];
    const scale = 1024 / Math.max(wide, tall);
    const canvas = h("canvas", { width: Math.max(2, Math.round(wide * scale)), height: Math.max(2, Math.round(tall * scale)) });
    const context = canvas.getContext("2d");
    context.fillStyle = "white";
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** What a host calls: anywidget, or the page's own. */
async function render({ model, el }) {
  const root = h("div", { class: "crz" }, h("p", { class: "crz-wait" }, "Waiting for Python …"));
  el.append(root);
  const wire = new Wire(model);
  const state = await wire.ask({ kind: "hello" });
  const editor = new Editor(model, root, { ...state, wire });
  // The tests look in here.
  root.editor = editor;
  return () => editor.stop();
}

export default { render };
