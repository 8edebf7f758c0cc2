"""Holds the sizes of the house by reading the sources: files, functions, the binding, and empty names."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from sources import rust_code, rust_files

FILE_LINES = 320
FUNCTION_LINES = 60
BANNED = {"utils", "util", "helpers", "helper", "common", "manager", "misc", "tools"}


def all_sources(root: Path) -> list[Path]:
    return [
        *rust_files(root / "rust"),
        *sorted((root / "python").rglob("*.py")),
        *sorted((root / "tests").rglob("*.py")),
    ]


def test_module_names_say_what_is_in_them(root: Path) -> None:
    assert [path for path in all_sources(root) if BANNED & set(path.stem.removeprefix("test_").split("_"))] == []


def docstring_lines(node: ast.AST) -> int:
    """Lines of a node's own docstring: it may be as long as it has to be."""
    if not isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
        return 0
    if ast.get_docstring(node, clean=False) is None:
        return 0
    return (node.body[0].end_lineno or 0) - node.body[0].lineno + 1


def file_lines(path: Path) -> int:
    text = path.read_text(encoding="utf-8")
    documented = sum(map(docstring_lines, ast.walk(ast.parse(text)))) if path.suffix == ".py" else 0
    return len(text.splitlines()) - documented


def test_files_are_short(root: Path) -> None:
    lengths = {str(path.relative_to(root)): file_lines(path) for path in all_sources(root)}
    assert {path: lines for path, lines in lengths.items() if lines > FILE_LINES} == {}


def python_functions(path: Path) -> Iterator[tuple[str, int]]:
    """Name and lines of every function, without its docstring."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, (node.end_lineno or 0) - node.lineno + 1 - docstring_lines(node)


def rust_functions(path: Path) -> Iterator[tuple[str, int]]:
    """Name and lines of every function with a body, found by counting braces."""
    code = rust_code(path)
    for head in re.finditer(r"\bfn (\w+)", code):
        opening = re.compile(r"[{;]").search(code, head.end())
        # A semicolon first is a declaration, or the length of an array in the signature: then look on.
        while (
            opening
            and opening[0] == ";"
            and code.count("[", head.end(), opening.start()) > code.count("]", head.end(), opening.start())
        ):
            opening = re.compile(r"[{;]").search(code, opening.end())
        if opening is None or opening[0] == ";":
            continue
        depth = 0
        for brace in re.compile(r"[{}]").finditer(code, opening.start()):
            depth += 1 if brace[0] == "{" else -1
            if depth == 0:
                yield head[1], code.count("\n", head.start(), brace.end()) + 1
                break


def test_functions_are_short(root: Path) -> None:
    long = [
        f"{path.relative_to(root)}: {name} has {lines} lines"
        for path in all_sources(root)
        for name, lines in (rust_functions(path) if path.suffix == ".rs" else python_functions(path))
        if lines > FUNCTION_LINES
    ]
    assert long == []


def code_lines(folder: Path) -> int:
    return sum(1 for path in rust_files(folder) for line in rust_code(path).splitlines() if line.strip())


def test_binding_is_at_most_a_quarter_of_the_core(root: Path) -> None:
    core, binding = (code_lines(root / "rust" / crate / "src") for crate in ("crazing", "crazing-py"))
    assert binding <= core / 4, f"{binding} lines of binding, {core} of core"
