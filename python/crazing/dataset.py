"""Pictures of cracks with exact labels, as many as wanted, for training and testing."""

from __future__ import annotations

import functools
import math
import operator
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from crazing import arguments, dataset_folder, sample
from crazing import rng as _rng
from crazing.crack import Crack
from crazing.errors import CrazingError
from crazing.material import Material, preset_material
from crazing.recipe import SEEN
from crazing.recipe import preset as _preset
from crazing.recipe import presets as _presets
from crazing.record import equal
from crazing.texture import texture

#: What can be labelled: the name, and the map of the texture it is taken from.
LABELS = {"mask": "mask", "coverage": "mask", "strand": "strand", "cell": "cell", "distance": "distance"}

#: Heights of the lamp over the surface, as the tangent of its angle: raking light shows relief, high light colour.
_LAMP = (0.5, 2.5)
#: Brightness varies by this factor up and down.
_EXPOSURE = 1.3
#: Of 255.
_HALF = 128
#: Parts of all pictures that go to training, validation and test.
SPLITS = {"train": 0.8, "val": 0.1, "test": 0.1}


@dataclass(frozen=True, eq=False, repr=False)
class LabelledImage:
    """A picture of cracks and what is known of every pixel.

    Attributes
    ----------
    index : int
        Its place in the data set.
    image : (H, W, 3) uint8
        sRGB, lit from one side.
    labels : mapping of str to (H, W) array
        ``mask``: uint8, 255 where half of a pixel or more is crack, else 0; ``coverage``: uint8, the part of the
        pixel that is crack; ``strand``: int32, which crack, -1 half a pixel off cracks and farther; ``cell``: int32,
        which plate, the face between the middle lines of cracks in which the pixel's middle lies; ``distance``:
        float32, pixels to the nearest crack edge, negative inside. In the order that was asked for; they and the image
        may be written to.
    crack : Crack
        The geometry itself.
    preset : str
        The kind of crack.
    plates : int
        The recipe's number of plates for it.
    light : (right, up, out)
        Where the lamp was.
    exposure : float
        Brightness.
    split : {"train", "val", "test"}
        Where it belongs.
    """

    index: int
    image: NDArray[np.uint8]
    labels: Mapping[str, NDArray[Any]]
    crack: Crack
    preset: str
    plates: int
    light: tuple[float, float, float]
    exposure: float
    split: str

    def __eq__(self, other: object) -> bool:
        return equal(self, other)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        height, width = self.image.shape[:2]
        return f"LabelledImage({self.index}, {height} x {width}, {self.preset!r}, {', '.join(self.labels)})"


