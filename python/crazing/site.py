"""Where a recipe is carried out: bounds or torus, source, density; and the plates it starts from."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, sample, steps
from crazing.arguments import areal, bounds_tuple, number, points_array, real_array
from crazing.diagram import Diagram, as_tiling, bounds_of
from crazing.errors import CrazingError
from crazing.fence import fenced, fenced_torus
from crazing.images import brightness
from crazing.maze import maze
from crazing.patches import Patches

if TYPE_CHECKING:
    from crazing.recipe import Recipe

#: Within this part of the smaller side of the bounds about the source plates are finest.
CORE = 0.125
#: Pixels of the longer side of a density, and of a patch, as long as that asks for no more than the most.
PIXELS, A_PATCH, MOST_PIXELS = 192, 6, 2048
#: A Poisson-disk sample of radius r holds about this many points in an area of r * r.
PACKED = 0.7

_Bounds = tuple[float, float, float, float]


@dataclass(frozen=True)
class Site:
    """One place and one recipe.

    Attributes
    ----------
    recipe : Recipe
    bounds : (xmin, ymin, xmax, ymax) or None
        None where they follow from points.
    period : (width, height) or None
    source : (x, y) or None
    density : array_like, callable or None
    """

    recipe: Recipe
    bounds: _Bounds | None
    period: tuple[float, float] | None
    source: Any
    density: Any

    def centre(self, bounds: _Bounds) -> tuple[tuple[float, float], float]:
        """The source, by default the middle, and the smaller side of the bounds."""
        xmin, ymin, xmax, ymax = bounds
        side = min(xmax - xmin, ymax - ymin)
        if self.source is None:
            return (xmin / 2 + xmax / 2, ymin / 2 + ymax / 2), side
        parts = real_array(self.source, "source")
        if parts.shape != (2,):
            raise ValueError(f"source has shape {parts.shape}; (x, y) is wanted")
        return (number(parts[0], "source[0]"), number(parts[1], "source[1]")), side

    def aged(self, seed: np.random.Generator) -> tuple[steps.Drawing, float]:
        """Cracks that know their age, and the spacing of their plates."""
        assert self.bounds is not None  # Only points leave them open, and these generators take none.
        r, box = self.recipe, self.bounds
        where = {"bounds": box} if self.period is None else {"period": self.period}
        if r.generator == "impact":
            (x, y), _ = self.centre(box)
            drawing = steps.impact(r.n, source=(x, y), speed=r.speed, arcs=r.arcs, rng=seed, **where)
            wide, high = box[2] - box[0], box[3] - box[1]
            of_torus = self.period is not None
            fence = fenced_torus(drawing.net, (x - wide / 2, y - high / 2)) if of_torus else fenced(drawing.net, box)
            drawing = replace(drawing, fence=fence)
        else:
            drawing = steps.split(
                r.n,
                jitter=r.jitter,
                bend=r.bend,
                anisotropy=r.anisotropy,
                angle=r.angle,
                density=None if self.is_even else (self._pixels(Frame.of(box, 1.0, 0.0), seed), box),
                rng=seed,
                **where,
            )
        return drawing, _unit((box[2] - box[0]) * (box[3] - box[1]), r.n)

    def maze(self, points: ArrayLike | Diagram | None, seed: np.random.Generator) -> tuple[steps.Drawing, float]:
        """The walls of a maze, and the spacing of its plates."""
        r = self.recipe
        if r.anisotropy != 1:
            return self._stretched(points, seed)
        if points is None:
            assert self.bounds is not None
            points = self._plates(Frame.of(self.bounds, 1.0, 0.0), seed)
        elif r.relax:
            points = self._relaxed(points)
        diagram = as_tiling(points, self.period)
        if diagram.period is None:
            return steps.carved(diagram, r.tree, r.opening, bounds_of(diagram, self.bounds, closely=True), seed)
        bounds = None if self.period is not None else bounds_of(diagram, self.bounds, closely=True)
        return steps.walls(maze(diagram, tree=r.tree, opening=r.opening, bounds=bounds, rng=seed)), _spacing(diagram)

    def _relaxed(self, points: ArrayLike | Diagram) -> NDArray[np.float64]:
        rows = points_array(points)
        box = self.bounds
        if box is None:
            low, high = rows.min(axis=0, initial=np.inf), rows.max(axis=0, initial=-np.inf)
            if not (low < high).all():
                # No plates on a line or in a place; what is no number is named by its row later.
                return rows
            box = areal(bounds_tuple((*low, *high), "the box around the points"), "the box around the points")
        return sample.relax(rows, iterations=self.recipe.relax, bounds=box, period=self.period)

    def _stretched(self, points: ArrayLike | Diagram | None, seed: np.random.Generator) -> tuple[steps.Drawing, float]:
        """A maze carved where its plates are as long as wide, and stretched."""
        r = self.recipe
        bounds = self.bounds
        if bounds is None:
            closely = bounds_of(as_tiling(points_array(points), None), None, closely=True)
            bounds = areal(closely, "the box around the points")
        # A period that is turned by anything but quarters is none.
        angle = r.angle if self.period is None else 90.0 * round(r.angle / 90)
        frame = Frame.of(bounds, r.anisotropy, angle)
        if points is None:
            inner = self._plates(frame, seed)
        else:
            rows = points_array(points)
            inner = self._evened((rows - frame.centre) @ np.linalg.inv(frame.matrix).T, frame)
        if self.period is None:
            stretch = frame.matrix, frame.centre, bounds
            return steps.carved(as_tiling(inner, None), r.tree, r.opening, frame.box, seed, stretch)
        period = (frame.box[2] - frame.box[0], frame.box[3] - frame.box[1])
        diagram = as_tiling(inner - np.array(frame.box[:2]), period)
        carved = maze(diagram, tree=r.tree, opening=r.opening, rng=seed)
        # On a torus the frame's corner is its origin; wherever it lands, vertices are wrapped in the end.
        centre = frame.matrix @ np.array(frame.box[:2]) + frame.centre
        return steps.stretched(carved, frame.matrix, centre, bounds), _spacing(diagram)

    def _plates(self, frame: Frame, seed: np.random.Generator) -> NDArray[np.float64]:
        """Points of the recipe's own sampler, in a frame."""
        r, box = self.recipe, frame.box
        area = (box[2] - box[0]) * (box[3] - box[1])
        n = round(r.n * area / frame.area)
        if r.sampler in ("normal", "laplace"):
            (x, y), side = self.centre(frame.bounds)
            draw = sample.normal if r.sampler == "normal" else sample.laplace
            middle = np.linalg.inv(frame.matrix) @ (np.array((x, y)) - frame.centre)
            points = draw(n, loc=middle, scale=side / 8, rng=seed)
        elif not self.is_even:
            points = sample.from_density(self._pixels(frame, seed), n, bounds=box, rng=seed)
        elif r.sampler == "poisson-disk":
            sides = (box[2] - box[0], box[3] - box[1])
            radius = float(np.sqrt(PACKED * area / max(n, 1)))
            torus = {"bounds": (0.0, 0.0, *sides)} if self.period is None else {"period": sides}
            points = sample.poisson_disk(radius, rng=seed, **torus) + box[:2]
        else:
            points = sample.uniform(n, bounds=box, rng=seed)
        return self._evened(points, frame)

    def _evened(self, points: NDArray[np.float64], frame: Frame) -> NDArray[np.float64]:
        """Points of a frame after the recipe's rounds of relaxation."""
        if not self.recipe.relax:
            return points
        box = frame.box
        period = None if self.period is None else (box[2] - box[0], box[3] - box[1])
        return sample.relax(points, iterations=self.recipe.relax, bounds=box, period=period)

    @property
    def is_even(self) -> bool:
        """Whether plates are as large everywhere."""
        return self.density is None and not self.recipe.falloff and not self.recipe.patchiness

    def _pixels(self, frame: Frame, seed: np.random.Generator) -> NDArray[np.float64]:
        """The density over a frame, row 0 at the top."""
        box = np.reshape(frame.box, (2, 2))
        across, high = box[1] - box[0]
        longer, patch = max(across, high), self.recipe.patch * _unit(frame.area, self.recipe.n)
        fine = PIXELS
        if self.recipe.patchiness:
            fine = min(max(PIXELS, round(A_PATCH * longer / patch)), MOST_PIXELS)
        columns, rows = (max(1, round(fine * side / longer)) for side in (across, high))
        u = box[0, 0] + across * (np.arange(columns) + 0.5) / columns
        v = box[1, 1] - high * (np.arange(rows) + 0.5) / rows
        places = np.stack(np.meshgrid(u, v), axis=-1) @ frame.matrix.T + frame.centre
        found = self._density_at(places, frame.bounds) * self._falloff_at(places, frame.bounds)
        if self.recipe.patchiness:
            field = Patches.of(patch, self.period, seed).over(u, v, frame.matrix, frame.centre)
            found = found * _steady(np.exp(self.recipe.patchiness * _steady(field)))
        if not found.any():
            raise CrazingError("density is 0 everywhere; a place where it is more is wanted")
        return np.ascontiguousarray(found)

    def _falloff_at(self, places: NDArray[np.float64], bounds: _Bounds) -> Any:
        (x, y), side = self.centre(bounds)
        apart = places - (x, y)
        if self.period is not None:
            apart = apart - np.rint(apart / self.period) * self.period
        return _steady((1 + (apart**2).sum(axis=-1) / (CORE * side) ** 2) ** -self.recipe.falloff)

    def _density_at(self, places: NDArray[np.float64], bounds: _Bounds) -> Any:
        if self.density is None:
            return 1.0
        if callable(self.density):
            return _everywhere(real_array(self.density(places[..., 0], places[..., 1]), "density"), places)
        image = brightness(self.density, "density")
        if image.min() < 0:
            row, column = np.unravel_index(int(image.argmin()), image.shape)
            raise CrazingError(f"density[{row}, {column}] is {image[row, column]}; no pixel may be negative")
        low, high = np.reshape(bounds, (2, 2))
        part = (places - low) / (high - low)
        part = part - np.floor(part) if self.period is not None else np.clip(part, 0, 1 - 1e-12)
        rows, columns = image.shape
        return image[rows - 1 - (part[..., 1] * rows).astype(int), (part[..., 0] * columns).astype(int)]


