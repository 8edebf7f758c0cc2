"""Point sets: distributions, and the contours of images."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, arguments, outline
from crazing.contour import contours
from crazing.errors import CrazingError
from crazing.images import brightness
from crazing.region import as_region
from crazing.rng import RNG, key

if TYPE_CHECKING:
    from crazing.diagram import Diagram

__all__ = [
    "from_density",
    "from_image",
    "from_polygon",
    "from_svg",
    "laplace",
    "normal",
    "poisson_disk",
    "relax",
    "uniform",
]


def __dir__() -> list[str]:
    """What is public, for completion."""
    return __all__


Points: TypeAlias = NDArray[np.float64]


def uniform(n: int, *, bounds: ArrayLike = (0, 0, 1, 1), rng: RNG = None) -> Points:
    """Points spread evenly at random over a rectangle.

    Point i depends on `rng` and i alone: fewer points from the same seed are the first of the more.

    Parameters
    ----------
    n : int
        Number of points, 0 or more.
    bounds : (xmin, ymin, xmax, ymax)
        The rectangle, in data units.
    rng : int, numpy.random.Generator or None
        The seed; the same on every platform and with any number of threads.

    Returns
    -------
    (n, 2) float64
        x and y, in data units.

    Raises
    ------
    TypeError, ValueError
        If an argument is not what is listed above.
    MemoryError
        If the points do not fit.

    Notes
    -----
    Source: thesis, section 8.1.

    Examples
    --------
    >>> import crazing as cz
    >>> cz.sample.uniform(2, bounds=(0, 0, 10, 1), rng=7).round(3)
    array([[4.994, 0.93 ],
           [9.937, 0.432]])
    """
    number = arguments.count(n, "n")
    return _core.sample_uniform(number, arguments.bounds_tuple(bounds), key(rng))


def normal(n: int, *, loc: ArrayLike = 0.0, scale: ArrayLike = 1.0, rng: RNG = None) -> Points:
    """Points whose coordinates are normal, each independently of the other: dense in the middle.

    Point i depends on `rng` and i alone. Quantiles by Wichura's AS 241, about 1e-15 accurate.

    Parameters
    ----------
    n : int
        Number of points, 0 or more.
    loc : float or (x, y)
        Mean, in data units.
    scale : float or (x, y)
        Standard deviation, 0 or more, in data units.
    rng : int, numpy.random.Generator or None
        The seed; the same on every platform and with any number of threads.

    Returns
    -------
    (n, 2) float64
        x and y, in data units.

    Raises
    ------
    TypeError, ValueError
        If an argument is not what is listed above.
    CrazingError
        If `loc` or `scale` is so large that points overflow.
    MemoryError
        If the points do not fit.

    Notes
    -----
    Source: thesis, section 8.3. Wichura: Algorithm AS 241 (Applied Statistics 37, 1988).

    Examples
    --------
    >>> import crazing as cz
    >>> cz.sample.normal(2, loc=(100, 0), rng=7).round(3)
    array([[ 99.999,   1.472],
           [102.497,  -0.17 ]])
    """
    number, middle, spread = arguments.count(n, "n"), _pair(loc, "loc"), _scale(scale)
    return _core.sample_normal(number, middle, spread, key(rng))


def laplace(n: int, *, loc: ArrayLike = 0.0, scale: ArrayLike = 1.0, rng: RNG = None) -> Points:
    """Points whose coordinates are Laplace, each independently of the other.

    Denser in the middle than `normal`, and with more points far out. Point i depends on `rng` and i alone.

    Parameters
    ----------
    n : int
        Number of points, 0 or more.
    loc : float or (x, y)
        Median, in data units.
    scale : float or (x, y)
        Mean distance from the median along each axis, 0 or more, in data units.
    rng : int, numpy.random.Generator or None
        The seed; the same on every platform and with any number of threads.

    Returns
    -------
    (n, 2) float64
        x and y, in data units.

    Raises
    ------
    TypeError, ValueError
        If an argument is not what is listed above.
    CrazingError
        If `loc` or `scale` is so large that points overflow.
    MemoryError
        If the points do not fit.

    Notes
    -----
    Source: thesis, section 8.3.

    Examples
    --------
    >>> import crazing as cz
    >>> cz.sample.laplace(2, scale=2, rng=1).round(3)
    array([[ 0.787,  2.407],
           [-1.265,  3.728]])
    """
    number, middle, spread = arguments.count(n, "n"), _pair(loc, "loc"), _scale(scale)
    return _core.sample_laplace(number, middle, spread, key(rng))


def poisson_disk(
    radius: float,
    *,
    bounds: ArrayLike = (0, 0, 1, 1),
    period: ArrayLike | None = None,
    rng: RNG = None,
) -> Points:
    """Points no nearer to each other than a radius, nearly as many as fit: evenly spread, and yet in no order.

    About every point 30 places for a next are tried: here and there room for one more may be left. More than some five
    thousand points are made tile by tile on all cores, by the same rule, so that no border shows.

    Parameters
    ----------
    radius : float
        The least distance, data units. About 0.62 area / radius**2 points come of it, some more in small bounds.
    bounds : (xmin, ymin, xmax, ymax)
        Where, in data units.
    period : (width, height), optional
        Repeat the points with this period, instead of `bounds`: distances are taken to copies too.
    rng : int, numpy.random.Generator or None
        The seed; the same on every platform and with any number of threads.

    Returns
    -------
    (n, 2) float64
        x and y, in data units. Rows that follow each other are mostly near to each other where points are made by
        tiles; tiles lie row by row from the lower left.

    Raises
    ------
    TypeError, ValueError
        If an argument is not what is listed above, or the radius is too small for the bounds.

    Notes
    -----
    Source: Bridson: Fast Poisson Disk Sampling in Arbitrary Dimensions (SIGGRAPH sketches 2007).

    Examples
    --------
    >>> import crazing as cz
    >>> points = cz.sample.poisson_disk(0.1, rng=1)
    >>> 55 < len(points) < 85
    True
    """
    if period is None:
        box = arguments.areal(arguments.bounds_tuple(bounds))
    else:
        box = 0.0, 0.0, *arguments.areal(arguments.period_pair(period), "period")
    radius = arguments.number(radius, "radius", low=0.0)
    return _core.sample_poisson_disk(radius, box, period is not None, key(rng))


def from_density(
    image: ArrayLike,
    n: int,
    *,
    bounds: ArrayLike | None = None,
    rng: RNG = None,
) -> Points:
    """Points denser where an image is brighter.

    Point i depends on `rng`, the image and i alone: fewer points from the same seed are the first of the more.

    Parameters
    ----------
    image : array_like
        (H, W) grey or (H, W, 3 or 4) colour as for :func:`from_image`; row 0 at the top. No pixel may be negative; a
        pixel of 0 gets no point.
    n : int
        Number of points, 0 or more.
    bounds : (xmin, ymin, xmax, ymax), optional
        Where the picture lies, data units; by default (0, 0, W, H), pixels.
    rng : int, numpy.random.Generator or None
        The seed; the same on every platform and with any number of threads.

    Returns
    -------
    (n, 2) float64
        x and y, in data units, y up. Each pixel as likely as it is bright, evenly within a pixel.

    Raises
    ------
    TypeError, ValueError
        If an argument is not what is listed above.
    CrazingError
        If a pixel is negative, NaN or infinite, or all are 0.

    Examples
    --------
    >>> import numpy as np
    >>> import crazing as cz
    >>> points = cz.sample.from_density(np.array([[0.0, 1.0]]), 100, rng=1)
    >>> bool((points[:, 0] > 1).all())
    True
    """
    pixels = np.ascontiguousarray(brightness(image))
    if pixels.min() < 0:
        row, column = np.unravel_index(int(pixels.argmin()), pixels.shape)
        raise CrazingError(f"image[{row}, {column}] is {pixels[row, column]}; no pixel may be negative")
    box = (0.0, 0.0, float(pixels.shape[1]), float(pixels.shape[0]))
    box = box if bounds is None else arguments.bounds_tuple(bounds)
    return _core.sample_from_density((pixels, box), arguments.count(n, "n"), key(rng))


def relax(
    points: ArrayLike | Diagram, *, iterations: int, bounds: ArrayLike, period: ArrayLike | None = None
) -> Points:
    """Even points out by Lloyd's relaxation: each goes to the centroid of its Voronoi cell, again and again.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        Finite coordinates, or the sites of a diagram.
    iterations : int
        Rounds; one or two take clumps away, many make a honeycomb.
    bounds : (xmin, ymin, xmax, ymax)
        What cells are clipped to, data units. On a torus its corner is where the period begins.
    period : (width, height), optional
        Relax on a torus; `bounds` must be as wide and as high.

    Returns
    -------
    (n, 2) float64
        One row for each row of `points`; equal rows stay equal. All lie in the bounds.

    Raises
    ------
    TypeError, ValueError
        If an argument is not what is listed above.
    CrazingError
        If a coordinate is NaN or infinite.

    Notes
    -----
    Source: Lloyd: Least Squares Quantization in PCM (1982).

    Examples
    --------
    >>> import crazing as cz
    >>> points = cz.sample.uniform(4, rng=1)
    >>> cz.sample.relax(points, iterations=100, bounds=(0, 0, 1, 1)).round(2).sum().item()
    4.0
    """
    box = arguments.areal(arguments.bounds_tuple(bounds))
    sides = None if period is None else arguments.areal(arguments.period_pair(period), "period")
    if sides is not None and not np.allclose(sides, (box[2] - box[0], box[3] - box[1]), rtol=1e-12, atol=0):
        raise ValueError(f"period is {sides}, bounds is {box}; bounds as wide and high as the period are wanted")
    rounds = arguments.count(iterations, "iterations", high=1_000_000)
    return _core.sample_relax(arguments.points_array(points), rounds, box, sides)


def from_image(
    image: ArrayLike,
    *,
    level: float | Sequence[float] = 0.5,
    n: int | None = None,
    spacing: float | None = None,
) -> Points:
    """Points on the contours of an image, found between its pixels.

    Needs contourpy, the extra `image`.

    Parameters
    ----------
    image : array_like
        (H, W) grey, (H, W, 3) colour or (H, W, 4) colour with alpha, row 0 at the top. Integers are divided by the
        largest number of their dtype, bools are 0 and 1, floats are used as they are; colour becomes its luminance
        (Rec. 709), over white where it is transparent. Label k of an 8-bit label image is the value k / 255.
    level : float or sequence of float
        The brightness whose contour is wanted, or several.
    n : int, optional
        Number of points in all, 3 or more, shared among the contours in proportion to length and evenly spaced on
        each. Contours too short for 3 of the n points are left out, the shortest first.
    spacing : float, optional
        Pixels between neighbours instead, rounded so that steps are even; contours too short for 3 points are left
        out. Without `n` and `spacing`: the contour's own vertices, where it crosses the lines between pixel centres.

    Returns
    -------
    (n, 2) float64
        Contour after contour, each in order along it, closed ones without their first point again. In pixels, x
        right and y up: the centre of pixel (row, col) is (col + 0.5, H - row - 0.5). A contour that leaves the image
        is open: pad the image to close it.

    Raises
    ------
    TypeError, ValueError
        If an argument is not what is listed above, or both `n` and `spacing` are given.
    CrazingError
        If a pixel is NaN or infinite, if there is no contour at any level (the message tells the range of values),
        or if every contour is too short for `spacing`.
    ImportError
        If contourpy is not installed.

    Notes
    -----
    Source: thesis, section 6.

    Examples
    --------
    >>> import numpy as np
    >>> import crazing as cz
    >>> y, x = np.mgrid[-10:11, -10:11]
    >>> disc = 7.5 - np.sqrt(x**2 + y**2)
    >>> points = cz.sample.from_image(disc, level=0.0, n=50)
    >>> points.shape
    (50, 2)
    >>> radius = np.linalg.norm(points - (10.5, 10.5), axis=1)
    >>> bool(abs(radius - 7.5).max() < 0.05)
    True
    """
    if n is not None and spacing is not None:
        raise ValueError(f"n is {n!r} and spacing is {spacing!r}; only one of them is wanted")
    found = contours(image, level)
    return found.coords.copy() if n is None and spacing is None else found.evenly(n, spacing=spacing)


def from_polygon(polygon: Any, *, n: int | None = None, spacing: float | None = None) -> Points:
    """Points on the boundary of a polygon with holes.

    Parameters
    ----------
    polygon : array_like, shapely geometry, mapping, Region or path
        A ring, a (k, 2) array; a list of rings; anything with a ``__geo_interface__`` or a GeoJSON mapping of type
        Polygon, MultiPolygon, Feature or a collection of them; a list of such; or the path of a GeoJSON file.
        Coordinates are taken as they are, whatever their reference system.
    n, spacing
        As for `from_image`, the spacing in data units. Without either: the corners as they are.

    Returns
    -------
    (n, 2) float64
        Ring after ring, in the order of the corners, first points not repeated, in data units.

    Raises
    ------
    TypeError, ValueError
        If there is no polygon, or both `n` and `spacing` are given.
    CrazingError
        If a coordinate is NaN or infinite, or every ring is too short for `spacing`.
    OSError
        If the file cannot be read.

    Examples
    --------
    >>> import crazing as cz
    >>> cz.sample.from_polygon([(0, 0), (2, 0), (2, 1), (0, 1)], n=6)
    array([[0., 0.],
           [1., 0.],
           [2., 0.],
           [2., 1.],
           [1., 1.],
           [0., 1.]])
    """
    if isinstance(polygon, str):
        polygon = Path(polygon)
    region = as_region(polygon, "polygon")
    lines = outline.rings([*np.split(region.coords, region.offsets[1:-1])])
    return outline.spread(lines, n, spacing)


def from_svg(source: str | os.PathLike[str], *, n: int | None = None, spacing: float | None = None) -> Points:
    """Points on the paths of an SVG picture.

    Needs svgpathtools, the extra `svg`.

    Parameters
    ----------
    source : str or path-like
        The path of an .svg file, whose paths and basic shapes are taken where `transform` attributes of their own,
        of groups, of copies (`use`) and of inner pictures put them, definitions and what is not displayed left out
        (hidden, or without fill and stroke, as the box about many icons); or path data: a string that begins with M or
        m and does not end in .svg. Style sheets and clip paths are not read: with a style sheet, what has no fill and
        stroke is taken too. Lengths may have a unit, of 96 to the inch, or be a part (%) of the picture they are in.
    n, spacing
        As for `from_image`, the spacing in the units of the picture, those of its own view box. Without either: the
        ends of all segments, and 31 points within every curved one.

    Returns
    -------
    (n, 2) float64
        Path after path, in the order of the file. y is turned to point up, so it is the negative of what the picture
        says.

    Raises
    ------
    ValueError
        If there is no path, the data cannot be read, or both `n` and `spacing` are given.
    CrazingError
        If every path is too short for `spacing`.
    OSError
        If the file cannot be read.
    ImportError
        If svgpathtools is not installed.

    Examples
    --------
    >>> import crazing as cz
    >>> cz.sample.from_svg("M0 0 H4 V2 H0 Z", spacing=2)[:3]
    array([[0., 0.],
           [2., 0.],
           [4., 0.]])
    """
    return outline.spread(outline.svg_lines(arguments.file_path(source, "source")), n, spacing)


def _pair(value: Any, name: str) -> tuple[float, float]:
    """A number, for both axes, or two numbers, as (x, y)."""
    parts = value if np.iterable(value) and not isinstance(value, str) else (value, value)
    x, y = arguments.entries(parts, name, 2, "a number or (x, y)")
    return arguments.number(x, f"{name}[0]"), arguments.number(y, f"{name}[1]")


def _scale(value: Any) -> tuple[float, float]:
    x, y = _pair(value, "scale")
    return arguments.number(x, "scale", low=0.0), arguments.number(y, "scale", low=0.0)
