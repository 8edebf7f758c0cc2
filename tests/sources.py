"""How the tests read the sources."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path


def rust_files(folder: Path) -> list[Path]:
    files = sorted(folder.rglob("*.rs"))
    assert files, folder
    return files


def rust_code(path: Path) -> str:
    """The code of a file without comments and the insides of literals, line for line."""
    pattern = r'//[^\n]*|/\*.*?\*/|r#".*?"#|"(?:\\.|[^"\\])*"|' + r"'(?:\\.|[^'\\])'"
    return re.sub(pattern, lambda hit: "\n" * hit[0].count("\n"), path.read_text(encoding="utf-8"), flags=re.DOTALL)


def imports(path: Path) -> Iterator[str]:
    """Every module that a file imports, at its top or in a function; not those for the type checker alone."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    typing_only = {
        id(child)
        for node in ast.walk(tree)
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)
        for child in ast.walk(node)
    }
    for node in ast.walk(tree):
        if id(node) in typing_only:
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def face_modules(root: Path) -> dict[str, list[Path]]:
    """The files of each top-level module of the face; a sub-package counts as one module."""
    package = root / "python" / "crazing"
    modules: dict[str, list[Path]] = {}
    for path in sorted(package.rglob("*.py")):
        modules.setdefault(path.relative_to(package).parts[0].removesuffix(".py"), []).append(path)
    return modules
