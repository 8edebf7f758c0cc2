"""Run far from the checkout, where only the wheel is: the main job works, and what is missing is named."""

from __future__ import annotations

import importlib
import importlib.metadata
import subprocess
import sys
from pathlib import Path

import numpy as np

before = set(sys.modules)

import crazing as cz  # noqa: E402 what it loads is looked at

loaded = {name.partition(".")[0] for name in set(sys.modules) - before} - sys.stdlib_module_names
assert loaded <= {"crazing", "numpy"}, f"import crazing loads {loaded}"

command = ["crazing", "texture", "--seed", "7", "--size", "512", "-o", "crack.png"]
subprocess.run(command, check=True)
assert Path("crack.png").read_bytes().startswith(b"\x89PNG\r\n\x1a\n")
assert cz.maze(np.random.default_rng(7).random((500, 2)), rng=7).passages.shape == (499, 2)

shipped = {Path(str(path)).name for path in importlib.metadata.files("crazing") or []}
assert {"LICENSE", "NOTICES.txt"} <= shipped, "licences are missing"

# NumPy, click, rich and what these bring; no extra came along.
installed = {dist.name.lower() for dist in importlib.metadata.distributions()}
extras = installed & {
    "anywidget",
    "contourpy",
    "matplotlib",
    "networkx",
    "pillow",
    "scipy",
    "scikit-image",
    "starlette",
}
assert not extras, f"the wheel brings {extras}"

try:
    cz.diagram([[0, 0], [1, 0], [0, 1]]).delaunay.plot()
    hint = "none: it plots without matplotlib"
except ImportError as error:
    hint = str(error)
assert "crazing[plot]" in hint, hint

# The editor's page came along; what serves it is an extra.
module = importlib.import_module("crazing.edit.front")
assert module.module().count("export default") == 1
assert all(module.text(name) for name in ("editor.css", "host.css", "host.js", "page.html", "favicon.svg"))
edit = subprocess.run(["crazing", "edit", "--no-browser"], capture_output=True, text=True)
assert edit.returncode == 2, edit
assert "crazing[edit]" in edit.stderr, edit.stderr

compare = subprocess.run(["crazing", "compare", "crack.png", "-o", "figure.png"], capture_output=True, text=True)
assert compare.returncode, "compare needs extras that are not here"
assert "crazing[" in compare.stderr, compare.stderr
assert "Traceback" not in compare.stderr, compare.stderr
print("the wheel works on", sys.version.split()[0])
