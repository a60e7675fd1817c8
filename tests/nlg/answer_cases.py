"""Factual answers and talk; what is said stands in the same line of golden/answer.txt."""

from tests.nlg.scenery import BLUE, GONE, LORRY, LORRY_THEN, NOW, OTHER_BLUE
from xavi_dialogue.domain.answers import (
    Acknowledged,
    Activity,
    Again,
    Answer,
    Beliefs,
    Bound,
    Closeness,
    Comfort,
    Comforting,
    Compared,
    Counted,
    Declined,
    DidNotHappen,
    Evidence,
    Forecast,
    Happenings,
    Helpful,
    Identified,
    Lasted,
    Located,
    Measures,
    MotionCause,
    Options,
    PlanAhead,
    Priority,
    Simulations,
    Sociable,
    Staying,
    Verdict,
)
from xavi_dialogue.domain.facts import Belief, Episode, Expectation, Measure, OptionValue
from xavi_dialogue.domain.meaning import Feel, Request
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Exit,
    Happens,
    Has,
    Is,
    Junction,
    Measured,
    Related,
    Vehicle,
    Vehicles,
    Wanted,
)

E, V, W = Ego(), Vehicle(1), Vehicle(2)
WALKERS = Described(
    "pedestrian", doing=Event("cross", Wanted(), E, tense="present"), plural=True, definite=False
)
REAR = Described("car", such=Related("behind", Wanted("car")), plural=True, definite=False)
THOSE = Described(among=Vehicles((1, 3)), plural=True, definite=False)
BRAKED = Described(doing=Event("brake", Wanted(), tense="past"), plural=True, definite=False)
TURN = Happens(Event("turn", V, side="right"))
UNSURE = Belief(1, 4.0, (Expectation(("exit-right",), 0.45), Expectation(("continue",), 0.4)))
EXPECTED = Belief(1, 8.0, (Expectation(("exit-right",), 0.78), Expectation(("continue",), 0.2)))
RIDE = (
    Episode(E, "change-left", 2.0, 4.0),
    Episode(W, "cut-in", 9.0, 10.0, object=E),
    Episode(E, "brake", 9.0, 11.0, speed_from=13.0, speed_to=8.0, object=W),
    Episode(E, "stand", 14.0, 18.0),
    Episode(E, "exit-right", 18.0),
)
ENDS = (("done", 80), ("collision", 6), ("termination", 3), ("dead", 30))
OPTIONS = (
    OptionValue("change-left", True, "done", 0.9, 12.0, 0.0, 1.0),
    OptionValue("continue", False, "done", 0.9, 16.0, 4.0, 0.5),
    OptionValue("stop", False, "termination", 0.9, None, None, -1.0),
    OptionValue("exit-right", False, "termination", 0.9, None, None, -2.0, exceeds=9.4),
)

DEAD = (OptionValue("exit-right", False, "dead", 1.0, None, None, -130.0),)

