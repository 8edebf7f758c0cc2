"""What is installed is what the sources say, and a machine without Rust is told so in one sentence."""

from __future__ import annotations

import base64
import csv
import hashlib
import importlib.metadata
import importlib.util
import os
import re
import stat
import subprocess
import sys
import tomllib
import types
import zipfile
from pathlib import Path

import pytest

import crazing as cz


@pytest.fixture
def backend(root: Path, monkeypatch: pytest.MonkeyPatch) -> types.ModuleType:
    """The build backend on top of an empty maturin, which the test extra does not install."""
    monkeypatch.setitem(sys.modules, "maturin", types.ModuleType("maturin"))
    monkeypatch.syspath_prepend(root / "rust")
    spec = importlib.util.spec_from_file_location("build_backend", root / "rust" / "build_backend.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


HOOKS = ["get_requires_for_build_wheel", "get_requires_for_build_editable", "get_requires_for_build_sdist"]


@pytest.mark.parametrize("hook", HOOKS)
def test_without_rust_one_sentence_names_what_to_install(
    backend: types.ModuleType, hook: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(SystemExit) as stop:
        getattr(backend, hook)()
    message = str(stop.value.code)
    assert re.search(r"no working cargo was found on PATH: install stable Rust \d+\.\d+ or newer", message)
    assert "\n" not in message


@pytest.mark.skipif(os.name == "nt", reason="the stand-in is a shell script")
@pytest.mark.parametrize(
    ("script", "wanted"),
    [("echo cargo 1.63.0", "cargo 1.63.0 is too old"), ("exit 1", "no working cargo was found")],
)
def test_an_old_or_hollow_rust_is_refused(
    backend: types.ModuleType, script: str, wanted: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "cargo"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(SystemExit, match=wanted):
        backend.get_requires_for_build_wheel()


def test_run_time_needs_numpy_click_and_rich_only() -> None:
    requirements = importlib.metadata.requires("crazing") or []
    always = [line for line in requirements if "extra ==" not in line]
    assert sorted(re.match(r"[\w-]+", line)[0] for line in always) == ["click", "numpy", "rich"]  # type: ignore[index]


def test_one_version_everywhere(root: Path) -> None:
    workspace = tomllib.loads((root / "Cargo.toml").read_text())["workspace"]["package"]["version"]
    command = [sys.executable, "-m", "crazing", "--version"]
    shown = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert importlib.metadata.version("crazing") == workspace
    assert cz.__version__ == workspace
    assert workspace in shown.split()


def test_the_package_is_typed_and_licensed() -> None:
    files = {str(path) for path in importlib.metadata.files("crazing") or []}
    package = Path(cz.__file__).parent
    assert (package / "py.typed").exists()
    assert (package / "_core.pyi").exists()
    assert any(name.endswith("licenses/LICENSE") for name in files)
    assert importlib.metadata.metadata("crazing")["License-Expression"] == "MIT"


def test_a_wheel_brings_the_licences_of_what_it_is_linked_from(
    backend: types.ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def build_wheel(folder: str, settings: object, metadata: object) -> str:
        with zipfile.ZipFile(Path(folder) / "crazing-1.whl", "w") as wheel:
            wheel.writestr("crazing/__init__.py", "")
            wheel.writestr("crazing-1.dist-info/RECORD", "crazing/__init__.py,,\n")
        return "crazing-1.whl"

    monkeypatch.setattr(sys.modules["maturin"], "build_wheel", build_wheel, raising=False)
    assert backend.build_wheel(str(tmp_path)) == "crazing-1.whl"
    assert [path.name for path in tmp_path.iterdir()] == ["crazing-1.whl"]
    with zipfile.ZipFile(tmp_path / "crazing-1.whl") as wheel:
        assert wheel.namelist()[::2] == ["crazing/__init__.py", "crazing-1.dist-info/RECORD"]
        text = wheel.read("crazing-1.dist-info/licenses/NOTICES.txt")
        *_, (name, digest, size) = csv.reader(wheel.read("crazing-1.dist-info/RECORD").decode().splitlines())
    assert name.endswith("NOTICES.txt")
    assert int(size) == len(text)
    assert digest == "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(text).digest()).decode().rstrip("=")
    for library in ("pyo3", "numpy", "spade", "tiny-skia", "rayon"):
        assert re.search(rf"^{library} \d[\d.]+ \(", text.decode(), re.MULTILINE), library
    # That of tiny-skia wants its text in every binary.
    assert b"Redistributions in binary form must reproduce" in text


def test_the_editors_page_is_in_the_package(root: Path) -> None:
    folder = Path("edit", "front")
    sources = {path.name: path.read_bytes() for path in (root / "python" / "crazing" / folder).iterdir()}
    shipped = {path.name: path.read_bytes() for path in (Path(cz.__file__).parent / folder).iterdir()}
    assert {"editor.js", "editor.css", "page.html", "host.js", "host.css", "favicon.svg"} <= sources.keys()
    assert shipped == sources


def test_no_machine_path_or_registry_host_is_committed(root: Path) -> None:
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=root, capture_output=True, text=True)
    if listing.returncode:
        pytest.skip("not a git checkout")
    # The pattern is put together here so that this file does not match itself.
    pattern = re.compile(
        r"(?<![\w.])/"
        + r"(?:home|root|work|Users)/\w|index-"
        + "url|"
        + "files.python"
        + "hosted|static.crates"
        + r"\.io"
    )
    for name in filter(None, listing.stdout.split("\0")):
        path = root / name
        if name == "Cargo.lock" or not path.is_file():
            continue
        text = path.read_bytes().decode("utf-8", "ignore")
        assert not pattern.search(text), f"{name}: {pattern.search(text)}"


def test_completion_shows_what_is_public() -> None:
    assert set(dir(cz)) == set(cz.__all__)