@dataclass(frozen=True, eq=False)
class Frame:
    """Where plates are as long as wide: `matrix` and `centre` map it to the bounds.

    Attributes
    ----------
    bounds, box : (xmin, ymin, xmax, ymax)
        In data units; and what holds all of it in the frame.
    matrix : (2, 2) float64
    centre : (2,) float64
    """

    bounds: _Bounds
    box: _Bounds
    matrix: NDArray[np.float64]
    centre: NDArray[np.float64]

    @classmethod
    def of(cls, bounds: _Bounds, anisotropy: float, angle: float) -> Frame:
        """The frame of an anisotropy along an angle in degrees."""
        if anisotropy == 1:
            return cls(bounds, bounds, np.eye(2), np.zeros(2))
        low, high = np.reshape(bounds, (2, 2))
        quarters = angle / 90
        turn = np.radians(angle)
        cos, sin = _steady(np.cos(turn)), _steady(np.sin(turn))
        if quarters == round(quarters):  # Exactly, so that a period stays one.
            cos, sin = ((1, 0), (0, 1), (-1, 0), (0, -1))[round(quarters) % 4]
        rotation = np.array([[cos, -sin], [sin, cos]], dtype=float)
        matrix = rotation * np.array([anisotropy**0.5, anisotropy**-0.5])
        centre = (low + high) / 2
        half = np.abs(np.linalg.inv(matrix)) @ ((high - low) / 2)
        return cls(bounds, (-half[0], -half[1], half[0], half[1]), matrix, centre)

    @property
    def area(self) -> float:
        """Of the bounds; the frame keeps areas."""
        return (self.bounds[2] - self.bounds[0]) * (self.bounds[3] - self.bounds[1])


