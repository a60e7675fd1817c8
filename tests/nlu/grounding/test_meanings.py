"""What an act is taken for where the situation decides: windows, generic verbs, conditions."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from tests.nlu.grounding.fakes import Car, FakeWorld, did, talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Doing,
    HowMany,
    HowMuch,
    Listing,
    Summarise,
    When,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    Back,
    Between,
    Both,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Junction,
    Measured,
    Next,
    Not,
    Now,
    Passenger,
    Pronoun,
    Rank,
    Related,
    Relative,
    Start,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
    Within,
)
from xavi_dialogue.nlu.grounding.acts.trips import of_trip
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.events.generic import come_along, in_order, specified
from xavi_dialogue.nlu.grounding.events.windows import pointed, unsaid, window
from xavi_dialogue.nlu.grounding.grounder import TermGrounder
from xavi_dialogue.nlu.grounding.things.such import UNTOLD, condition_of

RIDE = FakeWorld(
    {1: Car(20.0, colour="red", speed=8.0), 2: Car(-10.0, colour="blue", seen=(0.0, 30.0))},
    (
        did("slow-down", 10.0, 14.0),
        did("change-left", 22.0, 24.0),
        did("slow-down", 30.0, 33.0),
        did("pass", 34.0, 36.0, who=1, whom=0),
    ),
    now=40.0,
)
SLOW = Event("slow-down", tense="past")


def grounder(world: FakeWorld = RIDE, discourse: Discourse | None = None) -> TermGrounder:
    return TermGrounder(Context(world, discourse or Discourse()))


# --- The part of the ride that is meant -----------------------------------------------------------


@pytest.mark.parametrize(
    ("time", "begin", "end", "term", "search"),
    [
        (Now(), 40.0, 40.0, Now(), (37.0, 40.0)),
        (At(12.0), 12.0, 12.0, At(12.0), (9.5, 14.5)),
        (Ago(), 35.0, 40.0, Between(35.0, 40.0), (35.0, 40.0)),
        (Ago(10.0), 30.0, 30.0, At(30.0), (27.5, 32.5)),
        (Ago(10.0, span=True), 30.0, 40.0, Between(30.0, 40.0), (30.0, 40.0)),
        (Ago(60.0, span=True), 0.0, 40.0, Between(0.0, 40.0), (0.0, 40.0)),
        (Between(20.0, 12.0), 12.0, 20.0, Between(12.0, 20.0), (12.0, 20.0)),
        (Between(35.0, 50.0), 35.0, 40.0, Between(35.0, 40.0), (35.0, 40.0)),
        (Between(45.0, 50.0), 45.0, 50.0, Between(45.0, 50.0), (45.0, 50.0)),
        (Within(5.0), 40.0, 45.0, Within(5.0), (40.0, 45.0)),
        (Within(), 40.0, 55.0, Next(), (40.0, 55.0)),
        (Next(), 40.0, 55.0, Next(), (40.0, 55.0)),
        (Start(), 0.0, 8.0, Between(0.0, 8.0), (0.0, 8.0)),
        (WholeRide(), 0.0, 40.0, WholeRide(), (0.0, 40.0)),
        (Rank(2), 0.0, 40.0, WholeRide(), (0.0, 40.0)),
        (Relative("before", SLOW), 22.0, 29.8, Between(22.0, 29.8), (0.0, 29.75)),
        (Relative("after", SLOW), 33.0, 40.0, Between(33.0, 40.0), (33.05, 40.0)),
        (Relative("during", SLOW), 30.0, 33.0, Between(30.0, 33.0), (27.5, 35.5)),
        (Relative("until", SLOW), 0.0, 30.0, Between(0.0, 30.0), (0.0, 30.0)),
        (Relative("since", SLOW), 33.0, 40.0, Between(33.0, 40.0), (33.0, 40.0)),
        (Relative("during", SLOW, rank=1), 10.0, 14.0, Between(10.0, 14.0), (7.5, 16.5)),
        (Relative("during", SLOW, rank=-2), 10.0, 14.0, Between(10.0, 14.0), (7.5, 16.5)),
        (Relative("before", SLOW, rank=1), 2.0, 9.8, Between(2.0, 9.8), (0.0, 9.75)),
        (Relative("before", Destination()), 40.0, 55.0, Next(), (40.0, 55.0)),
        (Relative("after", Event("honk", tense="past")), 0.0, 40.0, Unsaid(), (0.0, 40.0)),
    ],
)  # fmt: skip
def test_a_time_names_a_part_of_the_ride(
    time: Any, begin: float, end: float, term: Any, search: tuple[float, float]
) -> None:
    found = window(time, "past", grounder())
    assert (found.begin, found.end) == pytest.approx((begin, end))
    assert type(found.term) is type(term)
    if isinstance(term, Between):
        assert (found.term.begin, found.term.end) == pytest.approx((term.begin, term.end))
    else:
        assert found.term == term
    assert found.search == pytest.approx(search)


@pytest.mark.parametrize(
    ("time", "ahead", "said", "whole", "prefer"),
    [
        (Now(), False, True, False, "last"),
        (At(12.0), False, True, False, "nearest"),
        (At(40.4), False, True, False, "nearest"),
        (At(41.0), True, True, False, "nearest"),
        (Ago(10.0, span=True), False, True, True, "last"),
        (Ago(), False, True, False, "last"),
        (Between(12.0, 20.0), False, True, True, "last"),
        (Between(45.0, 50.0), True, True, True, "last"),
        (Within(5.0), True, True, False, "last"),
        (Next(), True, True, False, "last"),
        (Start(), False, True, False, "first"),
        (WholeRide(), False, True, True, "last"),
        (Relative("after", SLOW), False, True, False, "first"),
        (Relative("before", SLOW), False, True, False, "last"),
        (Unsaid(), False, False, False, "last"),
    ],
)
def test_what_a_time_says_of_events(
    time: Any, ahead: bool, said: bool, whole: bool, prefer: str
) -> None:
    found = window(time, "past", grounder())
    assert (found.ahead, found.said, found.whole, found.prefer) == (ahead, said, whole, prefer)


def test_a_tense_alone_names_a_part_of_the_ride() -> None:
    context = grounder().context
    spans = {tense: unsaid(tense, context) for tense in ("past", "present", "perfect", "future")}
    assert [(w.begin, w.end, w.ahead, w.said) for w in spans.values()] == [
        (0.0, 40.0, False, False),
        (40.0, 40.0, False, False),
        (0.0, 40.0, False, False),
        (40.0, 55.0, True, False),
    ]
    assert spans["present"].search == (37.0, 40.0)


def test_a_time_by_what_never_was_is_noted_as_such() -> None:
    g = grounder()
    window(Relative("after", Event("honk", tense="past")), "past", g)
    assert g.notes.cost >= 0.6
    assert not g.notes.presupposed
    again = grounder()
    window(Relative("after", SLOW), "past", again)
    assert again.notes.cost == 0.0
    assert again.notes.presupposed


@pytest.mark.parametrize(
    ("time", "at"),
    [
        (Relative("before", SLOW), 29.8),
        (Relative("after", SLOW), 33.0),
        (Relative("during", SLOW), 30.0),
        (Relative("during", Event("pass", Vehicle(1), Ego(), tense="past")), 35.0),
    ],
)
def test_a_deed_that_names_a_time_points_to_a_moment(time: Relative, at: float) -> None:
    found = pointed(time, window(time, "past", grounder()))
    assert (found.begin, found.end) == pytest.approx((at, at))
    assert isinstance(found.term, At)


def test_back_then_is_what_was_spoken_of_or_the_latest_thing_of_note() -> None:
    spoken = grounder(discourse=talk(episode=(10.0, 14.0), asked_at=39.0))
    assert window(Back("during"), "past", spoken).span.begin == 10.0
    assert window(Back("after"), "past", spoken).begin == 14.0
    assert spoken.notes.leaned
    long_ago = grounder(discourse=talk(episode=(10.0, 14.0), asked_at=33.0))
    assert window(Back("during"), "past", long_ago).begin == 30.0
    assert window(Back("before"), "past", long_ago).term == Unsaid()


# --- What a generic verb means in the situation ---------------------------------------------------


RING = Junction("roundabout")
ONWARD = Event("continue-next-exit", Vehicle(1))
COMES = Event("come", Vehicle(2), tense="present")


def lanes(own: int = 0, ring: tuple[int, ...] = (), far: float = 200.0, **more: Any) -> RoadFacts:
    """Two lanes, with us in one of them, and somebody on a roundabout."""
    places = {0: RoadPlace("e", own, 2, 13.9, False, False)}
    places |= {v: RoadPlace("r", None, 1, 8.0, v != 0, True) for v in ring}
    step = RouteStep(far, more.get("kind", "roundabout"), "exit-straight", 2, 3, 4, "give-way")
    return RoadFacts(places=places, route=(step,))


def specify(event: Event, facts: RoadFacts | None = None, **cars: Any) -> Event:
    world = replace_world(facts, **cars)
    g = grounder(world)
    return specified(event, window(event.time, event.tense, g), g)


def replace_world(facts: RoadFacts | None, **more: Any) -> FakeWorld:
    happened = more.get("happened", RIDE.happened)
    return FakeWorld(more.get("cars", RIDE.cars), happened, 40.0, facts=facts)


@pytest.mark.parametrize(
    ("event", "facts", "meant"),
    [
        (Event("head"), None, Event("go")),
        (Event("go", object=RING), None, Event("enter", object=RING)),
        (Event("enter"), lanes(far=80.0), Event("enter", object=RING)),
        (Event("enter"), lanes(ring=(0,)), Event("enter", object=RING)),
        (Event("enter"), lanes(far=81.0), Event("change-left")),
        (Event("enter"), lanes(own=1, far=81.0), Event("change-right")),
        (Event("enter", Vehicle(1)), lanes(), Event("cut-in", Vehicle(1), Ego())),
        (Event("enter"), lanes(far=40.0, kind="junction"), Event("enter")),
        (Event("enter"), None, Event("enter")),
        (Event("pull-out", Vehicle(1)), lanes(ring=(1,)), Event("leave", Vehicle(1), RING)),
        (Event("pull-out", Vehicle(1)), lanes(), Event("pull-out", Vehicle(1))),
        (Event("pull-out", tense="past"), lanes(), Event("change-left", tense="past")),
        (Event("pull-out", tense="present"), None, Event("leave", tense="present")),
        (Event("pull-out", tense="past"), None, Event("pull-out", tense="past")),
        (Event("continue-next-exit"), lanes(ring=(0,)), Event("continue-next-exit")),
        (Event("continue-next-exit"), lanes(far=80.0), Event("continue-next-exit")),
        (ONWARD, lanes(ring=(1,)), ONWARD),
        (Event("continue-next-exit"), lanes(), Event("move")),
        (COMES, None, COMES),
    ],
)  # fmt: skip
def test_a_generic_verb_is_what_the_road_makes_of_it(
    event: Event, facts: RoadFacts | None, meant: Event
) -> None:
    assert specify(event, facts) == meant


@pytest.mark.parametrize(
    ("car", "action"),
    [
        (Car(10.0, 3.5), "change-lane"),
        (Car(-10.0, -3.5), "change-lane"),
        (Car(10.0, 1.9), "come"),  # in our own lane
        (Car(10.0, 2.0), "change-lane"),
        (Car(30.0, 3.5), "come"),  # too far
        (Car(10.0, 3.5, speed=0.9), "come"),  # it stands
        (Car(10.0, 3.5, speed=1.0), "change-lane"),
        (Car(10.0, 3.5, oncoming=True), "come"),
        (Car(10.0, 3.5, crossing=True), "cross"),  # our way
        (Car(10.0, 3.5, seen=(0.0, 39.0)), "come"),  # out of view
    ],
)
def test_who_drives_beside_us_comes_over(car: Car, action: str) -> None:
    event = Event("come", Vehicle(1), Ego(), tense="present")
    assert specify(event, None, cars={1: car}).action == action


@pytest.mark.parametrize(
    ("event", "cars", "signal", "action"),
    [
        (Event("pull-out", Vehicle(1), tense="present"), Car(20.0), True, "exit-right"),
        (Event("pull-out", Vehicle(1), tense="future"), Car(20.0), True, "exit-right"),
        (Event("pull-out", Vehicle(1), tense="past"), Car(20.0), True, "pull-out"),
        (Event("pull-out", Vehicle(1), tense="present"), Car(20.0), False, "pull-out"),
        (Event("pull-out", Vehicle(1), tense="present"), Car(20.0, speed=0.5), True, "pull-out"),
        (Event("pull-out", Vehicle(1), Ego(), tense="present"), Car(20.0), True, "pull-out"),
    ],
)
def test_who_signals_right_goes_off_to_the_right(
    event: Event, cars: Car, signal: bool, action: str
) -> None:
    signals = (did("signal", 38.0, 40.0, who=1, side="right"),) if signal else ()
    found = specify(event, lanes(), cars={1: cars}, happened=signals)
    assert found.action == action


def test_going_after_somebody_is_having_let_him_go() -> None:
    after = Event("let-go", Ego(), Vehicle(1), tense="present")
    gave = (did("give-way", 35.0, 38.0, whom=1),)
    assert specify(after, None, happened=gave).tense == "perfect"
    assert specify(after, None, happened=(did("give-way", 20.0, 33.0, whom=1),)).tense == "present"
    going_on = (did("give-way", 35.0, whom=1, going_on=True),)
    assert specify(after, None, happened=going_on).tense == "present"
    past = replace(after, tense="past")
    assert specify(past, None, happened=gave) == past


@pytest.mark.parametrize(
    ("event", "meant"),
    [
        (
            Event("go", manner=("first",), tense="present"),
            Related("has-priority-over", Ego(), Everyone(), Unsaid(), "present"),
        ),
        (
            Event("go", Vehicle(1), manner=("first",), tense="present"),
            Related("has-priority-over", Vehicle(1), Ego(), Unsaid(), "present"),
        ),
        (
            Event("enter", Ego(), Vehicle(1), manner=("first",), tense="present"),
            Related("has-priority-over", Ego(), Vehicle(1), Unsaid(), "present"),
        ),
        (
            Event("go", manner=("first",), tense="past"),
            Not(Happens(Event("give-way", tense="past")), lexical=True),
        ),
        (
            Event("go", Vehicle(1), manner=("first",), tense="past"),
            Happens(Event("go", Vehicle(1), manner=("first",), tense="past")),
        ),
        (
            Event("go", manner=("first",), modal="could"),
            Happens(Event("go", manner=("first",), modal="could")),
        ),
        (Event("go", tense="present"), Happens(Event("go", tense="present"))),
        (
            Event("cross", Vehicle(1), Feature("way")),
            Happens(Event("cross", Vehicle(1), Ego())),
        ),
        (
            Event("leave", Vehicle(1), Feature("way"), tense="past"),
            Not(Related("in-the-way-of", Vehicle(1), Ego(), Unsaid(), "past"), lexical=True),
        ),
        (
            Event("go", where=Related("beside", Ego(), Vehicle(1)), tense="past"),
            Is("close", Vehicle(1), time=Unsaid(), tense="past"),
        ),
        (
            Event("go", Vehicle(1), where=Related("oncoming-to", Vehicle(1), Ego()), tense="past"),
            Not(Related("with", Vehicle(1), Ego(), Now()), lexical=True),
        ),
    ],
)
def test_going_first_is_right_of_way_or_how_it_came_about(event: Event, meant: Any) -> None:
    assert in_order(Happens(event), "asked") == meant


def test_what_is_told_of_going_first_is_left_as_it_is() -> None:
    spoken = Happens(Event("go", manner=("first",), tense="present"))
    assert in_order(spoken, "presupposed") == spoken


def test_who_came_with_us_is_with_us_now() -> None:
    spoken = Related("with", Vehicle(1), Ego(), tense="past")
    assert come_along(spoken) == Related("with", Vehicle(1), Ego(), Now(), "perfect")
    assert come_along(replace(spoken, tense="present")).tense == "present"
    assert come_along(replace(spoken, time=At(3.0))) == replace(spoken, time=At(3.0))
    beside = replace(spoken, relation="beside")
    assert come_along(beside) == beside


# --- Questions of the ride and of our way ---------------------------------------------------------

DELAYED = Which(Wanted(), Happens(Event("block", Wanted(), Ego(), time=WholeRide())))
FIRST = Event("go", Wanted(), Ego(), manner=("first",), tense="present")
BRAKES = Event("brake", Wanted(), tense="past")


@pytest.mark.parametrize(
    ("spoken", "meant"),
    [
        (Why(Is("late", Ego())), DELAYED),
        (Why(Is("late", Passenger())), DELAYED),
        (Why(Is("late", Vehicle(1))), None),
        (
            Which(Wanted(), Happens(Event("go", Wanted(), Ego(), manner=("first",), tense="past"))),
            DELAYED,
        ),
        (
            Which(Wanted(), Happens(FIRST)),
            None,
        ),
        (When(Compares(Measured("delay"), "more", Measured("delay"))), HowMuch(Measured("delay"))),
        (When(Compares(Measured("speed"), "more", Measured("speed"))), None),
        (
            Whether(Happens(Event("go", where=Related("right-of", Junction(), Ego())))),
            Whether(Happens(Event("exit-right"))),
        ),
        (
            Whether(Happens(Event("turn", where=Related("left-of", Junction(), Ego())))),
            Whether(Happens(Event("exit-left"))),
        ),
        (Whether(Happens(Event("stop", where=Related("left-of", Junction(), Ego())))), None),
        (Whether(Happens(Event("go", where=Related("behind", Junction(), Ego())))), None),
        (Whether(Happens(Event("head"))), HowMuch(Measured("turn"))),
        (Whether(Not(Happens(Event("head")))), HowMuch(Measured("turn"))),
        (
            Whether(Related("same-as", Junction(), Described(kind="vehicle"))),
            Whether(Related("same-as", Junction(), Junction(rank=1))),
        ),
        (
            Whether(Compares(Measured("occupant"), "same", Measured("occupant"))),
            HowMuch(Measured("occupant")),
        ),
        (Whether(Is("over", Ego())), Whether(Happens(Event("arrive", tense="perfect")))),
        (Whether(Is("over", Described(doing=Event("come")))), Doing(tense="future")),
        (
            Whether(Happens(Event("come", Junction("roundabout")))),
            Whether(Exists(Junction("roundabout"))),
        ),
        (Whether(Happens(Event("happen", tense="future"))), Doing(tense="future")),
        (Whether(Happens(Event("happen", tense="past"))), None),
        (Whether(Happens(Event("stop"))), None),
        (
            Summarise(Event("brake", time=At(3.0))),
            Listing("events", time=WholeRide(), event=Event("brake")),
        ),
        (
            Summarise(Event("stop"), At(3.0)),
            Listing("events", time=At(3.0), event=Event("stop")),
        ),
        (Summarise(Event("turn")), None),
        (
            Summarise(Described(doing=BRAKES), WholeRide()),
            Listing("events", time=WholeRide(), event=BRAKES),
        ),
        (
            Listing("vehicles", Described(doing=BRAKES), WholeRide()),
            Listing("events", time=WholeRide(), event=BRAKES),
        ),
        (
            HowMany(Event("overtake", Ego(), Wanted())),
            Listing("events", time=WholeRide(), event=Event("overtake", Ego())),
        ),
        (HowMany(Event("overtake", Ego(), Vehicle(1))), None),
        (
            When(Happens(Event("overtake", Ego(), Wanted(), time=Start()))),
            Listing("events", time=Start(), event=Event("overtake", Ego())),
        ),
    ],
)  # fmt: skip
def test_a_question_of_the_ride_is_put_as_it_is_meant(spoken: Any, meant: Any) -> None:
    assert of_trip(spoken) == meant


MET = Event("approach", Ego(), Wanted(), tense="past")
SEEN = Related("can-see", Ego(), Wanted(), tense="past")


@pytest.mark.parametrize(
    ("spoken", "meant"),
    [
        (Which(Described("bus"), Happens(MET)), Listing("vehicles", Everyone("bus"), WholeRide())),
        (Which(Described(), SEEN), Listing("vehicles", Everyone(), WholeRide())),
        (
            HowMany(Described("bicycle", doing=replace(MET, time=Start()))),
            Listing("vehicles", Everyone("bicycle"), Start()),
        ),
        (HowMany(Described(such=SEEN)), Listing("vehicles", Everyone(), WholeRide())),
        (HowMany(Described(colour="red", such=SEEN)), None),
        (HowMany(Described(such=replace(SEEN, tense="present"))), None),
        (
            When(Happens(Event("give-way", Ego(), Described(definite=False)))),
            When(Happens(Event("give-way", Ego()))),
        ),
    ],
)
def test_whom_we_met_is_listed_and_anybody_is_left_open(spoken: Any, meant: Any) -> None:
    assert of_trip(spoken) == meant


def test_whom_we_waited_for_is_whom_we_let_go() -> None:
    waited = Event("wait", Ego(), Wanted(), tense="past")
    found = of_trip(HowMany(Described(doing=waited)))
    assert found == HowMany(Described(doing=replace(waited, action="give-way")))
    assert of_trip(HowMany(Described(doing=replace(waited, tense="future")))) is None


# --- Conditions on the vehicle that is looked for -------------------------------------------------

NEAR, LONG = Car(20.0, speed=8.0), Car(60.0, kind="truck", colour="red", speed=0.2)
GONE = Car(-10.0, speed=8.0, seen=(0.0, 30.0))
THREE = FakeWorld({1: NEAR, 2: LONG, 3: GONE}, (did("brake", 5.0, 6.0, who=1),), now=40.0)


@pytest.mark.parametrize(
    ("such", "costs"),
    [
        (Is("stationary", Wanted()), (1.0, 0.0, 1.0)),
        (Is("moving", Wanted()), (0.0, 1.0, 0.0)),
        (Is("visible", Wanted()), (0.0, 0.0, 1.0)),
        (Is("hidden", Wanted()), (1.0, 1.0, 0.0)),
        (Is("big", Wanted()), (1.0, 0.0, 1.0)),
        (Is("close", Wanted()), (0.0, 1.0, 0.0)),
        (Is("far", Wanted()), (1.0, 0.0, 1.0)),
        (Is("dangerous", Wanted()), (UNTOLD, UNTOLD, UNTOLD)),
        (Not(Is("close", Wanted())), (1.0, 0.0, 1.0)),
        (Not(Is("dangerous", Wanted())), (UNTOLD, UNTOLD, UNTOLD)),
        (Has("colour", "red", Wanted()), (1.0, 0.0, 1.0)),
        (Has("kind", "truck", Wanted()), (1.0, 0.0, 1.0)),
        (Has("speed", "fast", Wanted()), (UNTOLD, UNTOLD, UNTOLD)),
        (Exists(Wanted()), (0.0, 0.0, 1.0)),
        (Happens(Event("brake", Wanted(), tense="past")), (0.0, 1.0, 1.0)),
        (Happens(Event("brake", Wanted(), tense="present")), (1.0, 1.0, 1.0)),
        (Related("behind", Wanted(), Ego()), (UNTOLD, UNTOLD, UNTOLD)),
        (Both((Is("close", Wanted()), Is("visible", Wanted())), "and"), (0.0, 1.0, 1.0)),
        (Both((Is("close", Wanted()), Is("visible", Wanted())), "or"), (0.0, 0.0, 0.0)),
        (Both((Is("close", Wanted()), Is("dangerous", Wanted())), "and"), (UNTOLD, 1.0, UNTOLD)),
        (Both((Is("close", Wanted()), Is("dangerous", Wanted())), "or"), (0.0, UNTOLD, 0.0)),
        (Is("close", Pronoun("who")), (0.0, 1.0, 0.0)),
    ],
)
def test_a_condition_is_weighed_for_every_vehicle(such: Any, costs: tuple[float, ...]) -> None:
    g = grounder(THREE)
    condition = condition_of(such, g, unsaid("present", g.context), 40.0)
    assert tuple(condition.cost(vehicle) for vehicle in (1, 2, 3)) == costs


def test_who_is_faster_is_asked_of_the_world() -> None:
    class Racing(FakeWorld):
        def relation(self, relation: Any, thing: Any, to: Any, at: float) -> bool | None:
            faster = {Vehicle(1): 3.0, Vehicle(2): 1.0, Ego(): 2.0}
            return (
                faster[thing] > faster[to]
                if relation == "faster-than"
                else faster[thing] < faster[to]
            )

    g = grounder(Racing(THREE.cars, now=40.0))
    for comparator, costs in (("more", (0.0, 1.0)), ("less", (1.0, 0.0))):
        such = Compares(Measured("speed", Wanted()), comparator, Measured("speed"))  # type: ignore[arg-type]
        condition = condition_of(such, g, unsaid("present", g.context), 40.0)
        assert tuple(condition.cost(vehicle) for vehicle in (1, 2)) == costs
    other = Compares(Measured("length", Wanted()), "more", Measured("length"))
    assert condition_of(other, g, unsaid("present", g.context), 40.0).cost(1) == UNTOLD
