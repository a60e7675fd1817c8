"""Whether we come closer to somebody, and whether somebody moves over, by how both drive now."""

import pytest
from msgspec.structs import replace

from tests.explain.answers.given import NOW, Given, look, their
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Now, Tense, Vehicle
from xavi_dialogue.explain.answers.measuring import nearing
from xavi_dialogue.explain.answers.measuring.nearing import (
    ASIDE_IN,
    SINCE,
    closes,
    comes_before,
    keeps,
    moves_over,
    past_leader,
)

NEARS = Event("approach", Ego(), Vehicle(1), time=Now(), tense="present")


@pytest.mark.parametrize(("before", "holds"), [(16.0, True), (15.5, False), (15.0, False)])
def test_we_come_closer_to_somebody_whose_gap_to_us_shrinks(before: float, holds: bool) -> None:
    def seen(at: float) -> object:
        return look(1, distance=15.5 if at > NOW - SINCE / 2.0 else before)

    found = closes(Given(looks={1: seen}).asked(), NEARS)
    assert found is not None
    assert found.holds is holds


@pytest.mark.parametrize(
    ("action", "side", "shift", "holds"),
    [
        ("change-lane", "right", -0.3, True),
        ("change-lane", "left", 0.3, True),
        ("change-right", "right", -0.3, True),
        ("change-left", "right", -0.3, None),
        ("change-lane", "right", 0.3, None),
        ("change-lane", "right", -0.1, None),
        ("overtake", "right", -0.3, None),
    ],
)
def test_who_indicates_and_drives_to_that_side_moves_over(
    action: str, side: str, shift: float, holds: bool | None
) -> None:
    def seen(at: float) -> object:
        return look(1, left=shift if at > NOW - ASIDE_IN / 2.0 else 0.0)

    given = Given(looks={1: seen}, deeds=[their(1, "signal", NOW - 2.0, side=side)])
    found = moves_over(given.asked(), Event(action, Vehicle(1), tense="present"))  # type: ignore[arg-type]
    assert (None if found is None else found.holds) is holds


@pytest.mark.parametrize(
    ("where", "action"),
    [
        ({}, "overtake"),
        ({"left": 3.2}, "pass"),  # in another lane
        ({"speed": 0.0}, "pass"),  # it stands
        ({"ahead": -15.0, "bearing": "behind"}, "pass"),
        ({"oncoming": True}, "pass"),
        ({"in_view": False}, "pass"),
    ],
)
def test_going_past_who_drives_ahead_in_our_lane_is_overtaking(
    where: dict[str, object], action: str
) -> None:
    asked = Given(looks={1: look(1, **where)}).asked()
    assert past_leader(asked, Event("pass", Ego(), Vehicle(1))).action == action


@pytest.mark.parametrize(("share", "holds"), [(0.9, True), (0.2, False), (None, None)])
def test_whether_somebody_comes_out_before_us_is_what_is_expected(
    share: float | None, holds: bool | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(nearing, "chance", lambda *_: share)
    monkeypatch.setattr(nearing, "rule_between", lambda *_: None)
    asked = Given(looks={1: look(1), 2: look(2, in_view=False)}).asked()
    found = comes_before(asked, Event("pull-out", Vehicle(1), tense="future"))
    assert (None if found is None else (found.holds, found.probability)) == (
        None if share is None else (holds, share)
    )
    assert comes_before(asked, Event("pull-out", Vehicle(2), tense="future")) is None
    assert comes_before(asked, Event("pull-out", Ego(), tense="future")) is None
    assert comes_before(asked, Event("brake", Vehicle(1), tense="future")) is None
    assert comes_before(asked, Event("cross", Vehicle(1), Vehicle(2), tense="future")) is None


@pytest.mark.parametrize(("left", "theirs", "holds"), [(3.2, 5.0, True), (3.2, 20.0, False)])
def test_we_overtake_who_is_slower_in_another_lane(left: float, theirs: float, holds: bool) -> None:
    asked = Given(
        looks={1: look(1, left=left, speed=theirs)},
        measures={("speed", Ego()): 10.0, ("speed", Vehicle(1)): theirs},
    ).asked()
    found = nearing.nears(asked, Event("overtake", Ego(), Vehicle(1), tense="future"))
    assert found is not None
    assert found.holds is holds
    ahead = Given(looks={1: look(1, left=0.0)}).asked()
    assert nearing.nears(ahead, Event("overtake", Ego(), Vehicle(1), tense="future")) is None


def keeping(**more: object) -> Episode:
    known: dict[str, object] = {"actor": Ego(), "action": "keep-distance", "begin": 12.0}
    return Episode(**(known | {"object": Vehicle(1)} | more))  # type: ignore[arg-type]


BOTH = {1: look(1), 2: look(2)}
KEEP = Event("keep-distance", Ego(), Vehicle(1), tense="present")


@pytest.mark.parametrize("tense", ["present", "perfect"])
def test_we_keep_our_distance_to_whom_we_follow(tense: Tense) -> None:
    found = keeps(Given(looks=BOTH, deeds=(keeping(),)).asked(), replace(KEEP, tense=tense))
    assert found is not None
    assert found.holds is True
    assert found.facts[0] == keeping()


@pytest.mark.parametrize(
    ("event", "deed"),
    [
        (replace(KEEP, tense="past"), keeping()),
        (replace(KEEP, action="follow"), keeping(action="follow")),
        (replace(KEEP, actor=Vehicle(1), object=Ego()), keeping(actor=Vehicle(1), object=Ego())),
        (KEEP, keeping(end=15.0)),
        (KEEP, keeping(object=Vehicle(2))),
    ],
)
def test_what_is_no_distance_that_we_keep_is_answered_elsewhere(
    event: Event, deed: Episode
) -> None:
    assert keeps(Given(looks=BOTH, deeds=(deed,)).asked(), event) is None


def test_the_distance_that_we_kept_then_is_answered_elsewhere() -> None:
    asked = Given(looks=BOTH, deeds=(keeping(),)).asked(Span(13.0, 14.0, said=True))
    assert keeps(asked, KEEP) is None
