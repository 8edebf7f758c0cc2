"""Packages that only some functions need, imported where they are used."""

from __future__ import annotations

import importlib
from types import ModuleType


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
