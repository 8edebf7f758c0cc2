"""The page's files: one ES module put together from its parts, and one style sheet, for every host the same bytes."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

FOLDER = Path(__file__).parent / "front"

#: Each names only what stands before it.
PARTS = ("dom", "view", "cloud", "wire", "scene", "light", "preview", "tools", "controls", "panels", "editor")

# What joins the parts while they are separate modules; as one they share a scope.
_IMPORT = re.compile(r'^import \{[^}]*\} from "\./\w+\.js";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:async )?(?:class|const|function|let)\b)", re.MULTILINE)


@cache
def module() -> str:
    """The front end, as the module that anywidget and the page load.

    Examples
    --------
    >>> from crazing.edit.front import module
    >>> module().count("export default")
    1
    """
    texts = [(FOLDER / f"{part}.js").read_text(encoding="utf-8") for part in PARTS]
    return "\n".join(_EXPORT.sub("", _IMPORT.sub("", text)) for text in texts)


@cache
def style() -> str:
    """The style sheet."""
    return text("editor.css")


@cache
def text(name: str) -> str:
    """One file of the page."""
    return (FOLDER / name).read_text(encoding="utf-8")
