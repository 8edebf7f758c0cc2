// Light on a texture: the maps come from Python once, the light moves here. The sums are those of `crazing.shade`, but
// for its shadows: here a place that sees little of the sky sees little of the lamp.

const SKY = 0.32;
const MIRROR = 0.04;
/** Of the lamp that the most hidden place still sees. */
const HIDDEN = 0.35;

/** Bytes a pixel of the maps: colour, slopes in x and y, occlusion, roughness. */
export const PARTS = 7;

const LINEAR = Float32Array.from({ length: 256 }, (_, value) => (value <= 10 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4));
const SHOWN = Uint8ClampedArray.from({ length: 4097 }, (_, i) => 255 * (i <= 12 ? (i / 4096) * 12.92 : 1.055 * (i / 4096) ** (1 / 2.4) - 0.055));
const SLOPE = Float32Array.from({ length: 256 }, (_, value) => (value - 128) / 127);

/** What is mirrored at each angle to the middle of lamp and eye, for one byte of roughness; made when first asked for. */
const mirrors = [];
function mirror(rough) {
  const gloss = 2 / Math.max(rough / 255, 0.12) ** 4 - 2;
  mirrors[rough] ??= Float32Array.from({ length: 2049 }, (_, i) => ((MIRROR * (gloss + 2)) / 8) * (i / 2048) ** gloss);
  return mirrors[rough];
}

/** Where the lamp is, right, up and out: its side in degrees, 0 is the right, anticlockwise; and its height. */
export function lampAt({ side, high }) {
  const [azimuth, elevation] = [(side * Math.PI) / 180, (high * Math.PI) / 180];
  return [Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation)];
}

/** Puts `lamp` on the pixels from `first` to `last` of the maps, into RGBA. */
export function shine(maps, lamp, out, first = 0, last = maps.length / PARTS) {
  const [x, y, z] = lampAt(lamp);
  const long = Math.hypot(x, y, z + 1);
  const [halfX, halfY, halfZ] = [x / long, y / long, (z + 1) / long];
  // A level place is as bright under every lamp.
  const level = (1 - SKY) / z;
  for (let i = first, from = PARTS * first, to = 4 * first; i < last; i += 1, from += PARTS, to += 4) {
    const slopeX = SLOPE[maps[from + 3]];
    const slopeY = SLOPE[maps[from + 4]];
    const up = Math.sqrt(Math.max(0, 1 - slopeX * slopeX - slopeY * slopeY));
    const open = maps[from + 5] / 255;
    const facing = Math.max(0, slopeX * x + slopeY * y + up * z) * (HIDDEN + (1 - HIDDEN) * open);
    const half = Math.max(0, Math.min(1, slopeX * halfX + slopeY * halfY + up * halfZ));
    const light = SKY * open + level * facing;
    const glint = mirror(maps[from + 6])[(2048 * half) | 0] * facing;
    for (let part = 0; part < 3; part += 1) {
      out[to + part] = SHOWN[Math.min(4096, ((LINEAR[maps[from + part]] * light + glint) * 4096 + 0.5) | 0)];
    }
    out[to + 3] = 255;
  }
}
