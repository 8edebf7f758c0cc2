"""The editor's server as an attacker and as a browser see it, over real sockets."""

from __future__ import annotations

import contextlib
import http.client
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from crazing.edit import front
from crazing.edit.server import LONGEST_MESSAGE, Presence, Server
from crazing.edit.session import Message, Session
from crazing.edit.wire import packed, unpacked

TRIANGLE = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]


class Visitor:
    """A client of one server, with or without its cookie."""

    def __init__(self, server: Server) -> None:
        self.port = server.port
        self.address = server.address
        self.cookie = ""

    def ask(
        self, path: str, method: str = "GET", body: bytes | None = None, **headers: str
    ) -> http.client.HTTPResponse:
        """One request on a connection of its own; the answer is read."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        named = {"Host": f"127.0.0.1:{self.port}", "Cookie": self.cookie, **headers}
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, value in {**named, **({"Content-Length": str(len(body))} if body is not None else {})}.items():
            connection.putheader(name.replace("_", "-"), value)
        connection.endheaders(body)
        response = connection.getresponse()
        response.content = response.read()  # type: ignore[attr-defined]
        connection.close()
        return response

    def enter(self) -> http.client.HTTPResponse:
        """Exchanges the token for the cookie."""
        response = self.ask(self.address[self.address.index("/?") :])
        self.cookie = (response.getheader("set-cookie") or "").partition(";")[0]
        return response

    def socket(
        self, *, origin: str | None = "", cookie: str | None = None, host: str | None = None
    ) -> ClientConnection:
        """The page's socket; `origin` is ours if empty."""
        headers = {"Cookie": self.cookie if cookie is None else cookie}
        own = f"http://127.0.0.1:{self.port}"
        sock = socket.create_connection(("127.0.0.1", self.port), timeout=20)
        address = f"ws://{host or f'127.0.0.1:{self.port}'}/socket"
        return connect(
            address, sock=sock, origin=own if origin == "" else origin, additional_headers=headers, max_size=None
        )  # type: ignore[arg-type]


@contextlib.contextmanager
def serving(presence: Presence | None = None) -> Iterator[tuple[Server, threading.Thread]]:
    server = Server(Session(TRIANGLE), presence=presence)
    thread = threading.Thread(target=server.run)
    thread.start()
    try:
        yield server, thread
    finally:
        server.stop()
        thread.join(20)
        assert not thread.is_alive()


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    with serving() as (one, _):
        yield one


@pytest.fixture(scope="module")
def visitor(server: Server) -> Visitor:
    """A browser that came through the address that was printed."""
    one = Visitor(server)
    assert one.enter().status == 200
    return one


def test_it_listens_on_the_loopback_address_only(server: Server) -> None:
    assert server._socket.getsockname()[0] == "127.0.0.1"
    others = {found[4][0] for found in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)}
    for address in others - {"127.0.0.1"}:
        with pytest.raises(OSError), socket.create_connection((address, server.port), timeout=2):  # noqa: PT011
            pass


def test_the_token_works_once() -> None:
    with serving() as (server, _):
        first, second = Visitor(server), Visitor(server)
        entered = first.enter()
        assert entered.status == 200
        assert b"<main" in entered.content  # type: ignore[attr-defined]
        cookie = entered.getheader("set-cookie") or ""
        assert cookie.startswith(f"crazing-{server.port}=")
        assert {"HttpOnly", "SameSite=Strict", "Path=/"} <= set(cookie.split("; "))
        token = second.address.partition("token=")[2]
        assert token not in cookie
        assert second.enter().status == 403
        assert first.ask("/").status == 200


@pytest.mark.parametrize("query", ["", "?token=", "?token=x", "?token=None", "?TOKEN=x", "?token=%00"])
def test_without_the_token_there_is_nothing(query: str) -> None:
    with serving() as (server, _):
        stranger = Visitor(server)
        for path in ("/", "/editor.js", "/host.js", "/editor.css", "/favicon.svg"):
            response = stranger.ask(path + query)
            assert response.status == 403, path
            assert response.getheader("set-cookie") is None