def _everywhere(found: NDArray[np.float64], places: NDArray[np.float64]) -> NDArray[np.float64]:
    """What a function of x and y gave, one finite number a place."""
    shape = places.shape[:2]
    try:
        spread = np.broadcast_to(found, shape)
    except ValueError:
        raise ValueError(f"density gave shape {found.shape} for x and y of shape {shape}; one is wanted") from None
    bad = ~(np.isfinite(spread) & (spread >= 0))
    if bad.any():
        where = tuple(np.argwhere(bad)[0])
        raise CrazingError(
            f"density is {spread[where]} at {tuple(places[where].tolist())}; a finite number of at least 0 is wanted"
        )
    return spread


def _steady(values: Any) -> Any:
    """`values` without their last bits, in which platforms differ."""
    return np.rint(np.asarray(values) * 2.0**40) / 2.0**40


def _unit(area: float, n: int) -> float:
    """The spacing of `n` plates on an area."""
    return float(np.sqrt(area / max(n, 1)))


def _spacing(diagram: Diagram) -> float:
    """The median length of the Delaunay edges on a torus: the mean would follow far outliers."""
    assert diagram.period is not None  # In the plane it comes with the walls.
    return _core.crack_spacing(diagram.sites, diagram.edges, np.ascontiguousarray(diagram.shifts), diagram.period)
