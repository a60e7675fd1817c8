"""Causal answers and refusals; what is said stands in the same line of golden/causal_*.txt."""

from msgspec.structs import replace

from tests.nlg.scenery import BLUE, GONE, LORRY, LORRY_THEN, OTHER_BLUE
from xavi_dialogue.domain.answers import (
    Aim,
    Answer,
    Avoidance,
    CannotSay,
    Cause,
    Certainty,
    ChoiceReason,
    Contrast,
    DecisiveFactor,
    DidNotHappen,
    Effect,
    Evidence,
    Grounds,
    Mechanism,
    Method,
    MotionCause,
    MotionReason,
    NoSuchVehicle,
    NotApplicable,
    NotRecorded,
    NotUnderstood,
    OtherReason,
    OutcomeEstimate,
    Refusal,
    Share,
    SupposedOfOther,
    SupposedOfUs,
    TooLittle,
    Unavailable,
    WhichOne,
)
from xavi_dialogue.domain.evidence import TimeRange
from xavi_dialogue.domain.facts import Belief, Episode, Expectation, OptionValue
from xavi_dialogue.domain.reasons import Performed
from xavi_dialogue.domain.terms import (
    At,
    Described,
    Ego,
    Event,
    Happens,
    Pronoun,
    Vehicle,
    Wanted,
)

E, BUS, CAR = Ego(), Vehicle(1), Vehicle(2)
THEN = 5.0


def effect(component, delta, low=None, high=None):
    ends = (delta - 0.4 if low is None else low, delta + 0.4 if high is None else high)
    return Effect(component, "s", delta, *ends, 60, 20)


TURNS_OFF = Cause(
    1,
    ("change-right", "exit-right"),
    0.78,
    Mechanism("leader", 9.0, 3.6, 4.0, 0.9),
    0.3,
    decision_changes=True,
    necessary=True,
)
DRIVES_AHEAD = Cause(2, ("continue",), 0.999, Mechanism("leader", 16.7, 16.7, 4.0, 0.9, True))
MIGHT_TURN = Cause(2, ("exit-left",), 0.5, Mechanism("collision", None, None, None, 0.46))
GOES_FIRST = Cause(2, ("exit-right",), 0.3, Mechanism("right-of-way", 8.0, 8.0, 3.0, 0.9))
LATER = Contrast(
    fact=("change-left", "continue"),
    foil=("continue",),
    outcome=OutcomeEstimate("done", 1.0),
    effects=(effect("time", 4.0, 1.0, 6.0), effect("jerk", 0.4)),
    causes=(TURNS_OFF,),
    evidence=Evidence("tree", 120, 32, ("a",)),
    decided=THEN,
    verdict="better",
    terms=(Share("time", 4.0),),
    told=(Share("time", 4.0),),
    error=0.4,
    likely=TimeRange(1.0, 6.0, 0.9, 120),
)
CHANGED = Episode(E, "change-left", THEN, 9.0)
TURNED = Episode(E, "exit-right", 12.0, 15.0)


AHEAD = Aim("road", 120.0, destination=False, time=23.7)
TERMS = {"collision": "collision", "dead": "dead", "termination": "late", "done": "time"}


def ends(name, probability=1.0, struck=None, **more):
    told = (Share(TERMS[name], 9.0, probability if name != "done" else None, 0.0),)
    ending = OutcomeEstimate(name, probability, struck)
    return replace(LATER, **{"outcome": ending, "terms": told, "told": told, **more})


MAY_BE_LATE = replace(ends("termination", 0.3), outcome=OutcomeEstimate("done", 0.7))
EFFORT = replace(
    LATER,
    fact=("continue",),
    foil=("change-left",),
    effects=(effect("time", -1.0),),
    likely=None,
    terms=(Share("effort", 1.0), Share("angular-acceleration", 1.5), Share("time", -1.0)),
    told=(Share("angular-acceleration", 1.5), Share("time", -1.0)),
)
CLOSE = replace(
    LATER,
    verdict="close",
    terms=(Share("jerk", 1.0), Share("time", -1.5)),
    told=(Share("jerk", 1.0), Share("time", -1.5)),
    error=0.8,
    effects=(effect("time", -1.5), effect("jerk", 0.4)),
    likely=TimeRange(-3.5, 0.5, 0.9, 120),
)
WORSE = replace(
    CLOSE, verdict="worse", told=(Share("time", -1.5), Share("jerk", 1.0)), error=0.2, causes=()
)
RISKY = replace(
    LATER,
    fact=("exit-right",),
    foil=("exit-straight",),
    effects=(effect("time", -2.5),),
    likely=TimeRange(-4.0, -0.1, 0.9, 120),
    terms=(Share("collision", 80.0, 0.46, 0.02), Share("time", -1.6)),
    told=(Share("collision", 80.0, 0.46, 0.02), Share("time", -1.6)),
    collision=0.46,
    fact_collision=0.02,
    collided_with=2,
    causes=(MIGHT_TURN,),
)
ALONE = replace(LATER, foil=(), outcome=None, effects=(), verdict="alone", terms=(), told=())
STEERING = replace(
    LATER,
    effects=(effect("angular-acceleration", 0.1), effect("time", -2.0)),
    likely=None,
    terms=(Share("angular-acceleration", 3.0), Share("time", -2.0)),
    told=(Share("angular-acceleration", 3.0), Share("time", -2.0)),
    causes=(),
)

