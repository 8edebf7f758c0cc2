"""Textures: aligned maps of a crack pattern."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, arguments, files, provenance
from crazing import rng as _rng
from crazing.errors import CrazingError
from crazing.material import Material, in_data_units, preset_material
from crazing.pictures import output
from crazing.pictures.samples import sources
from crazing.record import equal
from crazing.render import MAX_PIXELS
from crazing.shade import shade

#: Every map: its type and its channels.
MAPS: dict[str, tuple[type[np.generic], int]] = {
    "color": (np.uint8, 3),
    "mask": (np.uint8, 1),
    "height": (np.float32, 1),
    "normal": (np.float32, 3),
    "ao": (np.float32, 1),
    "roughness": (np.float32, 1),
    "wear": (np.float32, 1),
    "distance": (np.float32, 1),
    "direction": (np.float32, 2),
    "cell": (np.int32, 1),
    "strand": (np.int32, 1),
    "generation": (np.int32, 1),
}

#: Most pixels a side of a picture that a plan may have; a window of it has at most `MAX_PIXELS`.
MAX_SIDE = 1 << 20

#: Largest coordinates and widths, data units.
_LARGEST, _WHY = 1e30, "lengths are drawn as float32"

#: Most pixels a side of what a notebook shows.
_SHOWN = 512

Bounds = tuple[float, float, float, float]


@dataclass(frozen=True, eq=False)
class TexturePlan:
    """A texture that is drawn window by window. Made by :func:`crazing.texture_plan`.

    Attributes
    ----------
    crack : Crack
        The pattern.
    size : (height, width)
        Pixels of the whole.
    maps : tuple of str
        Names of the maps.
    material : Material
        Profile and colours.
    bounds : (xmin, ymin, xmax, ymax)
        What the whole shows, data units.
    seed : int
        Seed of grain, patches and the differences between plates.
    threads : int or None
        None takes all cores.
    """

    crack: Any
    size: tuple[int, int]
    maps: tuple[str, ...]
    material: Material
    bounds: Bounds
    seed: int = 0
    threads: int | None = None
    _arrays: tuple[Any, ...] = field(default=(), repr=False, compare=False)
    _sides: tuple[Any, ...] = field(default=(), repr=False, compare=False)
    _scaled: dict[str, Any] = field(default_factory=dict, repr=False, compare=False)

    def __eq__(self, other: object) -> bool:
        return equal(self, other)

    __hash__ = None  # type: ignore[assignment]

    @property
    def period(self) -> tuple[float, float] | None:
        """(width, height) after which the pattern repeats, data units, or None."""
        return getattr(self.crack, "period", None)

    @property
    def tiles(self) -> bool:
        """Whether opposite sides of the picture fit together: of a periodic pattern, whole periods are shown."""
        return output.tiles(self.size, self.scale, self.period)

    @property
    def scale(self) -> float:
        """Pixels a data unit."""
        xmin, ymin, xmax, ymax = self.bounds
        return min(self.size[1] / (xmax - xmin), self.size[0] / (ymax - ymin))

    @property
    def relief(self) -> float:
        """What the range of heights from 0 to 1 is, data units."""
        return float(self._scaled["relief"])

    def window(
        self, top: int, left: int, height: int, width: int, *, out: Mapping[str, NDArray[Any]] | None = None
    ) -> dict[str, NDArray[Any]]:
        """Draw a part of the texture, bit for bit as the whole has it.

        Parameters
        ----------
        top, left : int
            Its first row and column; it may reach beyond the whole, and a periodic pattern goes on there.
        height, width : int
            Its size in pixels, at most 2**30 of them.
        out : mapping of str to array, optional
            Arrays to be filled and returned in place of new ones, such as an earlier window of that size gave: memory
            that was used before is faster than new memory. Whoever holds them sees them change.

        Returns
        -------
        dict of str to array
            The maps by name, as in :class:`Texture`.

        Raises
        ------
        TypeError, ValueError
            For numbers out of range, and when `out` has other maps, types or sizes, read-only arrays, or such as share
            memory.
        MemoryError
            When the maps do not fit into memory.

        Examples
        --------
        >>> import crazing as cz
        >>> plan = cz.texture_plan(cz.crack(n=50, rng=1), 512, maps=["height"])
        >>> rows = plan.window(0, 0, 128, 512)
        >>> for top in range(128, 512, 128):
        ...     rows = plan.window(top, 0, 128, 512, out=rows)
        """
        far = 1 << 30
        top, left = (arguments.count(value, name, low=-far, high=far) for value, name in ((top, "top"), (left, "left")))
        height, width = arguments.count(height, "height", low=1), arguments.count(width, "width", low=1)
        if height * width > MAX_PIXELS:
            raise ValueError(f"{height} x {width} are {height * width} pixels; at most {MAX_PIXELS} are supported")
        if out is None:
            maps = {name: np.empty(_shape(name, height, width), MAPS[name][0]) for name in self.maps}
        else:
            maps = self._given(out, height, width)
        window = (top, left, height, width)
        key, workers = _rng.key(self.seed), arguments.thread_count(self.threads)
        ends = arguments.bounds_tuple(self.crack.bounds)
        given = (self._arrays, self._sides, ends, self.bounds, self.size, self.period, window, self._scaled)
        _core.texture(*given, key, workers, maps)
        return maps

    def _given(self, out: Mapping[str, NDArray[Any]], height: int, width: int) -> dict[str, NDArray[Any]]:
        """The arrays of an earlier window, which are to be filled again."""
        if not isinstance(out, Mapping):
            raise TypeError(f"out is {arguments.found(out)}; arrays by the names of maps are wanted")
        if {*out} != {*self.maps}:
            raise ValueError(f"out has {', '.join(map(str, out)) or 'no maps'}; {', '.join(self.maps)} are wanted")
        maps = {
            name: arguments.filled(out[name], f"out[{name!r}]", MAPS[name][0], _shape(name, height, width))
            for name in self.maps
        }
        arguments.apart({f"out[{name!r}]": array for name, array in maps.items()}, (*self._arrays, *self._sides))
        return maps


@dataclass(frozen=True, eq=False, repr=False)
class Texture(Mapping[str, NDArray[Any]]):
    """Maps by name, all of one size and aligned. Made by :func:`crazing.texture`.

    Row 0 is the top; y points up in the data and in the vectors. ``color`` (H, W, 3) uint8 sRGB without light;
    ``mask`` (H, W) uint8 coverage by the crack; ``height`` (H, W) float32 from 0 to 1; ``normal`` (H, W, 3) float32
    unit vectors, OpenGL (+Y up); ``ao`` float32, 1 where nothing hides the sky; ``roughness`` and ``wear`` float32
    from 0 to 1; ``distance`` float32, data units to the nearest crack edge, negative inside; ``direction`` (H, W, 2)
    float32 unit vectors along the nearest edge, from its first vertex to its second; ``cell`` int32, the plate, whose
    pixels have their middles in one and the same face of the drawing of middle lines, however wide the cracks are,
    and also on the crack; without a period plates end at the crack's bounds, and beyond is that of the nearest place
    within; ``strand`` and ``generation`` int32, -1 off the crack, which ends half a pixel beside its edge. Beyond the
    end of several edges that are equally near, strand, generation and direction are those of the widest there, of
    equally wide ones of the first.

    The mask of one edge is its share of a pixel to within .05 along its sides and .15 at its ends (.1 and .26 where
    it is narrower than a pixel). Where several meet in a pixel, the one that covers most of it counts: up to half a
    pixel too little. In the mean that is .02 over pixels on the rim; the area of a pattern is within .3 % where
    cracks are some pixels wide, within 4 % where they are about one.

    Attributes
    ----------
    maps : dict of str to array
        Read-only.
    size : (height, width)
        Pixels.
    bounds : (xmin, ymin, xmax, ymax)
        What is shown, data units.
    period : (width, height) or None
        After which the pattern repeats, data units.
    scale : float
        Pixels a data unit.
    material : Material
        Profile and colours.
    relief : float
        What the range of heights from 0 to 1 is, data units.
    seed : int
        Seed of grain, patches and the differences between plates.
    crack : Crack
        The pattern.
    """

    maps: dict[str, NDArray[Any]]
    size: tuple[int, int]
    bounds: Bounds
    period: tuple[float, float] | None
    scale: float
    material: Material
    relief: float
    seed: int
    crack: Any

    def __post_init__(self) -> None:
        given: Any = self.maps
        if not (isinstance(given, dict) and all(isinstance(array, np.ndarray) for array in given.values())):
            raise TypeError(f"maps is {arguments.found(given)}; arrays by the names of maps are wanted")
        for array in self.maps.values():
            array.flags.writeable = False

    @property
    def tiles(self) -> bool:
        """Whether opposite sides fit together: of a periodic pattern, whole periods are shown."""
        return output.tiles(self.size, self.scale, self.period)

    def __reduce__(self) -> tuple[Any, ...]:
        # Through the constructor, so that unpickled maps are read-only again.
        return type(self), tuple(getattr(self, field.name) for field in fields(self))

    def __getitem__(self, name: str) -> NDArray[Any]:
        try:
            return self.maps[name]
        except KeyError:
            kept = ", ".join(self.maps)
            raise KeyError(
                f"the texture has no map {name!r}{arguments.meant(name, self.maps)}; it has {kept}"
            ) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self.maps)

    def __len__(self) -> int:
        return len(self.maps)

    def __eq__(self, other: object) -> bool:
        return equal(self, other)

    __hash__ = None  # type: ignore[assignment]

    def lit(self, **how: Any) -> NDArray[np.uint8]:
        """Show the texture under a light.

        Parameters
        ----------
        **how
            As for :func:`crazing.shade`.

        Returns
        -------
        (H, W, 3) uint8
            sRGB.
        """
        return shade(self, **how)

    def _repr_png_(self) -> bytes | None:
        if "color" not in self.maps:
            return None
        shown = self.lit() if {"normal", "ao", "roughness"} <= {*self.maps} else self["color"]
        step = -(-max(self.size) // _SHOWN)
        return files.encoded(np.ascontiguousarray(shown[::step, ::step]))

    def __repr__(self) -> str:
        return f"Texture({self.size[0]} x {self.size[1]}: {', '.join(self.maps)})"

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        maps: str | Iterable[str] | None = None,
        format: str | None = None,
        layout: str = "plain",
        name: str = "texture",
        metres: float = 1.0,
        origin: Mapping[str, Any] | None = None,
    ) -> tuple[Path, ...]:
        """Write maps into files, each whole or not at all.

        Parameters
        ----------
        path : str or path-like
            A file for one map: its ending is ``.png``, ``.tif``, ``.exr`` or ``.zarr``. Else a folder for several,
            which also gets a MaterialX file, and glTF with PNG, when there is colour.
        maps : str or sequence of str, optional
            Which maps; all that there are by default. ``"normal_gl"``, ``"normal_dx"`` and ``"orm"`` are as for
            :func:`crazing.write_texture`.
        format, layout, name, metres, origin
            As for :func:`crazing.write_texture`.

        Returns
        -------
        tuple of Path
            The files.

        Raises
        ------
        TypeError, ValueError
            For arguments of the wrong kind or range, a map that was not drawn, or several maps for one file.
        CrazingError
            When a label is too large for PNG or a distance for ``"exr16"``.
        ImportError
            When a format needs a package that is not installed.
        OSError
            When a file cannot be written.

        Examples
        --------
        >>> import crazing as cz
        >>> t = cz.texture(cz.crack(n=50, rng=1), 64, maps=["color", "normal"])
        >>> [path.name for path in t.save("glaze", layout="polyhaven", name="glaze")[:2]]
        ['glaze_diff_64.png', 'glaze_nor_gl_64.png']
        """
        wanted = output.Wanted(tuple(self.maps) if maps is None else output.words(maps), format, layout, name, metres)
        for source in sources(output.pictures_of(path, wanted)):
            arguments.choice(source, "a map to be saved", self.maps)
        shown = output.shown_by(self, provenance.of_crack(self.crack) if origin is None else origin)
        drawn = self.maps
        return output.write(
            path, wanted, shown, lambda top, rows: {name: array[top : top + rows] for name, array in drawn.items()}
        )


def texture_plan(
    crack: Any,
    size: int | tuple[int, int],
    *,
    maps: str | Iterable[str] = ("color", "mask", "height", "normal", "ao"),
    material: Material | str | None = None,
    bounds: ArrayLike | None = None,
    threads: int | None = None,
    seed: int = 0,
) -> TexturePlan:
    """Prepare a texture that is drawn window by window, however large it is.

    Parameters
    ----------
    crack : Crack
        The pattern.
    size : int or (height, width)
        Pixels of the whole; one integer means a square. For a periodic pattern, a period must be a whole number of
        pixels.
    maps : sequence of str
        Names of maps; ``"all"`` for every one.
    material : Material or str, optional
        Profile and colours, or the name of a preset that has them.
    bounds : (xmin, ymin, xmax, ymax), optional
        What the whole shows, data units; the crack's own bounds by default. One scale in both directions: bounds of
        another shape than the picture lie centred in it.
    threads : int, optional
        None takes all cores.
    seed : int, optional
        Seed of grain, patches and the differences between plates.

    Returns
    -------
    TexturePlan

    Raises
    ------
    TypeError, ValueError
        For arguments of the wrong kind, shape or range.

    Examples
    --------
    >>> import crazing as cz
    >>> plan = cz.texture_plan(cz.crack(n=50, rng=1), 100_000, maps=["mask"])
    >>> plan.window(70_000, 20_000, 64, 64)["mask"].shape
    (64, 64)
    """
    shape = arguments.size_pair(size, limit=MAX_SIDE)
    names = _names(maps)
    if isinstance(material, str):
        material = preset_material(material)
    material = Material() if material is None else material
    if not isinstance(material, Material):
        raise TypeError(f"material is {type(material).__name__}; a crazing.Material or the name of a preset is wanted")
    seed = arguments.count(seed, "seed", high=2**63 - 1)
    workers = arguments.thread_count(threads)
    arrays, whole = _pattern(crack)
    box = whole if bounds is None else _drawn(bounds, "bounds")
    extent = _core.extent(arrays, getattr(crack, "period", None), workers)
    scaled = in_data_units(material, extent, crack.bounds)
    sides = _sides(names, material, crack, arrays, workers)
    return TexturePlan(crack, shape, names, material, box, seed, threads, arrays, sides, scaled)


def texture(
    crack: Any,
    size: int | tuple[int, int],
    *,
    maps: str | Iterable[str] = ("color", "mask", "height", "normal", "ao"),
    material: Material | str | None = None,
    bounds: ArrayLike | None = None,
    threads: int | None = None,
    seed: int = 0,
    out: Texture | None = None,
) -> Texture:
    """Draw aligned maps of a crack pattern.

    Every value comes from the geometry of the edges nearest to the pixel's middle. The maps are the same for any
    number of threads and on every platform, and a periodic pattern gives maps that tile without a seam.

    Parameters
    ----------
    crack : Crack
        The pattern.
    size : int or (height, width)
        Pixels; one integer means a square. At most 2**30 pixels; larger ones window by window, with
        :func:`crazing.texture_plan`. For a periodic pattern, a period must be a whole number of pixels.
    maps : sequence of str
        Names of maps; ``"all"`` for every one.
    material : Material or str, optional
        Profile and colours, or the name of a preset that has them.
    bounds : (xmin, ymin, xmax, ymax), optional
        What is shown, data units; the crack's own bounds by default. One scale in both directions: bounds of
        another shape than the picture lie centred in it.
    threads : int, optional
        None takes all cores.
    seed : int, optional
        Seed of grain, patches and the differences between plates.
    out : Texture, optional
        An earlier texture with the same maps and size that is no longer wanted: its arrays are filled again, which is
        faster than new memory, as in a loop over frames. It is used up: its maps, and whatever else holds these
        arrays, show the new texture from then on, and something in between when drawing is stopped.

    Returns
    -------
    Texture
        Always a new one, though it holds the arrays of `out`.

    Raises
    ------
    TypeError, ValueError
        For arguments of the wrong kind, shape or range, and when `out` has other maps or another size.
    MemoryError
        When the maps do not fit into memory.

    Examples
    --------
    >>> import crazing as cz
    >>> t = cz.texture(cz.crack(n=50, rng=1), 64, maps=["mask", "height", "normal"])
    >>> t
    Texture(64 x 64: mask, height, normal)
    >>> t["normal"].shape, t["height"].dtype
    ((64, 64, 3), dtype('float32'))
    >>> crack, frame = cz.crack(n=50, rng=1), None
    >>> for age in (0.25, 0.5, 0.75, 1.0):
    ...     frame = cz.texture(crack.at(age), 64, bounds=crack.bounds, out=frame)
    """
    if out is not None:
        arguments.of_kind(out, "out", Texture)
    plan = texture_plan(crack, size, maps=maps, material=material, bounds=bounds, threads=threads, seed=seed)
    if out is None:
        drawn = plan.window(0, 0, *plan.size)
    else:
        with _writeable(out) as maps:
            drawn = plan.window(0, 0, *plan.size, out=maps)
    shown = (plan.size, plan.bounds, plan.period, plan.scale, plan.material, plan.relief, plan.seed)
    return Texture(drawn, *shown, crack)


def _names(maps: Any) -> tuple[str, ...]:
    if not np.iterable(maps):
        raise TypeError(f"maps is {arguments.found(maps)}; names of maps are wanted")
    names = (
        tuple(MAPS) if isinstance(maps, str) and maps == "all" else (maps,) if isinstance(maps, str) else tuple(maps)
    )
    for i, name in enumerate(names):
        arguments.choice(name, f"maps[{i}]", MAPS)
    if not names:
        raise ValueError("maps is empty; name at least one")
    return tuple(dict.fromkeys(names))


def _shape(name: str, height: int, width: int) -> tuple[int, ...]:
    channels = MAPS[name][1]
    return (height, width) if channels == 1 else (height, width, channels)


@contextmanager
def _writeable(texture: Texture) -> Iterator[dict[str, NDArray[Any]]]:
    """The maps of a texture that is given up, writeable for a while."""
    try:
        for name, array in texture.maps.items():
            try:
                array.flags.writeable = True
            except ValueError:
                raise ValueError(
                    f"out[{name!r}] is in memory that is read-only; arrays of their own are wanted"
                ) from None
        yield texture.maps
    finally:
        for array in texture.maps.values():
            array.flags.writeable = False


def _pattern(crack: Any) -> tuple[tuple[Any, ...], Bounds]:
    """Vertices, edges, shifts, width, strand and generation, as the core wants them; the bounds."""
    if not all(hasattr(crack, name) for name in ("graph", "width", "strand", "generation", "bounds")):
        raise TypeError(f"crack is {type(crack).__name__}; a crazing.Crack is wanted")
    box = _drawn(crack.bounds, "crack.bounds")  # named first where all of a pattern is too large
    vertices = arguments.points_array(crack.graph.vertices, "vertices")
    edges = arguments.index_pairs(crack.graph.edges, "edges", limit=len(vertices))
    widths = arguments.real_array(crack.width, "width").reshape(-1, 2)
    if not widths.max(initial=0.0) <= _LARGEST:
        raise CrazingError(f"width holds {widths.max():g}; widths of at most {_LARGEST:g} are wanted: {_WHY}")
    given = getattr(crack, "shifts", None)
    shifts = np.ascontiguousarray(np.zeros((len(edges), 2)) if given is None else given, dtype=np.int8).reshape(-1, 2)
    labels = (np.ascontiguousarray(label, dtype=np.int32) for label in (crack.strand, crack.generation))
    return (vertices, edges, shifts, widths, *labels), box


def _drawn(bounds: Any, name: str) -> Bounds:
    return arguments.areal(arguments.bounds_tuple(bounds, name), name, largest=_LARGEST, why=_WHY)


def _sides(
    names: tuple[str, ...], material: Material, crack: Any, arrays: tuple[Any, ...], workers: int
) -> tuple[Any, ...]:
    """The plates beside every edge where a map depends on them; else one plate, without tables."""
    differ = material.tilt or material.level or material.tint or material.curl * material.curl_spread
    if "cell" in names or (differ and not {*names} <= {"mask", "distance", "strand", "generation", "direction"}):
        return _core.plates(arrays, arguments.bounds_tuple(crack.bounds), getattr(crack, "period", None), workers)
    return np.empty((0, 2), dtype=np.int32), np.empty((0, 4)), np.zeros(1)
