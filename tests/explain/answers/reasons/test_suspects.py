"""What the planner chooses, and whether a suspect is the cause of a choice."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.chosen import (
    LEFT,
    STAY,
)
from tests.explain.answers.reasons.test_choices import ONE
from tests.explain.answers.stated import US, did
from xavi_dialogue.domain.answers import (
    Cause,
    ChoiceReason,
    Contrast,
    Evidence,
    Measures,
    MotionCause,
    MotionReason,
)
from xavi_dialogue.domain.evidence import Causation, Share
from xavi_dialogue.domain.terms import Event, Exit, Related
from xavi_dialogue.explain.answers.reasons.choices import is_choice, is_kept_from
from xavi_dialogue.explain.answers.reasons.suspects import (
    meant_on_foot,
    or_road,
    with_suspect,
    with_suspects,
)

# --- names --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "choice"),
    [
        (Event("change-lane"), True),
        (Event("turn"), True),
        (Event("continue"), True),
        (Event("stop"), False),
        (Event("brake"), False),
        (Event("let-go"), False),
        (Event("follow"), False),
        (Event("overtake"), True),
    ],
)
def test_what_the_planner_chooses(event: Event, choice: bool) -> None:
    assert is_choice(event) is choice


@pytest.mark.parametrize(
    ("other", "event", "kept"),
    [
        (Event("turn"), Event("keep-lane"), True),
        (Event("stop"), Event("keep-lane"), True),
        (Event("brake"), Event("keep-lane"), False),
        (Event("turn"), Event("go"), True),
        (Event("turn"), Event("continue"), True),
        (Event("turn"), Event("go", object=Exit(1)), False),
        (Event("turn"), Event("go", side="left"), False),
        (Event("turn"), Event("go", where=Related("behind", US, ONE)), False),
        (Event("turn"), Event("overtake"), False),
        (Event("turn"), Event("keep-lane", object=ONE), True),
    ],
)
def test_going_on_is_being_kept_from_something(other: Event, event: Event, kept: bool) -> None:
    keeping: Any = ("keep-lane",)
    assert is_kept_from(other, event, keeping) is kept


# --- suspects -----------------------------------------------------------------------------------


def of_choice(*vehicles: int, ahead: int | None = None, hit: int | None = None) -> ChoiceReason:
    """A choice because of some vehicles, most important first."""
    term = Share("collision" if hit is not None else "time", 2.0)
    against = Contrast(
        LEFT, STAY, None, (), tuple(Cause(v, ("continue",), 0.5) for v in vehicles), Evidence(),
        6.0, collided_with=hit, verdict="better", terms=(term,), told=(term,),
    )  # fmt: skip
    cause = None if ahead is None else MotionCause("leader", vehicle=ahead)
    return ChoiceReason("why", None, against, ahead=cause)


def of_motion(*vehicles: int | None) -> MotionReason:
    causes = tuple(MotionCause("leader", vehicle=v) for v in vehicles)
    return MotionReason(did("brake", 3.0, 5.0), causes)


@pytest.mark.parametrize(
    ("found", "part", "order"),
    [
        (of_choice(1, 2), "main", [1, 2]),
        (of_choice(2, 1), "part", [1, 2]),
        (of_choice(2, 3), "none", [2, 3]),
        (of_choice(2, ahead=1), "main", [2]),
        (of_choice(1, 2, ahead=2), "part", [1, 2]),
        (of_choice(2, hit=1), "main", [2]),
        (of_choice(1, 2, hit=2), "part", [1, 2]),
        (of_motion(2, None, 1), "part", [1, 2, None]),
        (of_motion(1), "main", [1]),
        (of_motion(), "none", []),
    ],
)
def test_a_suspect_is_told_of_first(found: Any, part: str, order: Any) -> None:
    told_ = with_suspect(found, 1)
    assert isinstance(told_, ChoiceReason | MotionReason)
    causes = told_.contrast.causes if isinstance(told_, ChoiceReason) else told_.causes
    assert (told_.suspect, told_.suspected) == (1, part)
    assert [cause.vehicle for cause in causes] == order
    assert with_suspect(found, None) == found


def test_of_two_suspects_the_one_that_is_more_of_a_cause_is_told() -> None:
    for found, suspect, part in (
        (of_choice(2, 1), 2, "either"),
        (of_choice(3, 1), 1, "either"),
        (of_choice(3), 1, "neither"),
        (of_motion(2, 1), 2, "either"),
        (of_motion(), 1, "neither"),
    ):
        told_ = with_suspect(found, 1, 2)
        assert isinstance(told_, ChoiceReason | MotionReason)
        assert (told_.suspect, told_.suspected) == (suspect, part)
    other = Measures(())
    assert with_suspect(other, 1) == other


def test_where_a_collision_does_not_decide_whom_it_would_be_with_is_no_cause() -> None:
    found = of_choice(2, hit=None)
    assert with_suspect(found, 1).suspected == "none"  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("kind", "vehicles", "part", "besides"),
    [
        ("one", (1,), "alone", ()),
        ("pre-empted", (1, 2), "alone", ()),
        ("both", (1, 2), "beside", (2,)),
        ("either", (2, 1), "beside", (2,)),
        ("several", (1, 2, 5), "beside", (2, 5)),
        ("open", (), "main", ()),
        ("one", (3,), "none", ()),
    ],
)
@pytest.mark.parametrize("choice", [True, False])
def test_who_is_taken_for_the_only_cause_is_held_against_planning_again(
    choice: bool, kind: Any, vehicles: tuple[int, ...], part: str, besides: tuple[int, ...]
) -> None:
    known = vehicles[:1] or (1,)  # the other is told of by planning again alone
    found: Any = of_choice(*known) if choice else of_motion(*known)
    causation = Causation(kind, vehicles)
    if choice:
        found = replace(found, contrast=replace(found.contrast, causation=causation))
    else:
        found = replace(found, causation=causation)
    told_: Any = with_suspect(found, 1, alone=True)
    assert (told_.suspect, told_.suspected, told_.besides) == (1, part, besides)
    plain: Any = with_suspect(found, 1)
    assert plain.suspected in ("main", "part", "none")
    assert plain.besides == ()


def test_a_turn_is_a_reason_beside_the_vehicle_that_is_taken_for_the_only_one() -> None:
    turn = replace(of_motion(1), causation=Causation("one", (1,)))
    turn = replace(turn, causes=(*turn.causes, MotionCause("turn")))
    told_: Any = with_suspect(turn, 1, alone=True)
    assert (told_.suspected, told_.besides) == ("beside", ())


def test_one_that_matters_by_what_it_makes_another_do_is_part_of_it() -> None:
    found = replace(of_motion(2), causation=Causation("both", (2, 1)))
    told_: Any = with_suspect(found, 1)
    assert told_.suspected == "part"


@pytest.mark.parametrize(
    ("kind", "vehicles", "changes", "decides", "part"),
    [
        ("one", (1,), False, False, "same"),
        ("one", (1,), True, True, "main"),
        ("both", (1, 2), False, False, "same"),
        ("both", (1, 2), True, False, "main"),
        ("either", (1, 2), False, True, "main"),
        ("either", (1, 2), False, False, "same"),
    ],
)
def test_one_without_which_the_same_is_done_is_not_the_reason(
    kind: Any, vehicles: Any, changes: bool, decides: bool, part: str
) -> None:
    found = of_choice(1, hit=1)
    causes = (replace(found.contrast.causes[0], decision_changes=changes),)
    causation = Causation(kind, vehicles, decides=decides)
    found = replace(found, contrast=replace(found.contrast, causes=causes, causation=causation))
    told_: Any = with_suspect(found, 1)
    assert told_.suspected == part
    two: Any = with_suspect(found, 1, 7)
    assert two.suspected == "either"


def test_one_of_several_that_are_not_named_is_not_the_only_cause() -> None:
    causation = Causation("several", (1, 2, 5), minimal=False)
    told_: Any = with_suspect(replace(of_motion(1), causation=causation), 1, alone=True)
    assert (told_.suspected, told_.besides) == ("beside", ())


def undecided(*same: int) -> ChoiceReason:
    """A choice because of 1 and 2, which is made without some of them all the same."""
    found = of_choice(1, 2)
    causes = tuple(
        replace(cause, decision_changes=cause.vehicle not in same)
        for cause in found.contrast.causes
    )
    causation = Causation("both", (1, 2))
    return replace(found, contrast=replace(found.contrast, causes=causes, causation=causation))


@pytest.mark.parametrize(
    ("found", "suspects", "which", "suspect", "part", "besides"),
    [
        (of_motion(1, 2), (1, 2), False, 1, "all", (2,)),
        (of_motion(2, 1), (1, 2), False, 2, "all", (1,)),
        (of_motion(1, 2), (1, 3), False, 1, "some", (3,)),
        (of_motion(3), (1, 2), False, 1, "none", (2,)),
        (of_motion(3), (1, 2), True, 1, "neither", (2,)),
        (of_motion(2, 1), (1, 2), True, 2, "all-alike", (1,)),
        (of_motion(2), (1, 2), True, 2, "which", (1,)),
        (of_motion(2, 1), (1, 2, 5), True, 2, "some", (5,)),
        # Which of them decides is asked; where neither does, both are.
        (undecided(), (1, 2), True, 1, "all-alike", (2,)),
        (undecided(1), (1, 2), True, 2, "which", (1,)),
        (undecided(2), (1, 2), True, 1, "which", (2,)),
        (undecided(1, 2), (1, 2), True, 1, "all-alike", (2,)),
        (undecided(1), (1, 2), False, 1, "all", (2,)),
    ],
)
def test_which_of_several_suspects_are_a_reason(
    found: Any, suspects: Any, which: bool, suspect: int, part: str, besides: Any
) -> None:
    told_: Any = with_suspects(found, suspects, which=which)
    assert (told_.suspect, told_.suspected, told_.besides) == (suspect, part, besides)


def test_some_of_a_group_stand_for_all_of_it() -> None:
    told_: Any = with_suspects(of_motion(2, 5), (1, 2), together=True)
    assert (told_.suspect, told_.suspected, told_.besides) == (2, "main", ())
    every: Any = with_suspects(of_motion(2, 1), (1, 2), together=True)
    assert (every.suspected, every.besides) == ("all", (1,))
    none: Any = with_suspects(of_motion(5), (1, 2), together=True)
    assert (none.suspected, none.besides) == ("none", (2,))
    other = Measures(())
    assert with_suspects(other, (1, 2)) == other


@pytest.mark.parametrize(("suspect", "part"), [(1, "either"), (2, "either"), (3, "neither")])
def test_whether_it_is_somebody_or_the_light_is_told_by_the_reason(suspect: int, part: str) -> None:
    told_: Any = or_road(with_suspect(of_motion(1, 2), suspect), ("light",))
    assert told_.suspected == part
    unasked = of_motion(1)
    assert or_road(unasked, ("light",)) == unasked
    assert or_road(Measures(()), ("light",)) == Measures(())
    lit: Any = replace(of_motion(1), causes=(MotionCause("light"),))
    of_lit: Any = or_road(with_suspect(lit, suspect), ("light",))
    assert of_lit.suspected is None


def test_people_on_foot_stand_for_those_who_were_the_reason() -> None:
    found, walkers = of_motion(3, 5), {1, 2, 5}
    assert meant_on_foot(found, (1, 2), walkers) == (5,)
    assert meant_on_foot(found, (5, 1), walkers) == (5, 1)
    assert meant_on_foot(of_motion(3), (1, 2), walkers) == (1, 2)
    assert meant_on_foot(Measures(()), (1, 2), walkers) == (1, 2)