CHOICES: tuple[Answer, ...] = (
    ChoiceReason("why", CHANGED, LATER),
    ChoiceReason("why", CHANGED, replace(LATER, causes=(DRIVES_AHEAD,)), 2, "main"),
    ChoiceReason("why", CHANGED, replace(LATER, causes=(TURNS_OFF, DRIVES_AHEAD)), 2, "part"),
    ChoiceReason("why", CHANGED, replace(LATER, cleared=(3,)), 3, "none"),
    ChoiceReason("why", CHANGED, LATER, 3, "none"),
    ChoiceReason("why", CHANGED, replace(LATER, causes=(GOES_FIRST,))),
    ChoiceReason("why", CHANGED, replace(LATER, aim=AHEAD)),
    ChoiceReason("why", CHANGED, STEERING),
    ChoiceReason("why", None, CLOSE, past=False),
    ChoiceReason("why", CHANGED, WORSE),
    ChoiceReason("why-not", None, WORSE, past=False),
    ChoiceReason("necessary", CHANGED, WORSE),
    ChoiceReason("worth-it", CHANGED, WORSE),
    ChoiceReason("why-not", None, MAY_BE_LATE),
    ChoiceReason("why-not", None, EFFORT, open_at=5.0),
    ChoiceReason("why-not", None, ends("dead", 0.9, foil=("change-left",), route="exit-right")),
    ChoiceReason("why-not", None, replace(EFFORT, continued=("change-right",)), past=False),
    ChoiceReason("why", TURNED, RISKY),
    ChoiceReason("why", CHANGED, replace(LATER, collision=0.03, collided_with=2)),
    ChoiceReason("why", CHANGED, replace(LATER, fact_collision=0.03)),
    ChoiceReason("why", CHANGED, ALONE),
    ChoiceReason("why", CHANGED, replace(ALONE, causes=())),
    ChoiceReason("why", CHANGED, ends("collision", 0.8, 2, foil=("stop", "exit-right"))),
    ChoiceReason("why", CHANGED, ends("dead", 0.97, foil=("exit-left",))),
    ChoiceReason("why", CHANGED, ends("dead", foil=("exit-left",), aim=AHEAD)),
    ChoiceReason("why", CHANGED, ends("termination", 0.7, foil=("stop",))),
    ChoiceReason("why", Episode(E, "continue", 18.0), EFFORT, past=False),
    ChoiceReason("why-not", None, EFFORT),
    ChoiceReason("why-not", None, replace(EFFORT, effects=(), foil=("stop",)), past=False),
    ChoiceReason("why-not", None, replace(CLOSE, told=(), effects=())),
    ChoiceReason("necessary", CHANGED, LATER),
    ChoiceReason("necessary", CHANGED, ends("collision", 0.8, 2)),
    ChoiceReason("necessary", CHANGED, ALONE),
    ChoiceReason("necessary", CHANGED, CLOSE),
    ChoiceReason("worth-it", CHANGED, LATER),
    ChoiceReason("worth-it", CHANGED, CLOSE),
    ChoiceReason("mistaken", CHANGED, LATER),
    ChoiceReason("mistaken", CHANGED, CLOSE),
    ChoiceReason("mistaken", CHANGED, WORSE),
    ChoiceReason("mistaken", CHANGED, ALONE),
    ChoiceReason("worth-it", CHANGED, CLOSE),
    SupposedOfUs(replace(LATER, foil=("stop",), continued=("exit-right",))),
    SupposedOfUs(LATER, past=False),
    SupposedOfUs(LATER, done=Performed("change-left", "did")),
    SupposedOfUs(ends("collision", 0.8, 2), past=False),
    SupposedOfUs(replace(LATER, collision=0.1, collided_with=2)),
    SupposedOfUs(RISKY),
    SupposedOfUs(ends("dead", fact=("continue-next-exit", "exit-right"), foil=("exit-right",))),
    SupposedOfUs(STEERING),
)

