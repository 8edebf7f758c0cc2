"""The editor on its own: a page on the loopback address, and one socket that carries all messages."""

from __future__ import annotations

import asyncio
import contextlib
import socket
import threading
import time
from collections.abc import Callable, Iterator

import uvicorn
from anyio import to_thread
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from crazing.edit import front, picture
from crazing.edit.guard import Guard
from crazing.edit.session import Session
from crazing.edit.wire import packed, unpacked
from crazing.errors import CrazingError

#: The only address: whoever wants the page elsewhere brings it there, through ssh for one.
LOOPBACK = "127.0.0.1"

#: Bytes of a message: a picture, or a million points, and the words around it.
LONGEST_MESSAGE = picture.MOST_BYTES + (1 << 20)

#: Seconds without a page before the server ends: at first, and after the last page was closed.
PATIENCE, GRACE = 600.0, 20.0

_FILES = {
    "/": ("page.html", "text/html"),
    "/host.js": ("host.js", "text/javascript"),
    "/host.css": ("host.css", "text/css"),
    "/favicon.svg": ("favicon.svg", "image/svg+xml"),
}


class Presence:
    """How many pages are open, and for how long none was.

    Parameters
    ----------
    patience, grace : float
        Seconds to wait for the first page, and for another after the last.
    """

    def __init__(self, patience: float = PATIENCE, grace: float = GRACE) -> None:
        self._limit, self._grace = patience, grace
        self._open = 0
        self._since = time.monotonic()

    @contextlib.contextmanager
    def page(self) -> Iterator[None]:
        """Counts a page while it is open."""
        self._open += 1
        try:
            yield
        finally:
            self._open -= 1
            self._since, self._limit = time.monotonic(), self._grace

    @property
    def over(self) -> bool:
        """Whether nobody is coming any more."""
        return not self._open and time.monotonic() - self._since > self._limit


def application(session: Session, presence: Presence) -> Starlette:
    """The routes: files without a path in them, one module, one style sheet, one socket."""
    turn = threading.Lock()

    def answer(frame: bytes) -> bytes:
        message = unpacked(frame)
        with turn:
            return packed(session.answer(message.content, message.buffers))

    async def talk(page: WebSocket) -> None:
        await page.accept()
        with presence.page(), contextlib.suppress(WebSocketDisconnect):
            while True:
                received = await page.receive()
                if received["type"] == "websocket.disconnect":
                    return
                try:
                    reply = await to_thread.run_sync(answer, received.get("bytes") or b"")
                except CrazingError as error:
                    await page.close(1007, str(error))
                    return
                await page.send_bytes(reply)

    routes = [Route(path, _file(*file)) for path, file in _FILES.items()]
    routes += [
        Route("/editor.js", _text(front.module(), "text/javascript")),
        Route("/editor.css", _text(front.style(), "text/css")),
    ]
    return Starlette(routes=[*routes, WebSocketRoute("/socket", talk)])


def _file(name: str, kind: str) -> Callable[[Request], Response]:
    return _text(front.text(name), kind)


def _text(text: str, kind: str) -> Callable[[Request], Response]:
    return lambda request: Response(text, media_type=kind)


class Server:
    """A server that is bound but does not serve yet.

    Parameters
    ----------
    session : Session
        What its page shows.
    port : int, optional
        Where to listen; 0 takes a free one.
    presence : Presence, optional
        How long it waits for pages.
    """

    def __init__(self, session: Session, *, port: int = 0, presence: Presence | None = None) -> None:
        self._socket = socket.create_server((LOOPBACK, port))
        self.port = int(self._socket.getsockname()[1])
        self._presence = Presence() if presence is None else presence
        self._guard = Guard(application(session, self._presence), self.port)
        config = uvicorn.Config(
            self._guard,
            ws="websockets-sansio",
            ws_max_size=LONGEST_MESSAGE,
            # Within one machine it would only cost time, most of an answer's with a picture in it.
            ws_per_message_deflate=False,
            log_level="critical",
            access_log=False,
            server_header=False,
            lifespan="off",
            timeout_graceful_shutdown=1,
        )
        self._server = uvicorn.Server(config)

    @property
    def address(self) -> str:
        """Where the page is; it opens once."""
        return f"http://{LOOPBACK}:{self.port}/?token={self._guard.token}"

    def run(self) -> None:
        """Serves until no page has been open for a while, or `stop`."""
        asyncio.run(self._run())

    async def _run(self) -> None:
        watching = asyncio.create_task(self._watch())
        try:
            await self._server.serve(sockets=[self._socket])
        finally:
            watching.cancel()
            self._socket.close()

    async def _watch(self) -> None:
        while not self._presence.over:
            await asyncio.sleep(0.2)
        self.stop()

    def stop(self) -> None:
        """Ends `run`; may be called from another thread."""
        self._server.should_exit = True
