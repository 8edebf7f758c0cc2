// Elements in one line each, icons, and words for those who listen instead of looking.

/** An element: properties, `class`, `aria-*`, `data-*` and `role` by name, `on*` as listeners, then its children. */
export function h(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name in element && !name.includes("-") && name !== "list") element[name] = value;
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

const PATHS = {
  draw: "M4 20l1-5L16 4l4 4L9 19zM13.5 6.5l4 4",
  select: "M4 4h4M12 4h4M4 4v4M4 12v4M20 8V4h-4M20 12v2M4 20h4M12 12l8 3-3.4 1.6L15 20z",
  curve: "M3 17c4 0 4-10 9-10s3 10 9 6",
  pan: "M8 13V6.5a1.5 1.5 0 013 0V11V4.5a1.5 1.5 0 013 0V11V6a1.5 1.5 0 013 0v8c0 4-2 6.500-5.500 6.500S8.500 18 6 15.500c-1-1-1.500-2-.5-2.500s2 .5 2.500 1.500",
  undo: "M8 5L4 9l4 4M4 9h9a6 6 0 010 12h-3",
  redo: "M16 5l4 4-4 4M20 9h-9a6 6 0 000 12h3",
  snap: "M4 4h16v16H4zM4 12h16M12 4v16",
  sun: "M12 8a4 4 0 100 8 4 4 0 000-8zM12 2v3M12 19v3M2 12h3M19 12h3M5 5l2 2M17 17l2 2M19 5l-2 2M7 17l-2 2",
  moon: "M20 14A8 8 0 1110 4a7 7 0 0010 10z",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  trash: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13",
  open: "M4 19V5h6l2 3h8v11z",
  picture: "M4 5h16v14H4zM4 16l5-5 4 4 3-3 4 4M15 9h.01",
  dice: "M5 5h14v14H5zM9 9h.01M15 15h.01M15 9h.01M9 15h.01M12 12h.01",
  copy: "M9 9h11v11H9zM5 15H4V4h11v1",
  help: "M9 9a3 3 0 114 3c-1 .5-1 1-1 2M12 18h.01M12 3a9 9 0 100 18 9 9 0 000-18z",
};

/** A line drawing of 24 units, for the eye only. */
export function icon(name) {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  const path = document.createElementNS(space, "path");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  svg.setAttribute("class", "crz-icon");
  path.setAttribute("d", PATHS[name]);
  svg.append(path);
  return svg;
}

/** A button that shows an icon; its words are its label and its tip. */
export function iconButton(name, label, action, more = {}) {
  return h("button", { type: "button", class: "crz-tool", "aria-label": label, title: label, onclick: action, ...more }, icon(name));
}

let numbered = 0;

/** A name for an element that no other has, in any notebook cell. */
export function unique(word) {
  numbered += 1;
  return `crz-${word}-${numbered}`;
}

/** Gives the browser a file to keep. */
export function download(name, parts, kind) {
  const address = URL.createObjectURL(new Blob(parts, { type: kind }));
  const link = h("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** A number for people: four digits that mean something. */
export function words(value) {
  if (value === null) return "–";
  if (Number.isInteger(value)) return value.toLocaleString("en");
  return Number(value.toPrecision(4)).toString();
}
