"""Reasons for slowing down where the hidden road that took most of the speed made no difference."""

import pytest

from tests.explain.facts.scenes import recorded
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.explain.causes.driving import restrained
from xavi_dialogue.explain.causes.driving.restrained import Restraining
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.restraints import Restraint

HIDDEN, BEND = Restraint("hidden"), Restraint("bend")


@pytest.mark.parametrize(
    ("found", "minor", "kinds"),
    [
        ((HIDDEN,), (BEND,), ["turn"]),
        ((HIDDEN,), (), None),
        ((HIDDEN, BEND), (), ["turn"]),
    ],
)
def test_a_bend_that_took_less_is_stated(
    monkeypatch: pytest.MonkeyPatch,
    found: tuple[Restraint, ...],
    minor: tuple[Restraint, ...],
    kinds: list[str] | None,
) -> None:
    ride = recorded("s4-0", 18.0)
    world = World(ride)
    deed = world.episodes(Ego(), ("brake",))[-1]
    held = Restraining(found, deed.begin + 1.0, minor)
    monkeypatch.setattr(restrained, "restraining", lambda *_: held)
    monkeypatch.setattr(restrained, "hidden_causes", lambda *_: None)
    monkeypatch.setattr(restrained, "_turn", lambda *_: restrained.MotionCause("turn"))
    reasons = restrained.as_driven(ride, world, deed, deed.begin + 1.0)
    assert (None if reasons is None else [cause.kind for cause in reasons.causes]) == kinds
