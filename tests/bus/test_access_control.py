"""The table of roles: what it grants as data, and as the access control of a hub."""

import json
from pathlib import Path
from typing import Any

import pytest
import zenoh

from xavi_dialogue.bus.access_control import (
    ROLES,
    BadName,
    Member,
    access_control,
    member,
    table,
)

EVERYBODY = [*map(member, ROLES), member("car", "b"), member("passenger", "anna")]


def rules_of(name: str, members: list[Member] = EVERYBODY) -> list[dict[str, Any]]:
    control: dict[str, Any] = access_control(members)
    rules = {rule["id"]: rule for rule in control["rules"]}
    assert len(rules) == len(control["rules"])
    [policy] = [one for one in control["policies"] if one["subjects"] == [name]]
    assert len(policy["rules"]) == len(set(policy["rules"]))
    return [rules[one] for one in policy["rules"]]


def may(name: str, flow: str, message: str, key: str) -> bool:
    """Whether a hub lets it pass, as Zenoh reads the rules: by inclusion."""
    return any(
        flow in rule["flows"]
        and message in rule["messages"]
        and any(
            zenoh.KeyExpr(allowed).includes(zenoh.KeyExpr(key)) for allowed in rule["key_exprs"]
        )
        for rule in rules_of(name)
    )


def test_what_is_not_granted_is_denied() -> None:
    control: dict[str, Any] = access_control(EVERYBODY)
    assert control["enabled"]
    assert control["default_permission"] == "deny"
    assert {rule["permission"] for rule in control["rules"]} == {"allow"}


def test_every_member_is_known_by_the_whole_of_its_common_name() -> None:
    subjects = access_control(EVERYBODY)["subjects"]
    names = sorted(one.common_name for one in EVERYBODY)
    assert subjects == [{"id": name, "cert_common_names": [name]} for name in names]


def test_zenoh_takes_the_access_control() -> None:
    config = zenoh.Config()
    config.insert_json5("access_control", json.dumps(access_control(EVERYBODY)))
    assert len(json.loads(config.get_json("access_control/subjects"))) == len(EVERYBODY)


def test_the_order_of_members_does_not_matter() -> None:
    assert access_control(EVERYBODY) == access_control(reversed([*EVERYBODY, *EVERYBODY]))


@pytest.mark.parametrize("tail", ["scene", "trace", "event"])
def test_nobody_but_the_car_tells_of_the_ride(tail: str) -> None:
    publishers = {
        one.common_name
        for one in EVERYBODY
        if may(one.common_name, "ingress", "put", f"xavi/v1/car/{tail}")
    }
    assert publishers == {"car"}
    assert may("car.b", "ingress", "put", f"xavi/v1/b/{tail}")
    assert not may("car.b", "ingress", "put", f"xavi/v1/*/{tail}")


def test_nobody_deletes() -> None:
    for one in EVERYBODY:
        assert not any("delete" in rule["messages"] for rule in rules_of(one.common_name))


def test_a_passenger_with_a_name_may_what_any_passenger_may() -> None:
    assert rules_of("passenger.anna") == rules_of("passenger")


def test_what_comes_from_a_car_is_under_its_own_name_alone() -> None:
    looks = {"query", "declare_liveliness_subscriber", "liveliness_query"}
    for rule in rules_of("car.b"):
        if "ingress" in rule["flows"] and not set(rule["messages"]) <= looks:
            assert all(key.startswith("xavi/v1/b/") for key in rule["key_exprs"]), rule["id"]


def test_no_key_is_granted_as_a_whole_tree() -> None:
    for one in EVERYBODY:
        for rule in rules_of(one.common_name):
            for key in rule["key_exprs"]:
                assert "**" not in key.removesuffix("/@adv/pub/**")


@pytest.mark.parametrize(
    ("role", "name"),
    [
        *[("hub", None), ("", None), ("car.b", None), ("Car", None)],
        *[("car", ""), ("car", "*"), ("car", "a/b"), ("car", "@x"), ("car", "$*"), ("car", "a\n")],
        *[
            ("car", "ä"),
            ("car", "x" * 61),
            ("passenger", "x" * 55),
            ("observer", "?"),
            ("car", "#"),
        ],
    ],
)
def test_names_that_nobody_can_have(role: str, name: str | None) -> None:
    with pytest.raises(BadName):
        member(role, name)


def test_names_with_dots_stay_names() -> None:
    assert member("car", "..").common_name == "car..."
    assert member("car", "x" * 60).vehicle == "x" * 60
    [scene] = [
        rule["key_exprs"]
        for rule in rules_of("car...", [member("car", "..")])
        if "put" in rule["messages"] and rule["key_exprs"][0].endswith("scene")
    ]
    assert scene == ["xavi/v1/../scene"]  # keys have no parents: it is a name as any other


def test_the_document_shows_the_table(root: Path) -> None:
    page = (root / "docs/security.md").read_text(encoding="utf-8")
    begin, end = "<!-- roles: begin -->\n", "\n<!-- roles: end -->"
    assert page.partition(begin)[2].partition(end)[0] == table()
