"""Answers about traffic lights; golden/light.txt has the texts."""

from tests.nlg.scenery import NOW
from xavi_dialogue.domain.answers import (
    Answer,
    MotionCause,
    MotionReason,
    OtherReason,
    Unslowed,
    Verdict,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Everyone, Feature, Happens, Vehicle
from xavi_dialogue.domain.traffic_lights import (
    Crossed,
    Foreseen,
    LightForeseen,
    LightOdds,
    LightPassed,
    LightTold,
    Shown,
    SupposedOfLight,
    TurnOnRed,
)

E = Ego()
LIGHT = Feature("light")
RED = Shown(LIGHT, "red", 2.0, False)
TURNED_RED = Shown(LIGHT, "red", 2.0, True)
WAS_RED = Shown(LIGHT, "red", 2.0, False, 8.0, True, after="green")
WAS_AMBER = Shown(LIGHT, "amber", 5.0, True, 8.0, True, after="red")
GREEN = Shown(LIGHT, "green", NOW - 3.0, True)
PERMISSIVE = Shown(LIGHT, "green", NOW - 3.0, True, gives_way=True)
ARROW = Shown(LIGHT, "red", 2.0, True, turning=True)
AT_GREEN = Crossed(NOW - 1.5, 4.0, GREEN, 1.5)
AT_RED = Crossed(NOW - 2.0, 10.0, RED, 6.0)
AT_AMBER = Crossed(6.0, 13.0, WAS_AMBER, 1.0, late=True)
EASILY = Crossed(7.9, 3.0, WAS_AMBER, 2.9)
UNSEEN = Crossed(6.0, 13.0, None)
SPREAD = Foreseen(RED, NOW, "green", 1.0, 30.0, NOW + 12.0, NOW + 4.0, NOW + 25.0)
OPEN = Foreseen(RED, NOW, "green", 0.7, 30.0, NOW + 12.0, NOW + 4.0)
NEVER = Foreseen(RED, NOW, "green", 0.3, 30.0, None, NOW + 20.0)
KNOWN = Foreseen(RED, NOW, "green", 1.0, 30.0, NOW + 3.0, NOW + 3.0, NOW + 3.5, cycle=True)
CAME = Foreseen(WAS_RED, 4.0, "green", 0.7, 30.0, 14.0, 7.0, came=8.0)
ODDS = LightOdds("green", NOW + 8.0, 0.3, False)
GOOD_ODDS = LightOdds("green", NOW + 8.0, 0.7, False)
STAYING = LightOdds("red", NOW + 8.0, 0.99, True)
GOING = LightOdds("red", NOW + 8.0, 0.01, True)
STOOD = Episode(E, "stop", 5.0, standing=True)
HELD = MotionCause("light", necessary=True, value=4.0, shown=RED)
QUEUE = MotionCause("leader", 1, speed=0.0)

CASES: tuple[Answer, ...] = (
    LightTold("colour", RED),
    LightTold("colour", GREEN),
    LightTold("colour", PERMISSIVE),
    LightTold("colour"),
    LightTold("colour", past=True),
    LightTold("colour", whose=Vehicle(1)),
    LightTold("whether", RED, "red", True),
    LightTold("whether", RED, "green", False),
    LightTold("whether", WAS_AMBER, "amber", True, past=True, time=6.0),
    LightTold("claim", RED, "green", False),
    LightTold("claim", GREEN, "green", True),
    LightTold("seen", RED, holds=True, distance=30.0),
    LightTold("seen", holds=False),
    LightTold("seen", WAS_RED, holds=True, past=True, passed=8.5),
    LightTold("when", GREEN, "green"),
    LightTold("when", RED, "green"),
    LightTold("when", RED, "red"),
    LightTold("how-long", RED, "red"),
    LightTold("how-long", TURNED_RED, "red"),
    LightTold("how-long", WAS_RED, "red", past=True),
    LightTold("how-long", WAS_AMBER, "amber", past=True),
    LightTold("where", RED, distance=30.0),
    LightTold("where", passed=6.0),
    LightTold("where"),
    LightTold("how-known", RED),
    LightTold("why", RED),
    LightTold("count", count=0),
    LightTold("count", count=1, crossed=(AT_AMBER,)),
    LightTold("count", count=3, crossed=(AT_AMBER,)),
    LightTold("count", count=0, others=(AT_GREEN,), wanted="red"),
    LightTold("count", count=0, others=(AT_GREEN, AT_AMBER), wanted="red"),
    LightTold("count", count=1, crossed=(AT_RED,), wanted="red"),
    LightTold("count", count=1, crossed=(AT_RED,), others=(AT_GREEN,), wanted="red"),
    LightTold("count", count=2, crossed=(AT_RED, AT_RED), others=(AT_GREEN,), wanted="red"),
    LightForeseen(SPREAD, RED),
    LightForeseen(OPEN, RED),
    LightForeseen(NEVER, RED),
    LightForeseen(KNOWN, RED),
    LightForeseen(SPREAD, RED, asked="whether", holds=True),
    LightForeseen(CAME, RED, past=True, asked="whether", holds=True),
    LightForeseen(NEVER, RED, past=True, asked="whether", holds=False),
    LightForeseen(None, GREEN),
    LightForeseen(None),
    LightForeseen(SPREAD, RED, asked="met", holds=False, stops=0.94),
    LightForeseen(SPREAD, RED, asked="met", holds=True, stops=0.99),
    LightForeseen(None, GREEN, asked="met", holds=True, stops=0.02),
    LightForeseen(None, GREEN, asked="met", stops=0.3),
    LightForeseen(SPREAD, RED, asked="how-sure", odds=ODDS),
    LightForeseen(SPREAD, RED, asked="whether", holds=True, odds=GOOD_ODDS),
    LightForeseen(SPREAD, RED, asked="whether", holds=False, odds=ODDS),
    LightForeseen(None, RED, asked="whether", holds=True, odds=STAYING),
    LightForeseen(None, RED, asked="whether", holds=False, odds=GOING),
    LightPassed(AT_GREEN, "red", False),
    LightPassed(AT_GREEN, "red", False, "claim"),
    LightPassed(AT_GREEN, "red", False, "why"),
    LightPassed(AT_RED, "red", True, "claim"),
    LightPassed(AT_AMBER, "amber", True),
    LightPassed(EASILY, "amber", True),
    LightPassed(UNSEEN, "red"),
    LightPassed(None, "red", False, "claim", RED),
    LightPassed(None, "red", False),
    TurnOnRed(RED, "straight", "right"),
    TurnOnRed(RED, "right", "right"),
    TurnOnRed(ARROW, "right", "right"),
    TurnOnRed(None, None, "right"),
    SupposedOfLight(RED, "green", 4.0, ("stop",), ("exit-straight",), False, False, 5.0, 9.0),
    SupposedOfLight(RED, "green", 4.0, ("stop",), ("exit-straight",), False, False, 5.0),
    SupposedOfLight(RED, "green", 4.0, ("stop",), ("continue",), False, False, holds=False),
    SupposedOfLight(RED, "green", 4.0, ("stop",), ("continue",), False, False, amount=True),
    SupposedOfLight(GREEN, "red", 4.0, ("continue",), ("stop",), False, True),
    SupposedOfLight(RED, "green", 4.0, ("stop",), ("continue",), False, False, first=(1, 2)),
    SupposedOfLight(RED, "green", 4.0, ("stop",), ("stop",), True, False, past=False, first=(1,)),
    SupposedOfLight(RED, "red", NOW, ("stop",), ("stop",), True, True, past=False, standing=True),
    SupposedOfLight(GREEN, "green", 4.0, ("continue",), ("continue",), True, False),
    SupposedOfLight(RED, "green", 4.0, ("stop",), ("continue",), False, False, 5.0, faster=True),
    SupposedOfLight(RED, "green", 4.0, ("stop",), ("continue",), False, False, faster=True),
    MotionReason(STOOD, (HELD,), asked="stop"),
    MotionReason(STOOD, (HELD, QUEUE), asked="wait"),
    MotionReason(
        Episode(E, "brake", 3.0, 6.0, speed_from=13.0, speed_to=2.0),
        (MotionCause("light", shown=WAS_AMBER, value=60.0),),
        asked="brake",
    ),
    OtherReason(
        1,
        Episode(Vehicle(1), "stop", 6.0),
        causes=(MotionCause("light", probability=0.6, shown=RED),),
    ),
    Verdict(Happens(Event("wait", E, LIGHT, tense="present")), True,
            (Episode(E, "wait", 5.0, object=LIGHT, standing=True),)),
    LightTold("turn", RED),
    LightTold("turn", RED, holds=False),
    LightTold("colour", whose=Everyone(), own=RED),
    LightTold("colour", whose=Vehicle(1), own=RED, past=True),
    LightTold("colour", whose=Vehicle(1)),
    MotionReason(Episode(E, "stop", 4.0, speed_to=0.0, standing=True),
                 (MotionCause("light", shown=WAS_RED),), asked="stand"),
    LightTold("colour", whose=Vehicle(1), own=RED, around=True),
    LightTold("colour", whose=Everyone(), around=False),
    LightTold("colour", whose=Everyone(), own=RED, around=True, past=True),
    LightTold("colour", whose=Everyone(), own=RED, around=False, past=True),
    LightTold("why", whose=Everyone(), own=RED, around=True),
    SupposedOfLight(GREEN, "green", NOW, ("continue",), ("continue",), True, False, past=False),
    SupposedOfLight(GREEN, "green", NOW, ("continue",), ("continue",), True, False, past=False,
                    holds=True, first=(1,)),
    Unslowed(Episode(E, "wait", NOW, speed_from=0.0), None, red=True, past=False),
    Unslowed(Episode(E, "wait", NOW, speed_from=0.0), QUEUE, red=True, past=False),
)  # fmt: skip
