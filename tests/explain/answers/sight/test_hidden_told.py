"""What we cannot see past, and who might come from there: by decisions made by hand.

A bus, 1, hides a road on the left, and a building one on the right; we drive north.
"""

import math
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.hidden_record import HeldByHidden, Phantom
from planner.record.trace import PlanTrace
from tests.explain.answers.given import NOW, Given, look, plan, refused
from tests.explain.answers.imagined import Drive, decided
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.hidden_areas import Hider, SightTold, SupposedSeeing
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    HowKnow,
    HowSure,
    Listing,
    WhatIf,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Believed,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Nobody,
    Not,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.explain.answers.sight.hidden_areas import explainer

BUS, OTHER, HOUSE, BLIND = Vehicle(1), Vehicle(2), Feature("building"), Feature("blind")
TALL = look(1, kind="bus", ahead=12.0)
BY_BUS, BY_HOUSE = Hider(1, "left", 0.2), Hider(None, "right", 0.5)


def phantom(behind: int | None, probability: float, heading: float, **more: Any) -> Phantom:
    return Phantom(
        ("side_0",), 0.0, 20.0, (10.0, 10.0), heading, 12.0, 10.0, 30.0, 0.1, probability, "J", 1,
        (0,), (4.0,), behind, **more,
    )  # fmt: skip


def hiding(
    time: float, *phantoms: Phantom, held: tuple[int, ...] = (), under_way: Any = None
) -> PlanTrace:
    """A decision with hidden parts of the road, some of which make us slower."""
    made = decided(("continue",), Drive(1.0, (10.0,) * 11))
    slow = tuple(HeldByHidden(k, False, time, time + 2.0) for k in held)
    rows = tuple(replace(row, held_by_hidden=slow) for row in made.rollouts)
    return replace(
        made, sim_time=time, phantoms=phantoms, rollouts=rows, under_way=under_way,
        decision=int(time),
    )  # fmt: skip


#: From the right somebody heads west, from the left east; we head east, so these are turned.
FROM_LEFT = phantom(1, 0.2, -math.pi / 2.0)
FROM_RIGHT = phantom(None, 0.5, math.pi / 2.0)
BOTH = hiding(NOW, FROM_LEFT, FROM_RIGHT)


def told(question: Any, *traces: PlanTrace, span: Span | None = None, **more: Any) -> Any:
    """The answer to a question; None if it is not one about hidden parts."""
    given = Given(**({"looks": {1: TALL}, "traces": traces or (BOTH,)} | more))
    asked, act = given.asked(span), Ask(question)
    explain = explainer(act, asked)
    return None if explain is None else explain(act, asked)


def sees_past(thing: Any, **more: Any) -> Related:
    return Related("sees-past", Ego(), thing, **more)


@pytest.mark.parametrize(
    ("about", "hiders"),
    [(BUS, (BY_BUS,)), (HOUSE, (BY_HOUSE,)), (BLIND, (BY_HOUSE, BY_BUS))],
)
def test_whether_we_see_past_something_is_told_with_its_side(about: Any, hiders: Any) -> None:
    assert told(Whether(sees_past(about))) == SightTold("past", hiders)
    assert told(Whether(Not(sees_past(about)))) == SightTold("past", hiders)


def test_a_car_hides_nothing_and_a_bus_who_drives_behind_it() -> None:
    car = told(Whether(sees_past(OTHER)), looks={2: look(2, kind="car")})
    assert car == SightTold("past", ())
    for kind in ("bus", "truck", "van", "tram"):
        tall = told(Whether(sees_past(OTHER)), looks={2: look(2, kind=kind)})
        assert tall == SightTold("past", (Hider(2, "ahead", None),))
    lost = told(Whether(sees_past(OTHER)), looks={2: look(2, kind="bus", in_view=False)})
    assert lost == SightTold("past", ())
    was = told(Whether(sees_past(OTHER, tense="past")), looks={2: look(2, kind="bus")})
    assert was == SightTold("past", (), past=True)


def test_what_we_cannot_see_is_all_that_is_hidden() -> None:
    assert told(Listing("hidden")) == SightTold("what", (BY_HOUSE, BY_BUS))
    assert told(Whether(Exists(BLIND))) == SightTold("past", (BY_HOUSE, BY_BUS))
    assert told(Listing("hidden"), plan(NOW, "continue")) == SightTold("what", ())
    assert told(Listing("vehicles")) is None


