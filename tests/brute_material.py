"""Height, normal, occlusion and colours by brute force, from the words of `crazing.Material`; see `brute_texture`."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray

import crazing as cz
from brute_texture import Brute, Floats

#: Purposes of random numbers, and kinds of noise.
_GRAIN, _PLATE = 40, 41
_KINDS = {"grain": (0, 2), "mottle": (1, 3), "chip": (2, 2)}

_LENGTHS = ("relief", "chip_size", "curl_width", "grain_size", "mottle_size", "dirt_width", "wear_width")


def philox(key: tuple[int, int], counter: tuple[int, int, int, int]) -> NDArray[np.uint64]:
    """Four random words; NumPy's generator counts before it draws."""
    whole = sum((word & (2**64 - 1)) << (64 * place) for place, word in enumerate(counter))
    before = (whole - 1) % 2**256
    words = np.array([before >> (64 * place) & (2**64 - 1) for place in range(4)], dtype=np.uint64)
    return np.random.Philox(counter=words, key=np.array(key, dtype=np.uint64)).random_raw(4)


def key_of(seed: int) -> tuple[int, int]:
    low, high = np.random.default_rng(seed).bit_generator.random_raw(2)
    return int(low), int(high)


def ease(t: Floats) -> Floats:
    return t**3 * (6 * t**2 - 15 * t + 10)


def linear(color: Any) -> Floats:
    value = np.asarray(color) / 255
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def srgb(light: Floats) -> Floats:
    return 255 * np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)


