"""Measuring crack patterns: graphs exactly, masks through their centrelines."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, arguments
from crazing.arguments import areal, bounds_tuple, count, number
from crazing.crack import Crack
from crazing.graph import PlanarGraph
from crazing.images import brightness
from crazing.record import Record
from crazing.statistics import CrackStatistics

# What pixels are measured with, as in the published figures: spurs and nodes in pixels, then border, reach, step of
# lengths, step of orientation, smallest lag, smallest box, smallest cell.
_SPUR, _MERGE = 14.0, 6.0
#: Nodes of a mask within so many pixels of its sides do not count.
BORDER = 20.0
_PIXELS = (BORDER, 15.0, 4.0, 8.0, 3.0, 4.0, 64.0)
_EXACT = (0.0,) * 7

_NO_SHIFTS = np.zeros((0, 2), np.int8)
_NO_WIDTHS = np.zeros((0, 2))

_Bounds = tuple[float, float, float, float]
_Lines = tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int8], NDArray[np.float64]]


def measure(
    source: Crack | PlanarGraph | ArrayLike,
    *,
    raster: int | None = None,
    bounds: ArrayLike | None = None,
    border: float | None = None,
    reach: float | None = None,
    level: float = 0.5,
    dark: bool = False,
    spur: float = _SPUR,
    merge: float = _MERGE,
) -> CrackStatistics:
    """The statistics of a crack pattern: nodes, angles, loops, cells, lines and widths.

    A graph is measured exactly: chains through vertices of degree 2 are one segment, faces are traced, ends on the
    bounds are no nodes. A mask is thinned to lines one pixel wide, which are measured as a graph of pixels with
    lengths of some pixels: the pipeline behind published figures, with its bias, see Notes.

    Parameters
    ----------
    source : Crack, PlanarGraph or (H, W) or (H, W, 3 or 4) array_like
        A pattern, or a picture of one, brighter than `level` where there is crack.
    raster : int, optional
        Measure a crack or a graph as a mask this many pixels wide: on the same footing as a photograph.
    bounds : (xmin, ymin, xmax, ymax), optional
        Where a graph was cut, data units; a crack knows. Without them no end is taken for cut.
    border : float, optional
        Nodes within this of the bounds do not count. 20 pixels for a mask, nothing for a graph.
    reach : float, optional
        How far from a node the direction of a segment is taken. 15 pixels for a mask; along the first edge for a graph.
    level : float, optional
        Brightness of a mask, 0 to 1, above which there is crack.
    dark : bool, optional
        Whether cracks are dark on bright ground instead.
    spur, merge : float, optional
        Pixels, for a mask: free ends shorter than `spur` are cut off, junctions closer than `merge` become one.

    Returns
    -------
    CrackStatistics

    Raises
    ------
    TypeError, ValueError
        If the mask is no picture, or a number is out of range.
    CrazingError
        If a coordinate or a pixel is NaN or infinite.

    Notes
    -----
    Bias of the raster: means of 20 patterns of 300 plates, graphs against masks of 800 x 800 pixels drawn from them
    (python/examples/measure_bias.py). Compare masks with masks only: the merging of near nodes makes X nodes, T's of
    Voronoi vertices are lost, lines are half a pixel to one pixel too wide. ::

        statistic                   Voronoi      opening .6          thesis
                               graph   mask    graph   mask    graph   mask
        i_nodes                0.000  0.000    0.134  0.110    0.518  0.480
        x_nodes                0.000  0.113    0.000  0.070    0.000  0.035
        mean_degree            3.000  3.126    2.731  2.855    1.965  2.074
        t_share                0.357  0.264    0.339  0.304    0.314  0.343
        near_right             0.297  0.304    0.300  0.314    0.306  0.325
        near_even              0.356  0.404    0.364  0.397    0.375  0.384
        angle_sd                29.6   26.4       29   28.4       28   30.3
        mosaic_n               2.643  2.892    2.661  2.805    2.686  2.748
        mosaic_v               5.286  5.139    5.323  5.173    5.372  5.148
        loops_per_junction     0.446  0.522    0.350  0.415    0.000  0.051
        dead_end_length        0.000  0.000    0.078  0.067    0.383  0.346
        bridge_length          0.091  0.084    0.238  0.215    1.000  0.835
        segment_length          30.8     35     49.3   53.4       90   93.8
        segment_cv             0.639  0.565    0.746  0.687    0.804  0.749
        tortuosity             1.000  1.012    1.114  1.114    1.266  1.246
        cell_cv                0.538  0.539    0.974  0.944        -  0.859
        orientation            0.024  0.023    0.029  0.031    0.039  0.040
        roughness              0.000  0.172    0.308  0.358    0.488  0.394
        box_dimension          1.189  1.425    1.257  1.341    1.407  1.271
        width                  2.264  2.775    2.685  3.119    2.612  3.110
        width_ratio            2.564  2.329    1.971  1.897    1.954  1.905
        area_fraction          0.093  0.091    0.087  0.086    0.069  0.070

    Cells are faces within their own outline: an island inside is not taken off. A strand that leaves the picture has
    no node there; cells that it cuts are not counted, so that the largest are missed most often.

    Source: Sanderson and Nixon, The use of topology in fracture network characterization, 2015; Domokos, Jerolmack,
    Kun and Torok, Plato's cube and the natural geometry of fragmentation, 2020; Sidorov and Hardeberg, Craquelure as a
    graph, 2019; the lengths in pixels are those that reproduce figures measured on the masks of two paintings.

    Examples
    --------
    >>> import crazing as cz
    >>> maze = cz.measure(cz.crack(n=300, rng=7))
    >>> maze.loops, cz.measure(cz.crack(n=300, opening=0, rng=7)).i_nodes
    (0.0, 0.0)
    """
    spur, merge = number(spur, "spur", low=0), number(merge, "merge", low=0)
    if isinstance(source, (Crack, PlanarGraph)):
        if raster is None:
            return _exact(source, _cut(source, bounds), _gauge(_EXACT, border, reach))
        picture = stamp(source, count(raster, "raster", low=1, high=1 << 14), bounds=bounds)
    elif isinstance(source, (Record, Mapping)) or hasattr(source, "__geo_interface__"):
        raise TypeError(f"source is {arguments.found(source)}; a Crack, a PlanarGraph or a mask of pixels is wanted")
    elif raster is not None or bounds is not None:
        raise ValueError("raster and bounds are for cracks and graphs; a mask has its own pixels")
    else:
        picture = as_mask(source, level=level, dark=dark)
    return _traced(picture, spur, merge, _gauge(_PIXELS, border, reach))


def _gauge(default: tuple[float, ...], border: float | None, reach: float | None) -> tuple[float, ...]:
    given = [None if x is None else number(x, name, low=0) for x, name in ((border, "border"), (reach, "reach"))]
    return (*(old if new is None else new for old, new in zip(default[:2], given, strict=True)), *default[2:])


def _exact(source: Crack | PlanarGraph, bounds: _Bounds | None, gauge: tuple[float, ...]) -> CrackStatistics:
    lines, period = _lines(source)
    if period is not None:
        found = _core.statistics(lines, period, None, period[0] * period[1], gauge)
    else:
        found = _core.statistics(lines, (0.0, 0.0), bounds, _area(lines[0], lines[1], bounds), gauge)
    return _statistics(dict(found))


def _traced(picture: NDArray[np.bool_], spur: float, merge: float, gauge: tuple[float, ...]) -> CrackStatistics:
    height, width = map(float, picture.shape)
    vertices, edges, widths = _core.trace(picture, spur, merge)
    lines = (vertices, edges, _NO_SHIFTS, widths[edges])
    found = dict(_core.statistics(lines, (0.0, 0.0), (0.0, 0.0, width, height), height * width, gauge))
    return _statistics({**found, "area_fraction": float(picture.mean())})


def _statistics(found: Mapping[str, float]) -> CrackStatistics:
    """With NaN where the core divides by nothing: loops over no junction, boxes that a point meets."""
    return CrackStatistics(**{name: value if math.isfinite(value) else math.nan for name, value in found.items()})


def _lines(source: Crack | PlanarGraph) -> tuple[_Lines, tuple[float, float] | None]:
    """The arrays of a drawing for the core, and its period."""
    graph = source.graph if isinstance(source, Crack) else source
    widths = np.ascontiguousarray(source.width) if isinstance(source, Crack) else _NO_WIDTHS
    period: tuple[float, float] | None = getattr(source, "period", None)
    shifts = np.ascontiguousarray(getattr(source, "shifts", _NO_SHIFTS)) if period is not None else _NO_SHIFTS
    return (graph.vertices, graph.edges, shifts, widths), period


def _cut(source: Crack | PlanarGraph, bounds: ArrayLike | None) -> _Bounds | None:
    if bounds is not None:
        return areal(bounds_tuple(bounds))
    return areal(source.bounds, "crack.bounds") if isinstance(source, Crack) else None


def _area(vertices: NDArray[np.float64], edges: NDArray[np.int32], bounds: _Bounds | None) -> float:
    """Of the bounds, or of the box around the edges: a vertex without one is not drawn."""
    if bounds is None:
        ends = vertices[np.unique(edges)]
        low, high = (ends.min(axis=0), ends.max(axis=0)) if len(ends) else (np.zeros(2), np.zeros(2))
        with np.errstate(over="ignore"):
            sides = high - low
            square = (*low.tolist(), *(low + sides.max()).tolist())
        # A line along an axis has no area, and is to have none. What is not finite the core names by its row.
        if np.isfinite(ends).all() and sides.max(initial=0) > 0:
            areal(square, "the square about the edges")
        return float(sides[0] * sides[1])
    return (bounds[2] - bounds[0]) * (bounds[3] - bounds[1])


def as_mask(picture: ArrayLike, *, level: float = 0.5, dark: bool = False) -> NDArray[np.bool_]:
    """A picture as a mask.

    Parameters
    ----------
    picture : (H, W) or (H, W, 3 or 4) array_like
        Bool, integers or floats. Integers that are all 0 or 1 are a mask already: 1 is crack, whatever `level` is.
        Others are a part of the largest number of their dtype, so that of 32 or 64 bits they must reach beyond 65,535.
    level : float, optional
        Brightness, 0 to 1, above which there is crack.
    dark : bool, optional
        Whether cracks are dark on bright ground instead: then what is not above `level` is crack.

    Returns
    -------
    (H, W) bool
        True where there is crack.

    Raises
    ------
    TypeError, ValueError
        If the picture has another shape or dtype, or no pixel, or holds numbers of 8 or 16 bits in a wider dtype.

    Examples
    --------
    >>> from crazing.measure import as_mask
    >>> as_mask([[0.2, 0.8]], dark=True)
    array([[ True, False]])
    """
    level = number(level, "level")
    if not isinstance(dark, (bool, np.bool_)):
        raise TypeError(f"dark is {arguments.found(dark)}; True or False is wanted")
    if isinstance(picture, (str, os.PathLike)):
        raise TypeError(f"mask is {os.fspath(picture)!r}; pixels are wanted: crazing.images.read_image reads a file")
    array = arguments.regular(picture, "mask")
    if array.size and array.dtype.kind in "iu":
        low, high = int(array.min()), int(array.max())
        if low >= 0 and high <= 1:
            array, level = array.astype(bool), 0.5
        elif array.dtype.itemsize > 2 and high <= 0xFFFF:
            # As np.where(crack, 255, 0) gives it: white would be billions, and nothing crack.
            raise ValueError(
                f"mask has numbers from {low} to {high} of {array.dtype}, whose white is {np.iinfo(array.dtype).max}; "
                "bools, or numbers of 8 or 16 bits, are wanted"
            )
    bright = brightness(array, "mask") > level
    if not bright.size:
        raise ValueError(f"mask has shape {bright.shape}; one pixel or more is wanted")
    return np.ascontiguousarray(bright != bool(dark))


def thin(mask: ArrayLike) -> NDArray[np.bool_]:
    """The skeleton of a mask: lines one pixel wide with the same pieces (8 neighbours) and holes (4 neighbours).

    Parameters
    ----------
    mask : (H, W) array_like
        As for :func:`crazing.measure`.

    Returns
    -------
    (H, W) bool

    Raises
    ------
    TypeError, ValueError
        As for :func:`as_mask`.

    Examples
    --------
    >>> import numpy as np
    >>> from crazing.measure import thin
    >>> thin(np.ones((3, 9), bool)).sum(axis=0).max()
    np.int64(1)
    """
    return _core.thin(as_mask(mask))


def trace(mask: ArrayLike, *, spur: float = _SPUR, merge: float = _MERGE) -> tuple[PlanarGraph, NDArray[np.float64]]:
    """The centrelines of a mask, as they are measured.

    Parameters
    ----------
    mask : (H, W) array_like
        As for :func:`crazing.measure`.
    spur, merge : float, optional
        Pixels: free ends shorter than `spur` are cut off, junctions closer than `merge` become one.

    Returns
    -------
    graph : PlanarGraph
        In pixels, y up, the lower left corner of the picture at the origin; an edge a step from pixel to pixel.
    width : (v,) float64
        Width of the crack at every vertex, pixels: twice the distance to the nearest pixel that is no crack.

    Raises
    ------
    TypeError, ValueError
        As for :func:`as_mask`, or if a number is out of range.

    Examples
    --------
    >>> import numpy as np
    >>> from crazing.measure import trace
    >>> graph, width = trace(np.pad(np.ones((3, 60), bool), 9))
    >>> graph.components, float(np.median(width))
    (1, 4.0)
    """
    vertices, edges, width = _core.trace(as_mask(mask), number(spur, "spur", low=0), number(merge, "merge", low=0))
    return PlanarGraph(vertices, edges), width


def stamp(source: Crack | PlanarGraph, width: int, *, bounds: ArrayLike | None = None) -> NDArray[np.bool_]:
    """A pattern as a mask without grey: pixels whose centre is on a crack, and a line of pixels along every edge.

    Parameters
    ----------
    source : Crack or PlanarGraph
        What to draw; a periodic crack is drawn as one period.
    width : int
        Pixels across; as many down as the shape of the bounds asks for.
    bounds : (xmin, ymin, xmax, ymax), optional
        What to show, data units; needed for a graph.

    Returns
    -------
    (H, W) bool
        Row 0 is the top.

    Raises
    ------
    TypeError, ValueError
        If `bounds` are missing or a number is out of range.

    Examples
    --------
    >>> import crazing as cz
    >>> from crazing.measure import stamp
    >>> stamp(cz.crack(n=50, rng=1), 64).shape
    (64, 64)
    """
    box = _cut(source, bounds)
    if box is None:
        raise ValueError("bounds are missing; a graph does not know what it was cut to")
    across = count(width, "width", low=1, high=1 << 14)
    down = count(round(across * (box[3] - box[1]) / (box[2] - box[0])) or 1, "height", low=1, high=1 << 14)
    lines, period = _lines(source)
    return _core.stamp(lines, period or (0.0, 0.0), box, (down, across))
