// Knobs, as Python describes them, as controls.

import { h, unique, words } from "./dom.js";

/** One knob: its element, `set(value)` and `refresh(values)`, which shows or hides it. */
function control(knob, change) {
  const id = unique(knob.name);
  const makers = { switch: switchOf, choice: choiceOf, number: sliderOf, count: countOf, seed: seedOf, optional: optionalOf };
  const made = makers[knob.kind](knob, id, (value) => change(knob.name, value));
  const [name, wanted] = knob.needs.split(":");
  made.refresh = (values) => {
    made.element.hidden = Boolean(name) && (wanted === undefined ? !values[name] : values[name] !== wanted);
  };
  made.element.dataset.knob = knob.name;
  return made;
}

function hint(knob) {
  return knob.help ? h("span", { class: "crz-hint" }, knob.help) : null;
}

function switchOf(knob, id, change) {
  const input = h("input", { type: "checkbox", role: "switch", id, onchange: () => change(input.checked) });
  const element = h("div", { class: "crz-row crz-switch" }, input, h("label", { htmlFor: id }, h("span", { class: "crz-swatch", "data-layer": knob.name, "aria-hidden": "true" }), knob.label, hint(knob)));
  return { element, set: (value) => (input.checked = value) };
}

function choiceOf(knob, id, change) {
  const options = knob.choices.map((word) => h("option", { value: word }, word.replaceAll("_", " ")));
  const select = h("select", { id, onchange: () => change(select.value) }, options);
  const element = h("div", { class: "crz-row" }, h("label", { htmlFor: id }, knob.label, hint(knob)), select);
  return { element, set: (value) => (select.value = value) };
}

function sliderOf(knob, id, change) {
  const shown = h("output", { htmlFor: id });
  const show = () => {
    shown.textContent = words(Number(input.value));
    input.style.setProperty("--part", `${(100 * (input.value - knob.low)) / (knob.high - knob.low)}%`);
  };
  const input = h("input", { type: "range", id, min: knob.low, max: knob.high, step: knob.step, oninput: () => { show(); change(Number(input.value)); } });
  const element = h("div", { class: "crz-row crz-slider" }, h("label", { htmlFor: id }, knob.label, hint(knob)), shown, input);
  const set = (value) => {
    input.value = value;
    show();
  };
  return { element, set };
}

/** A number box that says beside itself what is wrong with its value. */
function boxOf(knob, id, change, more = {}) {
  const wrong = h("span", { class: "crz-wrong", role: "alert", id: `${id}-wrong` });
  const input = h("input", { type: "number", id, inputMode: "numeric", step: "any", "aria-describedby": `${id}-wrong`, ...more, oninput: () => check() });
  const check = () => {
    const value = Number(input.value);
    const fits = input.value.trim() !== "" && value >= knob.low && value <= knob.high && (knob.kind === "number" || Number.isInteger(value));
    wrong.textContent = fits ? "" : `${knob.low.toLocaleString("en")} to ${knob.high.toLocaleString("en")}${knob.kind === "number" ? "" : ", whole"}`;
    input.setAttribute("aria-invalid", String(!fits));
    if (fits) change(value);
  };
  const set = (value) => {
    input.value = value;
    wrong.textContent = "";
    input.setAttribute("aria-invalid", "false");
  };
  return { input, wrong, set };
}

function countOf(knob, id, change) {
  if (knob.high - knob.low <= 20) return sliderOf(knob, id, change);
  const { input, wrong, set } = boxOf(knob, id, change);
  return { element: h("div", { class: "crz-row crz-box" }, h("label", { htmlFor: id }, knob.label, hint(knob)), input, wrong), set };
}

function seedOf(knob, id, change) {
  const whole = { ...knob, low: 0, high: Number.MAX_SAFE_INTEGER };
  const { input, wrong, set } = boxOf(whole, id, change);
  const roll = () => {
    const value = Math.floor(Math.random() * 100_000);
    set(value);
    change(value);
  };
  const dice = h("button", { type: "button", class: "crz-small", onclick: roll, "aria-label": "Another seed", title: "Another seed" }, "↻");
  return { element: h("div", { class: "crz-row crz-box" }, h("label", { htmlFor: id }, knob.label), h("span", { class: "crz-with" }, input, dice), wrong), set };
}

function optionalOf(knob, id, change) {
  const slider = sliderOf({ ...knob, kind: "number" }, id, change);
  const range = slider.element.querySelector("input");
  const own = h("input", { type: "checkbox", id: `${id}-own`, "aria-label": `Set ${knob.label.toLowerCase()} by hand`, onchange: () => {
    range.disabled = !own.checked;
    change(own.checked ? Number(range.value) : null);
  } });
  slider.element.prepend(own);
  slider.element.classList.add("crz-optional");
  const set = (value) => {
    own.checked = value !== null;
    range.disabled = value === null;
    slider.set(value ?? (knob.low + knob.high) / 2);
  };
  return { element: slider.element, set };
}

/** All knobs of a panel; `values` is changed in place. */
export function controls(knobs, values, changed) {
  const change = (name, value) => {
    values[name] = value;
    refresh();
    changed(name);
  };
  const made = knobs.map((knob) => control(knob, change));

  const refresh = () => made.forEach((one) => one.refresh(values));
  const set = () => {
    knobs.forEach((knob, i) => made[i].set(values[knob.name]));
    refresh();
  };
  set();
  const element = h("div", { class: "crz-knobs" });
  const folds = {};
  knobs.forEach(({ group }, i) => {
    if (group && !folds[group]) {
      folds[group] = h("div", { class: "crz-knobs" });
      element.append(h("details", { class: "crz-fold" }, h("summary", {}, group), folds[group]));
    }
    (folds[group] ?? element).append(made[i].element);
  });
  return { element, set };
}
