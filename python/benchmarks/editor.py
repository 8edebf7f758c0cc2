"""How long the editor takes to answer a moved point, socket and browser left out, as milliseconds and as a ratio."""

from __future__ import annotations

import argparse
import resource
from pathlib import Path
from statistics import median

import crazing as cz
from crazing.edit import knobs
from crazing.edit.samples import points_of
from crazing.edit.session import Message, Session
from crazing.edit.wire import packed, unpacked

#: Every layer of a skeleton that is live at any size.
LAYERS = ("delaunay", "voronoi", "crust", "axis", "poles")


def processor() -> float:
    """Milliseconds of processor time so far, of all threads."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return 1e3 * (usage.ru_utime + usage.ru_stime)


def answer_time(session: Session, frame: bytes, rounds: int) -> float:
    """Median of the time from a frame to its reply's frame."""
    times = []
    for _ in range(rounds + 1):
        start = processor()
        message = unpacked(frame)
        packed(session.answer(message.content, message.buffers))
        times.append(processor() - start)
    return median(times[1:])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="few points, few rounds")
    parser.add_argument("-o", "--output", type=Path, default=Path(), help="folder for editor.txt")
    options = parser.parse_args()
    count, rounds = (200, 3) if options.small else (2000, 30)
    inputs = {"uniform": cz.sample.uniform(count, rng=5), "curve": points_of("flower", count, 0)}
    lines = [f"{count} points: milliseconds of processor time, and ratio to the triangulation alone"]
    for name, points in inputs.items():
        start = processor()
        for _ in range(rounds):
            cz.diagram(points)
        alone = (processor() - start) / rounds
        for mode in knobs.PANELS:
            values = knobs.defaults()
            values["skeleton"].update(dict.fromkeys(LAYERS, True))
            content = {"kind": "layers", "serial": 1, "mode": mode, "values": values, "moving": True, "preview": 256}
            took = answer_time(Session(), packed(Message(content, [points.tobytes()])), rounds)
            lines.append(f"{name:8} {mode:9} {took:7.1f} ms {took / alone:6.1f} x")
    options.output.mkdir(parents=True, exist_ok=True)
    (options.output / "editor.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
