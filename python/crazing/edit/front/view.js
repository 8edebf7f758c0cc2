// Where data lies on the screen. y points up in data, down on the screen.

const SMALLEST = 1e-12;
const LARGEST = 1e12;

export class View {
  constructor() {
    this.width = 1;
    this.height = 1;
    // Pixels a unit, and the data point in the middle.
    this.scale = 400;
    this.x = 0.5;
    this.y = 0.5;
  }

  resize(width, height) {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
  }

  toScreen(x, y) {
    return [(x - this.x) * this.scale + this.width / 2, (this.y - y) * this.scale + this.height / 2];
  }

  toData(left, top) {
    return [(left - this.width / 2) / this.scale + this.x, this.y - (top - this.height / 2) / this.scale];
  }

  pan(left, top) {
    this.x -= left / this.scale;
    this.y += top / this.scale;
  }

  /** Zooms by a factor; what is at (left, top) stays there. */
  zoom(factor, left = this.width / 2, top = this.height / 2) {
    const [x, y] = this.toData(left, top);
    const across = Math.max(Math.abs(this.x), Math.abs(this.y), SMALLEST);
    // Beyond this, neighbouring pixels would be the same number.
    this.scale = Math.min(Math.max(this.scale * factor, SMALLEST), Math.min(LARGEST, 1e13 / across));
    const [newX, newY] = this.toData(left, top);
    this.x += x - newX;
    this.y += y - newY;
  }

  /** Shows a box of data, with a margin. */
  fit([left, low, right, high], margin = 0.12) {
    const wide = right - left || 1;
    const tall = high - low || (right - left || 1);
    this.x = (left + right) / 2;
    this.y = (low + high) / 2;
    this.scale = Math.min(this.width / wide, this.height / tall) / (1 + 2 * margin);
  }

  /** The grid's step: 1, 2 or 5 times a power of ten, some 28 pixels or more. */
  step(pixels = 28) {
    const least = pixels / this.scale;
    const power = 10 ** Math.floor(Math.log10(least));
    const factor = [1, 2, 5, 10].find((part) => part * power >= least * 0.999_999);
    return Number((factor * power).toPrecision(1));
  }

  /** The nearest crossing of the grid, as a short decimal. */
  snapped(x, y) {
    const step = this.step();
    return [x, y].map((value) => Number((Math.round(value / step) * step).toPrecision(12)) + 0);
  }
}
