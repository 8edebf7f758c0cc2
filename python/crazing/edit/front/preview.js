// The picture of a crack: while something moves as large as can be made in time, at rest as large as it is seen, a few
// rows at a time, so that whoever begins to move something does not wait for it.

import { numbers } from "./wire.js";
import { PARTS, shine } from "./light.js";

/** Most pixels of a picture at rest. */
const RESTING = 2_500_000;
/** Pixels while something moves, and milliseconds from the question to the picture. */
const MOVING = { first: 100_000, least: 25_000, most: 800_000, milliseconds: 62 };
/** Milliseconds that a few rows may take, and most pieces: what every piece takes, however small, adds up. */
const PIECE = { milliseconds: 50, most: 8 };

export class Preview {
  /** `held()` tells whether the pointer is down: then nothing large is begun. `fail(error)` is told what went wrong. */
  constructor(wire, view, scene, lamp, held, fail) {
    Object.assign(this, { wire, view, scene, lamp, held, fail, pixels: MOVING.first, task: null, maps: null, whole: null });
  }

  /** What Python is asked for. */
  wish(resting) {
    const { view } = this;
    const [left, high] = view.toData(0, 0);
    const [right, low] = view.toData(view.width, view.height);
    return { scale: view.scale * (window.devicePixelRatio || 1), view: [left, low, right, high], pixels: Math.round(resting ? RESTING : this.pixels) };
  }

  /** Whether all that is seen of the crack is in the picture. */
  get covers() {
    const { preview, view } = this.scene;
    if (!preview) return false;
    const [left, high] = view.toData(0, 0);
    const [right, low] = view.toData(view.width, view.height);
    const [a, b] = [preview.bounds, this.whole];
    const little = 1.5 / view.scale;
    return Math.max(left, b[0]) >= a[0] - little && Math.max(low, b[1]) >= a[1] - little && Math.min(right, b[2]) <= a[2] + little && Math.min(high, b[3]) <= a[3] + little;
  }

  /** Takes the picture of an answer, or none; one that is left for later comes when it is there. */
  take(answer, asked) {
    this.task = null;
    const { preview } = answer;
    if (!preview) {
      Object.assign(this, { maps: null, whole: null });
      this.scene.preview = null;
      return;
    }
    this.whole = preview.whole;
    if (preview.later) {
      this.#refine(preview);
      return;
    }
    const before = performance.now();
    this.maps = { ...preview, pixels: numbers(answer.buffers.at(-1), Uint8ClampedArray) };
    this.light();
    this.#learn(preview.width * preview.height, performance.now() - before + answer.drawing, performance.now() - asked);
  }

  /** Nothing of a large picture is asked for any more. */
  stop() {
    this.task = null;
  }

  /** Time goes with pixels, but for what every answer takes. Half the step at once: one slow answer is no rule. */
  #learn(pixels, drawing, all) {
    const room = Math.max(MOVING.milliseconds - (all - drawing), MOVING.milliseconds / 5);
    const wanted = (pixels * room) / Math.max(drawing, 1);
    this.pixels = Math.min(MOVING.most, Math.max(MOVING.least, Math.sqrt(this.pixels * wanted)));
  }

  async #refine(preview) {
    const task = (this.task = {});
    const { width, height, kind } = preview;
    const pixels = new Uint8ClampedArray(width * height * (kind === "ink" ? 4 : PARTS));
    const picture = new ImageData(width, height);
    const least = Math.ceil(height / PIECE.most);
    let count = Math.min(height, Math.max(least, Math.round(this.pixels / 2 / width)));
    for (let top = 0; top < height; ) {
      while (this.held() && this.task === task) await new Promise((resolve) => setTimeout(resolve, 60));
      if (this.task !== task) return;
      const start = performance.now();
      const answer = await this.wire.ask({ kind: "rows", top, count }).catch((error) => error);
      if (this.task !== task) return;
      if (answer instanceof Error) {
        this.task = null;
        this.fail(answer);
        return;
      }
      const part = numbers(answer.buffers[0], Uint8ClampedArray);
      pixels.set(part, (pixels.length / height) * top);
      if (kind === "ink") picture.data.set(part, 4 * width * top);
      else shine(pixels, this.lamp, picture.data, width * top, width * (top + count));
      top += count;
      const fitting = Math.round((count * PIECE.milliseconds) / Math.max(1, performance.now() - start));
      count = Math.min(height - top, Math.max(least, Math.min(2 * count, fitting)));
    }
    this.task = null;
    this.maps = { ...preview, pixels };
    this.#show(picture);
  }

  /** The picture as it lies under the lamp. */
  light() {
    const { maps } = this;
    if (!maps) return;
    const picture = new ImageData(maps.width, maps.height);
    if (maps.kind === "ink") picture.data.set(maps.pixels);
    else shine(maps.pixels, this.lamp, picture.data);
    this.#show(picture);
  }

  #show(picture) {
    const { bounds, ink, resolved } = this.maps;
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    canvas.getContext("2d").putImageData(picture, 0, 0);
    this.scene.preview = { image: canvas, bounds, resolved, ink: `rgb(${ink.join()})` };
    this.scene.invalidate();
  }
}
