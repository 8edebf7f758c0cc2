"""Every public name is documented in numpydoc form, names its parameters as they are, and shows what runs."""

from __future__ import annotations

import dataclasses
import doctest
import importlib
import inspect
import pkgutil
import re
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import crazing as cz


def members(module: types.ModuleType, prefix: str) -> Iterator[tuple[str, Any]]:
    """What a module makes public; a public module inside it is entered."""
    for name in module.__all__:
        value = getattr(module, name)
        yield f"{prefix}{name}", value
        if isinstance(value, types.ModuleType):
            yield from members(value, f"{prefix}{name}.")
        elif inspect.isclass(value):
            for attribute, member in vars(value).items():
                if attribute.startswith("_"):
                    continue
                if isinstance(member, (classmethod, staticmethod)):
                    yield f"{prefix}{name}.{attribute}", member.__func__
                elif isinstance(member, property) or inspect.isfunction(member):
                    yield f"{prefix}{name}.{attribute}", member


def is_documentable(value: Any) -> bool:
    kinds = (types.ModuleType, type, types.FunctionType, types.BuiltinFunctionType, property)
    return isinstance(value, kinds) and not isinstance(value, types.GenericAlias)


PUBLIC = {name: value for name, value in members(cz, "cz.") if is_documentable(value)}
FUNCTIONS = {name: value for name, value in PUBLIC.items() if inspect.isroutine(value)}
RECORDS = {name: value for name, value in PUBLIC.items() if dataclasses.is_dataclass(value)}


def sections(value: Any) -> dict[str, str]:
    """The docstring's sections by title; what stands before the first is its summary."""
    parts = re.split(r"^([A-Z][A-Za-z ]+)\n-{3,}$", inspect.getdoc(value) or "", flags=re.MULTILINE)
    return {"Summary": parts[0], **dict(zip(parts[1::2], parts[2::2], strict=True))}


def described(section: str) -> list[str]:
    """The names that a Parameters or Attributes section describes, in order."""
    heads = re.findall(r"^(\*{0,2}\w+(?:, \*{0,2}\w+)*)\s*(?::.*)?$", section, flags=re.MULTILINE)
    return [name.lstrip("*") for head in heads for name in head.split(", ")]


@pytest.mark.parametrize("name", PUBLIC)
def test_summary_is_one_sentence(name: str) -> None:
    summary = sections(PUBLIC[name])["Summary"].split("\n\n")[0].strip()
    assert summary, f"{name} has no docstring"
    assert summary.endswith("."), f"{name}: {summary!r} is not a sentence"


@pytest.mark.parametrize("name", FUNCTIONS)
def test_parameters_equal_the_signature(name: str) -> None:
    wanted = [
        parameter for parameter in inspect.signature(FUNCTIONS[name]).parameters if parameter not in ("self", "cls")
    ]
    assert described(sections(FUNCTIONS[name]).get("Parameters", "")) == wanted, name


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_say_what_they_return(name: str) -> None:
    found = sections(FUNCTIONS[name])
    if inspect.signature(FUNCTIONS[name]).return_annotation not in (None, "None"):
        assert {"Returns", "Yields"} & found.keys(), f"{name} has no Returns section"


@pytest.mark.parametrize("name", [name for name, value in FUNCTIONS.items() if "." not in value.__qualname__])
def test_functions_show_an_example(name: str) -> None:
    assert ">>> " in sections(FUNCTIONS[name]).get("Examples", ""), f"{name} has no example"


@pytest.mark.parametrize("name", RECORDS)
def test_records_describe_every_field(name: str) -> None:
    fields = [field.name for field in dataclasses.fields(RECORDS[name]) if not field.name.startswith("_")]
    found = sections(RECORDS[name])
    assert set(fields) <= set(described(found.get("Attributes", found.get("Parameters", "")))), name


MODULES = [
    module.name for module in pkgutil.walk_packages(cz.__path__, "crazing.") if not module.name.endswith("__main__")
]


@pytest.mark.parametrize("name", ["crazing", *MODULES])
def test_examples_run(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    flags = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS
    with np.printoptions(precision=8, suppress=False, linewidth=75):
        result = doctest.testmod(importlib.import_module(name), optionflags=flags, extraglobs={"cz": cz, "np": np})
    assert result.failed == 0


def test_readme_runs(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = (root / "README.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    assert blocks
    names: dict[str, Any] = {}
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)


def test_readme_links_to_what_is_there(root: Path) -> None:
    targets = re.findall(r"\]\((?!https?:)([^)#]+)\)", (root / "README.md").read_text(encoding="utf-8"))
    assert [target for target in targets if not (root / target).exists()] == []