class Ground:
    """A crack in a material, seen from the middles of pixels or beside them.

    `cell` is the map of that name, `plates` for each of its numbers the plate's middle and reach, data units, where
    plates tilt.
    """

    def __init__(
        self,
        crack: Any,
        size: tuple[int, int],
        material: cz.Material,
        seed: int,
        cell: NDArray[np.int32],
        plates: dict[int, tuple[Floats, float]] | None = None,
        beside: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        self.brute, self.crack, self.key, self.beside = Brute(crack, size, None, beside), crack, key_of(seed), beside
        scale = self.brute.scale
        vectors = self.brute.ends[:, 1] - self.brute.ends[:, 0]
        sides, length = (np.array(crack.bounds[2:]) - crack.bounds[:2]) * scale, np.hypot(*vectors.T).sum()
        self.plate_size = 2 * sides.prod() / length if length else sides.max()
        self.widest = float(np.quantile(crack.width, 0.95)) * scale
        lengths = {name: getattr(material, name) * self.plate_size for name in _LENGTHS}
        widths = {name: getattr(material, name) * self.widest for name in ("rim_width", "chip")}
        self.m: Any = type("M", (), {**dataclasses.asdict(material), **lengths, **widths})
        self.cell, self.plates = cell, plates or {}
        self.noise = {name: self._noise(name) for name in _KINDS}
        self.chip = self.m.chip * np.clip(self.noise["chip"], 0, 1) ** 2
        self.top = max(0.0, 1 - (max(self.m.curl, 0) + self.m.tilt + self.m.level + self.m.grain))
        self._carve()

    def _noise(self, name: str) -> Floats:
        """Octaves that are always there, and those whose lattice is no finer than two pixels."""
        (kind, count), found = _KINDS[name], np.zeros(self.brute.shape)
        pitch = getattr(self.m, f"{name}_size") * 4 / 3
        if pitch <= 0:
            return found
        stretch = 1.0 if name == "chip" else self.m.stretch
        times = np.maximum((1 / stretch, stretch), 1)
        for octave in range(16):
            part = 0.5**octave
            if octave < count or pitch * part >= 2:
                weight = part / (2 - 0.5 ** (count - 1))
                found += weight * self._octave(16 * kind + octave, max(1.0, pitch * part) * times)
        return found

    def _octave(self, stream: int, pitch: Floats) -> Floats:
        height, width = self.brute.shape
        first = self.brute.ends[0, 0] if len(self.brute.ends) else np.zeros(2)
        pin = np.floor([first[0] + width / 2, height / 2 - first[1]])
        places, steps = [], []
        for axis, count in enumerate((width, height)):
            pixel = np.arange(count) - pin[axis]
            rate, step = 1 / pitch[axis], 0
            if self.brute.period is not None:
                period = round(self.brute.period[axis])
                step = max(1, round(period / pitch[axis]))
                pixel, rate = pixel % period, step / period
            shift = stream * (0.6180339887498949, 0.7548776662466927)[axis] % 1
            places.append((pixel + 0.5 + (self.beside[0], -self.beside[1])[axis]) * rate + shift)
            steps.append(step)
        (i, j), (x, y) = (np.floor(at).astype(int) for at in places), (at - np.floor(at) for at in places)
        planes = self._lattice(stream, i.min(), j.min(), i.max() + 2, j.max() + 2, steps)
        i, j, y = i - i.min(), (j - j.min())[:, None], y[:, None]

        def plane(down: int, right: int) -> Floats:
            height, across, along = np.moveaxis(planes[j + down, i + right], -1, 0)
            return height + across * (x - right) + along * (y - down)

        above, below = (plane(down, 0) * (1 - ease(x)) + plane(down, 1) * ease(x) for down in (0, 1))
        return above * (1 - ease(y)) + below * ease(y)

    def _lattice(self, stream: int, left: int, top: int, right: int, bottom: int, steps: list[int]) -> Floats:
        """Height and slopes at lattice points from left to right, row by row; they come round after so many steps."""
        columns, rows = (
            np.arange(first, last) % step if step else np.arange(first, last)
            for first, last, step in ((left, right, steps[0]), (top, bottom, steps[1]))
        )
        found = np.empty((len(rows), len(columns), 3))
        for place, row in enumerate(rows):
            for group in np.unique(columns // 8):
                words = philox(self.key, (int(group), int(row), _GRAIN, stream)).astype("<u8").view("<u4").astype(int)
                own = columns // 8 == group
                bits = words[columns[own] % 8, None] >> np.array([0, 10, 20]) & 1023
                found[place, own] = np.array([0.7, 1.6, 1.6]) * ((bits + 0.5) / 512 - 1)
        return found

    def _own(self, number: int) -> tuple[float, float, Floats, float]:
        """Tint, level, tilt and curl of a plate."""
        words = philox(self.key, (number, 0, _PLATE, 0))
        tint, level, x, y, curl = (
            2 * ((int(word) >> shift & 0xFFFFFFFF) + 0.5 / 2**20) / 2**32 - 1
            for word, shift in ((words[0], 0), (words[0], 32), (words[1], 0), (words[1], 32), (words[2], 0))
        )
        return tint, level, np.array([x, y]) / max(1.0, float(np.hypot(x, y))), 0.5 + 0.5 * curl

    def _per_plate(self) -> tuple[Floats, Floats, Floats]:
        """Tint, rise and curl at every pixel."""
        tint, rise, curl = (np.zeros(self.brute.shape) for _ in range(3))
        for number in np.unique(self.cell):
            on, own = self.cell == number, self._own(int(number))
            tint[on], rise[on], curl[on] = (
                own[0],
                self.m.level * own[1],
                self.m.curl * (1 - self.m.curl_spread * own[3]),
            )
            if self.m.tilt and number in self.plates:
                middle, reach = self.plates[number]
                x, y = (self.brute.x - middle[0])[None, :], (self.brute.y - middle[1])[:, None]
                rise += np.where(on, self.m.tilt * (x * own[2][0] + y * own[2][1]) / reach, 0)
        return tint, rise, curl

    def _carve(self) -> None:
        """Height and occlusion above the nearest edge."""
        m, brute = self.m, self.brute
        self.tint, rise, curl = self._per_plate()
        bare, radius = brute.nearest[:2]
        chipped = bare - self.chip
        frayed = m.fray * radius * np.clip(0.5 + self.noise["grain"], 0, 1)
        self.distance = chipped - np.maximum(frayed - 0.5 * np.maximum(chipped, 0), 0)
        near, bent = (
            np.clip(1 - np.maximum(self.distance, 0) / width, 0, None) if width else np.zeros(brute.shape)
            for width in (m.rim_width, m.curl_width)
        )
        height = self.top + rise - m.rim * near**2 + curl * bent**2
        # Chips reach beyond the middle of thin cracks.
        u = np.divide(-self.distance, radius, out=np.ones(radius.shape), where=np.abs(self.distance) < radius)
        wall = (1 - m.roundness) * u + m.roundness * (1 - (1 - u) ** 4)
        share = np.minimum(radius / (self.widest / 2), 1) if self.widest else np.ones(u.shape)
        floor = self.top - min(m.depth, max(self.top - m.grain, 0)) * np.sqrt(share)
        height = np.where(self.distance < 0, height + (floor - height) * wall, height)
        self.ao = self._sky(self.distance, radius, height, rise)
        self.height = np.clip(height + m.grain * self.noise["grain"], 0, 1)
        if m.tilt == m.level == m.grain == m.fray == m.curl * m.curl_spread == 0:
            # Of plates that are all alike nothing is raised beyond this.
            reach = max(m.rim_width * (m.rim != 0), m.curl_width * (m.curl != 0)) + m.chip
            self.height[bare >= reach], self.ao[bare >= reach] = self.top, 1

    def _sky(self, distance: Floats, radius: Floats, height: Floats, rise: Floats) -> Floats:
        near, below = self.m.rim_width - distance, (self.top + rise - height) * self.m.relief
        far = np.maximum(2 * (radius + self.m.rim_width) - near, near)
        seen = [at / np.maximum(np.hypot(at, below), 1e-300) for at in (near, far)]
        return np.where((near > 0) & (below > 0), (seen[0] + seen[1]) / 2, 1)

    def crack_share(self) -> Floats:
        """How much of a pixel is crack, chips and frayed sides included."""
        covered = self.brute.coverage()
        return np.maximum(covered, np.clip(0.5 - self.distance, 0, 1)) if self.m.chip or self.m.fray else covered

    def wear(self) -> Floats:
        near = np.clip(1 - np.maximum(self.distance, 0) / self.m.wear_width, 0, 1) if self.m.wear_width else 0.0
        return self.m.wear * near**2 * np.clip(0.5 + 0.5 * self.noise["mottle"], 0, 1) * (1 - self.crack_share())

    def roughness(self) -> Floats:
        plate = self.m.roughness + self.m.roughness_spread / 2 * (self.noise["grain"] + self.noise["mottle"])
        return np.clip(plate + (self.m.crack_roughness - plate) * self.crack_share(), 0, 1)

    def color(self) -> Floats:
        """sRGB, 0 to 255."""
        m, mottle, grain = self.m, self.noise["mottle"], self.noise["grain"]

        def mix(first: Floats, second: Floats, part: Floats) -> Floats:
            return first + (second - first) * np.clip(part, 0, 1)[..., None]

        at = np.clip(0.5 + 0.5 * (m.tint * self.tint + m.mottle * mottle + m.speckle * grain), 0, 1)
        ramp = linear(m.plate)
        steps = np.linspace(0, 1, len(ramp))
        light = np.stack([np.interp(at, steps, ramp[:, channel]) for channel in range(3)], axis=-1)
        near = np.clip(1 - np.maximum(self.distance, 0) / m.dirt_width, 0, 1) if m.dirt_width else np.zeros(at.shape)
        light = mix(light, linear(m.dirt), m.dirt_amount * near**2 * (0.75 + 0.5 * mottle))
        light = mix(light, linear(m.worn), self.wear())
        floor = mix(linear(m.crack), linear(m.dirt), m.debris * (0.5 + grain + 0.5 * mottle))
        return srgb(mix(light, floor, self.crack_share()))
