"""A message as one binary frame: length of a JSON head, head, binary parts, each from a multiple of 8 bytes on."""

from __future__ import annotations

import json

from crazing.edit.session import Message
from crazing.errors import CrazingError

#: Bytes of a head that is read; ours have a few thousand.
_LONGEST_HEAD = 1 << 20


def packed(message: Message) -> bytes:
    """The frame of a message.

    Examples
    --------
    >>> from crazing.edit.session import Message
    >>> from crazing.edit.wire import packed, unpacked
    >>> unpacked(packed(Message({"kind": "hello"}, [b"12345"])))
    Message(content={'kind': 'hello'}, buffers=[b'12345'])
    """
    head = json.dumps({"content": message.content, "sizes": [len(part) for part in message.buffers]})
    parts = [head.encode(), *message.buffers]
    return len(parts[0]).to_bytes(4, "little") + b"".join(
        part + bytes(-(len(part) + (4 if i == 0 else 0)) % 8) for i, part in enumerate(parts)
    )


def unpacked(frame: bytes) -> Message:
    """The message of a frame.

    Raises
    ------
    CrazingError
        If the frame is not well formed.
    """
    length = int.from_bytes(frame[:4], "little")
    if len(frame) < 4 or length > _LONGEST_HEAD or 4 + length > len(frame):
        raise CrazingError("the frame is cut or its head too long")
    try:
        head = json.loads(frame[4 : 4 + length])
        content, sizes = head["content"], head["sizes"]
        whole = isinstance(content, dict) and all(type(size) is int and size >= 0 for size in sizes)
    except (ValueError, KeyError, TypeError, RecursionError):
        whole = False
    if not whole:
        raise CrazingError("the head of the frame cannot be read")
    buffers, at = [], 4 + length + -(4 + length) % 8
    for size in sizes:
        if at + size > len(frame):
            raise CrazingError("the frame is shorter than its head says")
        buffers.append(frame[at : at + size])
        at += size + -size % 8
    return Message(content, buffers)
