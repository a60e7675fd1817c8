"""Whose a conversation is: the user's secret, and what is made of it."""

import base64
import threading
from pathlib import Path

import pytest

from xavi_dialogue.bus.messages import HistoryRequest, pack, unpack
from xavi_dialogue.security.client_token import SECRET_BYTES, IdentityError, own_secret, token_of


def test_a_token_is_that_of_the_standard_and_fits_into_a_message() -> None:
    # RFC 4231, test case 2, with its key as the secret.
    digest = "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843"
    token = token_of(b"Jefe", "what do ya want for nothing?")
    assert base64.urlsafe_b64decode(token + "=").hex() == digest
    request = HistoryRequest(session="ada", token=token)
    assert unpack(pack(request), HistoryRequest) == request


def test_every_conversation_and_every_user_has_tokens_of_its_own() -> None:
    tokens = {token_of(secret, name) for secret in (b"a" * 32, b"b" * 32) for name in ("x", "y")}
    assert len(tokens) == 4


def test_the_secret_is_made_once_and_is_for_its_owner_alone(tmp_path: Path) -> None:
    file = tmp_path / "state" / "secret"
    secret = own_secret(file)
    assert len(secret) == SECRET_BYTES
    assert own_secret(file) == secret
    assert file.stat().st_mode & 0o777 == 0o600
    assert file.parent.stat().st_mode & 0o777 == 0o700
    assert [one.name for one in file.parent.iterdir()] == ["secret"]


def test_of_many_who_make_it_at_once_all_have_the_same(tmp_path: Path) -> None:
    made: list[bytes] = []
    begin = threading.Barrier(8)

    def make() -> None:
        begin.wait()
        made.append(own_secret(tmp_path / "secret"))

    threads = [threading.Thread(target=make) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(made) == 8
    assert len(set(made)) == 1


def test_where_nothing_is_to_be_kept_none_is_written(tmp_path: Path) -> None:
    file = tmp_path / "secret"
    assert own_secret(file, make=False) != own_secret(file, make=False)
    assert not file.exists()
    secret = own_secret(file)
    assert own_secret(file, make=False) == secret


@pytest.mark.parametrize("held", [b"", b"x" * 31, b"x" * 10_000])
def test_what_is_no_secret_is_not_used(tmp_path: Path, held: bytes) -> None:
    file = tmp_path / "secret"
    file.write_bytes(held)
    with pytest.raises(IdentityError, match="remove it"):
        own_secret(file)


def test_a_secret_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    (tmp_path / "secret").mkdir()
    with pytest.raises(IdentityError, match="cannot be used"):
        own_secret(tmp_path / "secret")
    (tmp_path / "file").write_text("")
    with pytest.raises(IdentityError, match="cannot be used"):
        own_secret(tmp_path / "file" / "secret")