SLOWED = Episode(E, "slow-down", 12.0, 15.0, speed_from=14.0, speed_to=8.0)
SLOWING = Episode(E, "slow-down", 18.0, None, speed_from=14.0, speed_to=8.0)
LEADER = MotionCause("leader", 2, ("continue",), 0.9, 16.7, necessary=True)
WENT_ON = Episode(CAR, "exit-straight", 16.0, 18.0)
PRIORITY = MotionCause("right-of-way", 2, ("exit-right",), 0.78, 8.0, WENT_ON, necessary=True)
FOLLOWING = Episode(E, "follow", 20.0, None, BUS, speed_to=8.0, speed_from=8.0)
MOVING = Episode(E, "move", 20.0, None, speed_to=13.5, speed_from=13.5)
LIMIT = MotionCause("limit", value=13.9)
SLOW_BUS = MotionCause("leader", 1, ("continue",), 0.9, 8.0)
HEADING = Belief(2, 10.0, (Expectation(("exit-right",), 0.78),))
KINDS = ("cut-in", "blocked", "turn", "limit", "give-way-line", "hidden", "destination",
         "lane-end", "plan", "starting", "light")  # fmt: skip
BY_KIND = tuple(
    MotionReason(
        deed,
        (
            MotionCause(
                kind,  # type: ignore[arg-type]
                1 if kind in ("cut-in", "blocked") else None,
                side="ahead" if kind == "hidden" else None,
            ),
        ),
    )
    for kind in KINDS
    for deed in (SLOWED, SLOWING)
)

MOTIONS: tuple[Answer, ...] = (
    MotionReason(SLOWED, (LEADER,)),
    MotionReason(SLOWED, (PRIORITY,), premise=False, asked="stop", evidence=LATER.evidence),
    MotionReason(SLOWING, (PRIORITY, LEADER), False, "stop", 2, "main"),
    MotionReason(SLOWED, ()),
    MotionReason(SLOWED, (replace(LIMIT, value=8.3),)),
    MotionReason(FOLLOWING, (SLOW_BUS,), asked="move", manner="slowly", limit=13.9),
    MotionReason(MOVING, (LIMIT,), premise=False, asked="move", manner="slowly", limit=13.9),
    MotionReason(MOVING, (LIMIT,), premise=False, asked="move", manner="fast", limit=13.9),
    MotionReason(MOVING, (LIMIT,), asked="move", manner="fast", limit=11.1),
    MotionReason(FOLLOWING, (SLOW_BUS,), asked="move", manner="close", limit=13.9),
    MotionReason(MOVING, (SLOW_BUS,), premise=False, asked="slow-down", manner="slowly"),
    MotionReason(Episode(E, "stand", 16.0), (MotionCause("leader", 2, ("stop",), 0.9, 0.0),)),
    MotionReason(Episode(E, "wait", 8.0, 14.0, CAR), (PRIORITY,), form="necessary"),
    MotionReason(SLOWED, (MotionCause("plan"),), form="necessary", cleared=(3,)),
    *BY_KIND,
    OtherReason(
        2,
        Episode(CAR, "stop", 10.0, 14.0),
        None,
        (MotionCause("leader", 3, ("stop",), 0.8, 0.0),),
        HEADING,
    ),
    OtherReason(
        2,
        Episode(CAR, "stand", 18.0),
        Event("go", CAR, tense="present"),
        (MotionCause("right-of-way", 0, ("continue",), 0.97, 8.0),),
    ),
    OtherReason(2, Episode(CAR, "exit-right", 10.0, 14.0), None, (), HEADING),
    OtherReason(2, Episode(CAR, "signal", 18.0, side="right"), None, (), HEADING),
    OtherReason(2, Episode(CAR, "slow-down", 10.0, 14.0)),
    OtherReason(2, None, None, (), HEADING),
    OtherReason(2, None),
)

SOONER = replace(LATER, foil=("continue",), effects=(effect("time", -2.0),), likely=None)
LEFT = Event("turn", CAR, side="left")
SUPPOSITIONS: tuple[Answer, ...] = tuple(
    case
    for past in (True, False)
    for case in (
        SupposedOfOther(2, None, None, LATER.fact, ("continue",), False, SOONER, past),
        SupposedOfOther(2, None, None, LATER.fact, LATER.fact, True, None, past),
        SupposedOfOther(2, None, None, LATER.fact, LATER.fact, True, None, past, faster=True),
        SupposedOfOther(
            2,
            LEFT,
            0.12,
            LATER.fact,
            ("continue",),
            False,
            replace(SOONER, collision=0.05, collided_with=3),
            past,
        ),
        SupposedOfOther(2, LEFT, 0.0, LATER.fact, LATER.fact, True, None, past, negated=True),
        SupposedOfOther(2, LEFT, None, (), (), False, None, past, Event("stop"), False),
        SupposedOfOther(2, None, None, (), (), True, None, past, Event("slow-down"), True),
        SupposedOfOther(2, None, None, (), (), True, None, past, Event("slow-down")),
    )
)

