"""The steps of a crack, from drawing to drawing: what recipes are composed of, each usable alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, arguments, course
from crazing.crack import Crack
from crazing.diagram import Diagram, unconstrained
from crazing.drawing import Bounds, Drawing, Fence, Net, draw, paired
from crazing.maze import Maze
from crazing.rng import RNG, key

__all__ = [
    "Drawing",
    "draw",
    "follow",
    "impact",
    "part",
    "roughen",
    "split",
    "straighten",
    "stubs",
    "walls",
    "warp",
    "widen",
]


def __dir__() -> list[str]:
    """What is public, for completion."""
    return __all__


def walls(maze: Maze) -> Drawing:
    """The walls of a maze of Voronoi cells.

    Parameters
    ----------
    maze : Maze
        In the plane or on a torus; its cells are the fence.

    Returns
    -------
    Drawing
        The thesis' pattern.

    Raises
    ------
    ValueError
        If the cells of the maze are triangles, or it is within a shape.

    Examples
    --------
    >>> import crazing as cz
    >>> m = cz.maze(cz.sample.uniform(50, rng=2), bounds=(0, 0, 1, 1), rng=2)
    >>> cz.steps.walls(m).bounds
    (0.0, 0.0, 1.0, 1.0)
    """
    return paired(*_walls(arguments.of_kind(maze, "maze", Maze)), maze.bounds)


def _walls(maze: Maze) -> tuple[Net, Fence]:
    d = maze.diagram
    if maze.cells != "voronoi" or maze.region is not None:
        raise ValueError("a maze of triangles or within a shape; one of Voronoi cells is wanted")
    if d.period is None:
        return _core.crack_walls(d.arrays, maze.open, maze.bounds)
    shifts = np.ascontiguousarray(d.shifts), np.ascontiguousarray(d.dual_shifts)
    return _core.crack_walls_on_torus(d.arrays, maze.open, *shifts, d.period)


def carved(
    diagram: Diagram,
    tree: str,
    opening: float,
    bounds: Bounds,
    seed: np.random.Generator,
    stretch: tuple[NDArray[np.float64], NDArray[np.float64], Bounds] | None = None,
) -> tuple[Drawing, float]:
    """The walls of a maze in the plane, and the spacing of its plates: what :func:`walls` draws, in one call.

    With `stretch` they are mapped by its matrix about its centre, and trimmed to its bounds.
    """
    how = tree, opening, key(seed), bounds, stretch
    net, fence, partner, spacing = _core.crack_plates(unconstrained(diagram).arrays, *how)
    within = bounds if stretch is None else stretch[2]
    return Drawing(*net, within, fence, partner, np.empty(0, dtype=np.int32)), spacing


def stretched(maze: Maze, matrix: NDArray[np.float64], centre: NDArray[np.float64], bounds: Bounds) -> Drawing:
    """The walls of a maze on a torus that was carved in a frame: mapped back by `matrix` about `centre`."""
    (vertices, edges, shifts, _, cut), (anchors, kites, turns) = _walls(maze)
    back = [np.ascontiguousarray(points @ matrix.T + centre) for points in (vertices, anchors)]
    if abs(matrix[0, 1]) > abs(matrix[0, 0]):  # A quarter turn: what crossed the one side crosses the other.
        turn = np.sign(matrix[0, 1]), np.sign(matrix[1, 0])
        shifts = np.ascontiguousarray(shifts[:, ::-1] * np.array(turn, dtype=np.int8))
        turns = np.ascontiguousarray(turns.reshape(-1, 3, 2)[:, :, ::-1] * np.array(turn, dtype=np.int8))
        turns = turns.reshape(-1, 6)
    # The bounds are the period as it was given; through the frame and back it would be off by roundings.
    period = bounds[2] - bounds[0], bounds[3] - bounds[1]
    return paired((back[0], edges, shifts, period, cut), (back[1], kites, turns), bounds)


def split(
    n: int,
    *,
    bounds: ArrayLike = (0, 0, 1, 1),
    period: ArrayLike | None = None,
    jitter: float = 0.3,
    bend: float = 1.0,
    anisotropy: float = 1.0,
    angle: float = 0.0,
    density: tuple[NDArray[np.float64], Bounds] | None = None,
    rng: RNG = None,
) -> Drawing:
    """Cracks that split cell after cell, each meeting the older ones at right angles.

    Parameters
    ----------
    n : int
        Number of cells in the end.
    bounds : (xmin, ymin, xmax, ymax)
        What is split, data units.
    period : (width, height), optional
        What is repeated, instead of `bounds`; its first cells are those of four points.
    jitter : float
        Standard deviation of the logarithm of the size by which the next cell is chosen: 0 makes all alike.
    bend : float
        How far new cracks bend to meet old ones at right angles, 0 to 1.
    anisotropy : float
        Cells are about this many times as long, along `angle`, as they are wide.
    angle : float
        Degrees from the x axis.
    density : (pixels, bounds), optional
        Cells are smaller where the pixels, row 0 at the top, are larger.
    rng : int, numpy.random.Generator or None
        Seed.

    Returns
    -------
    Drawing
        Its cracks know their age.

    Raises
    ------
    TypeError, ValueError
        If an argument is of the wrong type or out of range.

    Notes
    -----
    Source: after Bohn, Pauchard, Couder: Hierarchical crack pattern as formed by successive domain divisions (2005).

    Examples
    --------
    >>> import crazing as cz
    >>> int(cz.steps.split(20, rng=1).age.max()) + 1
    19
    """
    box = _box(bounds, period)
    found = _core.crack_split(
        box,
        period is not None,
        arguments.count(n, "n"),
        arguments.number(jitter, "jitter", low=0, high=8),
        arguments.number(bend, "bend", low=0, high=1),
        arguments.number(anisotropy, "anisotropy", low=1, high=100),
        float(np.radians(arguments.number(angle, "angle"))),
        density,
        key(rng),
    )
    return Drawing(*found[0], box, *found[1:])


def impact(
    n: int,
    *,
    source: ArrayLike | None = None,
    speed: float = 200.0,
    arcs: float = 0.8,
    bounds: ArrayLike = (0, 0, 1, 1),
    period: ArrayLike | None = None,
    rng: RNG = None,
) -> Drawing:
    """Cracks of an impact on glass: straight spokes, then arcs between them.

    On a torus the longest spokes go on until they meet cracks about a copy of the source.

    Parameters
    ----------
    n : int
        The more, the finer the pieces; some hundreds at most.
    source : (x, y), optional
        Where, data units; the middle by default.
    speed : float
        Of what hits, km/h: the number of spokes grows as its square root, 4 at 70 and 8 at 280.
    arcs : float
        The share of arcs that are there near the source; fewer farther out.
    bounds : (xmin, ymin, xmax, ymax)
        What the cracks are clipped to, data units.
    period : (width, height), optional
        What is repeated, instead of `bounds`.
    rng : int, numpy.random.Generator or None
        Seed.

    Returns
    -------
    Drawing
        Its cracks know their age.

    Raises
    ------
    TypeError, ValueError
        If an argument is of the wrong type or out of range.

    Notes
    -----
    Source: Vandenberghe, Vermorel, Villermaux: Star-Shaped Crack Pattern of Broken Windows (PRL 2013).

    Examples
    --------
    >>> import crazing as cz
    >>> drawing = cz.steps.impact(60, speed=280, rng=1)
    >>> int((drawing.edges == drawing.edges[0, 0]).sum())
    8
    """
    box = _box(bounds, period)
    x, y = ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2) if source is None else _place(source)
    found = _core.crack_impact(
        box,
        period is not None,
        (arguments.number(x, "source[0]"), arguments.number(y, "source[1]")),
        arguments.number(speed, "speed", low=1e-3, high=1e6),
        arguments.count(n, "n"),
        arguments.number(arcs, "arcs", low=0, high=1),
        key(rng),
    )
    return Drawing(*found[0], box, *found[1:])


def _box(bounds: ArrayLike, period: ArrayLike | None) -> Bounds:
    if period is None:
        return arguments.areal(arguments.bounds_tuple(bounds))
    return 0.0, 0.0, *arguments.areal(arguments.period_pair(period), "period")


def _place(source: ArrayLike) -> tuple[float, float]:
    x, y = arguments.entries(source, "source", 2, "(x, y)")
    return x, y


def follow(drawing: Drawing, *, turn: float = 60.0) -> Drawing:
    """Follow the cracks anew: at a junction a crack goes on only where it turns by no more than an angle.

    Parameters
    ----------
    drawing : Drawing
    turn : float
        Degrees, 0 to 180.

    Returns
    -------
    Drawing
        The same edges; cracks have no age but their length.

    Raises
    ------
    TypeError, ValueError
        If the angle is out of range.

    Examples
    --------
    >>> import crazing as cz
    >>> plain = cz.steps.walls(cz.maze(cz.sample.uniform(50, rng=2), rng=2))
    >>> bool((cz.steps.follow(plain, turn=20).partner == -1).sum() > (plain.partner == -1).sum())
    True
    """
    arguments.of_kind(drawing, "drawing", Drawing)
    partner = _core.crack_pairs(drawing.net, course.turning(turn))
    return replace(drawing, partner=partner, age=np.empty(0, dtype=np.int32))


def part(drawing: Drawing, *, hairpin: float, reach: float, spacing: float = 0.0) -> Drawing:
    """Part cracks where they turn back on themselves: two free tips instead of a hook.

    Parameters
    ----------
    drawing : Drawing
        Not yet rough.
    hairpin : float
        Degrees, 0 to 180: cracks that turn by more are parted.
    reach : float
        How far along the crack the turn is looked for, data units, over 128 edges at most; over a half and a quarter
        of it too, so that a crack that turns back twice in a short way is parted.
    spacing : float
        How far apart the plates are where that reach holds, data units: where they are farther apart it is longer in
        proportion. 0, the default, is one reach everywhere.

    Returns
    -------
    Drawing
        Without the shorter edge at each such turn, and without the vertices that then have none; where a third one
        meets the two, all stay, and the cracks end.

    Raises
    ------
    TypeError, ValueError
        If a number is out of range.

    Examples
    --------
    >>> import crazing as cz
    >>> hook = cz.PlanarGraph([(0, 0), (0, 4), (0.2, 5), (0.4, 4), (0.4, 0)], [(0, 1), (1, 2), (2, 3), (3, 4)])
    >>> len(cz.steps.part(cz.steps.draw(hook), hairpin=120, reach=2).edges)
    3
    """
    arguments.of_kind(drawing, "drawing", Drawing)
    turn = course.hooks(hairpin, reach, spacing)
    age = np.ascontiguousarray(drawing.age)
    net, fence, partner, age = _core.crack_part(drawing.net, drawing.fence, drawing.partner, age, turn)
    return Drawing(*net, drawing.bounds, fence, partner, age)


def straighten(
    drawing: Drawing,
    *,
    rounds: int = 5,
    pull: float = 0.64,
    slide: float = 0.18,
    clamp: float = 0.2,
    unbend: int = 0,
) -> Drawing:
    """Pull cracks straight, and slide them so that cracks that abut meet them at right angles.

    Parameters
    ----------
    drawing : Drawing
    rounds : int
        2 to 5 measure like paint, 40 are too straight.
    pull : float
        The part of the way to the chord between its neighbours that a vertex goes in a round.
    slide : float
        The part of the way along the chord to where the abutting crack meets it at 90 degrees.
    clamp : float
        The part of the chord at both ends that sliding keeps out of.
    unbend : int
        Rounds that come first and pull at bends only, half of the way to the chord: where two edges meet and no other
        crack.

    Returns
    -------
    Drawing
        The same edges. None crosses another or changes sides: moves that would are halved twice, then left out.

    Raises
    ------
    TypeError, ValueError
        If an argument is of the wrong type or out of range.

    Examples
    --------
    >>> import crazing as cz
    >>> m = cz.maze(cz.sample.uniform(50, rng=2), bounds=(0, 0, 1, 1), rng=2)
    >>> plain = cz.steps.walls(m)
    >>> straight = cz.steps.straighten(plain, rounds=3)
    >>> cz.PlanarGraph(straight.vertices, straight.edges).length < m.walls.length
    True
    """
    arguments.of_kind(drawing, "drawing", Drawing)
    how = course.straightening(rounds, pull, slide, clamp, unbend)
    moved = _core.crack_straighten(drawing.net, drawing.partner, drawing.fence, how)
    return replace(drawing, vertices=moved)


def stubs(
    drawing: Drawing,
    *,
    rate: float,
    length: float,
    unit: float,
    spread: float = 0.3,
    lean: float = course.LEAN,
    rng: RNG = None,
) -> Drawing:
    """Grow stubs: short free branches that leave cracks at about a right angle.

    Parameters
    ----------
    drawing : Drawing
        Not yet rough: pieces of rough cracks have no room of their own.
    rate : float
        Stubs tried along one `unit` of crack.
    length : float
        Median length, in units.
    unit : float
        A length, data units; recipes take the spacing of the plates.
    spread : float
        Standard deviation of the logarithm of length.
    lean : float
        Standard deviation of the angle to the right angle, degrees.
    rng : int, numpy.random.Generator or None
        Seed.

    Returns
    -------
    Drawing
        What was there stays, pieces of one edge being a strand still. Each stub is a strand of its own, the youngest
        where cracks know their age. Stubs that would meet another crack, leave the bounds or be longer than the edge
        they grow from are left out, so that there are fewer than tried, long ones most.

    Raises
    ------
    TypeError, ValueError
        If an argument is of the wrong type or out of range.

    Examples
    --------
    >>> import crazing as cz
    >>> bare = cz.steps.split(20, rng=1)
    >>> grown = cz.steps.stubs(bare, rate=2, length=0.2, unit=0.2, rng=1)
    >>> stubs = (len(grown.vertices) - len(bare.vertices)) // 2
    >>> stubs > 0, len(grown.edges) - len(bare.edges) == 2 * stubs
    (True, True)
    """
    arguments.of_kind(drawing, "drawing", Drawing)
    how = course.stubbing(rate, length, unit, spread, lean)
    age = np.ascontiguousarray(drawing.age)
    found = _core.crack_stubs(drawing.net, drawing.fence, drawing.partner, age, drawing.bounds, how, key(rng))
    net, fence, partner, age = found
    return Drawing(*net, drawing.bounds, fence, partner, age)


def roughen(
    drawing: Drawing,
    *,
    roughness: float,
    unit: float,
    hurst: float = 0.7,
    grain: float = 0.15,
    rounding: float = 0.0,
    rng: RNG = None,
) -> Drawing:
    """Let cracks wander: 1/f displacement, zero at junctions and ends; edges are subdivided.

    Parameters
    ----------
    drawing : Drawing
    roughness : float
        Standard deviation in the middle of a crack as long as `unit`, as a part of it.
    unit : float
        A length, data units; recipes take the spacing of the plates.
    hurst : float
        Deviation grows with this power of length: .5 is a random walk, .7 is what real cracks show.
    grain : float
        Edges are halved until no longer than this many units, or until their pieces are next to straight: till the
        middle of each lies off its chord by no more than a 25th of this in standard deviation, and by no more than a
        40th where they are bent. Edges with a free tip are halved to the grain, since there width runs out in a curve.
    rounding : float
        How far edges are bent, so that cracks turn in curves instead of corners: 0 not at all, 1 all the way, where
        there is room.
    rng : int, numpy.random.Generator or None
        Seed.

    Returns
    -------
    Drawing
        Junctions and what they join are the same, and nothing new crosses: an edge wanders within its own kite.

    Raises
    ------
    TypeError, ValueError
        If an argument is of the wrong type or out of range.

    Notes
    -----
    Source: Fournier, Fussell, Carpenter: Computer Rendering of Stochastic Models (1982); Catmull, Rom: A class of local
    interpolating splines (1974), for the curves.

    Examples
    --------
    >>> import crazing as cz
    >>> smooth = cz.steps.split(20, rng=1)
    >>> rough = cz.steps.roughen(smooth, roughness=0.05, unit=0.2, rng=1)
    >>> len(rough.edges) > len(smooth.edges)
    True
    """
    arguments.of_kind(drawing, "drawing", Drawing)
    how = course.roughness(roughness, unit, hurst, grain, rounding)
    # Pieces have no room of their own: a rough drawing takes no more steps that move it.
    found = _core.crack_roughen(drawing.net, drawing.partner, drawing.fence, how, key(rng))
    net, fence, partner, origin = found
    age = drawing.age[origin] if len(drawing.age) else drawing.age
    return Drawing(*net, drawing.bounds, fence, partner, age, origin)


def warp(drawing: Drawing, *, amplitude: float, rng: RNG = None) -> Drawing:
    """Warp the whole drawing smoothly: no line stays quite straight, no angle quite even.

    Parameters
    ----------
    drawing : Drawing
    amplitude : float
        Standard deviation of the displacement along each axis, data units.
    rng : int, numpy.random.Generator or None
        Seed.

    Returns
    -------
    Drawing
        The same edges; none crosses another or changes sides. Ends on the bounds stay.

    Raises
    ------
    TypeError, ValueError
        If an argument is of the wrong type or out of range.

    Examples
    --------
    >>> import crazing as cz
    >>> plain = cz.steps.split(20, rng=1)
    >>> bool((cz.steps.warp(plain, amplitude=0.01, rng=1).vertices != plain.vertices).any())
    True
    """
    arguments.of_kind(drawing, "drawing", Drawing)
    amplitude = arguments.number(amplitude, "amplitude", low=0)
    vertices, anchors = _core.crack_warp(drawing.net, drawing.fence, amplitude, drawing.bounds, key(rng))
    return replace(drawing, vertices=vertices, fence=(anchors, *drawing.fence[1:]))


def widen(
    drawing: Drawing,
    *,
    width: float,
    hierarchy: float = 0.5,
    shrink: float = 1.0,
    taper: float = 0.5,
    abutting: float = 0.6,
    unevenness: float = 0.0,
    unit: float = 1.0,
    source: ArrayLike = (0.0, 0.0),
    reach: float = 1.0,
    fade: float = 0.0,
    rng: RNG = None,
) -> Crack:
    """Give cracks their width: old and long ones are wide, free tips run out to a point.

    Parameters
    ----------
    drawing : Drawing
    width : float
        Of the longest crack, data units.
    hierarchy : float
        Width grows with this power of the length of a crack.
    shrink : float
        Width is this part of the parent generation's.
    taper : float
        The part of a crack over which a free tip runs out.
    abutting : float
        Width of an abutting end, as a part of the crack's own.
    unevenness : float
        Standard deviation of the logarithm of width from crack to crack; half of it along a crack.
    unit : float
        The length over which width changes along a crack, data units.
    source : (x, y)
        Where width is full; on a torus its copies too.
    reach, fade : float
        At a distance d from the source width is ``(1 + (d / reach)**2)**(-fade / 2)`` of it.
    rng : int, numpy.random.Generator or None
        Seed.

    Returns
    -------
    Crack

    Raises
    ------
    TypeError, ValueError
        If an argument is of the wrong type or out of range.

    Examples
    --------
    >>> import crazing as cz
    >>> c = cz.steps.widen(cz.steps.split(20, rng=1), width=0.01, hierarchy=0, shrink=0.8)
    >>> float(c.width.max())
    0.01
    """
    arguments.of_kind(drawing, "drawing", Drawing)
    profile = course.widths(
        width, hierarchy, shrink, taper, abutting, unevenness, unit, source=source, reach=reach, fade=fade
    )
    age, origin = (np.ascontiguousarray(rows) for rows in (drawing.age, drawing.origin))
    looks = _core.crack_widths(drawing.net, drawing.partner, age, origin, profile, key(rng))
    vertices, edges, shifts = drawing.vertices, drawing.edges, drawing.shifts
    if any(drawing.period):
        vertices, edges, shifts, _, _ = _core.crack_wrap(drawing.net)
    return course.widened(vertices, edges, shifts, drawing, looks)
