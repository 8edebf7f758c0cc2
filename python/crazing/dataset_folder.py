"""A data set as a folder of files."""

from __future__ import annotations

import csv
import dataclasses
import io
import json
import os
import threading
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from itertools import islice
from pathlib import Path
from typing import Any, BinaryIO, ClassVar, Protocol

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

    __dataclass_fields__: ClassVar[dict[str, dataclasses.Field[Any]]]

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
    name = os.fspath(arguments.file_path(folder, "folder"))
    if not name:
        # Path makes it the working folder, where nobody wants a thousand pictures.
        raise FileNotFoundError(2, "has no name; a folder is wanted", name)
    root = Path(name)
    if root.exists() and not root.is_dir():
        raise NotADirectoryError(20, "is a file; a folder is wanted", str(root))
    whole = _claim(root, dataset)
    for split in {dataset.drawn(i)["split"] for i in range(dataset.n)}:
        for place in ("images", *(FILES[label][0] for label in dataset.labels)):
            (root / split / place).mkdir(parents=True, exist_ok=True)
    missing = [i for i in range(dataset.n) if not all(path.exists() for path in _paths(root, dataset, i).values())]
    _make(dataset, root, missing, workers, progress)
    _save_table(root, whole)
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


def _claim(root: Path, dataset: Dataset) -> Dataset:
    """Makes the folder this data set's, unless it holds another; with the pictures that it holds beyond."""
    about, path = {**dataset.parameters, "algorithm_version": algorithm_version}, root / _ABOUT
    whole = dataset
    if path.exists():
        found = _found(path)
        unlike = [name for name in about if found.get(name) != about[name]]
        if unlike:
            # A key means nothing to who gave a seed.
            words = {name: f"its {name} is {found.get(name)}, not {about[name]}" for name in about}
            words["key"] = "it was made with another seed"
            told = "; ".join(words[name] for name in unlike)
            raise CrazingError(f"{root} holds another data set: {told}; another folder is wanted")
        whole = _with_more(root, dataset, found.get("n"))
    root.mkdir(exist_ok=True)
    record = {"crazing": _core.__version__, "parameters": {"n": whole.n, **about}}
    with atomic_write(path) as file:
        file.write(json.dumps(record, indent=1).encode())
    return whole


def _with_more(root: Path, dataset: Dataset, before: Any) -> Dataset:
    """The data set as far as the folder has pictures of it, where fewer are asked for than were before."""
    if not isinstance(before, int) or before <= dataset.n:
        return dataset
    longer = dataclasses.replace(dataset, n=before)
    there = (i for i in reversed(range(dataset.n, before)) if _paths(root, longer, i)["image"].exists())
    return dataclasses.replace(dataset, n=next(there, dataset.n - 1) + 1)


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
        # What a killed process leaves must not be among the pictures, where whoever lists the folder counts it.
        with atomic_write(paths[label], room=root) as file:
            _save_label(file, index, label, numbers)
    # Last, so that a picture never lacks its labels.
    with atomic_write(paths["image"], room=root) as file:
        save_png(file, made.image)


def _save_label(file: BinaryIO, index: int, label: str, numbers: NDArray[Any]) -> None:
    if label == "distance":
        array = io.BytesIO()
        np.save(array, numbers, allow_pickle=False)
        file.write(array.getvalue())
    elif label in ("strand", "cell"):
        most = int(numbers.max()) + 1
        if most > 65_535:
            raise CrazingError(f"{index:06d}.png has {most} {label}s; a file of 16 bits holds 65535")
        save_png(file, (numbers + 1).astype(np.uint16), srgb=False)
    else:
        save_png(file, numbers, srgb=False)


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
