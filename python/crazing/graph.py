"""Any drawing of straight edges: measuring, joining into lines, handing on to other packages."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, arguments, files
from crazing.extras import axes, require
from crazing.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Most edges of a picture that a notebook is sent unasked: about a megabyte of SVG.
PREVIEW_EDGES = 20_000


@dataclass(frozen=True, eq=False, repr=False)
class PlanarGraph(Record):
    """Vertices in the plane and straight edges between them.

    Vertices without an edge are allowed: graphs drawn from one diagram share its numbering. Edges may repeat
    or join a vertex to itself. Whether edges cross is not looked at.

    Parameters
    ----------
    vertices : (v, 2) float64
        Positions in data units, y up; any array-like of real numbers. Read-only, copied if it must be.
    edges : (e, 2) int32
        Two rows of `vertices` each; any array-like of integers. Read-only, copied if it must be.

    Raises
    ------
    TypeError
        If the dtypes are wrong.
    ValueError
        If a shape is wrong or an edge has an end that is no vertex; the message names the first.

    Examples
    --------
    >>> from crazing import PlanarGraph
    >>> PlanarGraph([[0, 0], [3, 0], [3, 4]], [[0, 1], [1, 2]])
    PlanarGraph(3 vertices, 2 edges)
    """

    vertices: NDArray[np.float64]
    edges: NDArray[np.int32]

    def __post_init__(self) -> None:
        vertices = arguments.points_array(self.vertices, "vertices")
        object.__setattr__(self, "vertices", vertices)
        object.__setattr__(self, "edges", arguments.index_pairs(self.edges, "edges", limit=len(vertices)))
        super().__post_init__()

    @classmethod
    def _of_core(cls, vertices: NDArray[np.float64], edges: NDArray[np.int32]) -> PlanarGraph:
        """A graph of arrays that the core has made, and nobody has to look through again."""
        graph = object.__new__(cls)
        object.__setattr__(graph, "vertices", vertices)
        object.__setattr__(graph, "edges", edges)
        Record.__post_init__(graph)
        return graph

    def __repr__(self) -> str:
        return f"PlanarGraph({len(self.vertices)} vertices, {len(self.edges)} edges)"

    @property
    def segments(self) -> NDArray[np.float64]:
        """(e, 2, 2) float64, the positions of both ends of every edge, in the order of `edges`.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [3, 4]], [[0, 1]]).segments
        array([[[0., 0.],
                [3., 4.]]])
        """
        return self.vertices[self.edges]

    @property
    def lengths(self) -> NDArray[np.float64]:
        """(e,) float64, the length of every edge in data units, in the order of `edges`.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [3, 4], [3, 0]], [[0, 1], [1, 2]]).lengths
        array([5., 4.])
        """
        # What is longer than the largest float is infinite.
        with np.errstate(over="ignore", invalid="ignore"):
            step = self.vertices[self.edges[:, 1]] - self.vertices[self.edges[:, 0]]
            return np.asarray(np.hypot(step[:, 0], step[:, 1]))

    @property
    def length(self) -> float:
        """Total length of the edges in data units.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [3, 4], [3, 0]], [[0, 1], [1, 2]]).length
        9.0
        """
        return float(self.lengths.sum())

    @property
    def degrees(self) -> NDArray[np.int32]:
        """(v,) int32, the number of edge ends at every vertex; an edge from a vertex to itself counts twice.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [3, 4], [3, 0]], [[0, 1], [1, 2]]).degrees
        array([1, 2, 1], dtype=int32)
        """
        return _core.graph_degrees(len(self.vertices), self.edges)

    @property
    def leaves(self) -> int:
        """Number of vertices where exactly one edge ends.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [3, 4], [3, 0]], [[0, 1], [1, 2]]).leaves
        2
        """
        return int(np.count_nonzero(self.degrees == 1))

    @cached_property
    def _components(self) -> tuple[NDArray[np.int32], int]:
        labels, count = _core.graph_components(len(self.vertices), self.edges)
        labels.flags.writeable = False
        return labels, count

    @property
    def components(self) -> int:
        """Number of connected components among the vertices that have an edge.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [1, 0], [2, 0]], [[0, 1]]).components
        1
        """
        return self._components[1]

    @property
    def labels(self) -> NDArray[np.int32]:
        """(v,) int32, the component of every vertex, numbered as `edges` meets them; -1 where no edge ends.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [1, 0], [2, 0], [2, 1], [9, 9]], [[2, 3], [0, 1]]).labels
        array([ 1,  1,  0,  0, -1], dtype=int32)
        """
        return self._components[0]

    def compact(self) -> PlanarGraph:
        """The same drawing without the vertices that no edge uses.

        Returns
        -------
        PlanarGraph
            Its vertices keep their order, and so do its edges.

        Examples
        --------
        >>> PlanarGraph([[9, 9], [0, 0], [3, 4]], [[2, 1]]).compact().edges
        array([[1, 0]], dtype=int32)
        """
        return PlanarGraph(*_core.graph_compact(self.vertices, self.edges))

    def polylines(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """The edges joined into the longest lines that pass no junction; every edge is in one line, once.

        First the chains between vertices of degree other than 2, in the order of their first edge end, then
        the closed rings, whose first point is repeated at the end, in the order of their first edge.

        Returns
        -------
        coords : (p, 2) float64
            Points of all lines one after the other, in data units.
        offsets : (lines + 1,) int64
            Line `i` is `coords[offsets[i]:offsets[i + 1]]`; it has two points or more.

        Examples
        --------
        >>> coords, offsets = PlanarGraph([[0, 0], [1, 0], [1, 1]], [[2, 1], [0, 1]]).polylines()
        >>> coords.tolist(), offsets.tolist()
        ([[1.0, 1.0], [1.0, 0.0], [0.0, 0.0]], [0, 3])
        """
        rows, offsets = _core.graph_polylines(len(self.vertices), self.edges)
        return self.vertices[rows], offsets

    def distances(self, points: ArrayLike) -> NDArray[np.float64]:
        """How far points are from the drawing.

        Parameters
        ----------
        points : (n, 2) array_like
            In data units.

        Returns
        -------
        (n,) float64
            Distance of each from the nearest point of the nearest edge, in data units; infinite without edges.

        Raises
        ------
        TypeError, ValueError
            If `points` has not the shape of points.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [3, 0]], [[0, 1]]).distances([[1, 2], [6, 4]])
        array([2., 5.])
        """
        return _core.graph_distances(self.vertices, self.edges, arguments.points_array(points))

    def plot(self, ax: Axes | None = None, **line_style: Any) -> Axes:
        """Draws the edges with Matplotlib, at equal scales.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; the current axes of pyplot if not given.
        **line_style
            As for `matplotlib.collections.LineCollection`: `color`, `linewidth`, `alpha`, `label`...

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on; showing it is left to the caller.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.

        Examples
        --------
        >>> from matplotlib.figure import Figure
        >>> ax = PlanarGraph([[0, 0], [3, 4]], [[0, 1]]).plot(Figure().subplots(), color="black")
        >>> len(ax.collections)
        1
        """
        drawn_on: Axes = axes(ax)
        lines = require("matplotlib.collections", "plot").LineCollection(self.segments, **line_style)
        drawn_on.add_collection(lines)
        drawn_on.set_aspect("equal")
        drawn_on.autoscale_view()
        return drawn_on

    def to_networkx(self) -> Any:
        """The same graph for NetworkX.

        Returns
        -------
        networkx.Graph
            Nodes are the rows of `vertices`, with the attribute `pos`, an (x, y) tuple; edges have the
            attribute `length`. Repeated edges become one.

        Raises
        ------
        ImportError
            If NetworkX is not installed.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [3, 4]], [[0, 1]]).to_networkx().edges(data="length")
        EdgeDataView([(0, 1, 5.0)])
        """
        graph = require("networkx", "graph").Graph()
        graph.add_nodes_from((row, {"pos": (x, y)}) for row, (x, y) in enumerate(self.vertices.tolist()))
        ends = self.edges.tolist()
        lengths = self.lengths.tolist()
        graph.add_weighted_edges_from(
            ((a, b, length) for (a, b), length in zip(ends, lengths, strict=True)), weight="length"
        )
        return graph

    def to_shapely(self) -> Any:
        """The polylines as one geometry of Shapely.

        Returns
        -------
        shapely.MultiLineString
            One line for each of `polylines`, in the same order, in data units. A reference system is not kept: give
            GeoPandas that of the input.

        Raises
        ------
        ImportError
            If Shapely is not installed.

        Examples
        --------
        >>> PlanarGraph([[0, 0], [3, 4]], [[0, 1]]).to_shapely().wkt
        'MULTILINESTRING ((0 0, 3 4))'
        """
        shapely = require("shapely", "graph")
        coords, offsets = self.polylines()
        line_of = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
        return shapely.MultiLineString(list(shapely.linestrings(coords, indices=line_of)))

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        """The polylines as a GeoJSON geometry of type MultiLineString, in data units, without a reference system."""
        coords, offsets = self.polylines()
        points = [tuple(point) for point in files.rows_of(coords)]
        starts, ends = offsets[:-1].tolist(), offsets[1:].tolist()
        lines = tuple(tuple(points[start:end]) for start, end in zip(starts, ends, strict=True))
        return {"type": "MultiLineString", "coordinates": lines}

    def to_svg(self, *, title: str | None = None, stroke: str = "black", width: float | None = None) -> str:
        """The polylines as a picture in SVG.

        Parameters
        ----------
        title : str, optional
            What viewers show as the name of the picture.
        stroke : str
            Colour of the lines, in the words of CSS.
        width : float, optional
            Width of the lines in data units; 1/500 of the longer side of the picture if not given.

        Returns
        -------
        str
            One path. Its coordinates are those of the data with the sign of y turned, as y points down in
            SVG; read back, they are equal to the last bit. A drawing farther from the origin than 64 times its size
            is moved there by a `transform`, since browsers and others calculate in single precision; with it they
            are equal, too.

        Raises
        ------
        ValueError
            If a vertex in use is not finite, or the width is negative.

        Examples
        --------
        >>> print(PlanarGraph([[0, 0], [3, 4]], [[0, 1]]).to_svg(width=1, title="3 & 4"))
        <svg xmlns="http://www.w3.org/2000/svg" viewBox="-1.0 -5.0 5.0 6.0">
        <title>3 &amp; 4</title>
        <metadata>crazing ...</metadata>
        <path fill="none" stroke="black" stroke-width="1.0" stroke-linecap="round" stroke-linejoin="round"
        d="M0.0 0.0L3.0 -4.0"/>
        </svg>
        """
        from crazing import export

        return export.svg(self, title=title, stroke=stroke, width=width)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the polylines to a file, in data units; an existing file is replaced.

        Parameters
        ----------
        path : str or path-like
            Its ending decides the format: `.svg` (as `to_svg`), `.geojson` (one feature, of type
            MultiLineString) or `.dxf` (one LWPOLYLINE a line, without a unit; needs ezdxf, the extra `cad`). All
            keep every bit of a coordinate. GeoJSON names no reference system; programs take it for longitude and
            latitude unless they are told another.

        Raises
        ------
        ValueError
            If the ending is another, or a vertex in use is not finite.
        OSError
            If the file cannot be written; what stood there before is then untouched.
        ImportError
            If ezdxf is needed and not installed.

        Examples
        --------
        >>> import json, os, tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = os.path.join(folder, "line.geojson")
        ...     PlanarGraph([[0, 0], [3, 4]], [[0, 1]]).save(path)
        ...     with open(path) as file:
        ...         json.load(file)["geometry"]
        {'type': 'MultiLineString', 'coordinates': [[[0.0, 0.0], [3.0, 4.0]]]}
        """
        from crazing import export

        export.save(self, path)

    def _repr_svg_(self) -> str | None:
        if not 0 < len(self.edges) <= PREVIEW_EDGES:
            return None
        try:
            return self.to_svg()
        except ValueError:
            # Not finite: the notebook then prints the counts.
            return None
