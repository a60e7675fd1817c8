"""Which questions of ours are worth putting, what solves them, and what replies come to."""

from types import SimpleNamespace
from typing import Any, cast

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Happened
from planner.record.trace import Action
from tests.dialogue.state.test_chain import turn
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.quizzes.quiz import MANY, candidates, solved
from xavi_dialogue.dialogue.state.turn import Quiz
from xavi_dialogue.domain.answers import (
    Answer,
    Cause,
    ChoiceReason,
    Contrast,
    Effect,
    Evidence,
    Helpful,
    MotionCause,
    MotionReason,
    OutcomeEstimate,
    Posed,
    SupposedOfOther,
    SupposedOfUs,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import WhatIf, Why
from xavi_dialogue.domain.reasons import Performed
from xavi_dialogue.domain.terms import At, Ego, Event, Exists, Happens, Not, Unsaid, Vehicle
from xavi_dialogue.explain.history.record import Record

CHANGED = Episode(Ego(), "change-left", 4.0, 7.0)
BRAKED = Episode(Ego(), "slow-down", 5.0, 8.0)


def decision(number: int, time: float, others: tuple[int, ...], *held: tuple[int, ...]) -> Any:
    """A trace as far as questions are made of it: who is there, and who holds up in each drive."""
    rollouts = [SimpleNamespace(held_up=[SimpleNamespace(vehicle=v) for v in row]) for row in held]
    scene = dict.fromkeys((0, *others))
    return SimpleNamespace(decision=number, sim_time=time, scene=scene, rollouts=rollouts)


FIRST = decision(0, 3.0, (1, 2, 3), (3,), (3, 3), (2, 3))
SECOND = decision(1, 4.0, (1, 2, 3), (2, 2, 2), (1,), (1,), (3,))


def events(*actions: Action, decided: int = 0) -> tuple[Happened, ...]:
    """Manoeuvres that were begun, committed to and ended."""
    kinds: list[Any] = ["action-started", "action-committed", "action-ended"]
    return tuple(
        Happened(kind, 4.0 + k, action, decided)
        for action in actions
        for k, kind in enumerate(kinds)
    )


def record(*happened: Happened, traces: tuple[Any, ...] = (FIRST, SECOND)) -> Record:
    return Record(9.0, traces, happened)


def who(action: str) -> Posed:
    return Posed("vehicle", Why(Happens(Event(cast("Any", action)))))


def without(vehicle: int, at: float | None = None) -> Posed:
    time, tense = (Unsaid(), "present") if at is None else (At(at), "past")
    there = Exists(Vehicle(vehicle), time=time, tense=cast("Any", tense))
    return Posed("deed", WhatIf(Not(there)))


def straight(vehicle: int, at: float | None = None) -> Posed:
    time, tense = (Unsaid(), "present") if at is None else (At(at), "past")
    went = Event("exit-straight", Vehicle(vehicle), time=time, tense=cast("Any", tense),
                 modal="would")  # fmt: skip
    return Posed("deed", WhatIf(Happens(went)))


def sooner_with(action: Action) -> Posed:
    return Posed("sooner", WhatIf(Happens(Event(action, modal="would"))))


SLOWED = [who("slow-down"), who("stop"), who("give-way")]


def test_without_a_manoeuvre_it_is_about_slowing_and_those_in_our_way_now() -> None:
    # In the last decision 1 is in the way of two drives, 2 and 3 of one each.
    assert candidates((), (), record()) == (*SLOWED, without(1), without(2), straight(1))


@pytest.mark.parametrize(
    ("action", "first"),
    [("change-left", [sooner_with("continue")]), ("exit-right", [])],
)
def test_the_last_manoeuvre_comes_first(action: Action, first: list[Posed]) -> None:
    # It was decided at 3 s, where 3 is in the way of all drives, 2 of one and 1 of none.
    found = candidates((), (), record(*events("exit-left", action)))
    rest = [without(3, 3.0), who(action), *SLOWED, without(2, 3.0), straight(3, 3.0)]
    assert found == (*first, *rest)[:MANY]


def test_nothing_is_asked_without_a_record_and_nothing_twice() -> None:
    assert candidates((), (), record(traces=())) == ()
    asked = [Quiz(posed=replace(one, again=True), at=5.0) for one in (SLOWED[0], without(1))]
    assert candidates((), asked, record()) == (*SLOWED[1:], without(2), straight(1))


def contrast(*causes: Cause, effects: tuple[Effect, ...] = (), outcome: str = "done") -> Contrast:
    return Contrast(
        fact=("change-left",),
        foil=("continue", "stop"),
        outcome=OutcomeEstimate(cast("Any", outcome), 1.0),
        effects=effects,
        causes=causes,
        evidence=Evidence(),
        decided=4.0,
    )


BUS, CAR = Cause(7, ("stop",), 0.9), Cause(8, ("stop",), 0.8)


@pytest.mark.parametrize(
    ("result", "first", "told"),
    [
        # Who made us, and whether it was sooner, was just told: only the deed is left to ask.
        (
            ChoiceReason("why", CHANGED, contrast(BUS, CAR)),
            [without(7, 4.0)],
            [sooner_with("continue"),
             Posed("vehicle", Why(Happens(Event("change-left", time=At(4.0), tense="past"))))],
        ),
        (ChoiceReason("why", None, contrast(BUS)), [without(7)], [sooner_with("continue")]),
        (MotionReason(BRAKED, (MotionCause("leader", 7), MotionCause("leader", 8))),
         [without(7, 5.0)], []),
        (MotionReason(BRAKED, (MotionCause("limit"),)), [], []),
        (SupposedOfUs(contrast(BUS)), [], [sooner_with("continue")]),
        (Helpful(), [], []),
    ],
)  # fmt: skip
def test_what_was_talked_about_comes_before_the_ride(
    result: Answer, first: list[Posed], told: list[Posed]
) -> None:
    found = list(candidates((turn(result),), (), record()))
    assert found[: len(first)] == first
    if told:  # it comes after the deeds
        assert found.index(told[0]) > found.index(straight(1))
        assert [posed for posed in found if posed in told] == told[: len(set(found) & set(told))]
    assert without(8, 5.0) not in found
    assert without(8, 4.0) not in found


def test_what_was_talked_about_last_comes_first() -> None:
    earlier = turn(MotionReason(BRAKED, (MotionCause("leader", 7),)))
    later = turn(MotionReason(replace(BRAKED, begin=6.0), (MotionCause("leader", 8),)))
    found = candidates((earlier, later), (), record())
    assert found[:2] == (without(8, 6.0), without(7, 5.0))


def test_after_a_supposition_about_another_deeds_come_last() -> None:
    supposed = SupposedOfOther(3, None, None, ("stop",), ("continue",), False)
    earlier = turn(MotionReason(BRAKED, (MotionCause("leader", 7),)))
    kinds = [posed.kind for posed in candidates((earlier, turn(supposed)), (), record())]
    assert kinds == ["vehicle"] * 3 + ["deed"] * 4
    motion = MotionReason(BRAKED, ())
    kinds = [posed.kind for posed in candidates((turn(motion),), (), record())]
    assert kinds == ["deed"] * 3 + ["vehicle"] * 3
    us = [posed.kind for posed in candidates((turn(SupposedOfUs(contrast())),), (), record())]
    assert us == ["vehicle"] * 3 + ["deed"] * 3 + ["sooner"]


def test_an_action_that_was_given_up_was_not_carried_out() -> None:
    started, committed, ended = events("change-left")
    assert carried_out((started, committed, ended)) == (ended,)
    assert carried_out((started, ended)) == carried_out((ended,)) == ()
    assert carried_out((started, committed, started, ended)) == ()
    assert carried_out((started, committed, ended, ended)) == (ended,)
    assert carried_out(events("continue")) == ()
    gave_way = Happened("gave-way", 5.0, vehicle=1)
    assert carried_out((started, committed, gave_way, ended)) == (ended,)


@pytest.mark.parametrize(
    ("causes", "vehicle"),
    [
        ((BUS,), 7),
        ((), None),
        ((BUS, CAR), None),  # either may have been it
        ((Cause(0, ("stop",), 0.9),), None),
        ((replace(BUS, probability=0.51),), 7),
        ((replace(BUS, probability=0.5),), None),
        ((replace(BUS, necessary=False),), None),
        ((replace(BUS, necessary=True), replace(CAR, necessary=False)), 7),
        ((BUS, replace(CAR, necessary=False)), None),
        ((replace(BUS, necessary=True), CAR), None),
        ((MotionCause("leader", 7), MotionCause("turn")), 7),
        ((MotionCause("turn"), MotionCause("leader", 7)), None),
        ((MotionCause("leader", 7, probability=0.3),), None),
    ],
)
def test_one_vehicle_solves_a_question_for_who_it_was(
    causes: tuple[Any, ...], vehicle: int | None
) -> None:
    found: list[Answer] = [MotionReason(BRAKED, causes)]
    if all(isinstance(cause, Cause) for cause in causes):
        found.append(ChoiceReason("why", CHANGED, contrast(*causes)))
    for answer in found:
        quiz = solved(who("stop"), answer, 9.0)
        assert (quiz and quiz.vehicle) == vehicle
        assert quiz is None or (quiz.posed, quiz.at) == (who("stop"), 9.0)


def time_effect(delta: float, low: float, high: float) -> Effect:
    return Effect("time", "s", delta, low, high, 10, 5)


@pytest.mark.parametrize(
    ("effects", "sooner"),
    [
        ((time_effect(4.0, 3.0, 5.0),), False),
        ((time_effect(-4.0, -5.0, -3.0),), True),
        ((time_effect(1.0, 0.5, 1.5),), False),
        ((time_effect(0.9, 0.5, 1.3),), None),  # too little to be asked for
        ((time_effect(-0.9, -1.3, -0.5),), None),
        ((time_effect(4.0, -1.0, 9.0),), None),  # not sure
        ((time_effect(4.0, 0.0, 8.0),), None),
        ((), None),
        ((Effect("jerk", "m/s3", 4.0, 3.0, 5.0, 10, 5),), None),
        ((Effect("jerk", "m/s3", 4.0, 3.0, 5.0, 10, 5), time_effect(-2.0, -3.0, -1.0)), True),
    ],
)
def test_a_clear_difference_in_time_solves_whether_it_is_sooner(
    effects: tuple[Effect, ...], sooner: bool | None
) -> None:
    asked = sooner_with("continue")
    quiz = solved(asked, SupposedOfUs(contrast(effects=effects)), 9.0)
    assert quiz == (None if sooner is None else Quiz(posed=asked, at=9.0, sooner=sooner))
    other = SupposedOfOther(
        3, None, None, ("stop",), ("exit-left", "stop"), False, contrast=contrast(effects=effects)
    )
    assert solved(without(3), other, 9.0) == Quiz(
        posed=without(3), at=9.0, actions=("exit-left",), same=False, sooner=sooner
    )


def test_some_questions_have_no_solution() -> None:
    clear = (time_effect(4.0, 3.0, 5.0),)
    asked = sooner_with("continue")
    assert solved(asked, SupposedOfUs(contrast(effects=clear, outcome="collision")), 9.0) is None
    assert solved(asked, SupposedOfUs(replace(contrast(effects=clear), outcome=None)), 9.0) is None
    done = Performed("change-left", "did")
    assert solved(asked, SupposedOfUs(contrast(effects=clear), done=done), 9.0) is None
    assert solved(without(3), SupposedOfOther(3, None, None, (), ("stop",), False), 9.0) is None
    assert solved(who("stop"), Helpful(), 9.0) is None
    same = SupposedOfOther(3, None, None, ("stop", "continue"), ("stop",), True)
    assert solved(without(3), same, 9.0) == Quiz(
        posed=without(3), at=9.0, actions=("stop",), same=True
    )


def test_those_in_our_way_are_those_of_the_last_manoeuvre() -> None:
    """At 4 s we decided to turn, and 1 was in our way most; to change lanes at 3 s, it was 3."""
    before = events("exit-left", "change-left", decided=0)
    happened = (*before, *events("exit-right", decided=1))
    found = candidates((), (), record(*happened))
    assert found[:2] == (without(1, 4.0), who("exit-right"))
    back = (*events("exit-right", decided=1), *events("change-left", decided=0))
    assert without(3, 3.0) in candidates((), (), record(*back))
    assert without(1, 3.0) not in candidates((), (), record(*back))