OPTIONS = (
    OptionValue("exit-right", True, "done", 0.9, 20.0, None, 1.0),
    OptionValue("exit-left", False, "dead", 1.0, None, None, -5.0),
)
RISKS = (
    OptionValue("stop", True, "done", 0.9, 20.0, None, 1.0, 0.004),
    OptionValue("exit-left", False, "done", 0.8, 20.0, None, 0.5, 0.15),
    OptionValue("change-right", False, "collision", 0.67, None, None, -5.0, 0.67),
    OptionValue("continue", False, "done", 0.9, 20.0, None, -6.0, 0.006),
)
GREW = Grounds(
    2,
    ("exit-right",),
    False,
    ((7.0, 0.4), (9.0, 0.92)),
    8.0,
    7.0,
    9.0,
    0.4,
    0.92,
    Episode(CAR, "slow-down", 7.0, 9.0),
    ("exit-straight",),
    3.02,
)
MANY, SINGLE = Evidence("tree", 64, 32, ("a",)), Evidence("tree", 40, 1, ("a",))
INSIGHTS: tuple[Answer, ...] = (
    GREW,
    replace(GREW, deed=None, fit=None),
    Grounds(2, ("exit-right",), True, ()),
    Grounds(2, ("exit-right",), False, ((7.0, 0.4),)),
    Grounds(2, ("exit-right",), False, ((7.0, 0.01),)),
    Grounds(2, ("slow-down",), False, ((7.0, 0.01),)),
    Certainty("plan", 0.97, 0.91, 32, 32, 19.5, MANY, ALONE),
    Certainty("plan", 0.97, 0.91, 32, 32, 19.5, MANY, ALONE, 1, 0.8, 0.8),
    Certainty("plan", 0.87, 0.8, 9, 32, 19.5, MANY, ALONE, 1, 0.9, 0.8),
    Certainty("choice", 0.87, 0.8, 9, 32, 10.0, MANY, LATER, 1, 0.9, 0.8),
    Certainty("choice", 0.67, 0.3, 28, 32, 10.0, MANY, LATER, 1, 0.9, 0.3),
    Certainty("choice", 0.95, 0.9, 32, 32, 10.0, MANY, LATER, 1, 0.6, 0.6),
    Certainty("plan", 0.3, 0.2, 9, 32, 19.5, MANY, ALONE),
    Certainty("choice", 0.81, 0.65, 26, 32, 10.0, MANY, LATER),
    Certainty("choice", 0.3, 0.2, 10, 32, 10.0, MANY, LATER),
    Certainty("choice", 0.95, 0.9, 32, 32, 10.0, MANY, LATER),
    Certainty("choice", 0.95, 0.9, 32, 32, 10.0, MANY, CLOSE),
    Certainty("choice", 0.5, 0.4, 17, 32, 10.0, MANY, CLOSE),
    Certainty("choice", 0.3, 0.2, 10, 32, 10.0, MANY, WORSE),
    Certainty("choice", None, None, 1, 1, 10.0, MANY, LATER),
    Certainty("choice", None, None, 1, 1, 10.0, SINGLE, LATER, others=2),
    Certainty("choice", None, None, 1, 1, 10.0, SINGLE, LATER),
    Certainty("plan", None, None, 1, 1, 19.5, SINGLE, ALONE, others=2),
    Certainty("plan", None, None, 0, 1, 10.0, SINGLE, ALONE, others=2),
    Method(10.0, OPTIONS, LATER.evidence, 4),
    Method(10.0, RISKS, LATER.evidence, 4),
    Method(10.0, OPTIONS, LATER.evidence, 4, risk_now=0.68),
    Method(None),
    DecisiveFactor("conduct", LATER, 2, ("exit-right",), 0.12),
    DecisiveFactor("removal", LATER, 2),
    DecisiveFactor("removal", None, 2, deed="brake"),
    DecisiveFactor("none", LATER),
    DecisiveFactor("factor", LATER, 2, ("exit-right",), most=True),
    DecisiveFactor("factor", STEERING, most=True),
    Avoidance("brake", True, True, 0.8, 0.05, 3, 4, LATER),
    Avoidance("collide", False, True, 0.8, 0.4, 3, 4, LATER),
    Avoidance("stop", False, True, 0.02, 0.01, 3, 4, LATER),
    Avoidance("stop", False, True, 0.8, 0.8, 3, 0, ALONE),
    Avoidance("collide", False, False, 0.0, 0.0, 0, 0),
)

