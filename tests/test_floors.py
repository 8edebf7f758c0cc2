"""Holds the floors of rust/ARCHITECTURE.md by reading the sources: who may name whom."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
import tomllib
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

from sources import face_modules, imports, rust_code, rust_files

# Lower floors first; a module named nowhere is a noun.
GROUND = {"errors", "record", "arguments", "rng", "extras"}
TOP = {"compare", "edit", "study", "cli", "__main__", "__init__"}
# Files of the binding that serve every noun, and the picture formats that belong to the face's files.
BINDING_FRAME = {"lib", "arrays", "guard", "png", "tiff"}
# Where the core's word is not the user's: it rasterises what the face renders.
CORE_WORDS = {"render": "raster"}


def naming(folder: Path, pattern: str) -> set[str]:
    """The top-level names under `folder` whose code matches."""
    return {
        path.relative_to(folder).parts[0].removesuffix(".rs")
        for path in rust_files(folder)
        if re.search(pattern, rust_code(path))
    }


def test_one_place_in_the_core_names_each_dependency(root: Path) -> None:
    core = root / "rust" / "crazing" / "src"
    assert naming(core, r"\bspade\b") <= {"diagram"}
    assert naming(core, r"\btiny_skia\b") <= {"raster"}
    assert naming(core, r"\bpyo3\b|\bnumpy\b") == set()


def test_core_knows_no_files_no_clock_and_no_global_random_state(root: Path) -> None:
    core = root / "rust" / "crazing" / "src"
    outside = r"\bstd::(?:fs|env|net|process)\b|\b(?:Instant|SystemTime|File)\b|\bstatic mut\b"
    chance = r"\brand::|\bthread_rng\b|\bRandomState\b"
    assert naming(core, f"{outside}|{chance}") == set()
    manifest = tomllib.loads((root / "rust" / "crazing" / "Cargo.toml").read_text())
    assert not {"pyo3", "numpy", "rand"} & manifest["dependencies"].keys()


def test_only_the_binding_depends_on_python(root: Path) -> None:
    binding = tomllib.loads((root / "rust" / "crazing-py" / "Cargo.toml").read_text())
    assert binding["dependencies"].keys() <= {"crazing", "numpy", "pyo3"}
    assert naming(root / "rust" / "crazing-py" / "src", r"\bspade\b|\btiny_skia\b") == set()


def face_graph(root: Path) -> dict[str, set[str]]:
    """Which top-level module of the face imports which."""
    modules = face_modules(root)
    graph: dict[str, set[str]] = {}
    for name, paths in modules.items():
        parts = [module.split(".") for path in paths for module in imports(path)]
        found = {part[1] if len(part) > 1 else "__init__" for part in parts if part[0] == "crazing"}
        # `from crazing import name` of something that is no module reads the package itself.
        graph[name] = {target if target in modules else "__init__" for target in found - {"_core"}} - {name}
    return graph


def test_python_imports_run_in_no_circle(root: Path) -> None:
    TopologicalSorter(face_graph(root)).prepare()


def floor(module: str) -> int:
    return 0 if module in GROUND else 1 if module == "files" else 3 if module in TOP else 2


def test_python_imports_run_down(root: Path) -> None:
    rising = [
        (name, target)
        for name, targets in face_graph(root).items()
        for target in targets
        if floor(target) > floor(name)
    ]
    assert rising == []


@pytest.mark.parametrize("folder", ["tests", "python/examples", "python/benchmarks"])
def test_nobody_outside_names_the_private_module(root: Path, folder: str) -> None:
    for path in sorted((root / folder).rglob("*.py")):
        assert not [name for name in imports(path) if name.startswith("crazing._")], path
        names = {node.attr for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Attribute)}
        assert "_core" not in names, path


def test_import_loads_numpy_and_nothing_else() -> None:
    program = """
import sys, numpy
before = set(sys.modules)
import crazing
new = {name.split(".")[0] for name in set(sys.modules) - before} - sys.stdlib_module_names
assert new <= {"crazing", "numpy"}, new
assert not {"email", "http", "ssl", "socket", "urllib.request", "importlib.metadata"} & (set(sys.modules) - before)
"""
    subprocess.run([sys.executable, "-c", program], check=True)


def test_every_noun_of_the_binding_stands_on_every_floor(root: Path) -> None:
    core, face = root / "rust" / "crazing" / "src", face_modules(root)
    for path in rust_files(root / "rust" / "crazing-py" / "src"):
        noun = path.relative_to(root / "rust" / "crazing-py" / "src").parts[0].removesuffix(".rs")
        if noun in BINDING_FRAME:
            continue
        word = CORE_WORDS.get(noun, noun)
        assert (core / f"{word}.rs").exists() or (core / word).is_dir(), f"no {word} in the core"
        assert noun in face, f"no {noun}.py"
        assert (root / "tests" / f"test_{noun}.py").exists(), f"no test_{noun}.py"
