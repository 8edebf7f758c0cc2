"""The work on one texture: its bands, drawn once, into all its files; taken up again where a killed run stopped."""

from __future__ import annotations

import json
import secrets
import shutil
import stat
from collections.abc import Callable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from crazing.errors import CrazingError
from crazing.files import alone_in
from crazing.pictures import exr, png, tiff, zarr
from crazing.pictures.about import About
from crazing.pictures.parts import State
from crazing.pictures.samples import COLORS, Format, layer, samples

Maps = Mapping[str, NDArray[Any]]
Progress = Callable[[int, int], object]

#: Rows of a band, most first, and what the maps of one band may take: with the samples made of them, and the next
#: band that is drawn meanwhile, a run needs some four times as much.
BANDS = (256, 128, 64, 32, 16)
BAND_BYTES = 1 << 27

#: A run that has lost its folder makes at most a band's files in it before it looks.
_TRIES = 8

_JOURNAL, _RECORD, _OWNER = "journal.jsonl", "record.json", "owner"


class Writer(Protocol):
    """A file that is written band by band."""

    def resume(self, states: list[State]) -> int:
        """How many bands stand as they were written."""

    def begin(self, states: list[State]) -> None:
        """Go on behind these bands; none is from the start."""

    def write(self, samples: NDArray[Any]) -> State:
        """Append a band, and say what is needed to go on behind it; nothing where a run cannot go on."""

    def finish(self) -> None:
        """Complete the file."""

    def close(self) -> None:
        """Leave the file as it is."""


_WRITERS: dict[str, Callable[[Path, tuple[int, ...], np.dtype[Any], int, About], Writer]] = {
    "png": png.Writer,
    "tiff": tiff.Writer,
    "exr": exr.Writer,
    "zarr": zarr.Writer,
}


@dataclass(frozen=True)
class Picture:
    """One file to be made."""

    name: str
    """Which picture, see `samples.PICTURES`."""
    target: Path
    """Where it goes, as it was asked for."""
    place: Path
    """Where that is, links followed."""
    form: Format
    record: dict[str, Any]


