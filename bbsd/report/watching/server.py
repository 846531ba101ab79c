"""A page for browsers on this machine, and for nobody else: it can only be read."""

from __future__ import annotations

from contextlib import contextmanager
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

LOOPBACK = "127.0.0.1"
HEADERS = {
    "Content-Type": "text/html; charset=utf-8",
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
}
ICON = "/favicon.ico"
"""What browsers ask for unless a page says that it has none."""
SECONDS = 10
"""How long a connection may be silent."""


@contextmanager
def serving(page: Callable[[], str], port: int = 0) -> Iterator[str]:
    """Serve what `page` returns to this machine while the context lasts; yield the address.

    Args:
        page: Called at each request, from other threads.
        port: 0 for any that is free.

    Raises:
        OSError: the port cannot be had.
    """

    class Handler(_Handler):
        content = staticmethod(page)

    with ThreadingHTTPServer((LOOPBACK, port), Handler) as server:
        thread = Thread(target=server.serve_forever, args=(0.1,), daemon=True)
        thread.start()
        try:
            yield f"http://{LOOPBACK}:{server.server_port}/"
        finally:
            server.shutdown()
            thread.join()


class _Handler(BaseHTTPRequestHandler):
    """Answers requests for `/` that name this machine.

    A page elsewhere whose name was made to lead here names itself in Host, and is refused.
    """

    content: Callable[[], str]
    timeout = SECONDS
    server_version, sys_version = "bbsd", ""

    def do_GET(self) -> None:
        """Send the page."""
        self._answer()

    def do_HEAD(self) -> None:
        """Send what is known of the page."""
        self._answer()

    def log_message(self, format: str, *arguments: object) -> None:  # noqa: A002 - as http.server has it
        """Say nothing of requests."""

    def _answer(self) -> None:
        port = self.connection.getsockname()[1]
        if self.headers.get_all("Host") not in ([f"{LOOPBACK}:{port}"], [f"localhost:{port}"]):
            self.send_error(HTTPStatus.FORBIDDEN)
        elif self.path == ICON:
            self.send_response(HTTPStatus.NO_CONTENT)
            self.end_headers()
        elif self.path != "/":
            self.send_error(HTTPStatus.NOT_FOUND)
        else:
            self._send(self.content().encode())

    def _send(self, content: bytes) -> None:
        self.send_response(HTTPStatus.OK)
        for name, value in HEADERS.items():
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(content)