CASES: tuple[Answer, ...] = (
    Verdict(
        Happens(Event("stop")),
        True,
        (Episode(E, "stop", 12.0, 13.0, speed_from=13.0, speed_to=0.0),),
    ),
    Verdict(
        Happens(Event("stop")),
        False,
        (Episode(E, "slow-down", 12.0, 15.0, speed_from=13.0, speed_to=6.0),),
    ),
    Verdict(Related("behind", W), False, (BLUE,)),
    Verdict(Related("ahead-of", V), True, (LORRY,)),
    Verdict(Related("can-see", V, E), None, gap="others-thoughts"),
    Verdict(Is("upset", V), None, gap="others-thoughts"),
    Verdict(Happens(Event("gesture", V, E)), None, gap="not-sensed"),
    Verdict(Exists(Described("car", bearing="behind", definite=False)), True, (OTHER_BLUE,)),
    Verdict(Exists(Described("car", bearing="behind", definite=False)), False),
    Verdict(Has("indicator", "left", V), False, (Measure("indicator", V, NOW, lights=("right",)),)),
    Verdict(Has("colour", "blue", V), False, (Measure("colour", V, NOW, word="red"),)),
    Verdict(
        Compares(Measured("speed"), "more", Measured("speed", V)),
        True,
        (Measure("speed", E, NOW, 13.0), Measure("speed", V, NOW, 10.0)),
    ),
    Verdict(
        Compares(Measured("speed"), "more", Measured("limit")),
        False,
        (Measure("speed", E, NOW, 13.0, reference=13.9),),
    ),
    Verdict(Is("necessary", event=Event("brake"), tense="past"), True),
    Verdict(Happens(Event("pull-out", V, E, tense="future")), None, probability=0.05),
    Verdict(Happens(Event("turn", V, side="right", tense="future")), None, probability=0.5),
    Verdict(Happens(Event("turn", V, side="right", tense="future")), None, probability=0.78),
    Verdict(
        TURN,
        False,
        (Episode(V, "continue", 10.0, 12.0),),
        claim=True,
        challenge=True,
        believed=(EXPECTED,),
        mistaken=True,
    ),
    Verdict(
        Is("wrong", E, tense="perfect"),
        True,
        (Episode(V, "continue", 10.0, 12.0), Episode(W, "exit-left", 14.0, 15.0)),
        believed=(EXPECTED, Belief(2, 13.0, (Expectation(("exit-right",), 0.6),))),
        mistaken=True,
    ),
    Verdict(
        Is("wrong", E, tense="perfect"),
        True,
        (Episode(V, "continue", 4.0), *(Episode(W, "exit-left", t, t + 1.0) for t in (9.0, 14.0))),
        believed=(
            EXPECTED,
            *(Belief(2, t, (Expectation(("exit-right",), 0.6),)) for t in (8.0, 13.0)),
        ),
        mistaken=True,
    ),
    Verdict(TURN, True, (Episode(V, "turn", 10.0, 12.0, side="right"),), claim=True),
    Verdict(TURN, False, (Episode(V, "continue", 10.0, 12.0),), claim=True),
    Verdict(TURN, None, gap="out-of-view", claim=True),
    Identified((LORRY,)),
    Identified((LORRY,), such=Happens(Event("wait", object=Wanted()))),
    Identified((), such=Happens(Event("wait", object=Wanted())), none=True),
    Identified((), such=Related("behind", Wanted()), none=True),
    Identified((LORRY, BLUE)),
    Identified((LORRY,), facts=(Episode(V, "wait", 18.0),)),
    Counted(Event("give-way"), 3, since=0.0, until=NOW),
    Counted(Event("stop"), 0, since=0.0, until=NOW),
    Counted(Event("stop"), 1, (Episode(E, "stop", 12.0, 13.0),)),
    Counted(Everyone("car"), 1),
    Counted(Everyone(), 9),
    Counted(Everyone(), 0, such=REAR),
    Counted(Everyone(), 0, until=10.0, such=REAR),
    Counted(Everyone(), 1, (OTHER_BLUE,), such=REAR),
    Counted(Everyone(), 9, such=REAR),
    Counted(Everyone(), 9, (LORRY, OTHER_BLUE), such=BRAKED),
    Counted(Vehicles((3,)), 2, (OTHER_BLUE,), such=THOSE),
    *(Counted(Everyone("pedestrian"), n, such=WALKERS) for n in range(3)),
    Counted(Everyone(), 9, until=10.0, such=REAR),
    Happenings("list", RIDE),
    Happenings(
        "summary",
        RIDE,
        measures=(
            Measure("time", E, NOW, 20.0, until=NOW),
            Measure("distance-driven", E, NOW, 210.0),
        ),
    ),
    Happenings("when", RIDE[:1]),
    Happenings("how-long", (Episode(E, "stand", 14.0, 18.0),)),
    Happenings("how-long", (Episode(E, "wait", 14.0, object=W),)),
    Happenings("when", (), asked=Event("stop"), since=0.0, until=NOW),
    Happenings("first", RIDE),
    Activity(E, NOW, (Episode(E, "exit-right", 18.0),), 7.0, "slowing"),
    Activity(V, NOW, (), 0.0, "standing", cause=MotionCause("right-of-way", vehicle=2)),
    Activity(
        W,
        NOW,
        (),
        13.0,
        "steady",
        belief=Belief(
            2, NOW, (Expectation(("exit-right",), 0.5), Expectation(("continue",), 0.45))
        ),
    ),
    PlanAhead((("continue", NOW), ("exit-left", 24.0))),
    PlanAhead((("exit-left", 24.0),), (Measure("time-to-go", E, NOW, 14.0),)),
    PlanAhead((), arrived=True),
    Located(V, (LORRY,)),
    Located(V, (LORRY_THEN,)),
    Located(Vehicle(4), (GONE,)),
    Located(W, (), gap="out-of-view"),
    Bound(
        E,
        measures=(
            Measure("distance-to-go", E, NOW, 230.0),
            Measure("turn", E, NOW, 60.0, side="left"),
        ),
    ),
    Bound(V, Belief(1, NOW, (Expectation(("exit-right",), 0.92),))),
    Forecast((Belief(1, NOW, (Expectation(("exit-right",), 0.92),)),)),
    Forecast((Belief(1, NOW, ()),)),
    Forecast(
        tuple(
            Belief(v, NOW, (Expectation(("stop" if v == 1 else "exit-right",), 0.9),))
            for v in (1, 2, 3, 4, 5)
        )
    ),
    Forecast(tuple(Belief(v, NOW, (Expectation(("stop",), 0.9),)) for v in (1, 2))),
    Forecast(tuple(Belief(v, NOW, (Expectation(("stop",), 0.9),)) for v in (1, 2, 3, 4))),
    Forecast(
        (
            Belief(1, NOW, (Expectation(("stop",), 0.9),)),
            Belief(2, NOW, (Expectation(("stop",), 0.5), Expectation(("continue",), 0.5))),
        )
    ),
    Forecast(
        tuple(
            Belief(v, NOW, (Expectation(("stop",), p), Expectation(("continue",), 1 - p)))
            for v, p in ((1, 0.9), (2, 0.5), (3, 0.5), (4, 0.5), (5, 0.5))
        )
    ),
    Forecast(
        tuple(
            Belief(v, NOW, (Expectation(("stop",), 0.5), Expectation(("continue",), 0.5)))
            for v in (1, 2, 3, 4)
        )
    ),
    Bound(V, went=Episode(V, "exit-right", 12.0, 14.0)),
    Beliefs(
        1,
        None,
        (UNSURE, EXPECTED),
        why=Episode(V, "slow-down", 4.0, 6.0, speed_from=11.0, speed_to=7.0),
        turning=(4.0, 8.0),
        came=Episode(V, "exit-right", 8.0, 10.0),
    ),
    Beliefs(1, Event("turn", V, side="right"), (UNSURE, EXPECTED), probability=0.78, time=8.0),
    Options(OPTIONS, 2.0, Evidence()),
    Options(OPTIONS[:1], 2.0, Evidence()),
    Compared(
        "speed", E, V, "first", (Measure("speed", E, NOW, 13.0), Measure("speed", V, NOW, 10.0))
    ),
    Compared("time", Happens(Event("change-left")), Happens(Event("continue")), "first"),
    Compared("safety", E, V, "unknown"),
    Priority(NOW, "give-way", 1),
    Priority(12.0, "equal", 2, first=W, blame=True, conflict=False),
    Comfort(Measure("deceleration", E, 9.0, 2.2, extreme="highest")),
    Comfort(Measure("deceleration", E, 9.0, 5.2, extreme="highest"), episode=RIDE[2], hard=True),
    Closeness(1, Measure("distance", V, 5.0, 4.2, to=E, extreme="lowest"), risk=0.001),
    Closeness(1, Measure("distance", V, NOW, 14.0, to=E), asked="close", past=False),
    Closeness(
        1,
        Measure("distance", V, 5.0, 0.6, to=E),
        Measure("time-to-collision", V, 5.0, 1.2),
        asked="dangerous",
    ),
    Comforting(
        Feel("startled"), Closeness(1, Measure("distance", V, 5.0, 4.2, to=E, extreme="lowest"))
    ),
    Comforting(Feel("nervous")),
    Declined(Request(Event("slow-down", tense="present")), ahead=PlanAhead((("exit-left", 24.0),))),
    Declined(Request(Event("honk", object=V)), able=False),
    Declined(Request(Event("slow-down")), already=True, doing=Activity(E, NOW, (), 8.0, "slowing")),
    Sociable("thanks"),
    Helpful(),
    Acknowledged("cancelled"),
    Again("shorter", Measures((Measure("speed", E, NOW, 13.0, reference=13.9),))),
    Again("repeat", None),
    Lasted(Related("behind", V, E), 3.0, None, NOW),
    Lasted(Related("behind", V, E), 3.0, 8.0, NOW),
    Lasted(Related("on", E, Junction()), 6.0, 10.0, NOW, held=2.0),
    Counted(Event("pass", object=Exit(), tense="perfect"), 0, since=4.0),
    Counted(Event("pass", object=Exit()), 0, since=4.0, until=8.0),
    Counted(Event("pass", object=Exit(), tense="perfect"), 2, since=4.0),
    Counted(Event("pass", object=Exit()), 1, since=4.0, until=8.0),
    Staying(V, "change-left", 24.0),
    Staying(V, off=0.8),
    Staying(V, left=Measure("time-to-go", E, NOW, 30.0)),
    Staying(V),
    Priority(NOW, "give-way", walkers=True, holds=False),
    Activity(V, NOW, (Episode(V, "stand", 8.0),), 1.0, "speeding-up"),
    Activity(V, NOW, (Episode(V, "stand", 8.0),), 0.0, "standing"),
    DidNotHappen(Event("turn", tense="present"), (Episode(E, "exit-right", 18.0),)),
    DidNotHappen(Event("turn", side="left", tense="present"), (Episode(E, "exit-right", 18.0),)),
    Options(OPTIONS[:2], 2.0, Evidence(), rival="better"),
    Options(OPTIONS[:2], 2.0, Evidence(), rival="close"),
    Options(OPTIONS[:2], 2.0, Evidence(), rival="close", closest=True),
    Options(OPTIONS[:2], 2.0, Evidence(), rival="better", named=True),
    Options((OPTIONS[0], OPTIONS[2]), 2.0, Evidence(), rival="better"),
    Options((OPTIONS[0], *DEAD), 2.0, Evidence(), rival="better"),
    Options(OPTIONS[:1], 2.0, Evidence(), rival="alone"),
    Options(OPTIONS, 2.0, Evidence(), counted=True),
    Options(OPTIONS, 2.0, Evidence(), counted=True, earlier=True),
    Simulations(2.0, 119, ENDS, Evidence(), options=4),
    Simulations(2.0, 80, ENDS[:1], Evidence(), of="stop", options=4),
    Simulations(2.0, 0, (), Evidence(), of="stop", options=4),
    Simulations(2.0, 119, ENDS, Evidence(), asked="collision", struck=((1, 4), (2, 2)), options=4),
    Simulations(2.0, 119, ENDS[:1], Evidence(), asked="collision", options=4),
    Simulations(2.0, 80, ENDS[:1], Evidence(), asked="done", options=4),
    Simulations(2.0, 0, (), Evidence(), asked="done", of="stop", options=4),
    Simulations(2.0, 119, ENDS, Evidence(), options=1),
    Simulations(2.0, 119, ENDS, Evidence(), apart=True, options=4),
)
