"""Answers that come up seldom, one for each rule that no other case needs; see golden/rare.txt."""

from msgspec.structs import replace

from tests.nlg.answer_cases import EXPECTED, OPTIONS, RIDE, UNSURE, E, V
from tests.nlg.causal_cases import (
    ALONE,
    CHANGED,
    EFFORT,
    LATER,
    LEADER,
    MAY_BE_LATE,
    PRIORITY,
    RISKS,
    RISKY,
    SLOW_BUS,
    SLOWED,
    ends,
)
from tests.nlg.scenery import BLUE, LORRY, NOW, OTHER_BLUE, look
from xavi_dialogue.domain.answers import (
    Activity,
    Answer,
    Beliefs,
    Bound,
    ChoiceReason,
    Comfort,
    Comforting,
    Counted,
    CrossingVehicle,
    Declined,
    Evidence,
    GoReason,
    Happenings,
    Identified,
    Located,
    Measures,
    Method,
    MotionCause,
    MotionReason,
    NobodyElse,
    Options,
    OtherReason,
    OutcomeEstimate,
    OwnSignal,
    PlaceReason,
    Priority,
    Share,
    SignalReason,
    SupposedOfOther,
    SupposedOfUs,
    Unslowed,
    Verdict,
)
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.domain.facts import Episode, Expectation, Measure
from xavi_dialogue.domain.hidden_areas import Hider, SupposedSeeing
from xavi_dialogue.domain.meaning import Feel, Request
from xavi_dialogue.domain.terms import (
    At,
    Compares,
    Described,
    Event,
    Everyone,
    Exit,
    Feature,
    Happens,
    Is,
    Junction,
    Measured,
    Nobody,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.traffic_lights import Shown

STOOD = (Episode(E, "stand", 4.0, 6.0), Episode(E, "stand", 14.0, 18.0))
MANY = tuple(
    look(number, NOW, "car", "grey", "behind", 20.0 + number, alone=False)
    for number in range(10, 20)
)
WALKERS = tuple(look(v, NOW, "pedestrian", None, "ahead", 4.0 + v, alone=False) for v in (20, 21))
BY_SIDE = look(22, NOW, "pedestrian", None, "ahead-right", 9.0, alone=False)
WALKING = tuple(Episode(Vehicle(v), "cross", NOW - 1.0, object=E) for v in (20, 21))
BLINKED = Episode(V, "signal", 8.0, 10.0, side="right")
TURNED_OFF = Episode(V, "exit-right", 10.0, 12.0)
TURNERS = Described("vehicle", doing=Event("turn", Wanted(), side="right", tense="past"))
STANDERS = Described("car", such=Is("stationary", Wanted()))
FASTER = Compares(Measured("speed", E), "more", Measured("speed", E, time=At(5.0)))
HOPELESS = replace(RISKY, collision=0.9)
LONG = ends("termination", 0.99, effects=(), causes=(), horizon=30.0, exceeds=9.6)
QUICK = replace(
    LONG,
    outcome=OutcomeEstimate("done", 0.99),
    fact_outcome=OutcomeEstimate("termination", 0.99),
    verdict="worse",
    terms=(Share("late", -9.0, 0.01, 0.99),),
    told=(Share("late", -9.0, 0.01, 0.99),),
)
LONG_BOTH = replace(
    LONG,
    fact_outcome=OutcomeEstimate("termination", 0.99),
    terms=(Share("late", 9.0, 0.99, 0.99),),
    told=(Share("late", 9.0, 0.99, 0.99),),
    exceeds=None,
)
WAY = replace(LATER, foil=("exit-left",), way=True)

TROUBLE = (Share("time", 4.0), Share("effort", 1.0))

HIDING = (
    ("hidden", 1, "ahead"), ("hidden", None, "left"), ("hidden", None, "right"),
    ("may-go-first", 1, None),
)  # fmt: skip
OTHERS = (
    ((1,), (), False), ((1, 2), (), False), ((1,), (2, 3), False), ((1,), (2, 3), True),
    ((1,), (2, 3, 4, 5), True), ((1, 2), (3,), None),
)  # fmt: skip
BRAKED = Episode(E, "brake", 4.0, 8.0, speed_to=6.0)
LONG_AGO = Episode(E, "give-way", 4.0, 8.0, object=V)

SPED_UP = Episode(E, "speed-up", NOW - 2.0, speed_from=0.0, speed_to=8.0)
#: What held us up, and does no longer.
FREED = (
    MotionCause("light", shown=Shown(Feature("light"), "green", NOW - 3.0, True)),
    MotionCause("moved-on", 1),
    MotionCause("let-go", 1),
)

CASES: tuple[Answer, ...] = (
    Happenings("list", RIDE * 6),
    Happenings("summary", (RIDE[0], Episode(V, "brake", 2.1, 4.0), *RIDE[1:])),
    Happenings("summary", (RIDE[-1], Episode(V, "stand", 18.1))),
    Happenings("how-long", STOOD),
    Happenings("how-long", (RIDE[0], STOOD[1])),
    Happenings("when", STOOD),
    Happenings("when", (Episode(E, "exit-left", 26.0, 28.0),)),
    Identified((LORRY, BLUE, OTHER_BLUE, *MANY)),
    Identified((LORRY, BLUE)),
    Identified((replace(LORRY, in_view=False), BLUE, OTHER_BLUE)),
    Identified(tuple(look(n, NOW, "pedestrian", None, "ahead") for n in (4, 5))),
    Measures((Measure("weather", E, NOW, 1.0),)),
    Beliefs(1, None, ()),
    Bound(V),
    Bound(E, measures=(Measure("distance-to-go", E, NOW, gap="no-way"),)),
    Measures((Measure("time-to-go", E, NOW, gap="no-way"),)),
    Options((), 2.0, Evidence()),
    Verdict(Is("safe"), None),
    Priority(
        NOW, "none", limit=Measure("speed", E, NOW, 13.0, reference=13.9), blame=True, legal=True
    ),
    Priority(NOW, "give-way", 1, holds=False, claim=True),
    Priority(12.0, "priority", 1, first=E, holds=True),
    Priority(12.0, "give-way", 1, first=E, stood=True),
    Priority(NOW, "we-change", 1),
    Priority(NOW, "priority", 1, others=(2, 3), holds=True),
    Declined(Request(Event("do", tense="present"))),
    Declined(Request(Event("overtake", object=V)), cannot="there is no lane to the left"),
    OtherReason(1, Episode(V, "brake", 15.0, 17.0), causes=(replace(SLOW_BUS, vehicle=2), LEADER)),
    ChoiceReason(
        "why", CHANGED, replace(LATER, causation=Causation("both", (1, 2))), of_causes=True
    ),
    ChoiceReason("why", CHANGED, replace(LATER, causation=Causation("several", (1, 2, 3)))),
    MotionReason(
        SLOWED,
        (LEADER,),
        suspect=2,
        suspected="beside",
        besides=(3,),
        causation=Causation("either", (2, 3)),
        of_causes=True,
    ),
    MotionReason(SLOWED, (LEADER,), suspect=2, suspected="alone", causation=Causation("one", (2,))),
    ChoiceReason("why", CHANGED, LONG),
    SupposedOfUs(LONG),
    SupposedOfUs(QUICK, form="quicker"),
    ChoiceReason("why-not", None, LONG_BOTH),
    SupposedOfOther(
        1, None, 0.8, ("change-left",), ("continue",), same=False, contrast=LONG, form="quicker"
    ),
    MotionReason(SLOWED, (MotionCause("given-up", actions=("exit-right",)),)),
    ChoiceReason("why", CHANGED, WAY),
    ChoiceReason("why-not", None, WAY),
    ChoiceReason("why-not", None, replace(EFFORT, effects=LATER.effects, told=TROUBLE)),
    ChoiceReason("why", CHANGED, replace(ALONE, fact_collision=0.1)),
    ChoiceReason("why", CHANGED, MAY_BE_LATE),
    SupposedOfUs(MAY_BE_LATE),
    Happenings("summary", (RIDE[0], RIDE[2])),
    Happenings("summary", (RIDE[-1], Episode(E, "slow-down", 18.5))),
    GoReason(CHANGED, ()),
    GoReason(
        CHANGED,
        (
            CrossingVehicle(1, "vehicle", "slowing", 30.0, gone=True),
            CrossingVehicle(2, "vehicle", "standing", 20.0),
            CrossingVehicle(3, "ego", "slowing", 20.0),
        ),
        LATER,
    ),
    GoReason(None, (CrossingVehicle(2, "vehicle", "slowing", 20.0),), past=False),
    GoReason(None, (CrossingVehicle(2, "vehicle", "steady", 20.0),), past=False),
    GoReason(None, (CrossingVehicle(2, "depends", None, 90.0),), past=False),
    Unslowed(SLOWED, PRIORITY, 14.0, 14.5),
    Unslowed(SLOWED, PRIORITY, 14.0, 18.0),
    Unslowed(SLOWED, PRIORITY, 18.0, 14.0),
    Unslowed(SLOWED, LEADER, going=False),
    Unslowed(SLOWED, None),
    Identified((LORRY,), Is("stuck", V), (Measure("speed", V, NOW, 8.0),)),
    Located(E, (), (Measure("distance", E, NOW, 40.0, to=Junction(rank=1)),)),
    Located(E, (), (Measure("distance", E, NOW, 20.0, to=Exit(2)),)),
    Located(
        E,
        (),
        (
            Measure("distance", E, NOW, 2.0, to=Junction(rank=1)),
            Measure("lane", E, NOW, 1.0, side="left", count=2),
        ),
    ),
    Bound(
        E,
        measures=(
            Measure("turn", E, NOW, 60.0, side="right"),
            Measure("distance", E, NOW, 90.0, to=Junction("roundabout", 1)),
            Measure("exit-number", E, NOW, 2.0, count=4),
        ),
    ),
    Verdict(
        Happens(Event("turn", E, side="left", tense="future", modal="will")),
        None,
        (Measure("time", E, NOW, 26.0),),
        probability=0.97,
    ),
    Verdict(
        Happens(Event("turn", E, side="left", tense="future", modal="will")),
        None,
        (Measure("time", E, NOW, 26.0),),
        probability=0.97,
        either=True,
    ),
    Verdict(Happens(Event("wait", V)), True, (Episode(V, "wait", 12.0),)),
    SupposedOfOther(2, None, None, ("stop",), ("stop",), same=True, contrast=HOPELESS),
    SupposedOfOther(2, None, None, ("stop",), ("stop",), same=True, contrast=HOPELESS, past=False),
    SignalReason(1, BLINKED, ("exit-right", "change-right"), 0.3, TURNED_OFF),
    SignalReason(1, BLINKED, ("exit-right", "change-right"), 0.1),
    SignalReason(1, BLINKED, ("exit-right",)),
    SignalReason(1, Episode(V, "signal", 18.0, side="right"), ("exit-right",), 0.8),
    SignalReason(1, Episode(V, "signal", 18.0, side="right"), ("exit-right",), 0.3),
    PlaceReason(1, "ahead-of", Episode(V, "overtake", 8.0, 12.0, E)),
    PlaceReason(1, "ahead-of", Episode(E, "give-way", 8.0, 12.0, V)),
    PlaceReason(1, "behind"),
    MotionReason(
        Episode(E, "give-way", 8.0, 11.0), (MotionCause("right-of-way", 1),), asked="let-go"
    ),
    OwnSignal(Episode(E, "signal", 18.0, side="right"), "exit-right"),
    OwnSignal(Episode(E, "signal", 8.0, 10.0, side="left"), "change-left", came=False),
    OwnSignal(Episode(E, "signal", 8.0, 10.0, side="left"), None),
    ChoiceReason(
        "why",
        Episode(E, "change-left", 8.0, 11.0),
        HOPELESS,
        1,
        "main",
        ahead=MotionCause("leader", 1, speed=0.0),
    ),
    GoReason(
        Episode(E, "exit-right", 9.0, 11.0),
        (CrossingVehicle(1, "vehicle", gone=True),),
        refrained="wait",
    ),
    Declined(Request(Event("stop", tense="present")), soon=26.0),
    Declined(Request(Event("stop", tense="present")), soon=20.2),
    Declined(
        Request(Event("speed-up", tense="present")),
        doing=Activity(E, NOW, (), 8.0, "slowing"),
        already=True,
    ),
    Declined(
        Request(Event("speed-up", tense="present")),
        facts=(Measure("speed", E, NOW, 13.0, reference=13.9),),
    ),
    Declined(
        Request(Event("keep-distance", object=V, tense="present")),
        already=True,
        facts=(Measure("gap", E, NOW, 45.0, to=V),),
    ),
    Comforting(
        Feel("sick"),
        Comfort(Measure("deceleration", E, 9.0, 5.2, extreme="highest"), hard=True),
    ),
    Bound(V, None, TURNED_OFF, LORRY),
    Bound(V, None, TURNED_OFF, replace(LORRY, in_view=False, seen=14.0)),
    Bound(V, None, None, replace(LORRY, in_view=False, seen=14.0)),
    Bound(V, None, None, LORRY),
    Beliefs(
        1,
        Event("turn", V, side="right"),
        (UNSURE, EXPECTED),
        probability=0.78,
        time=8.0,
        turning=(4.0, 8.0),
        changed=True,
        besides=(Expectation(("continue",), 0.2),),
    ),
    Beliefs(
        1, Event("turn", V, side="right"), (UNSURE, EXPECTED), probability=0.78, time=8.0, since=8.0
    ),
    Verdict(
        Happens(Event("let-go", V, E, tense="future")),
        False,
        believed=(EXPECTED,),
        probability=0.04,
    ),
    Verdict(Is("wrong", V, tense="past"), False, (TURNED_OFF,)),
    Verdict(Related("can-see", E, V, tense="future"), None, (LORRY,), "in-future"),
    Verdict(Happens(Event("let-go", Nobody(), E, tense="present")), False),
    Measures(tuple(Measure("speed", Vehicle(n), NOW, 5.0 + n) for n in (1, 2, 3, 5))),
    Counted(Everyone(), 0, such=TURNERS),
    Counted(Everyone(), 2, (LORRY, BLUE), such=TURNERS),
    Counted(Everyone(), 7, such=TURNERS),
    Counted(Everyone("car"), 0, such=STANDERS),
    Counted(Everyone("car"), 2, (BLUE, OTHER_BLUE), such=STANDERS),
    Counted(Everyone("car"), 9, such=STANDERS, until=5.0),
    Verdict(FASTER, False, (Measure("speed", E, NOW, 5.0), Measure("speed", E, 5.0, 10.0))),
    SupposedOfUs(replace(LATER, foil=("continue",)), ahead=MotionCause("leader", 1)),
    OtherReason(1, Episode(V, "stand", 4.0), causes=(MotionCause("parked"),)),
    OtherReason(1, Episode(V, "move", 20.0, speed_to=1.7), causes=(MotionCause("starting"),)),
    OtherReason(1, None, Event("overtake", V), (MotionCause("limit", 0, speed=8.0, value=13.9),)),
    MotionReason(SLOWED, (LEADER,), suspect=2, suspected="either"),
    MotionReason(
        SLOWED, (LEADER,), causation=Causation("several", (1, 2, 3), minimal=False), of_causes=True
    ),
    *(
        ChoiceReason("why", CHANGED, LONG, suspect=suspect, suspected="same", past=past)
        for suspect in (2, 3)
        for past in (True, False)
    ),
    MotionReason(SLOWED, (LEADER,), suspect=3, suspected="neither"),
    MotionReason(SLOWED, (MotionCause("give-way-line", 2),), halted=9.0),
    Priority(NOW, "give-way", 1, grounds=True),
    Priority(NOW, "priority", 1, ring=True),
    Options(OPTIONS[:1], 2.0, Evidence(), risk=True),
    ChoiceReason("why-not", None, EFFORT, ahead=MotionCause("lane-beside", 3)),
    ChoiceReason(
        "why",
        Episode(E, "change-left", 8.0, 11.0),
        replace(EFFORT, foil=("continue",), verdict="close", causes=()),
        ahead=MotionCause("leader", 1, speed=8.0),
    ),
    *(
        SupposedSeeing((hider,) * present, NOW, ("continue",), ("continue",), saved, past)
        for hider in (Hider(1, "left", 0.1), Hider(None, "right", 0.04))
        for present in (0, 1)
        for saved in (0.0, 2.0)
        for past in (False, True)
    ),
    *(
        MotionReason(SLOWED, (MotionCause(kind, vehicle, side=side),))
        for kind, vehicle, side in HIDING
    ),
    *(
        NobodyElse(named, others, matter, NOW, past)
        for named, others, matter in OTHERS
        for past in (True, False)
    ),
    MotionReason(LONG_AGO, (MotionCause("right-of-way", 1),), asked="let-go"),
    MotionReason(LONG_AGO, (MotionCause("right-of-way", 1),), asked="slow-down"),
    MotionReason(BRAKED, (MotionCause("turn"),), premise=False, asked="wait"),
    *(
        MotionReason(SLOWED, (LEADER,), suspect=suspect, suspected=part, besides=besides)
        for suspect, besides in ((2, (3,)), (3, (1, 2)))
        for part in ("all", "some", "which", "all-alike")
    ),
    *(
        SupposedOfUs(one, past=past, form=form, struck=3, struck_risk=risk)
        for one, form, risk in (
            (LATER, "chance", 0.0),
            (replace(LATER, collision=0.3), "chance", 0.2),
            (replace(LATER, collision=0.3), "crash", 0.0),
            (LATER, "crash", 0.1),
            (LATER, "crash", 0.7),
        )
        for past in (True, False)
    ),
    SupposedOfUs(LATER, form="chance"),
    SupposedOfUs(replace(LATER, collision=0.3, collided_with=2), form="chance"),
    SupposedOfUs(replace(LATER, collision=0.3, fact_collision=0.05), form="chance"),
    *(
        ChoiceReason("why", CHANGED, replace(LATER, causation=mixed), past=past, of_causes=True)
        for mixed in (Causation("both", (1, 2), decides=False, alters=(2,)),)
        for past in (True, False)
    ),
    *(
        SupposedOfUs(one, form=form)
        for form in ("slower", "worse", "riskier")
        for one in (
            LATER,
            QUICK,
            replace(LATER, effects=(), verdict="close", told=()),
            replace(LATER, collision=0.3),
            replace(LATER, fact_collision=0.3),
            replace(LATER, collision=0.3, fact_collision=0.3),
            ends("collision", 0.8, 2),
        )
    ),
    *(
        one
        for cause in FREED
        for past in (False, True)
        for one in (
            MotionReason(SPED_UP, (cause,), asked="speed-up", past=past),
            GoReason(SPED_UP, (), None, past=past, freed=cause),
        )
    ),
    ChoiceReason(
        "why", CHANGED, replace(LATER, causation=Causation("several", (1, 2, 3))), of_causes=True
    ),
    *(
        Method(10.0, (replace(RISKS[0], collision=0.2), *others, replace(RISKS[1], close=True)))
        for others in ((), (RISKS[2],))
    ),
    SupposedOfUs(replace(LATER, fact_collision=0.3, verdict="close", told=())),
    SupposedOfUs(replace(LATER, fact_collision=0.3)),
    *(
        Options(
            (replace(OPTIONS[1], outcome=outcome, collision=risk, collided_with=2),),
            2.0,
            Evidence(),
            risk=True,
            earlier=earlier,
        )
        for outcome, risk in (("collision", 0.9), ("done", 0.2))
        for earlier in (True, False)
    ),
    *(
        ChoiceReason("why-not", None, replace(LONG, foil=("exit-left",), way=True), past=past)
        for past in (True, False)
    ),
    Identified((*WALKERS, BY_SIDE), facts=WALKING),
    Identified((*WALKERS, BY_SIDE), facts=WALKING[:1]),
    Identified(WALKERS, facts=WALKING),
    Located(Vehicle(20), (*WALKERS, BY_SIDE, LORRY)),
    Measures(
        tuple(
            Measure("distance", E, NOW, value=far, to=Vehicle(v))
            for v, far in ((1, 12.0), (2, 9.0), (3, 30.0), (20, 24.0))
        )
    ),
)
