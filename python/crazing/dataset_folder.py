"""A data set as a folder of files."""

from __future__ import annotations

import csv
import io
import json
import os
import threading
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from itertools import islice
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from crazing import _core, arguments
from crazing.errors import CrazingError
from crazing.files import atomic_write, save_png
from crazing.versions import algorithm_version

#: Folder and ending of every kind of label.
FILES = {
    "mask": ("masks", ".png"),
    "coverage": ("coverage", ".png"),
    "strand": ("strands", ".png"),
    "cell": ("cells", ".png"),
    "distance": ("distances", ".npy"),
}
_ABOUT, _TABLE = "dataset.json", "images.csv"


class Dataset(Protocol):
    """What is asked of a :class:`crazing.Dataset`."""

    @property
    def n(self) -> int:
        """Number of pictures."""

    @property
    def labels(self) -> tuple[str, ...]:
        """Their labels."""

    @property
    def parameters(self) -> dict[str, Any]:
        """What decides every picture."""

    def drawn(self, index: int) -> dict[str, Any]:
        """What chance decided for one picture."""

    def __getitem__(self, index: int) -> Any:
        """One picture."""


def write(
    dataset: Dataset, folder: str | os.PathLike[str], workers: int, progress: Callable[[int, int], None] | None
) -> int:
    """See `Dataset.write`."""
    root = Path(arguments.file_path(folder, "folder"))
    if root.exists() and not root.is_dir():
        raise NotADirectoryError(20, "is a file; a folder is wanted", str(root))
    _claim(root, dataset)
    for split in {dataset.drawn(i)["split"] for i in range(dataset.n)}:
        for name in ("images", *(FILES[label][0] for label in dataset.labels)):
            (root / split / name).mkdir(parents=True, exist_ok=True)
    missing = [i for i in range(dataset.n) if not all(path.exists() for path in _paths(root, dataset, i).values())]
    _make(dataset, root, missing, workers, progress)
    _save_table(root, dataset)
    return len(missing)


def key_of(folder: str | os.PathLike[str]) -> tuple[int, int] | None:
    """The key of the data set that a folder holds, which its seed was turned into; None if it holds none."""
    path = Path(folder) / _ABOUT
    if not path.exists():
        return None
    try:
        first, second = _found(path)["key"]
        return int(first), int(second)
    except (KeyError, TypeError, ValueError):
        raise _damaged(path) from None


def _found(path: Path) -> dict[str, Any]:
    """The parameters that a folder was made with."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))["parameters"]
    except (ValueError, KeyError, TypeError):
        raise _damaged(path) from None
    if not isinstance(found, dict):
        raise _damaged(path)
    return found


def _damaged(path: Path) -> CrazingError:
    return CrazingError(f"{path} is damaged; another folder is wanted")


def _claim(root: Path, dataset: Dataset) -> None:
    """Makes the folder this data set's, unless it holds another."""
    about, path = {**dataset.parameters, "algorithm_version": algorithm_version}, root / _ABOUT
    if path.exists():
        found = _found(path)
        unlike = [name for name in about if found.get(name) != about[name]]
        if unlike:
            # A key means nothing to who gave a seed.
            words = {name: f"its {name} is {found.get(name)}, not {about[name]}" for name in about}
            words["key"] = "it was made with another seed"
            told = "; ".join(words[name] for name in unlike)
            raise CrazingError(f"{root} holds another data set: {told}; another folder is wanted")
    root.mkdir(exist_ok=True)
    record = {"crazing": _core.__version__, "parameters": {"n": dataset.n, **about}}
    with atomic_write(path) as file:
        file.write(json.dumps(record, indent=1).encode())


def _paths(root: Path, dataset: Dataset, index: int) -> dict[str, Path]:
    base = root / dataset.drawn(index)["split"]
    paths = {label: base / FILES[label][0] / f"{index:06d}{FILES[label][1]}" for label in dataset.labels}
    return {"image": base / "images" / f"{index:06d}.png", **paths}


def _make(
    dataset: Dataset, root: Path, wanted: list[int], workers: int, progress: Callable[[int, int], None] | None
) -> None:
    """A few more pictures than workers are under way at a time, however many there are."""
    left, done = iter(wanted), dataset.n - len(wanted)
    stop = threading.Event()
    with ThreadPoolExecutor(workers, initializer=_heed, initargs=(stop,)) as pool:
        pending: set[Future[None]] = set()
        try:
            while True:
                room = workers + 1 - len(pending)
                pending.update(pool.submit(_save, dataset, root, i) for i in islice(left, room))
                if not pending:
                    return
                finished, pending = wait(pending, return_when=FIRST_COMPLETED)
                for future in finished:
                    future.result()
                    done += 1
                    if progress is not None:
                        progress(done, dataset.n)
        finally:
            stop.set()
            pool.shutdown(wait=True, cancel_futures=True)


def _heed(stop: threading.Event) -> None:
    """Lets the core end its work for this thread when `stop` is set: signals do not reach it."""
    vars(threading.current_thread())["crazing_stop"] = stop


def _save(dataset: Dataset, root: Path, index: int) -> None:
    made = dataset[index]
    paths = _paths(root, dataset, index)
    for label, numbers in made.labels.items():
        _save_label(paths[label], label, numbers)
    # Last, so that a picture never lacks its labels.
    save_png(paths["image"], made.image)


def _save_label(path: Path, label: str, numbers: NDArray[Any]) -> None:
    if label == "distance":
        file = io.BytesIO()
        np.save(file, numbers, allow_pickle=False)
        with atomic_write(path) as target:
            target.write(file.getvalue())
    elif label in ("strand", "cell"):
        most = int(numbers.max()) + 1
        if most > 65_535:
            raise CrazingError(f"{path.name} has {most} {label}s; a file of 16 bits holds 65535")
        save_png(path, (numbers + 1).astype(np.uint16), srgb=False)
    else:
        save_png(path, numbers, srgb=False)


def _save_table(root: Path, dataset: Dataset) -> None:
    names = ("file", "split", "preset", "plates", "light_x", "light_y", "light_z", "exposure")
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(names)
    for i in range(dataset.n):
        drawn = dataset.drawn(i)
        file = _paths(root, dataset, i)["image"].relative_to(root).as_posix()
        table.writerow([file, drawn["split"], drawn["preset"], drawn["plates"], *drawn["light"], drawn["exposure"]])
    with atomic_write(root / _TABLE) as target:
        target.write(text.getvalue().encode())
