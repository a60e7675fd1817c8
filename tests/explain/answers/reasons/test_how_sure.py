"""How sure we are of what others do and of what we decide; asked at 20 s."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.stated import (
    aim,
    belief,
    decision,
    driven,
    look,
    result,
    scene,
    they,
)
from tests.traces import Way
from xavi_dialogue.domain.answers import (
    Beliefs,
    NotRecorded,
    Priority,
    Verdict,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import HowDecide, HowSure
from xavi_dialogue.domain.terms import (
    At,
    Both,
    Ego,
    Event,
    Happens,
    Not,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.reasons import knowing as room
from xavi_dialogue.explain.answers.reasons import others
from xavi_dialogue.explain.answers.suppositions import listing
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.history.deeds import Deed

IT, US = Vehicle(1), Ego()
SEEN = {1: look(1), 2: look(2)}
SAID = Span(4.0, 6.0, said=True)
YIELD = Priority(20.0, "give-way", 1)


def sure(of: Any, span: Span | None = None, *, changed: bool = False, **more: Any) -> Any:
    of = Happens(of) if isinstance(of, Event) else of
    return result(room.how_sure, HowSure(of, changed=changed), scene(span, looks=SEEN, **more))


def chance(time: float, left: float, first: Any = "exit-left", **more: Any) -> Any:
    """A decision at which another vehicle was expected to turn left with a probability."""
    on = aim("continue", round(1.0 - left, 3))
    return decision(time, aims={1: (aim(first, left), on)}, **more)


GROWS = tuple(chance(t, p) for t, p in ((2.0, 0.2), (4.0, 0.22), (6.0, 0.7), (8.0, 0.72)))


def test_where_the_rule_decides_it_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "ruled", lambda _, of: YIELD if of.thing == US else None)
    assert sure(Related("has-priority-over", US, IT)) == YIELD
    unsettled = sure(Related("has-priority-over", IT, US), traces=GROWS)
    assert isinstance(unsettled, Beliefs)
    assert isinstance(sure(Related("must-yield-to", IT, US), traces=GROWS), Beliefs)


@pytest.mark.parametrize(
    ("event", "motion", "why"),
    [
        (Event("stand", IT, tense="present"), 0.0, True),
        (Event("wait", IT, tense="present"), 0.0, True),
        (Event("stand", IT, tense="present"), 5.0, False),
        (Event("stand", IT), 0.0, False),
        (Event("turn", IT, tense="present"), 0.0, False),
    ],
)
def test_who_stands_is_told_why(
    monkeypatch: pytest.MonkeyPatch, event: Event, motion: float, why: bool
) -> None:
    monkeypatch.setattr(others, "why", lambda event, _, negated: (event, negated))
    stands = {1: driven((0.0,) * 21, speed=motion)}
    found = sure(event, motions=stands, traces=GROWS)
    expected = (Event("stand", IT, tense="present"), False)
    assert (found == expected) is why
    assert why or isinstance(found, Beliefs)


def test_a_collision_is_told_by_its_chance(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "collision_chance", lambda _, at, with_: at / 100 + (with_ or 0))
    hit, near = Event("collide", object=IT), Event("nearly-collide")
    by = Happens(Event("collide", IT, US))
    assert sure(hit) == Verdict(by, None, probability=1.2, either=True)
    then = replace(near, time=At(5.0))
    assert sure(near, SAID) == Verdict(Happens(then), None, probability=0.05, either=True)


def test_how_sure_we_are_of_ourselves_is_certainty(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "certain", lambda _, event, negated: (event, negated))
    stop = Event("stop")
    assert sure(stop) == (stop, False)
    assert sure(Not(Happens(stop))) == (stop, True)
    assert sure(None) == (None, False)


def test_what_was_believed_is_told_with_where_it_moved() -> None:
    left = Event("exit-left", IT)
    found = sure(left, traces=GROWS)
    assert (found.vehicle, found.of, found.time) == (1, left, 8.0)
    assert found.probability == pytest.approx(0.72)
    assert [b.time for b in found.history] == [2.0, 6.0, 8.0]
    assert found.turning == (4.0, 6.0)
    assert [e.actions for e in found.besides] == [("continue",)]
    assert not found.changed
    assert sure(left, traces=GROWS, changed=True).changed
    then = sure(left, Span(4.0, 4.0, said=True), traces=GROWS)
    assert (then.time, then.probability) == (4.0, pytest.approx(0.22))
    assert [b.time for b in then.history] == [2.0, 4.0, 6.0, 8.0]
    early = sure(left, Span(1.0, 1.0, said=True), traces=GROWS)
    assert early.time == 2.0


def test_what_it_does_is_all_that_is_believed() -> None:
    found = sure(Event("do", IT), traces=GROWS)
    assert (found.of, found.probability, found.besides) == (None, None, ())
    assert [b.time for b in found.history] == [2.0, 6.0, 8.0]  # its likeliest goal changed
    assert found.turning == (4.0, 6.0)
    assert isinstance(sure(Event("turn", Vehicle(2)), traces=GROWS), NotRecorded)


def test_that_conduct_does_not_come_is_as_likely_as_the_rest() -> None:
    off = Way(("continue",), 1.0, (0.0, 5.0, 9.0))
    stays = Way(("stop",), 1.0, (0.0, 0.0, 0.0))
    goes = (aim("continue", 0.3, ways=(off,)), aim("stop", 0.7, ways=(stays,)))
    traces = (decision(6.0, aims={1: goes}),)
    go = Happens(Event("go", IT, tense="future"))
    plain, negated = sure(go, traces=traces), sure(Not(go), traces=traces)
    assert plain.probability == pytest.approx(0.3)
    assert (negated.denied, negated.probability) == (True, pytest.approx(0.7))
    assert negated.besides == ()
    turn = sure(Not(Happens(Event("exit-left", IT))), traces=GROWS)
    assert turn.probability == pytest.approx(0.28)
    joined = Both((Not(go), Happens(Event("stop"))))
    assert sure(joined, traces=traces).of == negated.of


def test_what_came_of_it_is_told() -> None:
    left = Event("exit-left", IT)
    turned, braked = they(1, "exit-left", 9.0, 12.0), they(1, "brake", 4.5, 5.5)
    appears = they(1, "appear", 5.0)
    found = sure(left, traces=GROWS, episodes=(turned, braked, appears))
    assert (found.came, found.why) == (turned, braked)
    right = they(1, "exit-right", 19.0)
    assert sure(left, traces=GROWS, episodes=(right,)).came == right
    assert sure(left, SAID, traces=GROWS, episodes=(right,)).came is None  # 15 s later
    assert sure(left, traces=GROWS, episodes=(they(1, "change-left", 9.0),)).came is None
    moved = they(1, "change-right", 9.0)
    lanes = Event("change-left", IT)
    assert sure(lanes, traces=GROWS, episodes=(moved, right)).came == moved


def test_a_chance_that_ways_do_not_tell_is_that_of_conduct(monkeypatch: pytest.MonkeyPatch) -> None:
    left, asked = Event("exit-left", IT), scene(looks=SEEN)
    for known, share in ((None, 0.72), (0.0, 0.0), (0.4, 0.4)):
        monkeypatch.setattr(room, "chance", lambda _, event, at, known=known: known)
        assert room._held(asked, 1, left, GROWS[3]) == pytest.approx(share)
    monkeypatch.setattr(room, "chance", lambda _, event, at: (event.actor, at))
    asks: Any = room._held(asked, 2, left, GROWS[3])
    assert asks == (Vehicle(2), 8.0)


@pytest.mark.parametrize(
    ("chances", "kept", "turning"),
    [
        ([0.2, 0.24, 0.26, 0.7], [0, 2, 3], (2.0, 3.0)),
        ([0.2, 0.22, 0.23, 0.24], [0, 3], None),
        ([0.9, 0.2, 0.26, 0.1], [0, 1, 2, 3], (0.0, 1.0)),
        ([0.5], [0], None),
    ],
)
def test_beliefs_are_kept_where_they_moved(
    chances: list[float], kept: list[int], turning: Any
) -> None:
    rows = [belief(1, float(k), ("continue", 0.5)) for k in range(len(chances))]
    moved = room._moved(rows, chances, asked=True)
    assert [b.time for b in moved] == kept
    assert room._turning(rows, chances, asked=True) == turning
    assert room._turning(rows, chances, asked=False) is None


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [
        ((("continue", 0.5),), (("continue", 0.54),), True),
        ((("continue", 0.5),), (("continue", 0.56),), False),
        ((("continue", 0.5),), (("stop", 0.5),), False),
        ((), (), True),
        ((), (("stop", 0.5),), False),
    ],
)
def test_beliefs_are_alike_by_what_is_likeliest(one: Any, other: Any, alike: bool) -> None:
    rows = [belief(1, 0.0, *one), belief(1, 1.0, *other), belief(1, 2.0)]
    assert room._alike(rows[0], rows[1]) is alike
    assert len(room._moved(rows, [0.0] * 3, asked=False)) == (2 if alike else 3)
    assert room._turning(rows, [0.0] * 3, asked=False) is None


# How we decide ----------------------------------------------------------------------------------


@pytest.fixture
def decided(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Which premise certainty is asked of; it is of a choice unless a test says otherwise."""
    known: dict[str, Any] = {"choice": True}

    def of_choice(_: Any, found: Premise, foil: Any = ()) -> Any:
        known["against"] = foil
        return ("choice", found.trace.sim_time) if known["choice"] else None

    monkeypatch.setattr(room.certainty, "of_choice", of_choice)  # type: ignore[attr-defined]
    monkeypatch.setattr(
        room.certainty,  # type: ignore[attr-defined]
        "of_plan",
        lambda _, found: ("plan", found.trace.sim_time),
    )

    def premise(_: Any, about: Any) -> Premise:
        known["about"] = about
        return Premise(GROWS[0], None)

    def about_foil(_: Any, about: Any, foil: Any) -> Premise:
        known["foil"] = (about, foil)
        return Premise(GROWS[1], None)

    for module in (room, listing):
        monkeypatch.setattr(module, "premise", premise)
    monkeypatch.setattr(room, "about_foil", about_foil)
    return known


