// Questions to Python and their answers, over the model of whichever host this runs in.

export class Wire {
  constructor(model) {
    this.model = model;
    this.serial = 0;
    this.waiting = new Map();
    model.on("msg:custom", (content, buffers) => this.#arrived(content, buffers));
  }

  #arrived(content, buffers) {
    const asker = this.waiting.get(content.serial);
    if (!asker) return;
    this.waiting.delete(content.serial);
    if (content.kind === "error") asker.reject(new Error(content.message));
    else asker.resolve({ ...content, buffers: buffers ?? [] });
  }

  /** The answer to a question; an error of Python's is one here. */
  ask(content, buffers = []) {
    this.serial += 1;
    const serial = this.serial;
    return new Promise((resolve, reject) => {
      this.waiting.set(serial, { resolve, reject });
      this.model.send({ ...content, serial }, undefined, buffers);
    });
  }

  /** Nobody will answer what was asked so far. */
  forget(reason) {
    for (const { reject } of this.waiting.values()) reject(new Error(reason));
    this.waiting.clear();
  }
}

/** Asks again and again while something changes, one question at a time, the last state always asked. */
export class Live {
  constructor(ask, show, fail) {
    Object.assign(this, { ask, show, fail, wanted: false, busy: false });
  }

  async poke() {
    this.wanted = true;
    if (this.busy) return;
    this.busy = true;
    while (this.wanted) {
      this.wanted = false;
      try {
        this.show(await this.ask());
      } catch (error) {
        this.fail(error);
      }
    }
    this.busy = false;
  }
}

/** A binary part as numbers; hosts give it at any offset, so it is copied where it must be. */
export function numbers(part, Kind) {
  const view = part instanceof DataView ? part : new DataView(part);
  const bytes = new Uint8Array(view.buffer, view.byteOffset, view.byteLength);
  return new Kind(bytes.slice().buffer);
}
