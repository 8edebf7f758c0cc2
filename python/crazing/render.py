"""Cracks and graphs as pictures."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, arguments

Color: TypeAlias = "str | tuple[int, int, int] | tuple[int, int, int, int]"

MAX_PIXELS = 2**30
"""The most pixels one picture may have; it would take 4 GiB."""

MAX_COPIES = 2**26
"""The most edges that a periodic crack may be repeated to."""

_GRAPH_WIDTH = 1.5
"""Pixels; what Matplotlib's 1.5 points are at 72 dots an inch."""

_MARGIN = 0.02
"""The margin around a graph, as a part of its longer side."""


class Graph(Protocol):
    """Anything with straight edges between vertices."""

    @property
    def vertices(self) -> ArrayLike:
        """(v, 2) positions in data units."""

    @property
    def edges(self) -> ArrayLike:
        """(e, 2) rows of `vertices`."""


class Crack(Protocol):
    """A graph with a width at both ends of every edge."""

    @property
    def graph(self) -> Graph:
        """The edges."""

    @property
    def width(self) -> ArrayLike:
        """(e, 2) full widths at the two ends, data units."""

    @property
    def bounds(self) -> tuple[float, float, float, float] | None:
        """(xmin, ymin, xmax, ymax) in data units."""


@dataclass(frozen=True, kw_only=True)
class Style:
    """How edges are drawn.

    Parameters
    ----------
    ink
        Colour of the edges: ``"#rgb"``, ``"#rgba"``, ``"#rrggbb"``, ``"#rrggbbaa"``, or a tuple of 3 or 4 integers
        from 0 to 255. Alpha is straight.
    ground
        Colour under them; None leaves it transparent.
    width
        Full width of a graph's edges in data units; None draws them 1.5 pixels wide. A crack has its own widths.
    min_width
        No end of an edge is drawn thinner than this, in pixels; 0 lets tips run out to nothing.

    Examples
    --------
    >>> from crazing.render import Style
    >>> Style(ink="#a00", ground=None).min_width
    0.0
    """

    ink: Color = "#2b2622"
    ground: Color | None = "#f4f0e6"
    width: float | None = None
    min_width: float = 0.0

    def __post_init__(self) -> None:
        for name in ("ink", "ground"):
            given = getattr(self, name)
            # What is gone once it was read is kept.
            color = tuple(given) if isinstance(given, Iterator) else given
            parts = rgba(color, name)
            if color is not None and not isinstance(color, str):
                # Of a list or an array, which have no equality or hash that a style could use.
                object.__setattr__(self, name, parts[: len(color)])
        if self.width is not None:
            arguments.number(self.width, "width", low=0.0)
        arguments.number(self.min_width, "min_width", low=0.0)


