// The panel beside the canvas: points, the mode with its knobs and counts, and what can be taken away.

import { download, h, icon, unique, words } from "./dom.js";
import { Live } from "./wire.js";
import { controls } from "./controls.js";

const TITLES = { skeleton: "Skeleton", compare: "Compare", maze: "Maze", crack: "Crack" };

const KINDS = { csv: "text/csv", npy: "application/octet-stream", svg: "image/svg+xml", geojson: "application/geo+json", png: "image/png", dxf: "application/dxf", zip: "application/zip", toml: "application/toml", py: "text/x-python" };

/** A part of the panel that can be folded. */
function section(title, open, ...children) {
  return h("details", { class: "crz-section", open }, h("summary", {}, h("h2", {}, title)), h("div", { class: "crz-inside" }, children));
}

/** A place for what went wrong, right where it did; empty it takes no less room. */
function complaint() {
  return h("p", { class: "crz-complaint", role: "alert" });
}

/** Runs an action of a button; its failure is told in `place`. */
function tried(place, action) {
  return async () => {
    place.textContent = "";
    try {
      await action();
      // What an earlier try complained of meanwhile.
      place.textContent = "";
    } catch (error) {
      place.textContent = error.message;
      place.scrollIntoView({ block: "nearest" });
    }
  };
}

export function pointsSection(editor, state) {
  const place = complaint();
  const values = Object.fromEntries(state.samples.map((knob) => [knob.name, knob.default]));
  const knobs = controls(state.samples, values, () => {});
  const make = tried(place, () => editor.sample(values));
  const picker = h("input", { type: "file", class: "crz-hidden", tabIndex: -1, "aria-label": "File to open", accept: ".csv,.txt,.npy,.svg,.geojson,.json,image/*", onchange: () => {
    const [file] = picker.files;
    if (file) tried(place, () => editor.load(file))();
    picker.value = "";
  } });
  const kind = h("select", { "aria-label": "Format of the points" }, state.formats.map((word) => h("option", { value: word }, word.toUpperCase().replace("GEOJSON", "GeoJSON"))));
  const save = tried(place, async () => editor.keep(await editor.wire.ask({ kind: "save", format: kind.value }, [editor.bytes()])));
  const element = section("Points", true,
    knobs.element,
    h("div", { class: "crz-buttons" }, h("button", { type: "button", class: "crz-primary", "data-action": "generate", onclick: make }, icon("dice"), "Generate")),
    h("hr"),
    h("div", { class: "crz-buttons" },
      h("button", { type: "button", "data-action": "open", onclick: () => picker.click() }, icon("open"), "Open file or picture"), picker,
      h("button", { type: "button", class: "crz-quiet", "data-action": "clear", onclick: () => editor.clear() }, icon("trash"), "Clear")),
    h("div", { class: "crz-buttons" }, h("button", { type: "button", "data-action": "save", onclick: save }, "Save points as"), kind),
    place);
  return { element, open: () => picker.click(), complain: (message) => (place.textContent = message) };
}

/** The sliders of a dropped picture; hidden until there is one. */
export function pictureSection(editor, state) {
  const place = complaint();
  const values = Object.fromEntries(state.contour.map((knob) => [knob.name, knob.default]));
  const knobs = controls(state.contour, values, () => editor.trace());
  const about = h("p", { class: "crz-about" });
  const see = h("input", { type: "checkbox", id: unique("see"), checked: true, onchange: () => editor.showUnderlay(see.checked) });
  const element = section("Picture", true, about, knobs.element,
    h("div", { class: "crz-row crz-switch" }, see, h("label", { htmlFor: see.id }, "Show the picture")),
    h("div", { class: "crz-buttons" }, h("button", { type: "button", "data-action": "done", onclick: () => editor.closePicture() }, "Done")), place);
  element.hidden = true;
  const show = (name, width, height) => {
    element.hidden = false;
    about.textContent = `${name}, ${width} × ${height} pixels`;
  };
  return { element, values, show, complain: (message) => (place.textContent = message) };
}