def test_a_guessed_cookie_is_refused(visitor: Visitor) -> None:
    for cookie in (
        "",
        f"crazing-{visitor.port}=",
        f"crazing-{visitor.port}=x",
        "other=1",
        f"{visitor.cookie}x",
        "\x80",
    ):
        assert visitor.ask("/", Cookie=cookie).status == 403


@pytest.mark.parametrize(
    "host",
    [
        "evil.example",
        "evil.example:{port}",
        "127.0.0.1",
        "127.0.0.1:1",
        "localhost.evil.example:{port}",
        "",
        "[::1]:{port}",
    ],
)
def test_a_rebound_name_is_refused(visitor: Visitor, host: str) -> None:
    assert visitor.ask("/", Host=host.format(port=visitor.port)).status == 400


def test_two_hosts_are_refused(visitor: Visitor) -> None:
    with socket.create_connection(("127.0.0.1", visitor.port), timeout=20) as raw:
        hosts = f"Host: 127.0.0.1:{visitor.port}\r\nHost: evil.example\r\n"
        raw.sendall(f"GET / HTTP/1.1\r\n{hosts}Cookie: {visitor.cookie}\r\nConnection: close\r\n\r\n".encode())
        assert b" 400 " in raw.recv(4096).partition(b"\r\n")[0]


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1", "https://127.0.0.1:{port}", ""])
@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH", "OPTIONS"])
def test_another_pages_write_is_refused(visitor: Visitor, method: str, origin: str) -> None:
    headers = {"Origin": origin.format(port=visitor.port)} if origin else {}
    response = visitor.ask("/", method, b"{}", **headers)
    assert response.status == 403
    assert response.getheader("access-control-allow-origin") is None


def test_our_own_write_finds_nothing_to_write_to(visitor: Visitor) -> None:
    for path in ("/", "/socket", "/editor.js"):
        response = visitor.ask(path, "POST", b"{}", Origin=f"http://127.0.0.1:{visitor.port}")
        assert response.status in (404, 405)


def test_a_large_body_is_refused_unread(visitor: Visitor) -> None:
    start = time.perf_counter()
    response = visitor.ask("/", "POST", None, Origin=f"http://127.0.0.1:{visitor.port}", Content_Length=str(1 << 40))
    assert response.status == 413
    assert time.perf_counter() - start < 5


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", None, "http://127.0.0.1", "http://localhost.evil:{port}"]
)
def test_another_pages_socket_is_refused(visitor: Visitor, origin: str | None) -> None:
    with pytest.raises(InvalidStatus, match="403"):
        visitor.socket(origin=origin if origin is None else origin.format(port=visitor.port))


def test_a_socket_without_the_cookie_is_refused(visitor: Visitor) -> None:
    for cookie in ("a=b", f"crazing-{visitor.port}=guess"):
        with pytest.raises(InvalidStatus, match="403"):
            visitor.socket(cookie=cookie)


def test_a_socket_by_another_name_is_refused(visitor: Visitor) -> None:
    # An attacker's name that resolves to this machine: Host and Origin agree, and are not ours.
    host = f"evil.example:{visitor.port}"
    with pytest.raises(InvalidStatus, match="403"):
        visitor.socket(origin=f"http://{host}", host=host)


@pytest.mark.parametrize(
    "path",
    [
        "/../../etc/passwd",
        "/..%2f..%2fetc%2fpasswd",
        "/%2e%2e/session.py",
        "/front/editor.js",
        "//etc/passwd",
        "/page.html",
    ],
)
def test_no_path_leads_out(visitor: Visitor, path: str) -> None:
    assert visitor.ask(path).status == 404


def test_every_answer_forbids_what_is_not_ours(visitor: Visitor) -> None:
    for path in ("/", "/editor.js", "/editor.css", "/host.css", "/host.js", "/favicon.svg", "/nothing"):
        headers = {name.lower(): value for name, value in visitor.ask(path).getheaders()}
        policy = headers["content-security-policy"]
        assert policy.startswith("default-src 'self';")
        assert "unsafe" not in policy
        assert "frame-ancestors 'none'" in policy
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
        assert headers["cache-control"] == "no-store"
        assert "server" not in headers