@pytest.mark.parametrize(
    ("event", "span", "negated", "time"),
    [
        (None, None, False, 8.0),
        (None, SAID, False, 2.0),
        (Event("change-left"), None, False, 2.0),
        (Event("change-left"), None, True, 4.0),
        (Event("change-left", modal="would"), None, False, 4.0),
        (Event("stop"), None, False, 8.0),
        (Event("stop"), SAID, False, 4.0),
        (Event("stop"), Span(1.0, 1.0, said=True), False, 8.0),
        (Event("stop"), None, True, 4.0),
    ],
)
def test_certainty_is_of_the_decision_that_is_meant(
    decided: Any, event: Any, span: Any, negated: bool, time: float
) -> None:
    asked = scene(span, traces=GROWS)
    found: Any = room.certain(asked, event, negated=negated)
    assert found == ("choice", time)
    decided["choice"] = False
    found = room.certain(asked, event, negated=negated)
    assert found == ("plan", time)


def test_a_change_of_speed_is_as_sure_as_the_plan_it_comes_of(decided: Any) -> None:
    for event in (Event("brake"), Event("slow-down"), Event("speed-up")):
        found: Any = room.certain(scene(SAID, traces=GROWS), event, negated=False)
        assert found == ("plan", 4.0)


def test_what_was_not_done_is_asked_of_its_foil(decided: Any) -> None:
    room.certain(scene(SAID, traces=GROWS), Event("change-left", tense="present"), negated=True)
    about, foil = decided["foil"]
    assert (about.event, about.names, about.is_past, about.span) == (None, (), True, SAID)
    assert foil == ("change-left",)
    assert decided["against"] == ("change-left",)  # and not whatever else was best
    room.certain(scene(traces=GROWS), Event("change-left", tense="present"), negated=True)
    assert decided["foil"][0].is_past is False


