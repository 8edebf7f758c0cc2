"""Packages that only some functions need, imported where they are used."""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import Any

from crazing.arguments import found


def require(module: str, extra: str) -> ModuleType:
    """The module of that name, e.g. `"PIL.Image"`, from a package of the extra `extra`.

    Raises
    ------
    ImportError
        If its package is not installed; the message says what to install.
    """
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        package = module.partition(".")[0]
        if error.name != package:
            raise  # The package is there, but something of its own is missing: its words say more than ours.
        hint = f'{package} is not installed; it comes with: pip install "crazing[{extra}]"'
        raise ImportError(hint, name=package) from None


def axes(ax: Any) -> Any:
    """Matplotlib axes: those given, else the current ones of pyplot.

    Raises
    ------
    TypeError
        If it is something else.
    ImportError
        If Matplotlib is wanted and not installed.
    """
    if ax is None:
        return require("matplotlib.pyplot", "plot").gca()
    if not hasattr(ax, "add_collection"):
        raise TypeError(f"ax is {found(ax)}; axes of Matplotlib are wanted")
    return ax
