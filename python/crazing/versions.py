"""What a result depends on besides its arguments."""

from __future__ import annotations

import platform
import sys

import numpy as np

from crazing import _core

#: The same number, seed and arguments give the same result, for ever; it grows when any result changes.
algorithm_version: int = 1

_OPTIONAL = (
    "click",
    "contourpy",
    "ezdxf",
    "matplotlib",
    "networkx",
    "openexr",
    "pillow",
    "rich",
    "scipy",
    "shapely",
    "tifffile",
    "zarr",
)


def installed(package: str) -> str | None:
    """The version of a package that is installed, found without importing it; None if it is not."""
    # It brings email and socket with it.
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(package)
    except PackageNotFoundError:
        return None


def show_versions() -> None:
    """Prints what a report of a bug should begin with: versions, the platform, optional packages found.

    Examples
    --------
    >>> from crazing import show_versions
    >>> show_versions()
    crazing            ...
    algorithm_version  1
    Python             3...
    """
    rows = {
        "crazing": _core.__version__,
        "algorithm_version": algorithm_version,
        "Python": sys.version.split()[0],
        "NumPy": np.__version__,
        "platform": platform.platform(),
        **{package: installed(package) for package in _OPTIONAL},
    }
    for name, found in rows.items():
        if found is not None:
            print(f"{name:17}  {found}")
