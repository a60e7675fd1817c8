"""Certificates, as the TLS of Python's own library judges them."""

import ssl
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from xavi_dialogue.bus.certificates import (
    Authority,
    BadCertificate,
    BadHost,
    Identity,
    read,
    utc_now,
)

DAY = timedelta(days=1)
NOON = datetime(2030, 1, 1, 12, tzinfo=UTC)


def context(
    folder: Path, authority: Authority, identity: Identity | None, *, server: bool
) -> ssl.SSLContext:
    """One side of a connection that asks the other for a certificate of the authority."""
    made = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER if server else ssl.PROTOCOL_TLS_CLIENT)
    made.verify_mode = ssl.CERT_REQUIRED
    made.load_verify_locations(cadata=authority.identity.certificate.decode())
    if identity is not None:
        (folder / "one.pem").write_bytes(identity.certificate)
        (folder / "one.key").write_bytes(identity.key)
        made.load_cert_chain(folder / "one.pem", folder / "one.key")
    return made


def connect(
    folder: Path,
    authority: Authority,
    server: Identity,
    client: Identity | None,
    host: str = "127.0.0.1",
) -> None:
    """Shake hands, each side checking the other.

    Raises:
        ssl.SSLError: one of them refuses.
    """
    to_server, to_client = ssl.MemoryBIO(), ssl.MemoryBIO()
    ends = (
        context(folder, authority, client, server=False).wrap_bio(
            to_client, to_server, server_hostname=host
        ),
        context(folder, authority, server, server=True).wrap_bio(
            to_server, to_client, server_side=True
        ),
    )
    for _ in range(4):
        for end in ends:
            try:
                end.do_handshake()
            except ssl.SSLWantReadError:
                continue
    assert all(end.version() is not None for end in ends)


def issue(hosts: Sequence[str] = ("localhost", "127.0.0.1", "::1")) -> tuple[Authority, Identity]:
    authority = Authority.new(utc_now(), DAY)
    return authority, authority.issue("service", hosts, utc_now())


@pytest.mark.parametrize("host", ["127.0.0.1", "::1", "localhost"])
def test_both_sides_accept_one_another(tmp_path: Path, host: str) -> None:
    authority, server = issue()
    connect(tmp_path, authority, server, authority.issue("car", (), utc_now()), host)


def test_another_host_is_refused(tmp_path: Path) -> None:
    authority, server = issue()
    client = authority.issue("car", (), utc_now())
    for host in ("127.0.0.2", "example.org"):
        with pytest.raises(ssl.SSLError, match=r"doesn't match|mismatch"):
            connect(tmp_path, authority, server, client, host)


def test_a_client_without_a_certificate_is_refused(tmp_path: Path) -> None:
    authority, server = issue()
    with pytest.raises(ssl.SSLError, match=r"(?i)did not return a certificate"):
        connect(tmp_path, authority, server, None)


def test_a_client_of_another_authority_is_refused(tmp_path: Path) -> None:
    authority, server = issue()
    other = Authority.new(utc_now(), DAY).issue("car", (), utc_now())
    with pytest.raises(ssl.SSLError, match="verify failed"):
        connect(tmp_path, authority, server, other)


def test_an_expired_client_is_refused(tmp_path: Path) -> None:
    authority, server = issue()
    late = authority.issue("car", (), utc_now() - 2 * DAY, DAY)
    with pytest.raises(ssl.SSLError, match="expired"):
        connect(tmp_path, authority, server, late)


def test_a_client_cannot_pass_for_a_server(tmp_path: Path) -> None:
    authority, _ = issue()
    client = authority.issue("passenger", (), utc_now())
    with pytest.raises(ssl.SSLError, match="verify failed"):
        connect(tmp_path, authority, client, client)


def test_a_client_cannot_sign_another(tmp_path: Path) -> None:
    authority, server = issue()
    client = authority.issue("passenger", (), utc_now())
    forger = Authority.load(client)
    forged = forger.issue("service", (), utc_now())
    chain = Identity(forged.certificate + client.certificate, forged.key)
    with pytest.raises(ssl.SSLError, match="verify failed"):
        connect(tmp_path, authority, server, chain)


def test_an_authority_is_kept_and_loaded(tmp_path: Path) -> None:
    authority, server = issue()
    again = Authority.load(authority.identity)
    connect(tmp_path, authority, server, again.issue("car", (), utc_now()))


def test_what_a_certificate_says() -> None:
    authority = Authority.new(NOON, 10 * DAY)
    shown = read(authority.issue("car.b", (), NOON, DAY).certificate)
    assert (shown.name, shown.ends) == ("car.b", NOON + DAY)
    assert shown.begins < NOON
    longest = read(authority.issue("car.b", (), NOON + 5 * DAY, 99 * DAY).certificate)
    assert longest.ends == NOON + 10 * DAY  # it ends with its authority


def test_no_two_keys_are_the_same() -> None:
    authority = Authority.new(NOON, DAY)
    assert len({authority.issue("car", (), NOON).key for _ in range(3)}) == 3


@pytest.mark.parametrize("host", ["", "a b", "*.example.org", "-a", "a..b", "x" * 64, "é", "a/b"])
def test_what_is_no_host(host: str) -> None:
    with pytest.raises(BadHost, match="neither"):
        issue([host])


def test_what_is_no_certificate() -> None:
    authority, other = (Authority.new(NOON, DAY).identity for _ in range(2))
    with pytest.raises(BadCertificate):
        read(b"-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n")
    for wrong in (
        Identity(b"", b""),
        Identity(authority.certificate, b"-----BEGIN PRIVATE KEY-----"),
        Identity(authority.certificate, other.key),
    ):
        with pytest.raises(BadCertificate):
            Authority.load(wrong)