@dataclass(frozen=True)
class Dataset(Sequence[LabelledImage]):
    """Pictures of cracks with exact labels, each made when it is asked for; see :func:`crazing.dataset`.

    It has a length and takes an index, which is what the ``DataLoader`` of PyTorch asks of a data set; its
    ``collate_fn`` has to say what of each `LabelledImage` is stacked.

    Attributes
    ----------
    n : int
        Number of pictures.
    presets, size, labels, zoom, thinnest
        As they were given, the size as (height, width).
    key : (int, int)
        Two words of 64 bits that the seed became.
    """

    n: int
    presets: tuple[str, ...]
    size: tuple[int, int]
    labels: tuple[str, ...]
    zoom: float
    thinnest: float
    key: tuple[int, int]

    def __len__(self) -> int:
        return self.n

    def __getitem__(self, index: SupportsIndex | slice) -> Any:
        if isinstance(index, slice):
            return [self._made(i) for i in range(*index.indices(self.n))]
        try:
            i = operator.index(index)
        except TypeError:
            raise TypeError(f"index is {index!r}; an integer or a slice is wanted") from None
        if not -self.n <= i < self.n:
            raise IndexError(f"index is {i}; the data set has {self.n} pictures")
        return self._made(i % self.n)

    def __iter__(self) -> Iterator[LabelledImage]:
        return (self._made(i) for i in range(self.n))

    @property
    def parameters(self) -> dict[str, Any]:
        """What decides every picture, in the terms of JSON; not their number, which may grow."""
        return {
            "presets": list(self.presets),
            "size": list(self.size),
            "labels": list(self.labels),
            "zoom": self.zoom,
            "thinnest": self.thinnest,
            # JSON readers make floats of large numbers.
            "key": [str(word) for word in self.key],
        }

    def drawn(self, index: int) -> dict[str, Any]:
        """What chance decided for one picture, known without making it.

        Parameters
        ----------
        index : int
            From 0 to n - 1.

        Returns
        -------
        dict
            preset, plates, light, exposure and split, as in `LabelledImage`. They and the picture depend on the
            key and the index alone, so that a larger data set begins with the pictures of a smaller one.

        Raises
        ------
        TypeError, ValueError
            If `index` is no such integer.

        Examples
        --------
        >>> import crazing as cz
        >>> data = cz.dataset(10, rng=1)
        >>> cz.dataset(20, rng=1).drawn(9) == data.drawn(9)
        True
        """
        row = arguments.count(index, "index", high=self.n - 1)
        kind, scale, turn, rise, bright, part = sample.uniform(3, rng=self._seed(row, 0)).ravel().tolist()
        name = self.presets[int(kind * len(self.presets))]
        angle = 2.0 * math.pi * turn
        return {
            "preset": name,
            "plates": max(3, round(_plates(name) * self.zoom ** (2.0 * scale - 1.0))),
            "light": (math.cos(angle), math.sin(angle), _LAMP[0] + (_LAMP[1] - _LAMP[0]) * rise),
            "exposure": _EXPOSURE ** (2.0 * bright - 1.0),
            "split": _split(part),
        }

    def write(
        self,
        folder: str | os.PathLike[str],
        *,
        threads: int | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> int:
        """Write every picture and its labels into a folder.

        The pictures become ``train/images/000000.png``, likewise ``val`` and ``test``; each label a folder beside
        ``images``, with files of the same names: ``masks`` and ``coverage`` of 8 bits, ``strands`` and ``cells`` of
        16 bits (0 off cracks, strands and cells from 1; a number past 65,535 raises), ``distances`` as NPY.
        ``images.csv`` has a line for every picture with what was drawn for it, ``dataset.json`` says how to make
        the data set again. Files are whole or not there; a folder that was stopped or is to grow is gone on with.

        Parameters
        ----------
        folder : path
            Made if it is not there, in a folder that is.
        threads : int, optional
            Pictures that are made at a time; None takes all cores.
        progress : callable, optional
            Called with the number of pictures that are done and of all.

        Returns
        -------
        int
            The number of pictures that were not there before.

        Raises
        ------
        CrazingError
            If the folder holds another data set.
        OSError
            If a file cannot be written.

        Examples
        --------
        >>> import tempfile
        >>> import crazing as cz
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     data = cz.dataset(3, presets=["glaze"], size=64, rng=1)
        ...     data.write(folder), data.write(folder)
        (3, 0)
        """
        return dataset_folder.write(self, folder, arguments.thread_count(threads) or os.cpu_count() or 1, progress)

    def _seed(self, index: int, purpose: int) -> np.random.SeedSequence:
        return np.random.SeedSequence((*self.key, index, purpose))

    def _made(self, index: int) -> LabelledImage:
        drawn = self.drawn(index)
        height, width = self.size
        bounds = (0.0, 0.0, width / height, 1.0)
        recipe = _preset(drawn["preset"]).replace(n=drawn["plates"])
        crack = recipe.crack(bounds=bounds, detail=SEEN / height, rng=self._seed(index, 1))
        maps = ("color", "normal", "height", "ao", "roughness", *sorted({LABELS[name] for name in self.labels}))
        shown = texture(crack, self.size, maps=maps, material=_material(drawn["preset"]), bounds=bounds, threads=1)
        image = shown.lit(light=drawn["light"], exposure=drawn["exposure"])
        # Arrays of its own: PyTorch takes them as they are, and warns of those that cannot be written to.
        labels = {name: self._mask(crack) if name == "mask" else shown[LABELS[name]].copy() for name in self.labels}
        if "distance" in labels:
            labels["distance"] *= np.float32(height)
        return LabelledImage(index=index, image=image, labels=labels, crack=crack, **drawn)

    def _mask(self, crack: Crack) -> NDArray[np.uint8]:
        """Where half of a pixel is crack, with no crack thinner than it may be."""
        drawn = replace(crack, width=np.maximum(crack.width, self.thinnest / self.size[0]))
        coverage = texture(drawn, self.size, maps=("mask",), bounds=crack.bounds, threads=1)["mask"]
        return np.where(coverage >= _HALF, np.uint8(255), np.uint8(0))


def dataset(
    n: int,
    *,
    presets: str | Sequence[str] | None = None,
    size: int | tuple[int, int] = 512,
    labels: str | Sequence[str] = ("mask",),
    zoom: float = 2.0,
    thinnest: float = 1.0,
    rng: _rng.RNG = 0,
) -> Dataset:
    """Pictures of cracks with exact labels, for training and testing segmentation.

    Parameters
    ----------
    n : int
        Number of pictures, 1 or more.
    presets : str or sequence of str, optional
        Kinds of cracks, drawn with equal chances; by default all that :func:`crazing.presets` names.
    size : int or (height, width)
        Pixels; one integer means a square.
    labels : str or sequence of str
        Some of mask, coverage, strand, cell and distance; see :class:`LabelledImage`.
    zoom : float
        The number of plates varies by this factor up and down, 1 or more.
    thinnest : float
        Pixels. The mask shows thinner cracks as wide as this, as people do who draw masks; 0 shows them as they are,
        with gaps where less than half of a pixel is crack. At 1 and above no crack is broken.
    rng : int, numpy.random.Generator or None, optional
        Seed. Unlike elsewhere it is 0 by default, so that every process of a loader has the same data set.

    Returns
    -------
    Dataset
        A sequence: ``len``, an index or a slice, iteration. Pictures are made when they are asked for.

    Raises
    ------
    TypeError, ValueError
        If an argument is not what is listed above.

    Notes
    -----
    Labels are drawn from the geometry, not from the picture, and are the same on every machine; pictures are lit in
    single precision and may differ by a level between machines.

    Examples
    --------
    >>> import crazing as cz
    >>> data = cz.dataset(1000, presets=["asphalt-crack", "concrete-spall"], size=128, labels=["mask", "strand"])
    >>> picture = data[17]
    >>> picture.image.shape, picture.labels["mask"].shape, len(data)
    ((128, 128, 3), (128, 128), 1000)
    """
    kinds = _presets() if presets is None else _several(presets, "presets")
    for i, kind in enumerate(kinds):
        arguments.choice(kind, f"presets[{i}]", _presets())
    wanted = _several(labels, "labels")
    for i, label in enumerate(wanted):
        arguments.choice(label, f"labels[{i}]", LABELS)
    return Dataset(
        n=arguments.count(n, "n", low=1),
        presets=kinds,
        size=arguments.size_pair(size),
        labels=wanted,
        zoom=arguments.number(zoom, "zoom", low=1.0, high=1000.0),
        thinnest=arguments.number(thinnest, "thinnest", low=0.0, high=1000.0),
        key=_rng.key(rng),
    )


def _several(value: str | Sequence[str], name: str) -> tuple[str, ...]:
    if not np.iterable(value):
        raise TypeError(f"{name} is {arguments.found(value)}; one name or more are wanted")
    words = (value,) if isinstance(value, str) else tuple(value)
    if not words or not all(isinstance(word, str) for word in words) or len(set(words)) < len(words):
        raise ValueError(f"{name} is {arguments.found(words)}; one name or more, none of them twice, are wanted")
    return words


@functools.cache
def _plates(name: str) -> int:
    return _preset(name).n


@functools.cache
def _material(name: str) -> Material:
    try:
        return preset_material(name)
    except CrazingError:
        return Material()


def _split(part: float) -> str:
    for name, share in SPLITS.items():
        part -= share
        if part < 0.0:
            return name
    return "test"
