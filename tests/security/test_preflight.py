"""Keys that do not fit what they are used for are refused before anything is begun."""

from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from tests.security.test_provisioning import endpoint, linked
from xavi_dialogue.__main__ import app
from xavi_dialogue.bus import certificates
from xavi_dialogue.bus.access_control import Member
from xavi_dialogue.bus.certificates import Authority, Identity, utc_now
from xavi_dialogue.bus.interface import BadLink, HubUnreachable
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import join
from xavi_dialogue.chat import remote_backend
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.process import log_setup
from xavi_dialogue.recording import player, recorder
from xavi_dialogue.security.preflight import WrongKey, check, holder, may, own_name
from xavi_dialogue.security.provisioning import keep, material, wanted
from xavi_dialogue.service import main as hub
from xavi_dialogue.vehicle import main as drive


@pytest.fixture
def keys(tmp_path: Path) -> Path:
    folder = tmp_path / "keys"
    keep(
        material(wanted(listen=endpoint(), vehicles=["shuttle-3", "shuttle-4"]), folder, utc_now()),
        folder,
    )
    return folder


@pytest.fixture
def begun(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[object]:
    """What would have been begun, by the name of the car or of the command."""
    found: list[object] = []
    summary = drive.Summary("s1", 0)

    def driven(_: object, manner: drive.DriveOptions, __: object) -> drive.Summary:
        found.append(manner.vehicle)
        return summary

    def asked(*_: object) -> Reply:
        found.append("ask")
        return Reply(text="Yes.", kind="answer", sim_time=0.0)

    monkeypatch.setattr(drive, "drive", driven)
    monkeypatch.setattr(hub, "serve", lambda *_, **__: found.append("serve"))
    monkeypatch.setattr(recorder, "record", lambda *_: found.append("record"))
    monkeypatch.setattr(player, "replay", lambda show, _: found.append(show.vehicle))
    monkeypatch.setattr(remote_backend, "ask_there", asked)
    monkeypatch.setattr(remote_backend, "through_pipe", lambda *_, **__: found.append("chat"))
    for kind in ("DATA", "STATE", "CONFIG"):
        monkeypatch.setenv(f"XDG_{kind}_HOME", str(tmp_path / kind))
    return found


def xavi(*arguments: str, key: Path) -> Result:
    command = [*arguments, "--zenoh", str(key)]
    return CliRunner().invoke(app, command, catch_exceptions=False)


FITTING = (
    ("car.shuttle-3", ("drive",), "shuttle-3"),
    ("car.shuttle-3", ("drive", "--vehicle", "shuttle-3"), "shuttle-3"),
    ("car", ("drive",), "car"),
    ("car.shuttle-4", ("replay", "README.md"), "shuttle-4"),
    ("service", ("serve", "--keep-days", "0"), "serve"),
    ("observer", ("record", "ride.mcap"), "record"),
    ("dashboard", ("record", "ride.mcap"), "record"),
    ("dashboard", ("ask", "Why?"), "ask"),
    ("passenger", ("ask", "Why?", "--vehicle", "shuttle-4"), "ask"),
    ("passenger", ("chat", "--session", "sunday"), "chat"),
)


@pytest.mark.parametrize(("key", "arguments", "what"), FITTING)
def test_a_key_that_fits_is_used_and_names_the_car(
    keys: Path, begun: list[object], key: str, arguments: tuple[str, ...], what: str
) -> None:
    done = xavi(*arguments, key=keys / f"{key}.json5")
    assert (done.exit_code, begun) == (0, [what]), done.stderr


MISFITS = (
    ("passenger", ("drive",), "'passenger', which may ask, but not report a ride"),
    (
        "car.shuttle-3",
        ("drive", "--vehicle", "shuttle-4"),
        "as 'shuttle-3', but not as 'shuttle-4'",
    ),
    ("car", ("drive", "--vehicle", "shuttle-4"), "as 'car', but not as 'shuttle-4'"),
    ("car", ("replay", "README.md", "--vehicle", "museum"), "but not as 'museum'"),
    ("service", ("replay", "README.md"), "answer passengers, but not report a ride"),
    ("car.shuttle-4", ("serve",), "but not answer passengers; that takes the key of a service"),
    ("passenger", ("record", "ride.mcap"), "that takes the key of a dashboard or observer"),
    ("observer", ("ask", "Why?"), "'observer', which may record, but not ask"),
    ("car", ("chat",), "that takes the key of a passenger or dashboard"),
)


@pytest.mark.parametrize(("key", "arguments", "problem"), MISFITS)
def test_a_key_that_does_not_fit_is_refused(
    keys: Path, begun: list[object], key: str, arguments: tuple[str, ...], problem: str
) -> None:
    done = xavi(*arguments, key=keys / f"{key}.json5")
    assert (done.exit_code, begun, done.stderr.count("\n")) == (2, [], 1)
    assert f"{keys / key}.json5 holds the key of '{key}'" in done.stderr
    assert problem in done.stderr


def test_a_car_without_a_key_is_called_as_ever(begun: list[object]) -> None:
    for arguments in (("drive",), ("drive", "--vehicle", "shuttle-9")):
        command = [*arguments, "--connect", "tcp/127.0.0.1:1"]
        assert CliRunner().invoke(app, command, catch_exceptions=False).exit_code == 0
    assert begun == ["car", "shuttle-9"]


def test_whose_key_it_is_stands_in_its_certificate(keys: Path) -> None:
    assert holder(Link.to_hub()) is None
    for name, member in (("car.shuttle-3", Member("car", "shuttle-3")), ("car", Member("car"))):
        assert holder(Link.to_hub(config=keys / f"{name}.json5")) == member
    assert holder(Link.of_hub(config=keys / "service.json5")) == Member("service")
    assert holder(linked(keys, "bare", None)) is None


def test_certificates_of_others_are_for_their_hub_to_judge(
    keys: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ours = Authority.load(Identity((keys / "ca.pem").read_bytes(), (keys / "ca.key").read_bytes()))
    stranger = linked(keys, "stranger", ours.issue("admin.x", (), utc_now()))
    assert own_name(stranger, None) is None
    with pytest.raises(WrongKey):
        check(linked(keys, "known", ours.issue("passenger", (), utc_now())), "record")
    with monkeypatch.context() as patch:
        patch.setattr(certificates, "AUTHORITY", "Example CA")
        foreign = ours.issue("passenger", (), utc_now())
    assert check(linked(keys, "foreign", foreign), "record") is None


@pytest.mark.parametrize("spoil", [Path.unlink, lambda path: path.write_bytes(b"nothing")])
def test_a_certificate_that_cannot_be_read_is_named(keys: Path, spoil: object) -> None:
    config, certificate = keys / "car.json5", keys / "car.pem"
    spoil(certificate)  # type: ignore[operator]
    with pytest.raises(BadLink, match=r"car\.json5 names the certificate .*car\.pem: "):
        own_name(Link.to_hub(config=config), None)


def test_every_role_may_do_something_and_none_may_do_all() -> None:
    doings = ("report a ride", "answer passengers", "ask", "record")
    table = {
        role: [one for one in doings if may(role, one)]  # type: ignore[arg-type]
        for role in ("car", "service", "passenger", "dashboard", "observer")
    }
    assert table == {
        "car": ["report a ride"],
        "service": ["answer passengers"],
        "passenger": ["ask"],
        "dashboard": ["ask", "record"],
        "observer": ["record"],
    }


def test_the_log_names_the_car_as_its_key_does(
    keys: Path, begun: list[object], monkeypatch: pytest.MonkeyPatch
) -> None:
    vehicles: list[str | None] = []
    monkeypatch.setattr(log_setup, "begin", lambda _, telling: vehicles.append(telling.vehicle))
    assert xavi("drive", key=keys / "car.shuttle-3.json5").exit_code == 0
    assert vehicles == begun == ["shuttle-3"]


def test_who_finds_no_hub_is_told_whether_a_certificate_was_shown(keys: Path) -> None:
    told: list[str] = []
    for link in (Link.to_hub(config=keys / "car.json5"), linked(keys, "bare", None)):
        with pytest.raises(HubUnreachable) as caught:
            join(link, patience=0.0)
        told.append(str(caught.value))
    ends = [one.partition("; ")[2] for one in told]
    assert all(one.startswith("there is no hub at tls/127.0.0.1:") for one in told)
    assert ends == [
        "or it does not accept the certificate that it was shown",
        "or it asks for a certificate; name one with --zenoh FILE",
    ]