def test_two_on_the_same_side_may_either_be_there() -> None:
    three = hiding(NOW, FROM_LEFT, FROM_RIGHT, phantom(1, 0.5, -math.pi / 2.0))
    found = told(Whether(sees_past(BUS)), three)
    assert found.hiders == (Hider(1, "left", 0.6),)  # 1 - 0.8 x 0.5


def test_what_hides_a_place_too_is_named_where_it_is_asked_about() -> None:
    shared = hiding(NOW, phantom(1, 0.3, math.pi / 2.0, beyond=(2,), walled=True))
    for about, hider in ((BUS, 1), (OTHER, 2), (HOUSE, None)):
        found = told(Whether(sees_past(about)), shared)
        assert found.hiders == (Hider(hider, "right", 0.3),)


@pytest.mark.parametrize("where", [BUS, HOUSE, BLIND])
@pytest.mark.parametrize(
    ("form", "asked"),
    [
        (lambda x: Whether(Related("behind", Nobody(), x)), "there"),
        (lambda x: Whether(Exists(Nobody(Described(bearing="behind", of=x)))), "there"),
        (lambda x: Whether(Related("from", Everyone(), x)), "chance"),
        (lambda x: Whether(Happens(Event("come", Nobody(), x, modal="could", tense="present"))),
         "chance"),
        (lambda x: HowSure(Happens(Event("come", Nobody(), x, tense="future"))), "chance"),
        (lambda x: HowSure(Related("behind", Nobody(), x)), "there"),
        (lambda x: Whether(Believed(Happens(Event("pull-out", Nobody(), x, tense="future")))),
         "chance"),
        (lambda x: Whether(Happens(Event("go", Nobody(), where=Related("behind", Nobody(), x),
                                         tense="present", modal="could"))), "chance"),
        (lambda x: HowKnow(Related("behind", Nobody(), x)), "known"),
        (lambda x: WhatIf(Happens(Event("come", Nobody(), x, tense="present"))), "if"),
    ],
)  # fmt: skip
def test_who_may_be_there_or_come_is_told_of_what_hides_him(
    form: Any, asked: str, where: Any
) -> None:
    hiders = {BUS: (BY_BUS,), HOUSE: (BY_HOUSE,), BLIND: (BY_HOUSE, BY_BUS)}[where]
    found = told(form(where))
    assert isinstance(found, SightTold)
    assert (found.asked, found.hiders) == (asked, hiders)


@pytest.mark.parametrize(
    "question",
    [
        Whether(Happens(Event("come", OTHER, BUS, tense="present"))),
        Whether(Happens(Event("brake", Nobody(), BUS, tense="present"))),
        Whether(Related("behind", OTHER, BUS)),
        Whether(Related("beside", Nobody(), BUS)),
        Whether(Related("behind", Nobody(), Ego())),
        WhatIf(Related("behind", Nobody(), BUS)),
        WhatIf(Not(Happens(Event("come", Nobody(), BUS, tense="present")))),
        Whether(Exists(Nobody(Described(bearing="ahead", of=OTHER)))),
        Why(Exists(BUS)),
    ],
)
def test_other_questions_are_answered_elsewhere(question: Any) -> None:
    assert told(question, looks={1: look(1, ahead=12.0)}) is None
    asked = Given(traces=(BOTH,)).asked()
    assert explainer(Claim(Exists(BLIND)), asked) is None


def test_where_nothing_is_hidden_a_bus_alone_may_cover_somebody() -> None:
    free = plan(NOW, "continue")
    behind = Whether(Related("behind", Nobody(), BUS))
    covered = told(behind, free)
    assert covered == SightTold("there", (Hider(1, "ahead", None),))
    assert told(behind, free, looks={1: look(1)}) is None
    assert told(HowKnow(Related("behind", Nobody(), BUS)), free) is None


def test_who_is_behind_a_vehicle_is_somebody_seen_or_nobody_known() -> None:
    which = Which(Wanted(), Related("behind", Wanted(), BUS))
    assert told(which) == SightTold("there", (BY_BUS,))
    there = {("behind", OTHER, BUS): True}
    looks = {1: TALL, 2: look(2)}
    assert told(which, looks=looks, relations=there) is None
    assert told(which, looks=looks) == SightTold("there", (BY_BUS,))
    past = Which(Wanted(), Related("behind", Wanted(), BUS, tense="past"))
    assert told(past) is None
    free = plan(NOW, "continue")
    assert told(which, free) == SightTold("there", (Hider(1, "ahead", None),))
    assert told(which, free, looks={1: look(1)}) is None