/** The modes as tabs, each with its knobs and a table of counts. */
export function modeSection(editor, state) {
  const tabs = {};
  const panels = {};
  const knobs = {};
  const tables = {};
  for (const [mode, list] of Object.entries(state.knobs)) {
    const [tabName, panelName] = [unique("tab"), unique("panel")];
    tabs[mode] = h("button", { type: "button", role: "tab", id: tabName, "aria-controls": panelName, "data-mode": mode, onclick: () => editor.setMode(mode) }, TITLES[mode]);
    knobs[mode] = controls(list, state.values[mode], (name) => {
      if (name === "recipe") {
        // The knobs of the steps jump to where the recipe has them.
        Object.assign(state.values.crack, state.recipes[state.values.crack.recipe]);
        knobs.crack.set();
      }
      editor.changed("values");
    });
    tables[mode] = h("table", { class: "crz-counts" }, h("caption", { class: "crz-hidden" }, `Counts of the ${TITLES[mode].toLowerCase()}`));
    panels[mode] = h("div", { role: "tabpanel", id: panelName, "aria-labelledby": tabName, class: "crz-inside" }, knobs[mode].element, editor.extras(mode), tables[mode]);
  }
  const list = h("div", { role: "tablist", "aria-label": "What is made of the points", class: "crz-tabs", onkeydown: (event) => {
    const names = Object.keys(tabs);
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const next = names[(names.indexOf(editor.mode) + step + names.length) % names.length];
    editor.setMode(next);
    tabs[next].focus();
  } }, Object.values(tabs));
  const select = (mode) => {
    for (const name of Object.keys(tabs)) {
      tabs[name].setAttribute("aria-selected", String(name === mode));
      tabs[name].tabIndex = name === mode ? 0 : -1;
      panels[name].hidden = name !== mode;
    }
  };
  const count = (mode, head, rows) => {
    const table = tables[mode];
    table.querySelectorAll("thead, tbody").forEach((part) => part.remove());
    if (head.length) table.append(h("thead", {}, h("tr", {}, h("td"), head.map((name) => h("th", { scope: "col" }, name)))));
    table.append(h("tbody", {}, rows.map(([name, ...values]) => h("tr", {}, h("th", { scope: "row" }, name), values.map((value) => h("td", {}, words(value)))))));
  };
  const set = () => Object.values(knobs).forEach((one) => one.set());
  return { element: h("section", { class: "crz-modes", "aria-label": "Mode" }, list, Object.values(panels)), select, count, set };
}

/** Statistics of what is shown, measured while the section is open. */
export function measureSection(editor) {
  const place = complaint();
  const table = h("table", { class: "crz-counts" }, h("caption", { class: "crz-hidden" }, "Measures"));
  const live = new Live(() => editor.measure(), ({ rows }) => {
    place.textContent = "";
    table.querySelectorAll("tbody").forEach((part) => part.remove());
    table.append(h("tbody", {}, rows.map(([name, value]) => h("tr", {}, h("th", { scope: "row" }, name), h("td", {}, words(value))))));
  }, (error) => {
    place.textContent = error.message;
    table.querySelectorAll("tbody").forEach((part) => part.remove());
  });
  const element = section("Measure", false, place, table);
  const poke = () => {
    if (element.open) live.poke();
  };
  element.addEventListener("toggle", poke);
  return { element, poke };
}

/** What can be taken away. */
export function outSection(editor, state) {
  const place = complaint();
  const size = h("select", { "aria-label": "Pixels of the longer side" }, [512, 1024, 2048, 4096, 8192].filter((side) => side <= state.limits.size).map((side) => h("option", { value: side, selected: side === 1024 }, `${side} px`)));
  const buttons = state.outputs.map(({ what, label, modes }) => {
    const take = tried(place, async () => editor.keep(await editor.export(what, Number(size.value))));
    return { modes, element: h("button", { type: "button", "data-action": `export-${what}`, onclick: take }, label) };
  });
  const copied = h("span", { role: "status", class: "crz-said" });
  const text = h("textarea", { class: "crz-script", readOnly: true, rows: 8, spellcheck: false, "aria-label": "Python that makes the same", hidden: true });
  const copy = tried(place, async () => {
    text.value = await editor.script();
    text.hidden = false;
    try {
      await navigator.clipboard.writeText(text.value);
      copied.textContent = "Copied";
    } catch {
      // Not every host lets a page write there: then it is selected, and Ctrl+C does it.
      text.select();
      copied.textContent = "Press Ctrl+C";
    }
    setTimeout(() => (copied.textContent = ""), 3000);
  });
  const element = section("Take away", true,
    h("div", { class: "crz-row" }, h("span", {}, "Picture size"), size),
    h("div", { class: "crz-buttons crz-grid" }, buttons.map((button) => button.element)),
    h("div", { class: "crz-buttons" }, h("button", { type: "button", "data-action": "script", onclick: copy }, icon("copy"), "Copy as Python"), copied),
    text, place);
  const select = (mode) => {
    for (const button of buttons) button.element.hidden = !button.modes.includes(mode);
    text.hidden = true;
  };
  return { element, select };
}

/** Hands a file of Python's to the browser. */
export function keepFile(answer) {
  const kind = KINDS[answer.name.split(".").at(-1)] ?? "application/octet-stream";
  download(answer.name, answer.buffers, kind);
}
