"""The licences of the Rust libraries that are linked into a wheel, put into the wheel beside that of crazing itself.

They allow use in any program, on the condition that their texts go with it. They are read from the sources that the
wheel has just been compiled from, so that none is forgotten and none is kept here.
"""

from __future__ import annotations

import base64
import hashlib
import json
import os
import subprocess
import tempfile
import zipfile
from pathlib import Path
from typing import Any

#: Names that licence texts have, in small letters.
TEXTS = ("license", "licence", "copying", "notice", "unlicense")


def _printed(command: list[str], root: Path) -> str:
    """What a command prints. Cargo hands its standard input on to the compiler, which would take it for a program."""
    run = subprocess.run(
        command, cwd=root, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, encoding="utf-8", check=True
    )
    return run.stdout


def linked(root: Path) -> list[dict[str, Any]]:
    """The packages that the extension is linked from, by name; without those that only run while it is compiled."""
    host = _printed(["rustc", "-vV"], root)
    platform = next(line.removeprefix("host: ") for line in host.splitlines() if line.startswith("host: "))
    command = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", platform]
    metadata = json.loads(_printed(command, root))
    packages = {package["id"]: package for package in metadata["packages"]}
    nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}

    def is_linked(package: dict[str, Any]) -> bool:
        return not any("proc-macro" in target["kind"] for target in package["targets"])

    found, waiting = set(), [package["id"] for package in packages.values() if package["name"] == "crazing-py"]
    while waiting:
        package = waiting.pop()
        if package not in found and is_linked(packages[package]):
            found.add(package)
            needs = nodes[package]["deps"]
            waiting += [need["pkg"] for need in needs if any(kind["kind"] is None for kind in need["dep_kinds"])]
    libraries = [packages[package] for package in found if packages[package]["source"]]
    return sorted(libraries, key=lambda package: (package["name"], package["version"]))


def texts(package: dict[str, Any]) -> list[str]:
    """The licence texts in the sources of a package."""
    folder = Path(package["manifest_path"]).parent
    files = sorted(path for path in folder.iterdir() if path.is_file() and path.name.lower().startswith(TEXTS))
    return [path.read_text(encoding="utf-8", errors="replace").strip() for path in files]


def notices(root: Path) -> str:
    """All libraries with their licences, then every text once, with the libraries that it goes with."""
    lines = ["crazing is compiled from its own sources and from these Rust libraries, under their licences:", ""]
    holders: dict[str, tuple[str, list[str]]] = {}
    for package in linked(root):
        name = f"{package['name']} {package['version']}"
        authors = ", ".join(author.partition(" <")[0] for author in package["authors"])
        lines.append(f"{name} ({package['license'] or 'see below'})" + (f", by {authors}" if authors else ""))
        for text in texts(package):
            # Copies of one text differ in their line breaks.
            holders.setdefault(" ".join(text.split()), (text, []))[1].append(name)
    parts = [f"{'=' * 80}\n{', '.join(names)}\n\n{text}" for text, names in holders.values()]
    return "\n\n".join(["\n".join(lines), *parts]) + "\n"


def add(wheel: Path, text: str) -> None:
    """Put the text into a wheel, and into the record of its files. The wheel is replaced whole."""
    content = text.encode()
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    descriptor, name = tempfile.mkstemp(dir=wheel.parent, suffix=".whl")
    os.close(descriptor)
    with zipfile.ZipFile(wheel) as old, zipfile.ZipFile(name, "w", zipfile.ZIP_DEFLATED) as new:
        record = next(item for item in old.infolist() if item.filename.endswith(".dist-info/RECORD"))
        place = record.filename.removesuffix("RECORD") + "licenses/NOTICES.txt"
        for item in old.infolist():
            if item is not record:
                new.writestr(item, old.read(item))
        added = zipfile.ZipInfo(place)
        added.external_attr = record.external_attr
        new.writestr(added, content, zipfile.ZIP_DEFLATED)
        new.writestr(record, old.read(record) + f"{place},sha256={digest},{len(content)}\n".encode())
    os.chmod(name, wheel.stat().st_mode)  # noqa: PTH101 as the file that it replaces
    Path(name).replace(wheel)
