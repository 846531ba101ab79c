import socket
from contextlib import closing
from http.client import HTTPConnection
from urllib.parse import urlsplit

import pytest

from bbsd.report.watching.server import serving

TEXT = "<p>the pagé</p>"


@pytest.fixture
def address():
    with serving(lambda: TEXT) as address:
        yield urlsplit(address)


def asked(address, method="GET", path="/", **headers):
    with closing(HTTPConnection("127.0.0.1", address.port, timeout=5)) as connection:
        connection.request(method, path, headers=headers)
        response = connection.getresponse()
        return response.status, response.headers, response.read().decode()


def test_the_page_is_served_to_this_machine(address):
    assert address.hostname == "127.0.0.1"
    status, headers, text = asked(address)
    assert (status, text) == (200, TEXT)
    assert headers["Content-Length"] == str(len(TEXT.encode()))
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Cache-Control"] == "no-store"
    assert "Python" not in str(headers["Server"])
    assert asked(address, Host=f"localhost:{address.port}")[0] == 200


def test_only_the_page_is_there_and_only_to_read(address):
    assert asked(address, path="/etc/passwd")[0] == 404
    assert asked(address, path="/../")[0] == 404
    assert asked(address, path="/favicon.ico")[::2] == (204, "")
    for method in ("POST", "PUT", "DELETE", "OPTIONS"):
        assert asked(address, method)[0] == 501
    assert asked(address, "HEAD")[::2] == (200, "")


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1", "127.0.0.1:1", "localhost.evil.example", ""])
def test_other_names_are_refused(address, host):
    status, _, text = asked(address, Host=host)
    assert status == 403
    assert TEXT not in text


def test_two_names_are_refused(address):
    with socket.create_connection(("127.0.0.1", address.port), timeout=5) as connection:
        host = f"Host: 127.0.0.1:{address.port}\r\n"
        connection.sendall(f"GET / HTTP/1.0\r\n{host}Host: evil.example\r\n\r\n".encode())
        assert b" 403 " in connection.recv(100)


def test_it_listens_on_the_loopback_alone(address):
    with closing(socket.socket()) as other:
        other.bind(("127.0.0.2", address.port))  # free, unless the server listened on all addresses


def test_a_port_that_is_taken_is_said(address):
    with pytest.raises(OSError, match="in use"), serving(lambda: TEXT, address.port):
        pass


def test_what_is_served_is_made_at_each_request():
    pages = iter(["one", "two"])
    with serving(lambda: next(pages)) as address:
        assert [asked(urlsplit(address))[2] for _ in range(2)] == ["one", "two"]
