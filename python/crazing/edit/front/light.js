// Light on a texture: the maps come from Python once, the light moves here.

/** How much light is everywhere, how much comes from the lamp, and how bright its reflection is. */
const [AMBIENT, LAMP, GLOSS] = [0.42, 0.78, 0.32];

const LINEAR = Float32Array.from({ length: 256 }, (_, value) => (value / 255) ** 2.2);
const SHOWN = Uint8ClampedArray.from({ length: 4097 }, (_, value) => 255 * (value / 4096) ** (1 / 2.2));

/** The maps under a lamp: from which side (degrees, 0 is the right, anticlockwise), and how high (degrees). */
export function lit(maps, width, height, side, high) {
  const picture = new ImageData(width, height);
  const out = picture.data;
  const [azimuth, elevation] = [(side * Math.PI) / 180, (high * Math.PI) / 180];
  const [x, y, z] = [Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation)];
  // Halfway between lamp and eye, which looks straight down.
  const long = Math.hypot(x, y, z + 1);
  const [halfX, halfY, halfZ] = [x / long, y / long, (z + 1) / long];
  // A level place is as bright under every lamp.
  const level = 1 / (AMBIENT + LAMP * z);
  for (let i = 0, from = 0, to = 0; i < width * height; i += 1, from += 7, to += 4) {
    const slopeX = (maps[from + 3] - 128) / 127;
    const slopeY = (maps[from + 4] - 128) / 127;
    const up = Math.sqrt(Math.max(0, 1 - slopeX * slopeX - slopeY * slopeY));
    const open = maps[from + 5] / 255;
    const facing = Math.max(0, slopeX * x + slopeY * y + up * z);
    const smooth = 1 - maps[from + 6] / 255;
    let shine = Math.max(0, slopeX * halfX + slopeY * halfY + up * halfZ);
    shine = smooth > 0.04 ? GLOSS * smooth * shine ** (4 + 90 * smooth * smooth) * open : 0;
    const light = (AMBIENT * open + LAMP * facing * (0.35 + 0.65 * open)) * level;
    for (let part = 0; part < 3; part += 1) {
      const value = LINEAR[maps[from + part]] * light + shine * (1 - AMBIENT);
      out[to + part] = SHOWN[Math.min(4096, (value * 4096) | 0)];
    }
    out[to + 3] = 255;
  }
  return picture;
}
