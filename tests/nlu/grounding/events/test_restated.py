"""Events and states that are taken for what is meant by them, and moments of the ride."""

from typing import Any

import pytest

from planner.record.places import RoadFacts, RoadPlace
from tests.nlu.grounding.acts.test_asked import BRAKED, CARS, FOCUS, Grounded, asked, whether
from tests.nlu.grounding.fakes import FakeWorld, did, talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Ask,
    Changed,
    Fault,
    HowMuch,
    HowSure,
    Listing,
    Whether,
)
from xavi_dialogue.domain.terms import (
    At,
    AtDecision,
    Back,
    Believed,
    Between,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Junction,
    Lane,
    Measured,
    Pronoun,
    Related,
    Relative,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.grounding.acts.restating import restated
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.events.timing import believed_last, believed_then, foreseen
from xavi_dialogue.nlu.grounding.grounder import TermGrounder
from xavi_dialogue.nlu.grounding.things.places import on_roundabout, presence, visit_of, visits

SOME = Described("car", definite=False)
BEHIND_US = Related("behind", Wanted(), Ego())


def coming(**fields: Any) -> Happens:
    return Happens(Event(**{"action": "come", "actor": SOME, "tense": "present", **fields}))


@pytest.mark.parametrize(
    ("spoken", "found"),
    [
        (coming(), Exists(Described("car", definite=False, doing=Event("come", Wanted(),
                                                                         tense="present")))),
        (coming(where=BEHIND_US),
         Exists(Described("car", bearing="behind", definite=False,
                          doing=Event("come", Wanted(), tense="present")))),
        (coming(object=Vehicle(1)), None),
        (coming(side="left"), None),
        (coming(tense="past"), None),
        (coming(modal="can"), None),
        (coming(actor=Vehicle(1), where=BEHIND_US),
         Happens(Event("approach", Vehicle(1), Ego(), tense="present"))),
        (coming(actor=Ego(), where=BEHIND_US), None),
        (coming(actor=Vehicle(1)), None),
        (Happens(Event("move", Vehicle(1), manner=("still",), time=At(3.0))),
         Is("moving", Vehicle(1), time=At(3.0), tense="past")),
        (Happens(Event("go", Vehicle(1), manner=("still",))),
         Is("moving", Vehicle(1), tense="past")),
        (Happens(Event("move", Vehicle(1))), None),
        (Happens(Event("move", manner=("still",))), None),
        (Happens(Event("stop", Vehicle(1), manner=("still",))), None),
    ],
)  # fmt: skip
def test_events_that_say_what_somebody_is(spoken: Happens, found: Any) -> None:
    assert restated(spoken, "asked") == found


def test_that_somebody_comes_is_asked_for_only() -> None:
    assert restated(coming(), "presupposed") is None
    far = coming(actor=Described("car", bearing="left", definite=False), where=BEHIND_US)
    found = restated(far, "asked")
    assert isinstance(found, Exists)
    assert found.thing.bearing == "left"  # type: ignore[union-attr]


BEFORE = Relative("before", Event("brake"))


def test_lists_of_a_moment_are_of_the_moment_that_a_deed_names() -> None:
    options = Grounded(Ask(Listing("options", time=BEFORE)))
    assert options.act.question.time == At(11.8)
    span = options.notes.span
    assert span is not None
    assert (span.begin, span.end) == pytest.approx((11.8, 11.8))
    events = asked(Listing("events", time=BEFORE))
    assert (events.time.begin, events.time.end) == pytest.approx((4.0, 11.8))


def test_what_it_says_of_a_belief_at_a_time_is_of_the_belief() -> None:
    turns = Event("turn", Vehicle(1), tense="present")
    for time in (At(6.0), AtDecision(3), Back("during"), Relative("during", Event("brake"))):
        said = HowSure(Happens(Event("turn", Vehicle(1), tense="present", time=time)))
        to_come = Happens(Event("turn", Vehicle(1), tense="future"))
        assert foreseen(said) == HowSure(to_come, time=time)
    for other in (
        HowSure(Happens(turns)),
        HowSure(Happens(Event("turn", Vehicle(1), time=At(6.0)))),
        HowSure(Happens(Event("turn", Vehicle(1), tense="present", time=BEFORE))),
        HowSure(Is("fast", Ego(), time=At(6.0))),
        HowSure(Happens(Event("turn", Vehicle(1), tense="present", time=At(6.0))), time=At(9.0)),
    ):
        assert foreseen(other) == other


def test_what_was_believed_at_a_time() -> None:
    turns = Happens(Event("turn", Vehicle(1), tense="present", time=At(6.0)))
    to_come = Happens(Event("turn", Vehicle(1), tense="future"))
    assert believed_then(Believed(turns)) == Believed(to_come, At(6.0), "past")
    assert believed_then(Believed(Believed(turns))) == Believed(to_come, At(6.0), "past")
    for other in (Believed(turns, At(3.0)), Believed(BRAKED), Believed(Is("fast", Ego()))):
        assert believed_then(other) == other


def test_that_estimate_is_what_was_believed_of_another() -> None:
    turns = Happens(Event("turn", Vehicle(1), tense="future"))
    known = talk(propositions=(BRAKED, Believed(turns)))
    g = TermGrounder(Context(FakeWorld(), known))
    assert (believed_last(g), g.notes.leaned) == (turns, True)
    for other in (talk(propositions=(Believed(BRAKED),)), Discourse(),
                  talk(propositions=(Believed(turns),), question=HowSure())):  # fmt: skip
        assert believed_last(TermGrounder(Context(FakeWorld(), other))) is None
    assert asked(HowSure(changed=True), known).of == Believed(turns).content
    assert asked(HowSure(), talk(propositions=(BRAKED, Believed(turns)))).of == BRAKED


def test_what_changed_is_between_the_times_that_were_named() -> None:
    assert asked(Changed(time=At(6.0))).time == At(6.0)
    named = asked(Changed(), talk(named=(13.0, 13.0)))
    assert named.time == Between(13.0, 40.0)
    two = asked(Changed(), talk(times=(9.0, 5.0, 1.0)))
    assert two.time == Between(5.0, 9.0)
    assert asked(Changed(), talk(times=(9.0,))) == Changed()


@pytest.mark.parametrize(
    ("spoken", "discourse", "thing", "to"),
    [
        (Related("behind", Pronoun("it"), Described("bus")), talk(Vehicle(2)), Vehicle(2),
         Vehicle(1)),
        (Related("same-as", Pronoun("that"), Described(colour="red"), Back("before")),
         talk(Vehicle(1)), Vehicle(2), Vehicle(2)),
        (Related("same-as", Pronoun("that"), Described("car")), talk(Vehicle(2)), Vehicle(2),
         Described("car")),
        (Related("on", Ego(), Pronoun("it")), talk(question=Whether(Exists(Lane("left")))), Ego(),
         Lane("left")),
        (Related("on", Ego(), Pronoun("it")), talk(Vehicle(2)), Ego(), Vehicle(2)),
        (Related("behind", Ego(), Pronoun("it")), talk(Vehicle(2), question=Whether(
            Exists(Lane("left")))), Ego(), Vehicle(2)),
    ],
)  # fmt: skip
def test_what_is_beside_what(spoken: Related, discourse: Discourse, thing: Any, to: Any) -> None:
    found = whether(spoken, discourse)
    assert found.thing == thing
    if not isinstance(to, Described):
        assert found.to == to


def test_a_state_is_of_the_focus_where_no_time_is_said() -> None:
    was = Is("fast", Ego(), tense="past")
    assert whether(was, FOCUS).time == Between(12.0, 14.0)
    stale = talk(episode=(12.0, 14.0), asked_at=30.0)
    assert whether(was, stale).time == Unsaid()
    named = Grounded(Ask(Whether(was)), talk(named=(5.0, 6.0), episode=(12.0, 14.0)))
    assert named.act.question.that.time == Between(5.0, 6.0)
    assert named.notes.span is not None
    assert named.notes.span.said
    plain = Grounded(Ask(Whether(was)), FOCUS)
    assert plain.notes.span is not None
    assert not plain.notes.span.said
    assert Grounded(Ask(Whether(was))).notes.span is None
    assert whether(Is("fast", Ego(), time=BEFORE, tense="past")).time == At(11.8)


def test_whose_fault_is_asked_of_anything_where_nothing_was_told() -> None:
    found = asked(Fault(suspect=Described("bus")), Discourse(), did("see", 3.0))
    assert found == Fault(suspect=Vehicle(1))


def test_how_far_apart_is_of_whom_was_just_spoken_of() -> None:
    gap = asked(HowMuch(Measured("gap", Described("bus"), Described(colour="red"))))
    assert (gap.of.thing, gap.of.to) == (Vehicle(1), Vehicle(2))


# --- places --------------------------------------------------------------------------------------


def ride(*happened: Any, ring: bool | None = None) -> Context:
    facts = None
    if ring is not None:
        facts = RoadFacts({0: RoadPlace("e", 0, 1, 13.9, False, ring)}, ())
    return Context(FakeWorld(CARS, happened, now=40.0, facts=facts), Discourse())


def at_place(action: Any, begin: float, end: float, time: float | None = None, **more: Any) -> Any:
    return did(action, begin, end, place=Junction(more.pop("form", "junction"), time=time), **more)


@pytest.mark.parametrize(
    ("happened", "stretches"),
    [
        ((), []),
        ((did("brake", 3.0, 4.0),), []),
        ((at_place("turn", 3.0, 5.0), at_place("exit-left", 4.0, 7.0)), [(3.0, 7.0)]),
        ((at_place("turn", 3.0, 5.0), at_place("turn", 9.0, 10.0)), [(3.0, 10.0)]),  # 4 s apart
        ((at_place("turn", 3.0, 5.0), at_place("turn", 9.1, 10.0)), [(3.0, 5.0), (9.1, 10.0)]),
        ((at_place("turn", 3.0, 5.0, 3.0), at_place("turn", 6.0, 7.0, 3.0)), [(3.0, 7.0)]),
        ((at_place("turn", 3.0, 5.0, 3.0), at_place("turn", 6.0, 7.0, 6.0)),
         [(3.0, 5.0), (6.0, 7.0)]),
        ((at_place("turn", 3.0, 5.0, 3.0), at_place("turn", 4.0, 7.0, 4.0)), [(3.0, 7.0)]),
        ((at_place("turn", 3.0, 5.0), at_place("enter", 5.0, 6.0, form="roundabout")),
         [(3.0, 5.0), (5.0, 6.0)]),
        ((at_place("turn", 30.0, 38.0), at_place("stop", 31.0, 33.0)), [(30.0, 38.0)]),
        ((at_place("stop", 35.0, 0.0, going_on=True),), [(35.0, 40.0)]),
    ],
)  # fmt: skip
def test_stretches_at_junctions(happened: Any, stretches: list[tuple[float, float]]) -> None:
    assert [(v.begin, v.end) for v in visits(ride(*happened))] == stretches


def test_a_ring_that_we_are_still_on_lasts_until_now() -> None:
    entered = at_place("enter", 30.0, 31.0, form="roundabout")
    ends = {ring: visits(ride(entered, ring=ring))[-1].end for ring in (True, False, None)}
    assert ends == {True: 40.0, False: 31.0, None: 31.0}
    crossed = at_place("turn", 30.0, 31.0)
    assert visits(ride(crossed, ring=True))[-1].end == 31.0
    assert [on_roundabout(ride(ring=ring), 40.0) for ring in (True, False, None)] == [
        True, False, None
    ]  # fmt: skip
    both = ride(crossed, entered)
    assert [v.junction.form for v in visits(both, "roundabout")] == ["roundabout"]


@pytest.mark.parametrize(
    ("time", "found"), [(None, None), (2.9, 3.0), (5.1, 3.0), (5.2, None), (2.8, None)]
)
def test_the_stretch_at_a_place(time: float | None, found: float | None) -> None:
    visit = visit_of(ride(at_place("turn", 3.0, 5.0)), Junction(time=time))
    assert (visit and visit.begin) == found


@pytest.mark.parametrize(
    ("happened", "found"),
    [
        ((), None),
        ((did("brake", 3.0, 5.0, who=1),), (3.0, 5.0)),
        ((did("brake", 3.0, 5.0, who=1), did("stop", 8.0, 9.0, who=1)), (3.0, 9.0)),
        ((did("stop", 8.0, who=1, going_on=True),), (8.0, 40.0)),
        ((did("brake", 3.0, 5.0, who=1), did("wait", 6.0, 7.0, whom=1)), (6.0, 7.0)),
        ((did("cut-in", 9.0, 10.0, who=1, whom=0), did("wait", 6.0, 7.0, whom=1)), (9.0, 10.0)),
        ((did("wait", 6.0, whom=1, going_on=True),), (6.0, 40.0)),
        ((did("wait", 6.0, 7.0, whom=2),), None),
    ],
)
def test_when_a_vehicle_was_near(happened: Any, found: Any) -> None:
    assert presence(ride(*happened), Vehicle(1)) == found
