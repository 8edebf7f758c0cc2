"""Where a crack comes from, in the terms of JSON: enough to make it again."""

from __future__ import annotations

import base64
import binascii
import dataclasses
import hashlib
import io
import zipfile
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing.crack import Crack
from crazing.errors import CrazingError
from crazing.graph import PlanarGraph
from crazing.recipe import Recipe

#: Bytes of a pattern, packed, that a picture carries along; larger ones are known by their hash alone.
CARRIED = 1 << 18

_ARRAYS = ("width", "strand", "generation", "shifts", "parent")


def of_recipe(
    recipe: Recipe,
    *,
    seed: int,
    preset: str | None = None,
    bounds: tuple[float, ...] | None = None,
    period: tuple[float, ...] | None = None,
    width: float | None = None,
    detail: float | None = None,
    age: float | None = None,
) -> dict[str, Any]:
    """The origin of a crack that a recipe makes."""
    return {
        "recipe": dataclasses.asdict(recipe),
        "preset": preset,
        "seed": seed,
        "bounds": None if bounds is None else list(bounds),
        "period": None if period is None else list(period),
        "width": width,
        "detail": detail,
        "age": age,
    }


def of_crack(crack: Any) -> dict[str, Any]:
    """The origin of any crack: its arrays, or their hash where they are many."""
    arrays = _arrays(crack)
    period = getattr(crack, "period", None)
    origin = {
        "sha256": digest_of(crack),
        "bounds": list(crack.bounds),
        "period": None if period is None else list(period),
    }
    # Packing halves the bytes at best: what is far too much is not packed at all.
    if sum(array.nbytes for array in arrays.values()) > 8 * CARRIED:
        return origin
    packed = io.BytesIO()
    np.savez_compressed(packed, allow_pickle=False, **arrays)
    if packed.tell() > CARRIED:
        return origin
    return {**origin, "pattern": base64.b64encode(packed.getvalue()).decode("ascii")}


def digest_of(crack: Any) -> str:
    """The hash of a crack's arrays, which no other crack has."""
    arrays, digest = _arrays(crack), hashlib.sha256()
    for name in sorted(arrays):
        digest.update(name.encode() + np.ascontiguousarray(arrays[name]).tobytes())
    return digest.hexdigest()


def _arrays(crack: Any) -> dict[str, NDArray[Any]]:
    arrays = {name: np.asarray(getattr(crack, name)) for name in _ARRAYS if getattr(crack, name, None) is not None}
    return arrays | {"vertices": np.asarray(crack.graph.vertices), "edges": np.asarray(crack.graph.edges)}


def crack_of(origin: Mapping[str, Any]) -> Crack:
    """The crack of an origin.

    Raises
    ------
    CrazingError
        If the origin does not say enough, or is damaged.
    """
    try:
        if "recipe" in origin:
            recipe = Recipe(**origin["recipe"])
            # One of the two is None.
            frame = {name: origin[name] for name in ("bounds", "period", "width", "detail")}
            crack = recipe.crack(**frame, rng=int(origin["seed"]))
            return crack if origin["age"] is None else crack.at(origin["age"])
        if "pattern" in origin:
            return _unpacked(origin)
    except (KeyError, TypeError, ValueError, AttributeError, OSError, binascii.Error, zipfile.BadZipFile) as error:
        raise CrazingError(f"the record of how the crack was made is damaged: {error}") from None
    raise CrazingError("the pattern was given as arrays, and was too large to be kept: it cannot be made again")


def _unpacked(origin: Mapping[str, Any]) -> Crack:
    packed = io.BytesIO(base64.b64decode(origin["pattern"], validate=True))
    with np.load(packed, allow_pickle=False) as arrays:
        graph = PlanarGraph(arrays["vertices"], arrays["edges"])
        kept = {name: arrays[name] for name in _ARRAYS if name in arrays}
        xmin, ymin, xmax, ymax = map(float, origin["bounds"])
        period = origin["period"] and tuple(map(float, origin["period"]))
        return Crack(graph=graph, bounds=(xmin, ymin, xmax, ymax), period=period, **kept)
