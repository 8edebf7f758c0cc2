"""What presets are held to: measured means or published ranges, kept in the same TOML file as the recipe."""

from __future__ import annotations

import dataclasses
import tomllib
from dataclasses import dataclass
from typing import Any

from crazing import arguments
from crazing.arguments import choice
from crazing.crack import Crack
from crazing.measure import measure
from crazing.recipe import PRESETS, presets
from crazing.statistics import LEAST_DEVIATION, CrackStatistics

#: A measured statistic is in range within this many deviations of its mean.
REACH = 2.0

_NAMES = frozenset(field.name for field in dataclasses.fields(CrackStatistics))
_KEYS = {"source", "pixels", "measured", "range"}


@dataclass(frozen=True)
class Targets:
    """What a preset's patterns should measure. Made by :func:`crazing.targets`.

    Attributes
    ----------
    source : str
        Where the numbers are from; says so where no masks were measured.
    pixels : int or None
        Patterns are measured as masks this many pixels wide, as their models were; None measures their graphs.
    measured : dict of str to (mean, standard deviation)
        Statistics that were measured on masks.
    range : dict of str to (low, high)
        Statistics of which only a range was published.
    """

    source: str
    pixels: int | None
    measured: dict[str, tuple[float, float]]
    range: dict[str, tuple[float, float]]

    def limits(self) -> dict[str, tuple[float, float]]:
        """Lowest and highest value of every statistic.

        Returns
        -------
        dict of str to (low, high)
            The mean and two deviations (or 24 % of it, if that is more) to both sides, or the published range.

        Examples
        --------
        >>> import crazing as cz
        >>> low, high = cz.targets("painting-italian").limits()["t_share"]
        >>> 0 < low < high < 1
        True
        """
        found = {}
        for name, (mean, deviation) in self.measured.items():
            most = REACH * max(deviation, LEAST_DEVIATION * abs(mean))
            found[name] = (mean - most, mean + most)
        return {**found, **self.range}

    def within(self, statistics: CrackStatistics) -> dict[str, bool]:
        """Which statistics are in range.

        Parameters
        ----------
        statistics : CrackStatistics
            As `measure` gives them.

        Returns
        -------
        dict of str to bool
            By name; one that could not be measured is not in range.

        Examples
        --------
        >>> import crazing as cz
        >>> targets = cz.targets("painting-italian")
        >>> all(targets.within(targets.measure(cz.crack(n=100, rng=1))).values())
        False
        """
        values = arguments.of_kind(statistics, "statistics", CrackStatistics).to_dict()
        return {name: low <= values[name] <= high for name, (low, high) in self.limits().items()}

    def measure(self, crack: Crack) -> CrackStatistics:
        """Measure a pattern on the footing of the targets.

        Parameters
        ----------
        crack : Crack
            The pattern.

        Returns
        -------
        CrackStatistics

        Examples
        --------
        >>> import crazing as cz
        >>> cz.targets("painting-italian").measure(cz.crack(n=100, rng=1)).i_nodes > 0.3
        True
        """
        return measure(crack, raster=self.pixels)


def targets(preset: str) -> Targets:
    """What the patterns of a preset should measure.

    Parameters
    ----------
    preset : str
        One of :func:`crazing.presets`.

    Returns
    -------
    Targets

    Raises
    ------
    ValueError
        If there is no such preset, or its file has no such table.

    Examples
    --------
    >>> import crazing as cz
    >>> cz.targets("painting-italian").pixels
    800
    """
    path = PRESETS / f"{choice(preset, 'preset', presets())}.toml"
    table = tomllib.loads(path.read_text(encoding="utf-8")).get("targets")
    if not isinstance(table, dict) or not set(table) <= _KEYS or "source" not in table:
        raise ValueError(f"preset {preset!r} has no table [targets] with the keys {', '.join(sorted(_KEYS))}")
    return Targets(table["source"], table.get("pixels"), _pairs(table, "measured"), _pairs(table, "range"))


def _pairs(table: dict[str, Any], key: str) -> dict[str, tuple[float, float]]:
    rows = table.get(key, {})
    for name, pair in rows.items():
        if name not in _NAMES or not (isinstance(pair, list) and len(pair) == 2):
            raise ValueError(f"[targets.{key}] {name} = {pair!r}; a statistic and a pair of numbers are wanted")
    return {name: (float(first), float(second)) for name, (first, second) in rows.items()}
