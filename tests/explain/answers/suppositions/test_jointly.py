"""What is supposed of several vehicles at once."""

from typing import Any

import pytest

from planner.record.trace import VehicleState
from tests.explain.answers.given import NOW, Given, look, plan, refused
from tests.explain.answers.supposed import GONE, Setting, did, what_if
from xavi_dialogue.domain.answers import CannotSay, NoSuchVehicle
from xavi_dialogue.domain.meaning import Whether
from xavi_dialogue.domain.terms import (
    Both,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Is,
    Nobody,
    Not,
    Related,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.suppositions import supposing
from xavi_dialogue.explain.answers.suppositions.jointly import Joint, joint

ONE, TWO = Vehicle(1), Vehicle(2)
AWAY = Not(Exists(TWO))
BRAKES, TURNS = did("slow-down", ONE), did("exit-right", TWO)


def read(of: Any, around: tuple[int, ...] = ()) -> Any:
    state = VehicleState.__new__(VehicleState)
    from msgspec.structs import replace

    trace = replace(plan(NOW, "continue"), scene=dict.fromkeys((0, *around), state))
    return joint(of, Given(looks={1: look(1), 2: look(2)}, traces=(trace,)).asked())


@pytest.mark.parametrize(
    "of",
    [
        Both((GONE, AWAY)),
        Not(Both((Exists(ONE), Exists(TWO)))),
        Not(Exists(Vehicles((1, 2)))),
        Is("hidden", Vehicles((1, 2)), tense="past"),
        Both((Is("hidden", ONE), AWAY)),
        Both((GONE, Not(did("appear", TWO)))),
        Both((GONE, Both((AWAY, GONE)))),
    ],
)
def test_all_that_are_named_are_away(of: Any) -> None:
    assert read(of) == Joint((1, 2), None)


def test_the_conduct_of_several_is_one_event() -> None:
    both = Both((BRAKES, did("slow-down", TWO)))
    assert read(both) == Joint((1, 2), BRAKES.event)
    assert read(did("slow-down", Vehicles((2, 1)))) == Joint((2, 1), Event("slow-down", TWO))
    denied = Both((Not(BRAKES), Not(did("slow-down", TWO))))
    assert read(denied) == Joint((1, 2), BRAKES.event, negated=True)


def test_what_does_not_go_with_it_is_left_out_by_name() -> None:
    assert read(Both((BRAKES, TURNS))) == Joint((1,), BRAKES.event, left_out=(2,))
    assert read(Both((GONE, TURNS))) == Joint((1,), None, left_out=(2,))
    assert read(Both((BRAKES, AWAY))) == Joint((1,), BRAKES.event, left_out=(2,))
    either = Both((BRAKES, did("slow-down", TWO)), "or")
    assert read(either) == Joint((1,), BRAKES.event, left_out=(2,))


@pytest.mark.parametrize("of", [GONE, BRAKES, did("stop", Ego()), Related("near", ONE)])
def test_what_is_of_one_is_nothing_joint(of: Any) -> None:
    assert read(of) is None


def test_what_cannot_be_supposed_together_is_refused() -> None:
    ours = did("stop", Ego())
    assert refused(read, Both((ours, BRAKES))) == CannotSay("unsupported-condition")
    assert read(Both((ours, Not(did("go", Ego()))))) is None
    placed = Both((Related("near", ONE), Related("near", TWO)))
    assert refused(read, placed) == CannotSay("unsupported-condition")
    assert isinstance(refused(read, Both((GONE, Not(Exists(Vehicle(7)))))), NoSuchVehicle)


@pytest.mark.parametrize(
    ("of", "empty"),
    [
        (Exists(Nobody()), True),
        (Is("visible", Nobody(), tense="past"), True),
        (Is("present", Nobody()), True),
        (Not(Exists(Everyone())), True),
        (Is("hidden", Everyone()), True),
        (Not(Exists(Described(other=True, plural=True, definite=False))), True),
        (Is("safe", Nobody()), False),
        (Exists(Everyone()), False),
        (Not(Exists(Described(kind="bus", other=True, plural=True, definite=False))), False),
    ],
)
def test_nobody_else_is_there(of: Any, empty: bool) -> None:
    if empty:
        assert read(of, (3, 1)) == Joint((1, 3), None, everybody=True)
        assert read(of) is None  # there is nobody anyway
    else:
        assert read(of, (3, 1)) is None


# --- what would have been -----------------------------------------------------------------------


@pytest.fixture
def setting(monkeypatch: pytest.MonkeyPatch) -> Setting:
    return Setting(monkeypatch)


def test_it_is_planned_again_without_all_of_them(setting: Setting) -> None:
    found = what_if(Both((GONE, AWAY)))
    assert (setting.found[0].by, setting.found[0].args) == ("without", ((1, 2), NOW))
    assert (found.vehicle, found.others, found.left_out) == (1, (2,), ())
    assert (found.supposed, found.past) == (None, False)
    past = what_if(Both((GONE, AWAY)), Whether(did("stop", Ego())))
    assert (past.past, past.asked) == (True, Event("stop"))


def test_where_no_sample_has_all_do_so_the_others_are_left_out(
    setting: Setting, monkeypatch: pytest.MonkeyPatch
) -> None:
    braking = Both((BRAKES, did("slow-down", TWO)))
    monkeypatch.setattr(supposing, "together", lambda *args, **more: None)
    found = what_if(braking)
    assert (found.vehicle, found.others, found.left_out) == (1, (), (2,))
    assert setting.found[0].by == "otherwise"
    monkeypatch.setattr(
        supposing, "together", lambda *args, **more: setting._found("together", args, **more)
    )
    both = what_if(braking)
    assert (both.vehicle, both.others, both.left_out) == (1, (2,), ())
    assert setting.found[1].args[0] == (1, 2)
    mixed = what_if(Both((GONE, TURNS)))
    assert (mixed.vehicle, mixed.left_out) == (1, (2,))


def test_nothing_is_told_of_another_world_of_theirs(setting: Setting) -> None:
    theirs = Whether(did("stop", TWO))
    assert refused(what_if, Both((GONE, AWAY)), theirs) == CannotSay("unsupported-condition")