def test_the_page_gets_its_files(visitor: Visitor) -> None:
    module = visitor.ask("/editor.js")
    assert module.content.decode() == front.module()  # type: ignore[attr-defined]
    assert (module.getheader("content-type") or "").startswith("text/javascript")
    assert visitor.ask("/editor.css").content.decode() == front.style()  # type: ignore[attr-defined]


def test_messages_go_both_ways(visitor: Visitor) -> None:
    with visitor.socket() as page:
        page.send(packed(Message({"kind": "hello", "serial": 1})))
        state = unpacked(page.recv())  # type: ignore[arg-type]
        assert np.frombuffer(state.buffers[0]).reshape(-1, 2).tolist() == TRIANGLE
        page.send(packed(Message({"kind": "layers", "serial": 2, "mode": "skeleton"}, state.buffers)))
        assert unpacked(page.recv()).content["rows"][0] == ["sites", 3]  # type: ignore[arg-type]


@pytest.mark.parametrize("sent", ["text", b"", b"\0\0", b"\xff\xff\xff\xff", b"\x05\0\0\0[1,2]"])
def test_a_broken_message_ends_the_socket_not_the_server(visitor: Visitor, sent: str | bytes) -> None:
    with visitor.socket() as page, pytest.raises(ConnectionClosed, match="1007"):
        page.send(sent)
        page.recv()
    assert visitor.ask("/").status == 200


def test_a_message_too_long_is_refused(visitor: Visitor) -> None:
    with visitor.socket() as page, pytest.raises(ConnectionClosed):
        page.send(bytes(LONGEST_MESSAGE + 1))
        page.recv()
    assert visitor.ask("/").status == 200


def test_two_servers_do_not_know_each_others_cookies(visitor: Visitor) -> None:
    with serving() as (other, _):
        stranger = Visitor(other)
        stranger.cookie = visitor.cookie.replace(str(visitor.port), str(other.port))
        assert stranger.ask("/").status == 403


def test_it_ends_when_nobody_comes_or_all_have_left() -> None:
    with serving(Presence(patience=0.3, grace=60)) as (_, thread):
        thread.join(10)
        assert not thread.is_alive()
    with serving(Presence(patience=60, grace=0.3)) as (server, thread):
        visitor = Visitor(server)
        visitor.enter()
        with visitor.socket():
            time.sleep(1)
            assert thread.is_alive()
        thread.join(10)
        assert not thread.is_alive()


def test_the_command_serves_a_file_and_ends_at_ctrl_c(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    path.write_text("x,y\n0.1,0.2\n3,4\n")
    kept = tmp_path / "kept.npy"
    command = [sys.executable, "-m", "crazing", "edit", "--no-browser", "--seed", "11", "-o", str(kept), str(path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
        assert program.stdout is not None
        address = program.stdout.readline().split()[-1]
        visitor = Visitor.__new__(Visitor)
        visitor.port, visitor.address, visitor.cookie = int(address.split(":")[2].split("/")[0]), address, ""
        for _ in range(100):
            with contextlib.suppress(ConnectionRefusedError):
                assert visitor.enter().status == 200
                break
            time.sleep(0.1)
        with visitor.socket() as page:
            page.send(packed(Message({"kind": "hello", "serial": 1})))
            state = unpacked(page.recv())
            assert np.frombuffer(state.buffers[0]).tolist() == [0.1, 0.2, 3.0, 4.0]  # type: ignore[arg-type]
            values = state.content["values"]
            assert {panel["seed"] for panel in values.values() if "seed" in panel} == {11}
            asked = {"kind": "layers", "mode": "maze", "values": values}
            page.send(packed(Message(asked, [np.array([5, 6, 7, 8, 9.5, 1]).tobytes()])))
            assert unpacked(page.recv()).content["kind"] == "layers"
        program.send_signal(signal.SIGINT)
        _, errors = program.communicate(timeout=20)
    assert program.returncode == 130
    assert errors.strip() == ""
    assert np.load(kept).tolist() == [[5, 6], [7, 8], [9.5, 1]]


def test_a_file_without_points_is_refused_in_one_line(tmp_path: Path) -> None:
    path = tmp_path / "points.csv"
    path.write_text("1,2\nthree,4\n")
    command = [sys.executable, "-m", "crazing", "edit", "--no-browser", str(path)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr == "Error: line 2 is 'three,4'; two numbers are wanted\n"
