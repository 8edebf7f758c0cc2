// The page's own host: the model that anywidget would give, over one socket.

import editor from "/editor.js";

class Model {
  constructor() {
    this.values = new Map();
    this.listeners = new Map();
    this.unsent = [];
    this.#open();
  }

  #open() {
    this.socket = new WebSocket(`ws://${location.host}/socket`);
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("open", () => {
      document.documentElement.classList.remove("lost");
      this.unsent.splice(0).forEach((frame) => this.socket.send(frame));
    });
    this.socket.addEventListener("message", ({ data }) => this.#tell("msg:custom", ...unpacked(data)));
    this.socket.addEventListener("close", () => {
      document.documentElement.classList.add("lost");
      setTimeout(() => this.#open(), 1500);
    });
  }

  #tell(name, ...parts) {
    for (const listener of this.listeners.get(name) ?? []) listener(...parts);
  }

  get(name) {
    return this.values.get(name);
  }

  set(name, value) {
    this.values.set(name, value);
  }

  save_changes() {}

  on(name, listener) {
    this.listeners.set(name, [...(this.listeners.get(name) ?? []), listener]);
  }

  off(name, listener) {
    this.listeners.set(name, (this.listeners.get(name) ?? []).filter((one) => one !== listener));
  }

  send(content, callbacks, buffers = []) {
    const frame = packed(content, buffers);
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(frame);
    else this.unsent.push(frame);
  }
}

/** See wire.py. */
function packed(content, buffers) {
  const head = new TextEncoder().encode(JSON.stringify({ content, sizes: buffers.map((part) => part.byteLength) }));
  const starts = [];
  let length = 4 + head.length;
  for (const part of buffers) {
    length += -length & 7;
    starts.push(length);
    length += part.byteLength;
  }
  const frame = new Uint8Array(length + (-length & 7));
  new DataView(frame.buffer).setUint32(0, head.length, true);
  frame.set(head, 4);
  buffers.forEach((part, i) => frame.set(new Uint8Array(part.buffer ?? part, part.byteOffset ?? 0, part.byteLength), starts[i]));
  return frame;
}

function unpacked(frame) {
  const length = new DataView(frame).getUint32(0, true);
  const { content, sizes } = JSON.parse(new TextDecoder().decode(new Uint8Array(frame, 4, length)));
  let at = 4 + length;
  const buffers = sizes.map((size) => {
    at += -at & 7;
    at += size;
    return new DataView(frame, at - size, size);
  });
  return [content, buffers];
}

// The token has done its work; it need not stand in the address any longer.
history.replaceState(null, "", "/");
editor.render({ model: new Model(), el: document.getElementById("editor") });