@dataclass(frozen=True)
class Job:
    """All files of a texture."""

    pictures: tuple[Picture, ...]
    size: tuple[int, int]
    draw: Callable[[int, int], Maps]
    """The maps from a first row on, as many rows as that."""
    density: tuple[float, float]
    reach: float
    """Distances that whole numbers hold, data units."""
    part: Path
    """The folder of unfinished files."""
    digest: str
    """The hash of the pattern: parts of another one are not gone on with."""
    token: str = field(default_factory=lambda: secrets.token_hex(8))
    """Tells this run from others that make the same files."""

    def run(self, progress: Progress | None = None) -> None:
        """Make the files; what a stopped run left in the folder of parts is gone on with.

        Each file takes its place when all are whole. An exception leaves the finished bands for the next run. Of two
        runs at a time the later one takes over, and the earlier one stops.
        """
        one = self.draw(0, 1)
        row = sum(array.nbytes for array in one.values())
        band = next((rows for rows in BANDS if rows * row <= BAND_BYTES), BANDS[-1])
        writers: list[Writer] = []
        is_begun = False
        try:
            with alone_in(self.part.parent):
                states = self._left(band)
            is_begun = True
            writers += (self._writer(index, one, band) for index in range(len(self.pictures)))
            done = min(writer.resume(own) for writer, own in _columns(writers, states))
            with alone_in(self.part.parent):
                # Another run may have written more by now, which is not cut off.
                self._check()
                for writer, own in _columns(writers, states[:done]):
                    writer.begin(own)
                self._keep(states[:done])
            self._bands(writers, band, done, progress)
            for writer in writers:
                writer.finish()
            with alone_in(self.part.parent):
                self._check()
                self._put()
        except Exception:
            if is_begun:
                # Whatever else went wrong: its files were taken away.
                self._check()
            raise
        finally:
            for writer in writers:
                writer.close()
            with alone_in(self.part.parent):
                if self._is_own() and not _lines(self.part / _JOURNAL):
                    # Nothing that could be gone on with.
                    shutil.rmtree(self.part)

    def _put(self) -> None:
        """The files in their places."""
        for index, picture in enumerate(self.pictures):
            _place(self._path(index), picture.place)
        shutil.rmtree(self.part)

    def _is_own(self) -> bool:
        """Whether the folder of parts is there, and no other run has taken it over."""
        try:
            return (self.part / _OWNER).read_text(encoding="ascii") == self.token
        except OSError:
            return False

    def _check(self) -> None:
        if not self._is_own():
            raise self._taken() from None

    def _taken(self) -> CrazingError:
        target = self.pictures[0].target
        return CrazingError(f"{target} is being made by another run as well; one at a time is wanted")

    def _bands(self, writers: list[Writer], band: int, done: int, progress: Progress | None) -> None:
        """Draws a band while the one before it is written."""
        height = self.size[0]
        with ThreadPoolExecutor(1) as pool, (self.part / _JOURNAL).open("a", encoding="ascii") as journal:
            waiting: Future[None] | None = None
            for top in range(done * band, height, band):
                if progress is not None:
                    progress(top, height)
                self._check()
                maps = self.draw(top, min(band, height - top))
                if waiting is not None:
                    waiting.result()
                waiting = pool.submit(self._write, writers, maps, journal)
            if waiting is not None:
                waiting.result()
        if progress is not None:
            progress(height, height)

    def _write(self, writers: list[Writer], maps: Maps, journal: Any) -> None:
        states = []
        for writer, picture in zip(writers, self.pictures, strict=True):
            states.append(writer.write(samples(picture.name, layer(picture.name, maps), picture.form, self.reach)))
        if all(states):
            journal.write(json.dumps(states) + "\n")
            journal.flush()

    def _writer(self, index: int, one: Maps, band: int) -> Writer:
        """The writer of a picture, whose shape and type are those of one row."""
        picture = self.pictures[index]
        row = samples(picture.name, layer(picture.name, one), picture.form, self.reach)
        about = About(picture.record, self.density, picture.name in COLORS)
        shape = (*self.size, *row.shape[2:])
        return _WRITERS[picture.form.kind](self._path(index), shape, row.dtype, band, about)

    def _path(self, index: int) -> Path:
        return self.part / f"{index}{self.pictures[index].form.ending}"

    def _left(self, band: int) -> list[list[State]]:
        """What a run of the very same job noted, a list a band; the folder of parts is there afterwards."""
        own = json.dumps([self.digest, band, [[picture.target.name, picture.record] for picture in self.pictures]])
        try:
            if (self.part / _RECORD).read_text(encoding="ascii") == own:
                (self.part / _OWNER).write_text(self.token, encoding="ascii")
                return _lines(self.part / _JOURNAL)
        except OSError:
            pass
        _remove(self.part)
        try:
            self.part.mkdir()
        except FileExistsError:
            raise self._taken() from None
        try:
            (self.part / _OWNER).write_text(self.token, encoding="ascii")
            (self.part / _RECORD).write_text(own, encoding="ascii")
        except OSError:
            # A full disk.
            _remove(self.part)
            raise
        return []

    def _keep(self, states: list[list[State]]) -> None:
        """Forgets the bands that are gone."""
        text = "".join(json.dumps(line) + "\n" for line in states)
        (self.part / _JOURNAL).write_text(text, encoding="ascii")


def _columns(writers: list[Writer], states: list[list[State]]) -> list[tuple[Writer, list[State]]]:
    """Each writer with its own states."""
    return [(writer, [line[index] for line in states]) for index, writer in enumerate(writers)]


def _lines(path: Path) -> list[list[State]]:
    """The whole lines of a journal; the last of a killed run may be torn."""
    lines: list[list[State]] = []
    if path.exists():
        for text in path.read_text(encoding="ascii", errors="replace").splitlines():
            try:
                lines.append(json.loads(text))
            except ValueError:
                break
    return lines


def _remove(folder: Path) -> None:
    """Takes a folder away if it is there, also from a run that is still filling it."""
    for _ in range(_TRIES):
        shutil.rmtree(folder, ignore_errors=True)
        if not folder.exists():
            return
    shutil.rmtree(folder)


def _place(source: Path, target: Path) -> None:
    """Puts a finished file, or folder of files, where it belongs; an existing file keeps its permissions."""
    target.parent.mkdir(exist_ok=True)
    if target.is_dir():
        # A folder cannot be replaced in one step; the old one goes with the folder of parts.
        target.replace(source.with_name(f"{source.name}.before"))
    elif target.exists():
        source.chmod(stat.S_IMODE(target.stat().st_mode))
    source.replace(target)