@pytest.mark.parametrize(
    ("of", "span", "time", "named"),
    [
        (None, None, 8.0, None),
        (None, SAID, 4.0, None),
        (Event("change-left"), None, 2.0, Event("change-left")),
        (Event("stop"), None, 8.0, None),
        (Event("stop"), SAID, 4.0, None),
        (Event("stop", IT), None, 8.0, None),
    ],
)
def test_how_it_was_decided_tells_what_was_compared(
    decided: Any, monkeypatch: pytest.MonkeyPatch, of: Any, span: Any, time: float, named: Any
) -> None:
    monkeypatch.setattr(room.options, "weighed", lambda _, found: ("rows",))  # type: ignore[attr-defined]
    asked = scene(span, traces=GROWS, looks=SEEN)
    found: Any = room.how_decide(HowDecide(None if of is None else Happens(of)), asked)
    assert (found.decided, found.options, found.vehicles, found.tried) == (time, ("rows",), 1, 1)
    assert ("about" in decided) is (of is not None and of.action == "change-left")
    assert "about" not in decided or decided["about"].event == named


def test_how_we_decided_and_how_sure_we_are_is_of_the_decision_in_force(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[float] = []

    def sure(_: Any, found: Premise, *__: Any) -> Any:
        asked.append(found.trace.sim_time)
        return "sure"

    over = Deed("change-left", 0, 2.0, 2.0, 9.0)
    monkeypatch.setattr(room, "premise", lambda _, about: Premise(GROWS[0], over))
    monkeypatch.setattr(room.options, "weighed", lambda _, found: ())  # type: ignore[attr-defined]
    monkeypatch.setattr(room.certainty, "of_choice", sure)  # type: ignore[attr-defined]
    here = scene(traces=GROWS, looks=SEEN)
    found: Any = room.how_decide(HowDecide(), here)
    room.certain(here, None, negated=False)
    assert (found.decided, asked) == (8.0, [8.0])


def test_how_sure_we_are_of_what_goes_on_is_of_the_last_decision(
    decided: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = GROWS[3].plan[0].action
    for ended, tense, time in ((None, "present", 8.0), (None, "past", 2.0), (4.0, "present", 2.0)):
        deed = Deed(first, 0, 2.0, None, ended)
        monkeypatch.setattr(room, "premise", lambda _, about, deed=deed: Premise(GROWS[0], deed))
        asked: Any = Event(first, tense=tense)  # type: ignore[arg-type]
        found: Any = room.certain(scene(traces=GROWS), asked, negated=False)
        assert found == ("choice", time)