def render(
    crack_or_graph: Crack | Graph,
    size: int | tuple[int, int],
    *,
    bounds: ArrayLike | None = None,
    style: Style | None = None,
    threads: int | None = None,
) -> NDArray[np.uint8]:
    """Draw a crack or a graph.

    Every edge is the convex hull of two discs, one at each end, so joints are round and have no seams; crossing
    edges do not blend twice. Every pixel takes 64 samples; what is thinner than 1/8 pixel is drawn 1/8 pixel wide,
    faint but unbroken, unless its width is 0 at both ends. The picture is the same for any number of threads.

    Parameters
    ----------
    crack_or_graph
        An object with ``graph``, ``width`` and ``bounds``, drawn with its widths; or one with ``vertices`` (v, 2)
        and ``edges`` (e, 2), drawn with the width of the style. A crack with a ``period`` is drawn again and again,
        as far as is shown.
    size
        (height, width) in pixels; one integer means a square. At most 2**30 pixels.
    bounds
        (xmin, ymin, xmax, ymax), the part of the data to show; the crack's own bounds, or a box around all edges
        with a margin of 2 %, by default. One scale in both directions: bounds of another shape than the picture
        lie centred in it, and what lies beside them is shown too.
    style
        Colours and widths.
    threads
        None takes all cores.

    Returns
    -------
    (H, W, 4) uint8
        sRGB and straight alpha. Row 0 is the top; y points up in the data.

    Raises
    ------
    TypeError, ValueError
        For arguments of the wrong kind, shape or range.
    CrazingError
        For a width that is negative or an edge that names a vertex that is not there or not finite.
    MemoryError
        When the picture does not fit into memory.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> from crazing.render import Style, render
    >>> cross = SimpleNamespace(vertices=[[0, 0], [4, 4], [0, 4], [4, 0]], edges=[[0, 1], [2, 3]])
    >>> picture = render(cross, 5, bounds=(0, 0, 4, 4), style=Style(ink="#f00", ground=None, width=1.0))
    >>> picture.shape, picture[2, 2].tolist(), picture[2, 0].tolist()
    ((5, 5, 4), [255, 0, 0, 255], [0, 0, 0, 0])
    """
    style = Style() if style is None else style
    if not isinstance(style, Style):
        raise TypeError(f"style is {type(style).__name__}; a crazing.Style is wanted")
    height, width = arguments.size_pair(size)
    if height * width > MAX_PIXELS:
        raise ValueError(f"size is {height} x {width}, {height * width} pixels; at most {MAX_PIXELS} are supported")
    workers = arguments.thread_count(threads)
    vertices, edges = _edges(getattr(crack_or_graph, "graph", crack_or_graph))
    box = _bounds(crack_or_graph, vertices, edges, bounds)
    widths = _widths(crack_or_graph, len(edges), style, min(width / (box[2] - box[0]), height / (box[3] - box[1])))
    if getattr(crack_or_graph, "period", None) is not None and hasattr(crack_or_graph, "shifts"):
        vertices, edges, widths = _repeated(crack_or_graph, vertices, edges, widths, _shown(box, height, width))
    picture = np.empty((height, width, 4), dtype=np.uint8)
    colors = rgba(style.ink, "ink"), rgba(style.ground, "ground")
    _core.render(vertices, edges, widths, box, *colors, float(style.min_width), workers, picture)
    return picture


def _edges(graph: Any) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    if not (hasattr(graph, "vertices") and hasattr(graph, "edges")):
        raise TypeError(f"{type(graph).__name__} has no vertices and edges; a crack or a graph is wanted")
    edges = np.asarray(graph.edges)
    if edges.size == 0:
        edges = np.empty((0, 2), dtype=np.int32)
    if edges.ndim != 2 or edges.shape[1] != 2 or edges.dtype.kind not in "iu":
        raise ValueError(f"edges is {edges.dtype} of shape {edges.shape}; integers of shape (n, 2) are wanted")
    limits = np.iinfo(np.int32)
    if edges.size and not (limits.min <= edges.min() and edges.max() <= limits.max):
        raise ValueError("edges holds numbers beyond 32 bits")
    return arguments.points_array(graph.vertices, "vertices"), np.ascontiguousarray(edges, dtype=np.int32)


def _widths(crack_or_graph: Any, edges: int, style: Style, scale: float) -> NDArray[np.float64]:
    if hasattr(crack_or_graph, "graph"):
        widths = arguments.real_array(crack_or_graph.width, "width")
        if widths.shape != (edges, 2) and not (edges == 0 == widths.size):
            raise ValueError(f"width has shape {widths.shape}; {(edges, 2)}, one row an edge, is wanted")
        return widths.reshape(edges, 2)
    width = _GRAPH_WIDTH / scale if style.width is None else float(style.width)
    return np.full((edges, 2), width)


def _shown(box: tuple[float, float, float, float], height: int, width: int) -> NDArray[np.float64]:
    """(2, 2) the lower left and the upper right corner of a picture, in data units."""
    low, high = np.reshape(box, (2, 2))
    half = np.array([width, height]) * float(((high - low) / (width, height)).max()) / 2
    middle = low / 2 + high / 2
    return np.stack([middle - half, middle + half])