@pytest.mark.parametrize(
    ("looks", "beyond"),
    [
        ({1: TALL}, True),
        ({1: TALL, 2: look(2, ahead=30.0)}, False),
        ({1: TALL, 2: look(2, ahead=30.0, left=2.0)}, False),
        ({1: TALL, 2: look(2, ahead=30.0, left=2.1)}, True),
        ({1: TALL, 2: look(2, ahead=5.0)}, True),
        ({1: replace(TALL, kind="car")}, False),
        ({1: replace(TALL, ahead=-5.0)}, False),
        ({1: replace(TALL, oncoming=True)}, False),
        ({}, False),
    ],
)
def test_who_drives_ahead_of_a_bus_is_not_known(looks: Any, beyond: bool) -> None:
    expected = SightTold("beyond", (Hider(1, "ahead", None),)) if beyond else None
    for question in (
        Which(Wanted(), Related("ahead-of", Wanted(), BUS)),
        Whether(Exists(Nobody(Described(bearing="ahead", of=BUS)))),
        HowKnow(Related("ahead-of", Nobody(), BUS)),
        HowKnow(Exists(Nobody(Described(bearing="ahead", of=BUS)))),
    ):
        assert told(question, plan(NOW, "continue"), looks=looks) == expected


def test_what_was_hidden_is_told_of_the_first_decision_that_it_made_slower() -> None:
    early, slow = hiding(12.0, FROM_LEFT), hiding(13.0, FROM_LEFT, held=(0,))
    last = hiding(14.0, replace(FROM_LEFT, probability=0.4))
    was = Whether(sees_past(BUS, tense="past"))
    assert told(was, early, slow, last) == SightTold("past", (BY_BUS,), True, True)
    # It is no longer hidden now.
    assert told(Whether(sees_past(BUS)), early, slow, looks={}) == SightTold("past", ())
    assert told(was, last).hiders == (Hider(1, "left", 0.4),)
    assert not told(was, early, last).slowed
    now = replace(slow, sim_time=19.0)
    present = told(Whether(sees_past(BUS)), now)
    assert (present.past, present.slowed) == (False, True)


def test_whether_somebody_came_is_told_unless_somebody_did() -> None:
    came = Whether(Happens(Event("come", Nobody(), BUS)))
    before = hiding(12.0, FROM_LEFT)
    known = replace(plan(9.0, "continue"), scene=dict.fromkeys((0, 1), before.scene[0]))
    assert told(came, known, before) == SightTold("came", (BY_BUS,), past=True)
    for time, comes in ((9.0, False), (12.0, True), (14.0, True)):
        new = replace(plan(time, "continue"), scene=dict.fromkeys((0, 1, 2), before.scene[0]))
        rows = sorted((known, before, new), key=lambda t: t.sim_time)
        found = told(came, *rows, looks={1: TALL, 2: look(2)})
        assert (found is None) is comes


def test_seeing_past_it_is_supposed_of_what_it_hides() -> None:
    free = plan(NOW, "continue")
    assert told(WhatIf(sees_past(OTHER)), free) == SupposedSeeing((), NOW, (), (), 0.0)
    # A building hides it as well, so that nothing would change.
    walled = replace(FROM_LEFT, walled=True)
    same: Any = (("continue",), ("continue",), 0.0)
    found = told(WhatIf(sees_past(BUS)), hiding(NOW, walled))
    assert found == SupposedSeeing((BY_BUS,), NOW, *same)
    lately = told(WhatIf(sees_past(BUS)), hiding(NOW - 1.5, walled))
    assert not lately.past
    over = told(WhatIf(sees_past(BUS)), hiding(NOW - 1.6, walled))
    assert over == SupposedSeeing((BY_BUS,), NOW - 1.6, *same, True)
    was = told(WhatIf(sees_past(BUS, tense="past")), hiding(NOW, walled))
    assert was.past
    assert told(WhatIf(Not(sees_past(BUS))), BOTH) is None


@pytest.mark.parametrize(
    ("supposed", "seen"),
    [
        (sees_past(BUS), (0,)),
        (sees_past(HOUSE), (1,)),
        (Not(Exists(HOUSE)), (1,)),
        (sees_past(BLIND), (0, 1)),
        (Not(Exists(BLIND)), (0, 1)),
    ],
)
def test_it_is_planned_again_as_if_nobody_were_where_we_then_see(
    supposed: Any, seen: tuple[int, ...]
) -> None:
    asked = Given(traces=(BOTH,)).asked()
    act = Ask(WhatIf(supposed))
    explain = explainer(act, asked)
    assert explain is not None
    assert refused(explain, act, asked) == NeedRollout(trace_id=BOTH.trace_id, seen_past=seen)
