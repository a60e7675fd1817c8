"""Answers about our way, moments that stand out and decisions; golden/journey.txt has the texts."""

from msgspec.structs import replace

from tests.nlg.causal_cases import LATER as WAITS
from tests.nlg.scenery import BLUE, LORRY, NOW
from xavi_dialogue.domain.answers import (
    Altered,
    Answer,
    ChoiceReason,
    Course,
    Decided,
    PeakMoment,
    Wavered,
)
from xavi_dialogue.domain.facts import Belief, Episode, Expectation, Measure
from xavi_dialogue.domain.journeys import AbandonedPlan, LaneFits, WayStep
from xavi_dialogue.domain.terms import Ego, Event, Feature, Vehicle
from xavi_dialogue.domain.traffic_lights import Shown

E = Ego()
LEFT = WayStep("junction", "exit-left", 55.0, 1)
THERE = WayStep("junction", "exit-straight", 1.0, 1)
LATER = WayStep("junction", "exit-right", 120.0, 2)
RING = WayStep("roundabout", "exit-straight", 40.0, 1, exit=2)
SIDEWAYS = WayStep("roundabout", "exit-left", 1.0, 1, exit=3)
INSIDE = WayStep("roundabout", "exit-right", 12.0, 1, exit=1, inside=True)
FURTHER = WayStep("roundabout", "exit-right", 60.0, 1, exit=2, inside=True)
TURN = Episode(E, "exit-left", 9.0, 12.0)
YIELD = Episode(E, "give-way", 9.0, 12.0, object=Vehicle(1))
BEFORE = Decided(4.0, ("continue",))
AFTER = Decided(9.0, ("change-left",), doing=(YIELD,))
OLD = Belief(1, 4.0, (Expectation(("exit-right",), 0.4),))
GREEN = Shown(Feature("light"), "green", 8.0, True)
FALLEN = Belief(1, 9.0, (Expectation(("exit-right",), 0.6),))
NEW = Belief(1, 9.0, (Expectation(("exit-right",), 0.9),))


def near(attribute: str, value: float) -> Measure:
    """Make a measure of a moment."""
    return Measure(attribute, E, 9.0, value, to=Vehicle(1))  # type: ignore[arg-type]


def lost(value: float, until: float | None) -> Measure:
    """Make the time [s] that was lost from 9 s on, up to a time [s] or still."""
    on = until is None
    return Measure("delay", E, 9.0, value, until=NOW if on else until, at_least=on)


CASES: tuple[Answer, ...] = (
    Course("way", (LEFT,), left=200.0),
    Course("way", (LEFT,), holds=True),
    Course("way", (THERE, LATER), holds=False),
    Course("way", (LATER,), then=True),
    Course("way", (RING,)),
    Course("way", (SIDEWAYS,)),
    Course("way", (INSIDE,)),
    Course("way", (FURTHER,)),
    Course("way", (), left=200.0),
    Course("way", (), holds=True, left=200.0),
    Course("bound", (), holds=True, left=200.0),
    Course("bound", (), holds=False, left=200.0),
    Course("bound", (), holds=True),
    Course("bound", (), holds=False),
    Course("way", (), holds=False),
    Course("way", (), then=True),
    Course("road", (LEFT,), holds=False),
    Course("road", (), holds=True, left=200.0),
    Course("road", (), left=200.0),
    Course("route", (LEFT, LATER), left=200.0),
    Course("route", (LEFT, LATER)),
    Course("choice", (LEFT, LATER), left=200.0),
    Course("choice", (), left=200.0),
    Course("choice", ()),
    Course("turns", (LEFT, LATER)),
    Course("turns", (INSIDE,)),
    Course("turns", (), left=200.0),
    Course("roundabouts", (RING,), holds=True),
    Course("roundabouts", (), holds=False, left=200.0),
    Course("nearly", (), left=30.0, soon=3.0),
    Course("halt", (replace(LEFT, rule="give-way"),)),
    Course("halt", (replace(LEFT, rule="give-way", light=True),)),
    Course("halt", (replace(RING, rule="give-way"),)),
    Course("halt", (replace(THERE, rule="equal"),)),
    Course("halt", (), left=200.0),
    PeakMoment("slowness", 9.0, (YIELD,), near("speed", 0.0)),
    PeakMoment("slowness", 9.0, (), near("speed", 5.0)),
    PeakMoment("speed", 9.0, (), near("speed", 13.0)),
    PeakMoment("tightness", 9.0, (TURN,), near("speed", 5.0), kind=Event("turn")),
    PeakMoment("braking", 9.0, (YIELD,), near("deceleration", 3.0)),
    PeakMoment("slowing", 9.0, (YIELD,), near("speed-change", 10.0)),
    PeakMoment("delay", 9.0, (YIELD,), lost(12.0, 21.0), (BLUE,)),
    PeakMoment("delay", 9.0, (YIELD,), lost(12.0, 21.0)),
    PeakMoment("delay", 9.0, (YIELD,), lost(12.0, 21.0), lit=True),
    PeakMoment("delay", 9.0, (), lost(8.0, None), (BLUE,)),
    PeakMoment("waiting", 9.0, (YIELD,), near("duration", 3.0)),
    PeakMoment("waiting", 9.0, (YIELD,), near("duration", 0.5)),
    PeakMoment("closeness", 9.0, (), near("distance", 2.0), (BLUE,)),
    PeakMoment("danger", 9.0, (YIELD,), near("time-to-collision", 2.0), (BLUE,)),
    PeakMoment("difficulty", 9.0, (YIELD,), near("duration", 3.0), (BLUE, LORRY)),
    PeakMoment("danger", 9.0, (YIELD,), near("duration", 3.0), (BLUE,)),
    PeakMoment("difficulty", 9.0),
    PeakMoment("waiting"),
    PeakMoment("braking"),
    PeakMoment("slowing"),
    PeakMoment("delay"),
    PeakMoment("closeness"),
    PeakMoment("risk", 9.0, (YIELD,), near("probability", 0.1)),
    PeakMoment("risk"),
    PeakMoment("choice"),
    BEFORE,
    AFTER,
    Decided(NOW, ("exit-left",), kept=True),
    Altered(BEFORE, AFTER, (LORRY,), ((OLD, NEW),), (YIELD,)),
    Altered(BEFORE, AFTER, (LORRY,)),
    Altered(BEFORE, BEFORE),
    Altered(BEFORE, AFTER, (), (), (), GREEN, True),
    Altered(BEFORE, AFTER, sudden=True, reason=ChoiceReason("why", None, WAITS)),
    Altered(BEFORE, AFTER, beliefs=((NEW, FALLEN),), sudden=True),
    Wavered("change-left", (AbandonedPlan(4.0, 0.2, 1),)),
    Wavered("change-left", (AbandonedPlan(4.0, 0.2, 1), AbandonedPlan(6.0, 0.31)), resumed=True),
    Course("turns", (LEFT, LATER), onward=True),
    Course("turns", (), left=200.0, onward=True),
    LaneFits(Measure("lane", E, NOW, 1.0, count=3)),
    LaneFits(Measure("lane", E, NOW, 1.0, count=1), turn=LEFT),
    LaneFits(Measure("lane", E, NOW, 1.0, count=2), "change-left", LEFT),
)
