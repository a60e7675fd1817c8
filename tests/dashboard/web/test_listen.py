"""Where the dashboard listens: what may be typed, and under which names it is opened."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from xavi_dialogue.dashboard.web.address import ListenError, ListenOptions, name_of

TOKEN = "0123456789abcdef"


@pytest.mark.parametrize(
    ("typed", "host", "port", "loopback", "address"),
    [
        (None, "127.0.0.1", 8480, True, "http://127.0.0.1:8480/"),
        ("", "127.0.0.1", 8480, True, "http://127.0.0.1:8480/"),
        ("127.0.0.1:9000", "127.0.0.1", 9000, True, "http://127.0.0.1:9000/"),
        ("127.0.0.2:9000", "127.0.0.2", 9000, True, "http://127.0.0.2:9000/"),
        (":9000", "127.0.0.1", 9000, True, "http://127.0.0.1:9000/"),
        ("9000", "127.0.0.1", 9000, True, "http://127.0.0.1:9000/"),
        ("[::1]:8480", "::1", 8480, True, "http://[::1]:8480/"),
        ("localhost:1", "localhost", 1, True, "http://localhost:1/"),
        ("0.0.0.0:8480", "0.0.0.0", 8480, False, "http://127.0.0.1:8480/"),
        ("[::]:8480", "::", 8480, False, "http://[::1]:8480/"),
        ("192.0.2.7", "192.0.2.7", 8480, False, "http://192.0.2.7:8480/"),
        ("box.example:80", "box.example", 80, False, "http://box.example:80/"),
    ],
)
def test_a_place_is_read(
    typed: str | None, host: str, port: int, loopback: bool, address: str
) -> None:
    listen = ListenOptions.read(typed)
    assert (listen.host, listen.port, listen.loopback) == (host, port, loopback)
    assert listen.address(port) == address
    assert (listen.token is None) == loopback


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("::1", "write it as"),
        ("[::1", "write it as"),
        ("127.0.0.1:x", "write it as"),
        ("127.0.0.1:", "write it as"),
        ("127.0.0.1:-1", "write it as"),
        ("127.0.0.1:٣", "write it as"),
        ("127.0.0.1:65536", "up to 65535"),
        ("[localhost]:1", "not a host"),
        ("[fe80::1%eth0]:1", "not a host"),
        ("a b:1", "not a host"),
        ("*:1", "not a host"),
        ("http://127.0.0.1:1", "write it as"),
        ("\x1b[31m:1", "write it as"),
    ],
)
def test_what_is_no_place_is_said_to_be_none(typed: str, words: str) -> None:
    with pytest.raises(ListenError, match=words) as caught:
        ListenOptions.read(typed)
    assert "\x1b" not in str(caught.value)


@given(st.text(max_size=30))
def test_any_text_is_a_place_or_is_refused(typed: str) -> None:
    try:
        listen = ListenOptions.read(typed)
    except ListenError:
        return
    assert 0 <= listen.port <= 65535
    assert listen.serves(listen.address(1).removeprefix("http://").rstrip("/"))


def test_a_random_token_is_made_elsewhere_each_time() -> None:
    tokens = {ListenOptions.read("0.0.0.0:1").token for _ in range(3)}
    assert len(tokens) == 3
    assert all(token and len(token) >= 32 for token in tokens)
    assert ListenOptions.read(":1", token=TOKEN).token == TOKEN
    assert TOKEN not in repr(ListenOptions.read(":1", token=TOKEN))


@pytest.mark.parametrize("token", ["", "short", "0123456789abcde!", "0123456789abcdef\n", "é" * 20])
def test_a_token_that_is_none_is_refused(token: str) -> None:
    with pytest.raises(ListenError, match="16 to 128"):
        ListenOptions.read(token=token)


@pytest.mark.parametrize(
    "name", ["", "a:80", "http://a", "a b", "-a", "a/b", "a..b", "[::1", "\x1b"]
)
def test_a_name_that_is_none_is_refused(name: str) -> None:
    with pytest.raises(ListenError, match="not a host name"):
        ListenOptions.read(names=(name,))


@pytest.mark.parametrize(
    ("listen", "host", "served"),
    [
        (":8480", "127.0.0.1:8480", True),
        (":8480", "localhost:8480", True),
        (":8480", "LOCALHOST.:9999", True),  # a forwarded port
        (":8480", "[::1]", True),
        (":8480", "localhost.evil.example", False),
        (":8480", "127.0.0.1.evil.example:8480", False),
        (":8480", "evil.example:8480", False),
        (":8480", "127.0.0.2", False),
        (":8480", "192.0.2.7", False),
        (":8480", "2130706433", False),
        (":8480", "0x7f.1", False),
        (":8480", "", False),
        (":8480", ":8480", False),
        (":8480", "localhost:8480:1", False),
        (":8480", "localhost:8480@evil.example", False),
        (":8480", "user@localhost", False),
        (":8480", "localhost/", False),
        (":8480", "localhost,evil.example", False),
        (":8480", " localhost", False),
        (":8480", "locaIhost", False),
        (":8480", "ⓛocalhost", False),
        ("127.0.0.2:1", "127.0.0.2:1", True),
        ("192.0.2.7:1", "192.0.2.7:1", True),
        ("192.0.2.7:1", "localhost:1", False),
        ("192.0.2.7:1", "192.0.2.8:1", False),
        ("0.0.0.0:1", "192.0.2.8:1", True),
        ("0.0.0.0:1", "[2001:db8::1]:1", True),
        ("0.0.0.0:1", "localhost:1", True),
        ("0.0.0.0:1", "evil.example:1", False),
        ("0.0.0.0:1", "192.0.2.8.evil.example", False),
        ("box.example:1", "BOX.example:1", True),
    ],
)
def test_a_host_is_served_or_not(listen: str, host: str, served: bool) -> None:
    assert ListenOptions.read(listen).serves(host) is served


def test_other_names_are_served_when_they_are_given() -> None:
    listen = ListenOptions.read("0.0.0.0:8480", names=("Hall.Example.", "desk"))
    assert listen.serves("hall.example:8480")
    assert listen.serves("DESK")
    assert not listen.serves("desk.example")
    assert listen.address(8480) == "http://hall.example:8480/"


@given(st.text(max_size=40))
def test_any_host_header_names_something_harmless_or_nothing(host: str) -> None:
    name = name_of(host, ported=True)
    assert name is None or (name.isascii() and name.isprintable() and " " not in name)
