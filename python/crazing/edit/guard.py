"""Who may talk to the editor's server: this browser on this machine, and no page but ours."""

from __future__ import annotations

import hmac
import secrets
from http import cookies
from typing import Any

from starlette.types import ASGIApp, Message, Receive, Scope, Send

#: Bytes of a body that would be read. Nothing of ours has one.
_LONGEST_BODY = 1 << 20

#: Nothing is loaded from elsewhere; `blob:` is for pictures that were dropped.
_POLICY = (
    "default-src 'self'; img-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)

HEADERS = {
    "content-security-policy": _POLICY,
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-store",
}


class Guard:
    """ASGI middleware in front of everything the server has.

    A request needs a Host that is ours (against rebound names), to be no write from another Origin (against other
    pages, sockets included), and the cookie that the one-time token of the first address was exchanged for.

    Parameters
    ----------
    app : ASGI application
        What is guarded.
    port : int
        Where the server listens, on the loopback address.
    """

    def __init__(self, app: ASGIApp, port: int) -> None:
        self._app = app
        self._hosts = {f"{name}:{port}" for name in ("127.0.0.1", "localhost")}
        self._origins = {f"http://{host}" for host in self._hosts}
        # Cookies know no ports: two editors must not overwrite one another's.
        self._cookie = f"crazing-{port}"
        self._key = secrets.token_urlsafe(32)
        self.token: str | None = secrets.token_urlsafe(32)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Lets a request through or answers it."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        headers = {name.lower(): value for name, value in scope["headers"]}
        if _repeats(scope["headers"]):
            await _refuse(scope, send, 400, "a header is there twice")
            return
        fresh = self._takes_token(scope)
        status, words = self._judge(scope, headers, fresh)
        if status:
            await _refuse(scope, send, status, words)
            return
        if fresh:
            self.token = None
        await self._app(scope, receive, self._with_headers(send, fresh))

    def _judge(self, scope: Scope, headers: dict[bytes, bytes], fresh: bool) -> tuple[int, str]:
        """A status other than 0 refuses."""
        if headers.get(b"host", b"").decode("latin-1").lower() not in self._hosts:
            return 400, "unknown host"
        socket = scope["type"] == "websocket"
        origin = headers.get(b"origin", b"").decode("latin-1")
        writes = socket or scope["method"] not in ("GET", "HEAD")
        if (writes or origin) and origin not in self._origins:
            return 403, "another origin"
        if _length(headers) > _LONGEST_BODY:
            return 413, "too large"
        if not (fresh or self._knows(headers)):
            return 403, "This link has been used, or is not complete. Run: crazing edit"
        return 0, ""

    def _takes_token(self, scope: Scope) -> bool:
        if scope["type"] != "http" or scope["method"] != "GET" or scope["path"] != "/" or self.token is None:
            return False
        given = scope["query_string"].decode("latin-1")
        return hmac.compare_digest(given.encode(), f"token={self.token}".encode())

    def _knows(self, headers: dict[bytes, bytes]) -> bool:
        jar: cookies.SimpleCookie = cookies.SimpleCookie()
        try:
            jar.load(headers.get(b"cookie", b"").decode("latin-1"))
        except cookies.CookieError:
            return False
        found = jar.get(self._cookie)
        return found is not None and hmac.compare_digest(found.value.encode(), self._key.encode())

    def _with_headers(self, send: Send, fresh: bool) -> Send:
        async def sent(message: Message) -> None:
            if message["type"] == "http.response.start":
                extra = dict(HEADERS)
                if fresh:
                    extra["set-cookie"] = f"{self._cookie}={self._key}; Path=/; HttpOnly; SameSite=Strict"
                message = {**message, "headers": [*message["headers"], *_raw(extra)]}
            await send(message)

        return sent


def _length(headers: dict[bytes, bytes]) -> int:
    try:
        return int(headers.get(b"content-length", b"0"))
    except ValueError:
        return _LONGEST_BODY + 1


def _repeats(headers: Any) -> bool:
    """Whether a header that is judged here is there twice, so that others may read another one."""
    names = [name.lower() for name, _ in headers]
    return any(names.count(name) > 1 for name in (b"host", b"origin", b"cookie", b"content-length"))


def _raw(headers: dict[str, str]) -> list[tuple[bytes, bytes]]:
    return [(name.encode(), value.encode()) for name, value in headers.items()]


async def _refuse(scope: Scope, send: Send, status: int, words: str) -> None:
    if scope["type"] == "websocket":
        # Closed before it is accepted: the server answers 403.
        await send({"type": "websocket.close", "code": 1008, "reason": words})
        return
    body = f"{words}\n".encode()
    headers = {**HEADERS, "content-type": "text/plain; charset=utf-8", "content-length": str(len(body))}
    await send({"type": "http.response.start", "status": status, "headers": _raw(headers)})
    await send({"type": "http.response.body", "body": b"" if scope.get("method") == "HEAD" else body})