def _repeated(
    crack: Any,
    vertices: NDArray[np.float64],
    edges: NDArray[np.int32],
    widths: NDArray[np.float64],
    shown: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64]]:
    """Every copy of every edge of a periodic crack that may be seen, with vertices of its own."""
    period = np.asarray(crack.period, dtype=float)
    ends = vertices[edges]
    ends[:, 1] += np.asarray(crack.shifts) * period
    around = widths.max(axis=1, initial=0)[:, None] / 2
    first = np.ceil((shown[0] - ends.max(axis=1) - around) / period)
    last = np.floor((shown[1] - ends.min(axis=1) + around) / period)
    across, up = np.maximum(last - first + 1, 0).T
    count = float((across * up).sum())
    if count > MAX_COPIES:
        wanted = f"at most {MAX_COPIES} are drawn: smaller bounds are wanted"
        raise ValueError(f"bounds show {count:.0f} edges of copies of one period; {wanted}")
    row = np.repeat(np.arange(len(edges)), (across * up).astype(np.int64))
    copy = np.arange(len(row)) - np.repeat(np.cumsum(across * up) - across * up, (across * up).astype(np.int64))
    turns = first[row] + np.column_stack([copy % across[row], copy // across[row]])
    places = (ends[row] + (turns * period)[:, None]).reshape(-1, 2)
    return places, np.arange(2 * len(row), dtype=np.int32).reshape(-1, 2), widths[row]


def _bounds(
    crack_or_graph: Any,
    vertices: NDArray[np.float64],
    edges: NDArray[np.int32],
    bounds: Any,
) -> tuple[float, float, float, float]:
    if bounds is None and hasattr(crack_or_graph, "graph"):
        bounds = getattr(crack_or_graph, "bounds", None)
    return _box(vertices, edges) if bounds is None else arguments.bounds_tuple(bounds)


def _box(vertices: NDArray[np.float64], edges: NDArray[np.int32]) -> tuple[float, float, float, float]:
    """The box of all vertices that an edge names and that are there and finite, with a margin."""
    named = edges[(edges >= 0) & (edges < len(vertices))]
    places = vertices[named]
    places = places[np.isfinite(places).all(axis=1)]
    if not len(places):
        return 0.0, 0.0, 1.0, 1.0
    (xmin, ymin), (xmax, ymax) = places.min(axis=0), places.max(axis=0)
    # A single place still needs a box that floats can tell apart, and can scale to pixels.
    smallest = max(abs(xmin), abs(xmax), abs(ymin), abs(ymax)) * 1e-9
    margin = max(_MARGIN * max(xmax - xmin, ymax - ymin), smallest)
    margin = margin if margin > 1e-290 else 1.0
    box = (xmin - margin, ymin - margin, xmax + margin, ymax + margin)
    return arguments.bounds_tuple(tuple(map(float, box)), "the box around the edges")


def rgba(color: Any, name: str) -> tuple[int, int, int, int]:
    """Straight RGBA of a colour of a style; None is clear."""
    if color is None and name == "ground":
        return 0, 0, 0, 0
    if isinstance(color, str):
        parts = _hex_parts(color, name)
    else:
        try:
            parts = [arguments.count(part, f"{name}[{i}]", high=255) for i, part in enumerate(color)]
        except TypeError:
            raise TypeError(f"{name} is {color!r}; '#rrggbb' or 3 or 4 integers are wanted") from None
    if len(parts) not in (3, 4):
        raise ValueError(f"{name} is {color!r}; 3 or 4 channels are wanted")
    red, green, blue, alpha = [*parts, 255][:4]
    return red, green, blue, alpha


def _hex_parts(color: str, name: str) -> list[int]:
    if not re.fullmatch(r"#(?:[0-9a-fA-F]{3,4}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})", color):
        raise ValueError(f"{name} is {color!r}; '#rgb', '#rgba', '#rrggbb' or '#rrggbbaa' is wanted")
    digits = color[1:]
    if len(digits) < 6:
        digits = "".join(2 * digit for digit in digits)
    return list(bytes.fromhex(digits))