BRAKED = MotionReason(SLOWED, (MotionCause("leader", 2, speed=8.0),))
REFUSALS: tuple[Refusal, ...] = (
    NotUnderstood(),
    NotUnderstood(("blorb",)),
    NotUnderstood(("blorb", "flim")),
    NotUnderstood(quote="glued to our bumper"),
    NotUnderstood(quote="glued to our bumper", rest=True),
    WhichOne((CAR, Vehicle(3)), (BLUE, OTHER_BLUE)),
    WhichOne((Happens(Event("stop")), Happens(Event("stop", CAR))), between="meanings"),
    WhichOne(
        (Happens(Event("exit-left", time=At(5.0))), Happens(Event("exit-left", time=At(12.0)))),
        between="times",
    ),
    NoSuchVehicle(Vehicle(9), 20.0, (LORRY, BLUE)),
    NoSuchVehicle(Described("car", "red"), 20.0, (), BLUE),
    NoSuchVehicle(Described("bus", bearing="behind"), 5.0, (LORRY_THEN,)),
    NoSuchVehicle(Described("car", doing=Event("cut-in", Wanted())), 20.0, (LORRY, BLUE, GONE)),
    NoSuchVehicle(Pronoun("it"), 20.0),
    DidNotHappen(Event("turn", side="left"), (TURNED,)),
    DidNotHappen(Event("turn", side="left"), planned=20.0),
    DidNotHappen(Event("turn", side="right"), (TURNED,), elsewhen=12.0),
    DidNotHappen(Event("turn", side="right"), (TURNED,)),
    DidNotHappen(Event("stop"), (SLOWED,), answer=BRAKED),
    DidNotHappen(Event("slow-down"), (SLOWED,), answer=BRAKED),
    DidNotHappen(Event("stop", tense="present"), (SLOWING,)),
    DidNotHappen(Event("brake", CAR), (Episode(CAR, "speed-up", 12.0, 13.0),)),
    DidNotHappen(Event("turn", CAR, side="left", tense="future")),
    DidNotHappen(Event("stop", tense="future")),
    DidNotHappen(Event("happen")),
    NotApplicable(("change-left",), "there is no lane to the left", 20.0),
    NotApplicable(("change-left",), "there is no lane to the left", 5.0),
    NotApplicable(("exit-left",), "its lane does not lead to the left", 5.0),
    NotApplicable(("continue",), "another manoeuvre is under way"),
    NotApplicable((), "speed is no choice of its own: it follows from the road", 5.0),
    NotApplicable((), "its goal is too far", 5.0),
    TooLittle("too-little-evidence", ("exit-left",), (), 3, 8),
    TooLittle("too-little-evidence", ("exit-left",)),
    TooLittle("effect-too-small", ("stop",)),
    TooLittle("no-influence", ("stop",), ("stop", "exit-left")),
    TooLittle("no-influence"),
    NotRecorded("before-record"),
    NotRecorded("in-future"),
    NotRecorded("gap-in-record", since=5.0, until=8.0),
    NotRecorded("gap-in-record"),
    NotRecorded("out-of-view", CAR, 5.0),
    NotRecorded("hidden", CAR, 5.0),
    NotRecorded("not-sensed", about="weather"),
    NotRecorded("not-recorded", CAR, about="lane"),
    NotRecorded("not-recorded"),
    NotRecorded("not-applicable", CAR, about="time-to-collision"),
    NotRecorded("others-thoughts"),
    *(
        CannotSay(topic)
        for topic in ("off-topic", "injection", "non-english", "capability", "perception", "advice",
                      "opinion", "unsupported-condition", "imagined", "abuse", "deeper", "else")
    ),
    CannotSay("capability", "honk", "not-an-action"),
    Unavailable("planner-unavailable"),
    Unavailable("timed-out"),
    Unavailable("busy"),
    Unavailable("planner-failed"),
    Unavailable("planner-unavailable", roadless=True),
    NotRecorded("no-deeds"),
)  # fmt: skip

CASES: tuple[Answer | Refusal, ...] = (
    *CHOICES, *MOTIONS, *SUPPOSITIONS, *INSIGHTS, *REFUSALS
)  # fmt: skip
